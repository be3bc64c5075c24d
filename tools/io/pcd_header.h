// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/point_table.h"

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pds
{

enum class PcdEncoding
{
  ascii,
  binary,
  binary_compressed
};

/** \brief A field of a PCD file: one or more scalars of one type. */
struct PcdField
{
  std::string name;  ///< "_" for padding
  ScalarType type = ScalarType::float32;
  std::size_t count = 1;  ///< scalars

  [[nodiscard]] std::size_t bytes() const { return count * size_of(type); }
  [[nodiscard]] bool is_padding() const { return name == "_"; }
};

struct PcdHeader
{
  std::vector<PcdField> fields;
  std::uint64_t points = 0;
  PcdEncoding encoding = PcdEncoding::ascii;
  std::optional<Eigen::Vector3d> sensor_origin;  ///< set if VIEWPOINT is not the default one
  std::size_t bytes = 0;                         ///< length of the header; the data follow
};

/** \brief Reads the header of a PCD file. \throws InvalidInput naming the entry that is wrong */
[[nodiscard]] PcdHeader parse_pcd_header(std::string_view file);

}  // namespace pds
