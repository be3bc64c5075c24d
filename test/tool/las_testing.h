// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reader_testing.h"

#include <array>
#include <cstring>

namespace pds
{

/** \brief Writes LAS files byte by byte, as ASPRS LAS 1.4 R15 lays them out. */
class LasFile
{
 public:
  LasFile(std::uint8_t minor_version, std::uint8_t format, std::uint16_t record_bytes)
      : header_(minor_version < 3   ? 227
                : minor_version < 4 ? 235
                                    : 375,
                '\0')
  {
    header_.replace(0, 4, "LASF");
    set(6, static_cast<std::uint16_t>(format < 6 ? 0 : 16));  // the standard wants the flag for WKT
    set(24, std::uint8_t{1});
    set(25, minor_version);
    set(94, static_cast<std::uint16_t>(header_.size()));
    set(96, static_cast<std::uint32_t>(header_.size()));
    set(104, format);
    set(105, record_bytes);
    set(131, std::array<double, 3>{0.001, 0.001, 0.01});
    set(155, std::array<double, 3>{500000, 5000000, 0});
  }

  /** \brief Puts a number into the header. */
  template <typename Number>
  void set(std::size_t place, const Number& number)
  {
    std::memcpy(header_.data() + place, &number, sizeof number);
  }

  /** \brief Puts the bounds of the coordinates into the header. */
  void set_bounds(const std::array<double, 3>& least, const std::array<double, 3>& greatest)
  {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      set(179 + 16 * axis, greatest[axis]);
      set(187 + 16 * axis, least[axis]);
    }
  }

  /** \brief Describes a number in the extra bytes, in the order in which they lie there.
   * \param options bit 3: it has a scale, bit 4: an offset; of type 0 the bytes */
  void describe_extra(std::uint8_t type, std::uint8_t options, const std::string& name, double scale, double offset)
  {
    descriptions_.resize(descriptions_.size() + 192, '\0');
    char* description = descriptions_.data() + descriptions_.size() - 192;
    description[2] = static_cast<char>(type);
    description[3] = static_cast<char>(options);
    std::memcpy(description + 4, name.data(), name.size());
    std::memcpy(description + 112, &scale, sizeof scale);
    std::memcpy(description + 136, &offset, sizeof offset);
    set(96, static_cast<std::uint32_t>(header_.size() + 54 + descriptions_.size()));
    set(100, std::uint32_t{1});
  }

  /** \brief Appends a record; bytes that are missing are zero. */
  void add(std::string record)
  {
    std::uint16_t record_bytes = 0;
    std::memcpy(&record_bytes, header_.data() + 105, sizeof record_bytes);
    record.resize(record_bytes, '\0');
    records_ += record;
    ++count_;
    set(107, header_[25] < 4 ? count_ : std::uint32_t{0});
    if (header_[25] >= 4) {
      set(247, std::uint64_t{count_});
    }
  }

  [[nodiscard]] std::string bytes() const
  {
    if (descriptions_.empty()) {
      return header_ + records_;
    }
    std::string head(54, '\0');
    head.replace(2, 9, "LASF_Spec");
    head[18] = 4;
    const auto length = static_cast<std::uint16_t>(descriptions_.size());
    std::memcpy(head.data() + 20, &length, sizeof length);
    return header_ + head + descriptions_ + records_;
  }

 private:
  std::string header_;
  std::string descriptions_;
  std::string records_;
  std::uint32_t count_ = 0;
};

/** \brief The beginning of a record of format 0 to 3: position and intensity, flags, classification. */
inline std::string las_record(std::int32_t x, std::int32_t y, std::int32_t z, std::uint8_t classification)
{
  return bytes_of(x) + bytes_of(y) + bytes_of(z) + bytes_of(std::uint16_t{77}) + bytes_of(std::uint8_t{0}) +
         bytes_of(classification);
}

}  // namespace pds
