// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/point_table.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pds
{

enum class PlyEncoding
{
  ascii,
  little_endian,
  big_endian
};

struct PlyProperty
{
  std::string name;
  ScalarType type = ScalarType::float32;
  std::optional<ScalarType> list_size_type;  ///< set for a list property

  /** \brief Whether it lists the vertices of a face. */
  [[nodiscard]] bool is_corner_list() const
  {
    return list_size_type && (name == "vertex_indices" || name == "vertex_index");
  }
};

struct PlyElement
{
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader
{
  PlyEncoding encoding = PlyEncoding::ascii;
  std::vector<PlyElement> elements;
  std::size_t bytes = 0;  ///< length of the header; the data follow
};

/** \brief Reads the header of a PLY file. \throws InvalidInput naming the line that is wrong */
[[nodiscard]] PlyHeader parse_ply_header(std::string_view file);

}  // namespace pds
