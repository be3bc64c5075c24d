// SPDX-License-Identifier: BSD-3-Clause
#include "io/las_extra_bytes.h"

#include "io/las_records.h"
#include "io/number_at.h"
#include "io/snake_case.h"

#include <pcl_pds_recon/options.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <utility>

namespace pds
{

namespace
{

constexpr std::size_t description_bytes = 192;

/** The content of the variable-length record that describes the extra bytes; empty if there is none. */
std::string find_descriptions(const ByteSource& source, const LasHeader& header)
{
  const std::optional<LasRecord> record = find_las_record(source, header, las_user, extra_bytes_record_id);
  std::string content(record ? record->bytes : 0, '\0');
  if (record) {
    source.read(record->begin, content.data(), content.size());
  }
  return content;
}

/** One description: the places of what is read of it. */
struct Description
{
  const char* bytes;

  [[nodiscard]] std::uint8_t type() const { return static_cast<std::uint8_t>(bytes[2]); }
  [[nodiscard]] std::uint8_t options() const { return static_cast<std::uint8_t>(bytes[3]); }
  [[nodiscard]] std::string name() const { return {bytes + 4, strnlen(bytes + 4, 32)}; }
  [[nodiscard]] double scale() const { return number_at<double>(bytes + 112); }
  [[nodiscard]] double offset() const { return number_at<double>(bytes + 136); }
};

/** The type of a single number; none of arrays, which are deprecated, and of bytes without a meaning. */
std::optional<ScalarType> scalar_type(std::uint8_t code)
{
  constexpr std::array<ScalarType, 10> types = {
      ScalarType::uint8, ScalarType::int8,   ScalarType::uint16, ScalarType::int16,   ScalarType::uint32,
      ScalarType::int32, ScalarType::uint64, ScalarType::int64,  ScalarType::float32, ScalarType::float64};
  return code >= 1 && code <= types.size() ? std::optional(types[code - 1U]) : std::nullopt;
}

/** Bytes that the description covers: of bytes without a meaning the options say how many, 11 to 30 are arrays. */
std::size_t size_of(const Description& description)
{
  constexpr std::uint8_t scalar_types = 10;
  const std::uint8_t code = description.type();
  if (code == 0 || code > 3 * scalar_types) {
    return description.options();
  }
  const std::size_t numbers = (code - 1U) / scalar_types + 1U;
  return numbers * size_of(*scalar_type(static_cast<std::uint8_t>((code - 1U) % scalar_types + 1U)));
}

std::string choose_name(const Description& description, std::vector<std::string>& taken)
{
  std::string name = snake_case(description.name());
  if (name.empty()) {
    name = "extra";
  }
  while (std::find(taken.begin(), taken.end(), name) != taken.end()) {
    name += '_';
  }
  taken.push_back(name);
  return name;
}

}  // namespace

ExtraBytes read_extra_bytes(const ByteSource& source, const LasHeader& header, std::vector<std::string> taken)
{
  constexpr std::uint8_t has_scale = 8;  // bits of the options
  constexpr std::uint8_t has_offset = 16;
  ExtraBytes extra;
  std::size_t place = las_standard_bytes(header.point_format);
  if (place == header.record_bytes) {
    return extra;
  }
  const std::string content = find_descriptions(source, header);
  for (std::size_t begin = 0; begin + description_bytes <= content.size(); begin += description_bytes) {
    const Description description{content.data() + begin};
    const std::size_t bytes = size_of(description);
    if (place + bytes > header.record_bytes) {
      throw InvalidInput("describes more extra bytes than its records have: the file is damaged; write it again");
    }
    if (const auto type = scalar_type(description.type())) {
      ExtraScalar scalar{{choose_name(description, taken), *type, place}};
      scalar.scale = (description.options() & has_scale) != 0 ? description.scale() : 1;
      scalar.offset = (description.options() & has_offset) != 0 ? description.offset() : 0;
      scalar.is_scaled = (description.options() & (has_scale | has_offset)) != 0;
      extra.scalars.push_back(std::move(scalar));
    } else {
      extra.is_complete = false;
    }
    place += bytes;
  }
  extra.is_complete = extra.is_complete && place == header.record_bytes;
  return extra;
}

}  // namespace pds
