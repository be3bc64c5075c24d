// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/point_table.h"

#include <string>
#include <string_view>
#include <vector>

namespace pds
{

/** \brief The numbers of a text file, row after row. */
struct TextColumns
{
  const std::vector<double>& values;
  std::size_t count;  ///< columns; 0 if there are no rows

  [[nodiscard]] std::size_t rows() const { return count == 0 ? 0 : values.size() / count; }
  [[nodiscard]] double operator()(std::size_t row, std::size_t column) const { return values[row * count + column]; }
};

/** \brief The name that PLY uses for what a text file's header calls \a name: lower case for coordinates, normals and
 * colours, red green blue for r g b, no quotes. */
[[nodiscard]] std::string canonical_column_name(std::string_view name);

/** \brief The table of these columns, under \a names if there are any, otherwise under those that read_text documents.
 * \throws InvalidInput if there are fewer than three columns
 */
[[nodiscard]] PointTable make_table(const TextColumns& columns, std::vector<std::string> names);

}  // namespace pds
