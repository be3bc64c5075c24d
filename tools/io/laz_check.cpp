// SPDX-License-Identifier: BSD-3-Clause
#include "io/laz_check.h"

#include "io/las_records.h"
#include "io/laszip_record.h"
#include "io/record_reader.h"

#include <pcl_pds_recon/options.h>

#include <cstdint>
#include <string>
#include <vector>

namespace pds
{

namespace
{

[[noreturn]] void throw_truncated()
{
  throw InvalidInput("holds fewer data than its LAZ header announces: the file is cut short; copy it again");
}

[[noreturn]] void throw_contradiction(const std::string& what)
{
  throw InvalidInput("contradicts itself in " + what + ": the file is damaged; copy it again");
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

std::size_t find_table(const ByteSource& source, const LasHeader& header)
{
  constexpr std::size_t place_bytes = sizeof(std::int64_t);
  auto place = read_number<std::int64_t>(source, header.begin);
  if (place == -1) {  // the writer could not seek back, and has left it at the end of the file
    place = read_number<std::int64_t>(source, source.size() - place_bytes);
  }
  if (place < static_cast<std::int64_t>(header.begin + place_bytes)) {
    throw_contradiction("where the table of its chunks lies");
  }
  return static_cast<std::size_t>(place);
}

/** Chunks of one size, only the last of which may be smaller. */
void check_count(const LasHeader& header, std::uint32_t chunk_size, std::uint64_t chunks)
{
  if (header.count > chunks * chunk_size) {
    throw_truncated();
  }
  if (chunks > 0 && header.count <= (chunks - 1) * chunk_size) {
    throw_contradiction("the number of its points");
  }
}

/** The number of points that the chunks say they hold, each behind its first point. */
std::uint64_t count_points(const ByteSource& source,
                           const LazParts& parts,
                           std::uint32_t chunk_size,
                           std::uint64_t chunks)
{
  const LasHeader& header = parts.header;
  const std::size_t layers = laszip_layers(header);
  std::uint64_t points = 0;
  std::size_t place = header.begin + sizeof(std::int64_t);
  for (std::uint64_t chunk = 0; chunk < chunks; ++chunk) {
    std::vector<std::uint32_t> head(1 + layers);  // the number of points, and the bytes of each layer
    const std::size_t head_bytes = head.size() * sizeof head.front();
    if (parts.table_at - place < header.record_bytes + head_bytes) {
      throw_contradiction("the size of its chunks");
    }
    source.read(place + header.record_bytes, head.data(), head_bytes);
    place += header.record_bytes + head_bytes;
    points += head.front();
    if (chunk_size != variable_chunk_size && chunk + 1 < chunks && head.front() != chunk_size) {
      throw_contradiction("the size of its chunks");
    }
    for (std::size_t layer = 1; layer < head.size(); ++layer) {
      if (head[layer] > parts.table_at - place) {
        throw_contradiction("the size of its chunks");
      }
      place += head[layer];
    }
  }
  if (place != parts.table_at) {
    throw_contradiction("the size of its chunks");
  }
  return points;
}

}  // namespace

LazParts check_laz(const ByteSource& source)
{
  LazParts parts;
  parts.header = read_las_header(source, LasCompression::laszip);
  const LasHeader& header = parts.header;
  check_extended_records(source, header);
  const LaszipRecord record = read_laszip_record(source, header);
  parts.table_at = find_table(source, header);
  constexpr std::size_t version_bytes = 4;
  const auto chunks = read_number<std::uint32_t>(source, std::uint64_t{parts.table_at} + version_bytes);
  if (chunks > (parts.table_at - header.begin) / header.record_bytes) {  // each begins with a point as it is
    throw_truncated();
  }
  if (record.chunk_size != variable_chunk_size) {
    check_count(header, record.chunk_size, chunks);
  }
  if (header.point_format >= first_layered_format) {
    const std::uint64_t points = count_points(source, parts, record.chunk_size, chunks);
    if (header.count > points) {
      throw_truncated();
    }
    if (header.count < points) {
      throw_data_after_points();
    }
  }
  return parts;
}

}  // namespace pds
