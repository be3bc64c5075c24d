// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/byte_source.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace pds
{

// ASPRS LAS 1.4 R15, table 3: places in the public header block that also a copy of a file needs.
inline constexpr std::size_t las_begin_at = 96;
inline constexpr std::size_t las_record_count_at = 100;
inline constexpr std::size_t las_extended_record_count_at = 243;  ///< from version 1.4 on
inline constexpr std::size_t las_count_at = 247;                  ///< from version 1.4 on
inline constexpr std::size_t las_header_bytes_1_4 = 375;

inline constexpr std::size_t las_record_head_bytes = 54;  ///< before the content of a variable-length record

/** \brief How the point records are stored. */
enum class LasCompression
{
  none,   ///< .las
  laszip  ///< .laz
};

/** \brief What the public header of a LAS file says about its point records. */
struct LasHeader
{
  std::size_t point_format = 0;  ///< 0 ... 10
  std::size_t record_bytes = 0;
  std::size_t begin = 0;  ///< of the first record in the file
  std::uint64_t count = 0;
  std::size_t end = 0;             ///< of the points at the latest: waveforms, extended records or the end of the file
  std::array<double, 3> scale{};   ///< of x, y and z: coordinate = scale * integer + offset
  std::array<double, 3> offset{};  ///< of x, y and z
  std::array<double, 3> least{};   ///< coordinates of all points, if the writer has filled them in
  std::array<double, 3> greatest{};  ///< likewise
  std::size_t header_bytes = 0;      ///< where the variable-length records begin
  std::uint32_t record_count = 0;    ///< variable-length records
  std::uint64_t extended_begin = 0;  ///< of the extended variable-length records
  std::uint32_t extended_count = 0;
};

/** \brief Reads the header of a LAS file, version 1.0 to 1.4.
 * \throws InvalidInput if it is not one, is not compressed as \a compression says, damaged, or, if not compressed,
 * announces more or fewer records than the file holds
 */
[[nodiscard]] LasHeader read_las_header(const ByteSource& source, LasCompression compression);

/** \brief Whether points of this format refer to waveforms, in the file or in one of their own. */
[[nodiscard]] bool las_has_waveforms(std::size_t point_format);

/** \brief Bytes of a record of this format as the standard lays it out; a file may append more. */
[[nodiscard]] std::size_t las_standard_bytes(std::size_t point_format);

}  // namespace pds
