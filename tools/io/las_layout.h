// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/record_reader.h"

#include <cstddef>
#include <vector>

namespace pds
{

/** \brief A part of a byte that becomes a field of its own. */
struct Bits
{
  const char* name;
  std::size_t offset;  ///< of the byte in the record
  unsigned shift;
  unsigned width;
};

/** \brief Where the fields lie in a record of one point format (ASPRS LAS 1.4 R15, section 2.6). */
struct LasLayout
{
  std::vector<Column> columns;  ///< those that a table holds as they are
  std::vector<Bits> bits;
  std::size_t scan_angle_at = 0;  ///< of the wide scan angle; 0 if the format has a narrow one, among the columns
  std::size_t color_at = 0;       ///< 0 if there are no colours
  [[nodiscard]] bool has_color() const { return color_at != 0; }
};

/** \brief The layout of a point format, 0 ... 10. */
[[nodiscard]] LasLayout las_layout(std::size_t point_format);

}  // namespace pds
