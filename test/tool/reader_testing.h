// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/point_table.h"

#include <pcl_pds_recon/options.h>

#include <gtest/gtest.h>

#include <functional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace pds
{

/** \brief "x:double y:double ..." */
inline std::string describe_fields(const PointTable& table)
{
  std::string text;
  for (const Field& field : table.fields()) {
    text += (text.empty() ? "" : " ") + field.name + ":" + ply_name(field.type);
  }
  return text;
}

/** \brief A table of zeros. \param groups names parted by blanks, and the type of all fields of a group */
inline PointTable table_with(const std::vector<std::pair<std::string, ScalarType>>& groups, std::size_t size)
{
  std::vector<Field> fields;
  for (const auto& [names, type] : groups) {
    std::istringstream stream(names);
    for (std::string name; stream >> name;) {
      fields.push_back({name, type});
    }
  }
  return PointTable(std::move(fields), size);
}

/** \brief Puts values into a row, in the order of the fields. */
inline void set_row(PointTable& table, std::size_t row, const std::vector<double>& values)
{
  for (std::size_t i = 0; i < values.size(); ++i) {
    table.set_value(row, table.fields()[i], values[i]);
  }
}

/** \brief All values of a row in the order of the fields. */
inline std::vector<double> row_values(const PointTable& table, std::size_t row)
{
  std::vector<double> values;
  for (const Field& field : table.fields()) {
    values.push_back(table.value(row, field));
  }
  return values;
}

/** \brief What the reader says is wrong; empty if it takes the input. */
inline std::string complaint(const std::function<PointTable()>& read)
{
  try {
    static_cast<void>(read());
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

/** \brief The bytes of a number as they lie in memory. */
template <typename Number>
std::string bytes_of(Number number)
{
  return {reinterpret_cast<const char*>(&number), sizeof number};
}

}  // namespace pds
