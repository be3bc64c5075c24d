// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/point_table.h"

#include <array>
#include <string_view>
#include <vector>

namespace pds
{

/** \brief The colours of the vertices of an OBJ file, which are numbers in 0 ... 1, and the type that they had. */
class ObjColors
{
 public:
  using Vector = std::array<double, 3>;

  /** \brief Takes the colour of a vertex. \param first the first of its three words \return false if one is no number
   */
  [[nodiscard]] bool add(const std::string_view* first);

  [[nodiscard]] bool empty() const { return values_.empty(); }

  /** \brief uchar or ushort if all of them are whole there, as far as their digits tell; double otherwise. */
  [[nodiscard]] ScalarType type() const;

  /** \brief The colour of each of \a count vertices as this type has it; empty if not each has one in 0 ... 1. */
  [[nodiscard]] std::vector<Vector> of_vertices(std::size_t count) const;

 private:
  std::vector<Vector> values_;
  bool are_in_range_ = true;
  bool fits_byte_ = true;
  bool fits_word_ = true;
};

}  // namespace pds
