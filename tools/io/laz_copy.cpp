// SPDX-License-Identifier: BSD-3-Clause
#include "io/laz_copy.h"

#include "io/las_records.h"
#include "io/laszip_record.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>
#include <optional>
#include <vector>

namespace pds
{

namespace
{

/** The records that tell how the points are packed, with their heads. */
std::vector<LasRecord> find_kept_records(const ByteSource& source, const LasHeader& header)
{
  std::vector<LasRecord> kept;
  for (const auto& [user, id] :
       {std::pair(laszip_user, laszip_record_id), std::pair(las_user, extra_bytes_record_id)}) {
    if (const std::optional<LasRecord> record = find_las_record(source, header, user, id)) {
      kept.push_back({record->begin - las_record_head_bytes, record->bytes + las_record_head_bytes});
    }
  }
  return kept;
}

template <typename Number>
void put(std::string& bytes, std::size_t place, Number number)
{
  std::memcpy(&bytes[place], &number, sizeof number);
}

}  // namespace

LazCopy::MemoryFile::MemoryFile() : descriptor(memfd_create("pcl_pds_recon.laz", MFD_CLOEXEC))
{
  if (descriptor < 0) {
    throw std::bad_alloc();
  }
}

LazCopy::MemoryFile::~MemoryFile() { close(descriptor); }

LazCopy::LazCopy(const ByteSource& source, const LazParts& parts)
{
  const LasHeader& header = parts.header;
  const std::vector<LasRecord> records = find_kept_records(source, header);
  const std::size_t table_end = header.end > parts.table_at ? header.end : source.size();
  std::size_t table_at = header.header_bytes;
  for (const LasRecord& record : records) {
    table_at += record.bytes;
  }
  std::string head = source.head(header.header_bytes);
  put(head, las_begin_at, static_cast<std::uint32_t>(table_at + table_end - parts.table_at));
  put(head, las_record_count_at, static_cast<std::uint32_t>(records.size()));
  if (head.size() >= las_header_bytes_1_4) {
    put(head, las_extended_record_count_at, std::uint32_t{0});
    put(head, las_count_at, header.count);  // which may have come from the legacy count
  }
  append(head.data(), head.size());
  for (const LasRecord& record : records) {
    append(source, record.begin, record.begin + record.bytes);
  }
  append(source, parts.table_at, table_end);
  const auto place = static_cast<std::int64_t>(table_at);
  append(&place, sizeof place);
  append(source, header.begin + sizeof place, parts.table_at);
}

void LazCopy::drop_last_byte() const
{
  const off_t size = lseek(file_.descriptor, 0, SEEK_END);
  if (size <= 0 || ftruncate(file_.descriptor, size - 1) != 0) {
    throw std::bad_alloc();
  }
}

void LazCopy::append(const void* bytes, std::size_t size) const
{
  const char* place = static_cast<const char*>(bytes);
  while (size > 0) {
    const ssize_t count = write(file_.descriptor, place, size);
    if (count < 0 && errno != EINTR) {
      throw std::bad_alloc();
    }
    place += std::max<ssize_t>(count, 0);
    size -= static_cast<std::size_t>(std::max<ssize_t>(count, 0));
  }
}

void LazCopy::append(const ByteSource& source, std::size_t begin, std::size_t end) const
{
  std::vector<char> block(std::min(end - begin, std::size_t{1} << 20));
  while (begin < end) {
    const std::size_t size = std::min(block.size(), end - begin);
    source.read(begin, block.data(), size);
    append(block.data(), size);
    begin += size;
  }
}

}  // namespace pds
