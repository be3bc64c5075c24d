// SPDX-License-Identifier: BSD-3-Clause
#include "io/las_records.h"

#include "io/number_at.h"

#include <pcl_pds_recon/options.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace pds
{

std::optional<LasRecord> find_las_record(const ByteSource& source,
                                         const LasHeader& header,
                                         std::string_view user,
                                         std::uint16_t id)
{
  constexpr std::size_t user_at = 2;
  constexpr std::size_t user_bytes = 16;
  constexpr std::size_t id_at = 18;
  constexpr std::size_t length_at = 20;
  std::size_t place = header.header_bytes;
  for (std::uint32_t i = 0; i < header.record_count; ++i) {
    std::array<char, las_record_head_bytes> head{};
    if (place + las_record_head_bytes > header.begin) {
      throw InvalidInput(
          "has a LAS header with records that reach into the points: the file is damaged; copy it again");
    }
    source.read(place, head.data(), las_record_head_bytes);
    place += las_record_head_bytes;
    const std::size_t length = number_at<std::uint16_t>(&head[length_at]);
    const std::string_view found_user(&head[user_at], strnlen(&head[user_at], user_bytes));
    if (number_at<std::uint16_t>(&head[id_at]) == id && found_user == user) {
      return LasRecord{place, std::min(length, header.begin - place)};
    }
    place += length;
  }
  return std::nullopt;
}

void check_extended_records(const ByteSource& source, const LasHeader& header)
{
  constexpr std::size_t head_bytes = 60;
  constexpr std::size_t length_at = 20;
  std::uint64_t place = header.extended_begin;
  for (std::uint32_t i = 0; i < header.extended_count; ++i) {
    std::uint64_t length = 0;
    const bool has_head = place <= source.size() && head_bytes <= source.size() - place;
    if (has_head) {
      source.read(static_cast<std::size_t>(place) + length_at, &length, sizeof length);
      place += head_bytes;
    }
    if (!has_head || length > source.size() - place) {
      throw InvalidInput(
          "has a LAS header with extended records that are not there: the file is cut short or damaged; copy it again");
    }
    place += length;
  }
}

}  // namespace pds
