// SPDX-License-Identifier: BSD-3-Clause
#include "io/pcd_header.h"

#include "io/text_scanner.h"

#include <pcl_pds_recon/options.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace pds
{

namespace
{

using Words = std::vector<std::string_view>;

/** The words after each keyword. */
using Entries = std::map<std::string_view, Words, std::less<>>;

[[noreturn]] void throw_bad_header(const std::string& what)
{
  throw InvalidInput("is not a PCD file: its header " + what + "; write it again or check its extension");
}

[[noreturn]] void throw_impossible(std::string_view keyword)
{
  throw_bad_header("has an impossible " + std::string(keyword));
}

Entries parse_entries(std::string_view file, std::size_t& header_bytes)
{
  Entries entries;
  TextScanner scanner(file);
  std::string_view line;
  Words words;
  while (entries.count("DATA") == 0 && scanner.next_line(line)) {
    split(line, " \t", words);
    if (!words.empty() && words.front().front() != '#') {
      const std::string_view keyword = words.front() == "COLUMNS" ? "FIELDS" : words.front();
      entries[keyword] = Words(words.begin() + 1, words.end());
    }
  }
  header_bytes = scanner.position();
  for (const char* keyword : {"FIELDS", "SIZE", "DATA"}) {
    if (entries.count(keyword) == 0) {
      throw_bad_header("has no line '" + std::string(keyword) + "'");
    }
  }
  return entries;
}

/** One number per field. */
std::vector<std::size_t> parse_sizes(const Entries& entries, std::string_view keyword, std::size_t greatest)
{
  const std::size_t field_count = entries.at("FIELDS").size();
  const auto entry = entries.find(keyword);
  if (entry == entries.end()) {
    return std::vector<std::size_t>(field_count, 1);
  }
  std::vector<std::size_t> sizes(field_count);
  bool understood = entry->second.size() == field_count;
  for (std::size_t i = 0; i < field_count && understood; ++i) {
    understood = parse_number(entry->second[i], sizes[i]) && sizes[i] > 0 && sizes[i] <= greatest;
  }
  if (!understood) {
    throw_impossible(keyword);
  }
  return sizes;
}

ScalarType scalar_type(std::string_view letter, std::size_t size)
{
  constexpr std::array<std::pair<std::string_view, std::array<std::optional<ScalarType>, 4>>, 4> types = {{
      {"I", {ScalarType::int8, ScalarType::int16, ScalarType::int32, ScalarType::int64}},
      {"U", {ScalarType::uint8, ScalarType::uint16, ScalarType::uint32, ScalarType::uint64}},
      {"F", {std::nullopt, std::nullopt, ScalarType::float32, ScalarType::float64}},
      {"B", {ScalarType::uint8, std::nullopt, std::nullopt, std::nullopt}},
  }};
  constexpr std::array<std::size_t, 4> sizes = {1, 2, 4, 8};
  const auto size_index = static_cast<std::size_t>(std::find(sizes.begin(), sizes.end(), size) - sizes.begin());
  if (size_index == sizes.size()) {
    throw_bad_header("has a SIZE that is not 1, 2, 4 or 8");
  }
  for (const auto& [type_letter, by_size] : types) {
    if (letter == type_letter && by_size[size_index]) {
      return *by_size[size_index];
    }
  }
  throw_bad_header("has a TYPE '" + std::string(letter) + "' of " + std::to_string(size) + " bytes");
}

std::vector<PcdField> parse_fields(const Entries& entries)
{
  constexpr std::size_t greatest_scalar = 8;     // bytes of a double
  constexpr std::size_t greatest_count = 65536;  // of scalars in a field; the longest feature histograms have 2000
  const Words& names = entries.at("FIELDS");
  const auto sizes = parse_sizes(entries, "SIZE", greatest_scalar);
  const auto counts = parse_sizes(entries, "COUNT", greatest_count);
  const auto types = entries.find("TYPE");
  if (types != entries.end() && types->second.size() != names.size()) {
    throw_impossible("TYPE");
  }
  if (!std::all_of(names.begin(), names.end(), is_printable)) {
    throw_impossible("FIELDS");
  }
  std::vector<PcdField> fields;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string_view letter = types == entries.end() ? "F" : types->second[i];
    fields.push_back({std::string(names[i]), scalar_type(letter, sizes[i]), counts[i]});
  }
  return fields;
}

std::uint64_t parse_count(const Entries& entries, std::string_view keyword)
{
  const auto entry = entries.find(keyword);
  std::uint64_t count = 1;
  if (entry != entries.end() && (entry->second.size() != 1 || !parse_number(entry->second.front(), count))) {
    throw_bad_header("has no number of " + std::string(keyword));
  }
  return count;
}

/** POINTS, or WIDTH times HEIGHT, of which files of old versions lack one or the other. */
std::uint64_t parse_points(const Entries& entries)
{
  const std::uint64_t width = parse_count(entries, "WIDTH");
  const std::uint64_t height = parse_count(entries, "HEIGHT");
  const std::uint64_t points = parse_count(entries, "POINTS");
  const bool has_points = entries.count("POINTS") != 0;
  const bool has_width = entries.count("WIDTH") != 0;
  if (!has_points && !has_width) {
    throw_bad_header("has no number of POINTS");
  }
  if (has_width && has_points && (height == 0 ? points != 0 : points / height != width || points % height != 0)) {
    throw_bad_header("announces WIDTH x HEIGHT points and another number of POINTS");
  }
  if (has_points) {
    return points;
  }
  if (height != 0 && width > std::numeric_limits<std::uint64_t>::max() / height) {
    throw_impossible("WIDTH");
  }
  return width * height;
}

std::optional<Eigen::Vector3d> parse_sensor_origin(const Entries& entries)
{
  constexpr std::array<double, 7> default_viewpoint = {0, 0, 0, 1, 0, 0, 0};  // translation, rotation as a quaternion
  const auto entry = entries.find("VIEWPOINT");
  if (entry == entries.end()) {
    return std::nullopt;
  }
  std::array<double, 7> viewpoint{};
  bool understood = entry->second.size() == viewpoint.size();
  for (std::size_t i = 0; i < viewpoint.size() && understood; ++i) {
    understood = parse_number(entry->second[i], viewpoint[i]);
  }
  if (!understood) {
    throw_impossible("VIEWPOINT");
  }
  const Eigen::Vector3d origin(viewpoint[0], viewpoint[1], viewpoint[2]);
  return viewpoint == default_viewpoint || !origin.allFinite() ? std::nullopt : std::optional(origin);
}

PcdEncoding parse_encoding(const Words& words)
{
  constexpr std::array<std::pair<std::string_view, PcdEncoding>, 3> encodings = {
      {{"ascii", PcdEncoding::ascii},
       {"binary", PcdEncoding::binary},
       {"binary_compressed", PcdEncoding::binary_compressed}}};
  for (const auto& [name, encoding] : encodings) {
    if (words.size() == 1 && words.front() == name) {
      return encoding;
    }
  }
  throw_bad_header("has a DATA that is not ascii, binary or binary_compressed");
}

}  // namespace

PcdHeader parse_pcd_header(std::string_view file)
{
  PcdHeader header;
  const Entries entries = parse_entries(file, header.bytes);
  header.fields = parse_fields(entries);
  header.points = parse_points(entries);
  header.encoding = parse_encoding(entries.at("DATA"));
  header.sensor_origin = parse_sensor_origin(entries);
  return header;
}

}  // namespace pds
