// SPDX-License-Identifier: BSD-3-Clause
#include "io/laz_check.h"

#include "io/las_header.h"
#include "io/las_records.h"

#include <pcl_pds_recon/options.h>

#include <cstdint>
#include <limits>
#include <optional>

namespace pds
{

namespace
{

constexpr std::uint32_t variable_chunks = std::numeric_limits<std::uint32_t>::max();

[[noreturn]] void throw_truncated()
{
  throw InvalidInput("holds fewer data than its LAZ header announces: the file is cut short; copy it again");
}

template <typename Number>
Number read_number(const ByteSource& source, std::uint64_t place)
{
  Number number{};
  if (place > source.size() || source.size() - place < sizeof number) {
    throw_truncated();
  }
  source.read(static_cast<std::size_t>(place), &number, sizeof number);
  return number;
}

/** Points in a chunk, from the record that LASzip leaves in the header. */
std::uint32_t find_chunk_size(const ByteSource& source, const LasHeader& header)
{
  constexpr std::uint16_t laszip_record = 22204;
  constexpr std::size_t chunk_size_at = 12;
  const std::optional<LasRecord> record = find_las_record(source, header, "laszip encoded", laszip_record);
  if (!record) {
    throw InvalidInput("has no LASzip record in its header: the file is damaged or no LAZ; write it again");
  }
  return read_number<std::uint32_t>(source, record->begin + chunk_size_at);
}

}  // namespace

void check_laz(const ByteSource& source)
{
  const LasHeader header = read_las_header(source, LasCompression::laszip);
  const std::uint32_t chunk_size = find_chunk_size(source, header);
  const auto table_at = read_number<std::int64_t>(source, header.begin);
  const bool is_table_at_end = table_at == -1;  // the writer could not seek back
  if (chunk_size == variable_chunks || is_table_at_end) {
    return;
  }
  constexpr std::uint64_t version_bytes = 4;
  const auto chunks = read_number<std::uint32_t>(source, static_cast<std::uint64_t>(table_at) + version_bytes);
  if (header.count > std::uint64_t{chunks} * chunk_size) {
    throw_truncated();
  }
}

}  // namespace pds
