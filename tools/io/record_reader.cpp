// SPDX-License-Identifier: BSD-3-Clause
#include "io/record_reader.h"

#include <pcl_pds_recon/options.h>

#include <algorithm>
#include <cstring>

namespace pds
{

namespace
{

/** Bytes that a thread reads at a time: they stay in its cache until they are in the table. */
constexpr std::size_t block_bytes = std::size_t{1} << 18;

template <typename Scalar>
void reverse_bytes(std::byte* scalars, std::size_t stride, std::size_t count)
{
  for (std::size_t i = 0; i < count; ++i) {
    std::reverse(scalars + i * stride, scalars + i * stride + sizeof(Scalar));
  }
}

void make_native(std::byte* records, const RecordLayout& layout, std::size_t count)
{
  if (layout.order == boost::endian::order::native) {
    return;
  }
  for (const Column& column : layout.columns) {
    visit_scalar(column.type, [&](auto zero) {
      reverse_bytes<decltype(zero)>(records + column.offset, layout.record_bytes, count);
    });
  }
}

template <typename Source, typename Target>
void copy_scalars(
    const std::byte* source, std::size_t source_stride, std::byte* target, std::size_t target_stride, std::size_t count)
{
  for (std::size_t i = 0; i < count; ++i) {
    Source scalar;
    std::memcpy(&scalar, source + i * source_stride, sizeof scalar);
    const auto converted = static_cast<Target>(scalar);  // NOLINT(bugprone-signed-char-misuse): a number, no letter
    std::memcpy(target + i * target_stride, &converted, sizeof converted);
  }
}

void copy_column(const std::byte* records,
                 const RecordLayout& layout,
                 const Column& column,
                 std::size_t count,
                 PointTable& table,
                 std::size_t row)
{
  const Field& field = *table.find(column.name);
  const std::byte* source = records + column.offset;
  std::byte* target = table.record(row) + field.offset;
  visit_scalar(column.type, [&](auto source_zero) {
    visit_scalar(field.type, [&](auto target_zero) {
      copy_scalars<decltype(source_zero), decltype(target_zero)>(source, layout.record_bytes, target,
                                                                 table.record_bytes(), count);
    });
  });
}

/** Whether the records of the file lie as those of the table do. */
bool is_same_layout(const RecordLayout& layout, const PointTable& table)
{
  return layout.record_bytes == table.record_bytes() &&
         std::all_of(layout.columns.begin(), layout.columns.end(), [&table](const Column& column) {
           const Field& field = *table.find(column.name);
           return field.offset == column.offset && field.type == column.type;
         });
}

}  // namespace

void throw_data_after_points()
{
  throw InvalidInput(
      "goes on after the last point that its header announces: the number of points there is wrong, or its writer was "
      "stopped; write it again");
}

bool has_data_after_points(const RecordLayout& layout, std::size_t end)
{
  return end >= layout.begin && layout.record_bytes > 0 && (end - layout.begin) / layout.record_bytes > layout.count;
}

PointTable make_table(const std::vector<Column>& columns, std::size_t size)
{
  std::vector<Field> fields;
  fields.reserve(columns.size());
  for (const Column& column : columns) {
    fields.push_back({column.name, column.type});
  }
  return PointTable(std::move(fields), size);
}

void copy_records(
    const std::byte* records, const RecordLayout& layout, std::size_t count, PointTable& table, std::size_t row)
{
  for (const Column& column : layout.columns) {
    copy_column(records, layout, column, count, table, row);
  }
}

PointTable read_records(const ByteSource& source, const RecordLayout& layout, const Parallel& parallel)
{
  PointTable table = make_table(layout.columns, static_cast<std::size_t>(layout.count));
  const bool is_same = is_same_layout(layout, table);
  std::vector<std::vector<std::byte>> buffers(parallel.threads());
  const std::size_t block = std::max<std::size_t>(1, block_bytes / layout.record_bytes);
  parallel.blocks(table.size(), block, [&](std::size_t begin, std::size_t end, unsigned worker) {
    const std::size_t bytes = (end - begin) * layout.record_bytes;
    if (!is_same) {
      buffers[worker].resize(bytes);
    }
    std::byte* records = is_same ? table.record(begin) : buffers[worker].data();
    source.read(layout.begin + begin * layout.record_bytes, records, bytes);
    make_native(records, layout, end - begin);
    if (!is_same) {
      copy_records(records, layout, end - begin, table, begin);
    }
  });
  return table;
}

}  // namespace pds
