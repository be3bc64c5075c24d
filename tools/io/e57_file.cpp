// SPDX-License-Identifier: BSD-3-Clause
#include "io/e57_file.h"

#include "io/number_at.h"

#include <pcl_pds_recon/options.h>

#include <algorithm>

namespace pds
{

namespace
{

constexpr std::uint64_t page_bytes = 1024;
constexpr std::uint64_t page_content = page_bytes - 4;  // the rest is the checksum

// ASTM E2807, table 1: places in the header.
constexpr std::size_t file_bytes_at = 16;
constexpr std::size_t description_at = 24;
constexpr std::size_t description_bytes_at = 32;
constexpr std::size_t page_bytes_at = 40;
constexpr std::size_t header_bytes = 48;

[[noreturn]] void throw_cut_short()
{
  throw InvalidInput("holds fewer data than its E57 header announces: the file is cut short or damaged; copy it again");
}

}  // namespace

E57File::E57File(const ByteSource& source) : source_(source)
{
  const std::string header = source.head(header_bytes);
  if (header.compare(0, 8, "ASTM-E57") != 0) {
    throw InvalidInput("is not an E57 file, which starts with 'ASTM-E57'; check the file's extension");
  }
  if (header.size() < header_bytes || number_at<std::uint64_t>(&header[file_bytes_at]) > source.size()) {
    throw_cut_short();
  }
  if (number_at<std::uint64_t>(&header[file_bytes_at]) < source.size()) {
    throw InvalidInput("is longer than its E57 header announces: the file is damaged; copy it again");
  }
  if (number_at<std::uint64_t>(&header[page_bytes_at]) != page_bytes || source.size() % page_bytes != 0) {
    throw InvalidInput("has an E57 header with an impossible size of pages: the file is damaged; copy it again");
  }
  bytes_ = source.size() / page_bytes * page_content;
}

void E57File::read(std::uint64_t place, void* target, std::size_t size) const
{
  if (place > bytes_ || size > bytes_ - place) {
    throw_cut_short();
  }
  auto* bytes = static_cast<char*>(target);
  while (size > 0) {
    const std::uint64_t in_page = place % page_content;
    const std::size_t count = std::min<std::size_t>(size, page_content - in_page);
    source_.read(place / page_content * page_bytes + in_page, bytes, count);
    bytes += count;
    place += count;
    size -= count;
  }
}

std::uint64_t E57File::logical(std::uint64_t physical)
{
  return physical / page_bytes * page_content + physical % page_bytes;
}

std::string E57File::description() const
{
  const std::string header = source_.head(header_bytes);
  const auto size = number_at<std::uint64_t>(&header[description_bytes_at]);
  if (size > bytes_) {  // before the memory is asked for
    throw_cut_short();
  }
  std::string text(size, '\0');
  read(logical(number_at<std::uint64_t>(&header[description_at])), text.data(), text.size());
  return text;
}

}  // namespace pds
