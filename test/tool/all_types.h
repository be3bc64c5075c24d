// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/point_table.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

namespace pds
{

/** \brief A field of each type, called by it. */
inline std::vector<Field> all_types()
{
  return {{"int8", ScalarType::int8},      {"uint8", ScalarType::uint8},   {"int16", ScalarType::int16},
          {"uint16", ScalarType::uint16},  {"int32", ScalarType::int32},   {"uint32", ScalarType::uint32},
          {"int64", ScalarType::int64},    {"uint64", ScalarType::uint64}, {"float32", ScalarType::float32},
          {"float64", ScalarType::float64}};
}

/** \brief Three points of a scan in UTM with normals and colours. Each of these fields besides holds the least, the
 * greatest and a value in between of its type. */
inline PointTable points_with(const std::vector<Field>& more)
{
  std::vector<Field> fields = {{"x", ScalarType::float64},  {"y", ScalarType::float64},   {"z", ScalarType::float64},
                               {"nx", ScalarType::float32}, {"ny", ScalarType::float32},  {"nz", ScalarType::float32},
                               {"red", ScalarType::uint8},  {"green", ScalarType::uint8}, {"blue", ScalarType::uint8}};
  fields.insert(fields.end(), more.begin(), more.end());
  PointTable table(fields, 3);
  for (std::size_t row = 0; row < table.size(); ++row) {
    const double third = static_cast<double>(row) / 3;
    double value = 0;
    for (const char* name : {"x", "y", "z", "nx", "ny", "nz"}) {
      table.set_value(row, *table.find(name), name[0] == 'n' ? third + value : 500000.001 + third + value);
      value += 0.1;
    }
    for (const char* name : {"red", "green", "blue"}) {
      table.set_value(row, *table.find(name), static_cast<double>(100 * row) + name[0] % 7);
    }
    for (const Field& field : more) {
      visit_scalar(field.type, [&](auto zero) {
        using Number = decltype(zero);
        const Number numbers[] = {std::numeric_limits<Number>::lowest(), std::numeric_limits<Number>::max(),
                                  static_cast<Number>(123.456)};
        std::memcpy(table.record(row) + table.find(field.name)->offset, &numbers[row], sizeof zero);
      });
    }
  }
  return table;
}

}  // namespace pds
