// SPDX-License-Identifier: BSD-3-Clause
#include "io/laszip_record.h"

#include "io/las_records.h"
#include "io/number_at.h"

#include <pcl_pds_recon/options.h>

#include <array>
#include <optional>
#include <string>

namespace pds
{

namespace
{

/** Parts of a point that LASzip packs one by one, under its own numbers (LASzip specification, table 4). */
enum class Item : std::uint16_t
{
  byte = 0,
  point10 = 6,
  gps_time11 = 7,
  rgb12 = 8,
  wave_packet13 = 9,
  point14 = 10,
  rgb14 = 11,
  rgb_nir14 = 12,
  wave_packet14 = 13,
  byte14 = 14,
  none = 0xFFFF
};

/** The items of each point format, before the extra bytes. */
using Items = std::array<Item, 4>;
constexpr std::array<Items, 11> standard_items = {{{Item::point10, Item::none, Item::none, Item::none},
                                                   {Item::point10, Item::gps_time11, Item::none, Item::none},
                                                   {Item::point10, Item::rgb12, Item::none, Item::none},
                                                   {Item::point10, Item::gps_time11, Item::rgb12, Item::none},
                                                   {Item::point10, Item::gps_time11, Item::wave_packet13, Item::none},
                                                   {Item::point10, Item::gps_time11, Item::rgb12, Item::wave_packet13},
                                                   {Item::point14, Item::none, Item::none, Item::none},
                                                   {Item::point14, Item::rgb14, Item::none, Item::none},
                                                   {Item::point14, Item::rgb_nir14, Item::none, Item::none},
                                                   {Item::point14, Item::wave_packet14, Item::none, Item::none},
                                                   {Item::point14, Item::rgb_nir14, Item::wave_packet14, Item::none}}};

/** Whether the items of the record, a type, a size and a version each, are those of the points in the header. */
bool has_items_of(const LasHeader& header, const std::string& items)
{
  constexpr std::size_t item_bytes = 6;
  constexpr std::size_t size_at = 2;
  std::size_t bytes = 0;
  std::size_t count = 0;
  const Items& expected = standard_items.at(header.point_format);
  for (std::size_t place = 0; place < items.size(); place += item_bytes, ++count) {
    const auto type = number_at<Item>(&items[place]);
    const bool is_extra = type == Item::byte || type == Item::byte14;
    const Item wanted = count < expected.size() ? expected[count] : Item::none;
    if (is_extra ? wanted != Item::none : type != wanted) {
      return false;
    }
    bytes += number_at<std::uint16_t>(&items[place + size_at]);
  }
  return bytes == header.record_bytes && (count >= expected.size() || expected[count] == Item::none);
}

}  // namespace

LaszipRecord read_laszip_record(const ByteSource& source, const LasHeader& header)
{
  constexpr std::uint16_t chunks_of_points = 2;  // kinds of packing; that of before LASzip 2.0 is another
  constexpr std::uint16_t chunks_of_layers = 3;
  constexpr std::size_t chunk_size_at = 12;
  constexpr std::size_t item_count_at = 32;
  constexpr std::size_t items_at = 34;
  constexpr std::size_t item_bytes = 6;
  const std::optional<LasRecord> place = find_las_record(source, header, laszip_user, laszip_record_id);
  if (!place) {
    throw InvalidInput("has no LASzip record in its header: the file is damaged or no LAZ; write it again");
  }
  std::string bytes(place->bytes, '\0');
  source.read(place->begin, bytes.data(), bytes.size());
  if (bytes.size() < items_at ||
      bytes.size() - items_at < item_bytes * number_at<std::uint16_t>(&bytes[item_count_at])) {
    throw InvalidInput("has a LASzip record that is cut short: the file is damaged; copy it again");
  }
  const bool has_layers = header.point_format >= first_layered_format;
  if (number_at<std::uint16_t>(bytes.data()) != (has_layers ? chunks_of_layers : chunks_of_points)) {
    throw InvalidInput("is packed in a way that PDAL does not know, or damaged; write it anew");
  }
  const std::size_t items_bytes = item_bytes * number_at<std::uint16_t>(&bytes[item_count_at]);
  if (!has_items_of(header, bytes.substr(items_at, items_bytes))) {
    throw InvalidInput("has a LASzip record of other points than its header: the file is damaged; copy it again");
  }
  return {number_at<std::uint32_t>(&bytes[chunk_size_at])};
}

std::size_t laszip_layers(const LasHeader& header)
{
  constexpr std::size_t point_layers = 9;  // xy, z, class, flags, intensity, angle, user data, source, time
  std::size_t layers = point_layers + header.record_bytes - las_standard_bytes(header.point_format);
  for (const Item item : standard_items.at(header.point_format)) {
    layers += item == Item::rgb14 || item == Item::wave_packet14 ? 1 : item == Item::rgb_nir14 ? 2 : 0;
  }
  return layers;
}

}  // namespace pds
