// SPDX-License-Identifier: BSD-3-Clause
#include "io/pcd_reader.h"

#include "io/pcd_header.h"
#include "io/record_reader.h"
#include "io/text_scanner.h"

#include <pcl_pds_recon/options.h>

#include <lzf.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

namespace pds
{

namespace
{

[[noreturn]] void throw_truncated()
{
  throw InvalidInput("holds fewer data than its PCD header announces: the file is cut short; copy it again");
}

std::string ply_field_name(const std::string& name)
{
  constexpr std::array<std::pair<std::string_view, const char*>, 3> normals = {
      {{"normal_x", "nx"}, {"normal_y", "ny"}, {"normal_z", "nz"}}};
  for (const auto& [pcd_name, ply_name] : normals) {
    if (name == pcd_name) {
      return ply_name;
    }
  }
  return name;
}

/** PCL packs a colour as 0xAARRGGBB, lowest byte first. */
void append_color(const PcdField& field, std::size_t offset, std::vector<Column>& columns)
{
  constexpr std::array<std::pair<const char*, std::size_t>, 4> channels = {
      {{"red", 2}, {"green", 1}, {"blue", 0}, {"alpha", 3}}};
  for (const auto& [name, byte] : channels) {
    if (std::string_view(name) != "alpha" || field.name == "rgba") {
      columns.push_back({name, ScalarType::uint8, offset + byte});
    }
  }
}

/** The columns of one field that begins at \a offset of a record. */
void append_columns(const PcdField& field, std::size_t offset, std::vector<Column>& columns)
{
  constexpr std::size_t packed_color_bytes = 4;
  if (field.is_padding()) {
    return;
  }
  if ((field.name == "rgb" || field.name == "rgba") && field.bytes() == packed_color_bytes) {
    append_color(field, offset, columns);
    return;
  }
  const std::string name = ply_field_name(field.name);
  for (std::size_t i = 0; i < field.count; ++i) {
    const std::string number = field.count == 1 ? "" : "_" + std::to_string(i);
    columns.push_back({name + number, field.type, offset + i * size_of(field.type)});
  }
}

/** Records of all fields, padding included, one after the other. */
RecordLayout record_layout(const PcdHeader& header)
{
  RecordLayout layout;
  for (const PcdField& field : header.fields) {
    append_columns(field, layout.record_bytes, layout.columns);
    layout.record_bytes += field.bytes();
  }
  layout.begin = header.bytes;
  layout.count = header.points;
  return layout;
}

void parse_row(const std::vector<std::string_view>& words,
               const PcdHeader& header,
               std::size_t line_number,
               std::byte* record)
{
  std::size_t scalars = 0;
  for (const PcdField& field : header.fields) {
    scalars += field.count;
  }
  bool is_row = words.size() == scalars;
  auto word = words.begin();
  for (const PcdField& field : header.fields) {
    for (std::size_t i = 0; i < field.count && is_row; ++i, ++word) {
      visit_scalar(field.type, [&](auto scalar) {
        is_row = parse_scalar(*word, scalar);
        std::memcpy(record, &scalar, sizeof scalar);
        record += sizeof scalar;
      });
    }
  }
  if (!is_row) {
    throw InvalidInput("line " + std::to_string(line_number) + " of the data is not a row of " +
                       std::to_string(scalars) + " numbers; correct it");
  }
}

PointTable read_ascii(const ByteSource& source, const PcdHeader& header)
{
  const RecordLayout layout = record_layout(header);
  const std::string file = source.all();
  const std::string_view body = std::string_view(file).substr(header.bytes);
  if (header.points > body.size()) {  // before the memory is asked for: a damaged header may announce any number
    throw_truncated();
  }
  PointTable table = make_table(layout.columns, static_cast<std::size_t>(header.points));
  constexpr std::size_t block = 1024;  // rows; as many as stay in the cache
  std::vector<std::byte> records(block * layout.record_bytes);
  TextScanner scanner(body);
  std::string_view line;
  std::vector<std::string_view> words;
  for (std::size_t begin = 0; begin < table.size(); begin += block) {
    const std::size_t count = std::min(block, table.size() - begin);
    for (std::size_t row = 0; row < count;) {
      if (!scanner.next_line(line)) {
        throw_truncated();
      }
      split(line, " \t", words);
      if (!words.empty()) {
        parse_row(words, header, scanner.line_number(), records.data() + layout.record_bytes * row++);
      }
    }
    copy_records(records.data(), layout, count, table, begin);
  }
  std::string_view token;
  if (scanner.next_token(token)) {
    throw_data_after_points();
  }
  return table;
}

PointTable read_binary(const ByteSource& source, const PcdHeader& header, const Parallel& parallel)
{
  const RecordLayout layout = record_layout(header);
  if (layout.count > (source.size() - layout.begin) / layout.record_bytes) {
    throw_truncated();
  }
  if (has_data_after_points(layout, source.size())) {
    throw_data_after_points();
  }
  return read_records(source, layout, parallel);
}

/** What compressed data hold: field by field, the scalars of all points. Padding is left out. */
std::string decompress(const ByteSource& source, const PcdHeader& header)
{
  std::array<std::uint32_t, 2> sizes{};
  if (source.size() - header.bytes < sizeof sizes) {
    throw_truncated();
  }
  source.read(header.bytes, sizes.data(), sizeof sizes);
  const auto [compressed_bytes, bytes] = sizes;
  const std::size_t begin = header.bytes + sizeof sizes;
  std::uint64_t record_bytes = 0;
  for (const PcdField& field : header.fields) {
    record_bytes += field.is_padding() ? 0 : field.bytes();
  }
  if (compressed_bytes > source.size() - begin || record_bytes == 0 || header.points > bytes / record_bytes) {
    throw_truncated();
  }
  constexpr std::uint64_t greatest_compression = 88;  // a match of LZF copies at most 264 bytes and takes three
  if (bytes > greatest_compression * compressed_bytes) {
    throw InvalidInput("holds compressed data of an impossible size: the file is damaged; write it again");
  }
  if (header.points < bytes / record_bytes) {  // where a field begins depends on the number of points
    throw InvalidInput("holds compressed data of more points than its PCD header announces; write it again");
  }
  std::string compressed(compressed_bytes, '\0');
  source.read(begin, compressed.data(), compressed.size());
  std::string data(bytes, '\0');
  if (lzf_decompress(compressed.data(), compressed_bytes, data.data(), bytes) != bytes) {
    throw InvalidInput("holds compressed data that cannot be unpacked: the file is damaged; write it again");
  }
  return data;
}

PointTable read_compressed(const ByteSource& source, const PcdHeader& header, const Parallel& parallel)
{
  const std::string data = decompress(source, header);
  PointTable table = make_table(record_layout(header).columns, static_cast<std::size_t>(header.points));
  const auto* begin = reinterpret_cast<const std::byte*>(data.data());
  constexpr std::size_t block = std::size_t{1} << 14;  // rows; some hundred microseconds
  for (const PcdField& field : header.fields) {
    if (field.is_padding()) {
      continue;
    }
    RecordLayout layout;
    append_columns(field, 0, layout.columns);
    layout.record_bytes = field.bytes();
    parallel.blocks(table.size(), block, [&](std::size_t first, std::size_t last, unsigned) {
      copy_records(begin + first * layout.record_bytes, layout, last - first, table, first);
    });
    begin += table.size() * layout.record_bytes;
  }
  return table;
}

}  // namespace

PointTable read_pcd(const ByteSource& source, const Parallel& parallel)
{
  const PcdHeader header = parse_pcd_header(source.head_through_line("DATA"));
  PointTable table = header.encoding == PcdEncoding::ascii    ? read_ascii(source, header)
                     : header.encoding == PcdEncoding::binary ? read_binary(source, header, parallel)
                                                              : read_compressed(source, header, parallel);
  table.sensor_origin = header.sensor_origin;
  return table;
}

}  // namespace pds
