// SPDX-License-Identifier: BSD-3-Clause
#include "io/las_reader.h"

#include "io/color_depth.h"
#include "io/las_bounds.h"
#include "io/las_extra_bytes.h"
#include "io/las_header.h"
#include "io/las_layout.h"
#include "io/las_records.h"
#include "io/number_at.h"
#include "io/record_reader.h"
#include "io/sentence_list.h"

#include <array>
#include <cstring>
#include <functional>
#include <mutex>

namespace pds
{

namespace
{

constexpr double scan_angle_unit = 0.006;  // degrees; of formats 6 to 10

/** Some records of the file, and the rows that they become. */
struct Block
{
  const std::byte* records;
  std::size_t record_bytes;
  std::size_t begin, end;

  [[nodiscard]] std::size_t size() const { return end - begin; }
  [[nodiscard]] const std::byte* operator[](std::size_t i) const { return records + i * record_bytes; }
};

/** The blocks of all records, read by several threads. */
void for_each_block(const ByteSource& source,
                    const LasHeader& header,
                    const Parallel& parallel,
                    const std::function<void(const Block& block)>& body)
{
  constexpr std::size_t block_records = std::size_t{1} << 13;  // records; they stay in the cache
  std::vector<std::vector<std::byte>> buffers(parallel.threads());
  parallel.blocks(static_cast<std::size_t>(header.count), block_records,
                  [&](std::size_t begin, std::size_t end, unsigned worker) {
                    std::vector<std::byte>& buffer = buffers[worker];
                    buffer.resize((end - begin) * header.record_bytes);
                    source.read(header.begin + begin * header.record_bytes, buffer.data(), buffer.size());
                    body({buffer.data(), header.record_bytes, begin, end});
                  });
}

ColorDepth survey_colors(const ByteSource& source,
                         const LasHeader& header,
                         std::size_t color_at,
                         const Parallel& parallel)
{
  ColorDepth depth;
  std::mutex mutex;
  for_each_block(source, header, parallel, [&](const Block& block) {
    ColorDepth block_depth;
    for (std::size_t i = 0; i < block.size(); ++i) {
      for (const std::uint16_t channel : number_at<std::array<std::uint16_t, 3>>(block[i] + color_at)) {
        block_depth.add(channel);
      }
    }
    const std::lock_guard<std::mutex> lock(mutex);
    depth.add(block_depth);
  });
  return depth;
}

std::vector<Field> standard_fields(const LasLayout& layout, std::uint16_t divisor)
{
  std::vector<Field> fields = {{"x", ScalarType::float64}, {"y", ScalarType::float64}, {"z", ScalarType::float64}};
  for (const Column& column : layout.columns) {
    fields.push_back({column.name, column.type});
  }
  for (const Bits& bits : layout.bits) {
    fields.push_back({bits.name, ScalarType::uint8});
  }
  if (layout.scan_angle_at != 0) {
    fields.push_back({"scan_angle", ScalarType::float32});
  }
  for (const char* name : color_fields) {
    if (layout.has_color()) {
      fields.push_back({name, divisor == 0 ? ScalarType::uint16 : ScalarType::uint8});
    }
  }
  return fields;
}

std::vector<std::string> names_of(const std::vector<Field>& fields)
{
  std::vector<std::string> names;
  names.reserve(fields.size());
  for (const Field& field : fields) {
    names.push_back(field.name);
  }
  return names;
}

/** Calls \a convert for every record of a block and stores what it gives as the field \a name. */
template <typename Convert>
void fill(PointTable& table, const std::string& name, const Block& block, const Convert& convert)
{
  const std::size_t offset = table.find(name)->offset;
  for (std::size_t i = 0; i < block.size(); ++i) {
    const auto scalar = convert(block[i]);
    std::memcpy(table.record(block.begin + i) + offset, &scalar, sizeof scalar);
  }
}

void fill_coordinates(PointTable& table, const LasHeader& header, const Block& block)
{
  for (std::size_t axis = 0; axis < header.scale.size(); ++axis) {
    const double scale = header.scale[axis];
    const double offset = header.offset[axis];
    fill(table, table.fields()[axis].name, block, [=](const std::byte* record) {
      return scale * number_at<std::int32_t>(record + axis * sizeof(std::int32_t)) + offset;
    });
  }
}

void fill_bits(PointTable& table, const LasLayout& layout, const Block& block)
{
  for (const Bits& bits : layout.bits) {
    const unsigned mask = (1U << bits.width) - 1;
    fill(table, bits.name, block, [&](const std::byte* record) {
      return static_cast<std::uint8_t>(std::to_integer<unsigned>(record[bits.offset]) >> bits.shift & mask);
    });
  }
}

void fill_scan_angle(PointTable& table, const LasLayout& layout, const Block& block)
{
  fill(table, "scan_angle", block, [&](const std::byte* record) {
    return static_cast<float>(number_at<std::int16_t>(record + layout.scan_angle_at) * scan_angle_unit);
  });
}

void fill_colors(PointTable& table, const LasLayout& layout, std::uint16_t divisor, const Block& block)
{
  std::size_t place = layout.color_at;
  for (const char* name : color_fields) {
    if (divisor == 0) {
      fill(table, name, block, [=](const std::byte* record) { return number_at<std::uint16_t>(record + place); });
    } else {
      fill(table, name, block, [=](const std::byte* record) {
        return static_cast<std::uint8_t>(number_at<std::uint16_t>(record + place) / divisor);
      });
    }
    place += sizeof(std::uint16_t);
  }
}

void fill_scaled(PointTable& table, const ExtraScalar& scalar, const Block& block)
{
  visit_scalar(scalar.column.type, [&](auto zero) {
    fill(table, scalar.column.name, block, [&](const std::byte* record) {
      return scalar.scale * static_cast<double>(number_at<decltype(zero)>(record + scalar.column.offset)) +
             scalar.offset;
    });
  });
}

std::string what_is_not_read(const LasHeader& header, const ExtraBytes& extra)
{
  std::vector<std::string> names;
  if (las_has_waveforms(header.point_format)) {
    names.emplace_back("waveforms");
  }
  if (!extra.is_complete) {
    names.emplace_back(extra.scalars.empty() ? "extra bytes" : "some of the extra bytes");
  }
  return sentence_list(names);
}

}  // namespace

PointTable read_las(const ByteSource& source, const Parallel& parallel)
{
  const LasHeader header = read_las_header(source, LasCompression::none);
  check_extended_records(source, header);
  const LasLayout layout = las_layout(header.point_format);
  const std::uint16_t divisor =
      layout.has_color() ? survey_colors(source, header, layout.color_at, parallel).divisor() : std::uint16_t{0};
  std::vector<Field> fields = standard_fields(layout, divisor);
  const ExtraBytes extra = read_extra_bytes(source, header, names_of(fields));
  RecordLayout plain;
  plain.columns = layout.columns;
  plain.record_bytes = header.record_bytes;
  for (const ExtraScalar& scalar : extra.scalars) {
    fields.push_back({scalar.column.name, scalar.is_scaled ? ScalarType::float64 : scalar.column.type});
    if (!scalar.is_scaled) {
      plain.columns.push_back(scalar.column);
    }
  }
  PointTable table(std::move(fields), static_cast<std::size_t>(header.count));
  table.not_read = what_is_not_read(header, extra);
  for_each_block(source, header, parallel, [&](const Block& block) {
    fill_coordinates(table, header, block);
    copy_records(block.records, plain, block.size(), table, block.begin);
    fill_bits(table, layout, block);
    for (const ExtraScalar& scalar : extra.scalars) {
      if (scalar.is_scaled) {
        fill_scaled(table, scalar, block);
      }
    }
    if (layout.scan_angle_at != 0) {
      fill_scan_angle(table, layout, block);
    }
    if (layout.has_color()) {
      fill_colors(table, layout, divisor, block);
    }
  });
  check_las_bounds(header, table, parallel);
  return table;
}

}  // namespace pds
