// SPDX-License-Identifier: BSD-3-Clause
#include "io/text_columns.h"

#include <pcl_pds_recon/options.h>

#include <algorithm>
#include <array>
#include <boost/algorithm/string/case_conv.hpp>
#include <boost/algorithm/string/trim.hpp>
#include <cmath>
#include <utility>

namespace pds
{

namespace
{

using ColorNames = std::array<const char*, 4>;
constexpr ColorNames color_names = {"red", "green", "blue", "alpha"};

bool is_byte(double value) { return value >= 0 && value <= 255 && std::trunc(value) == value; }

bool is_byte_column(const TextColumns& columns, std::size_t column)
{
  for (std::size_t row = 0; row < columns.rows(); ++row) {
    if (!is_byte(columns(row, column))) {
      return false;
    }
  }
  return true;
}

/** Normals along the axes are whole numbers too, but none exceeds 1. */
bool is_color(const TextColumns& columns, std::size_t first)
{
  double greatest = 0;
  for (std::size_t column = first; column < first + 3; ++column) {
    if (!is_byte_column(columns, column)) {
      return false;
    }
    for (std::size_t row = 0; row < columns.rows(); ++row) {
      greatest = std::max(greatest, columns(row, column));
    }
  }
  return greatest > 1;
}

bool is_unit_vector(const TextColumns& columns, std::size_t first)
{
  constexpr double tolerance = 0.02;  // of the length: some tools write two decimals
  for (std::size_t row = 0; row < columns.rows(); ++row) {
    const double length = std::hypot(columns(row, first), columns(row, first + 1), columns(row, first + 2));
    if (!(std::abs(length - 1) <= tolerance)) {
      return false;
    }
  }
  return columns.rows() > 0;
}

std::vector<std::string> guess_names(const TextColumns& columns)
{
  std::vector<std::string> names = {"x", "y", "z"};
  const auto has = [&names](const char* name) { return std::find(names.begin(), names.end(), name) != names.end(); };
  while (names.size() < columns.count) {
    const std::size_t column = names.size();
    const bool triple_fits = column + 3 <= columns.count;
    if (triple_fits && !has("red") && is_color(columns, column)) {
      names.insert(names.end(), {"red", "green", "blue"});
    } else if (triple_fits && !has("nx") && is_unit_vector(columns, column)) {
      names.insert(names.end(), {"nx", "ny", "nz"});
    } else if (!has("intensity")) {
      names.emplace_back("intensity");
    } else {
      names.push_back("field_" + std::to_string(column + 1));
    }
  }
  return names;
}

bool is_color_name(const std::string& name)
{
  return std::find(color_names.begin(), color_names.end(), name) != color_names.end();
}

}  // namespace

std::string canonical_column_name(std::string_view name)
{
  constexpr std::array<std::pair<const char*, const char*>, 6> synonyms = {
      {{"r", "red"}, {"g", "green"}, {"b", "blue"}, {"normal_x", "nx"}, {"normal_y", "ny"}, {"normal_z", "nz"}}};
  std::string trimmed(name);
  boost::algorithm::trim_if(trimmed, [](char c) { return c == '"' || c == '\''; });
  const std::string lower = boost::algorithm::to_lower_copy(trimmed);
  for (const auto& [synonym, canonical] : synonyms) {
    if (lower == synonym) {
      return canonical;
    }
  }
  constexpr std::array<const char*, 6> coordinates = {"x", "y", "z", "nx", "ny", "nz"};
  std::replace(trimmed.begin(), trimmed.end(), ' ', '_');  // a blank would end the name in a PLY header
  const bool is_known =
      is_color_name(lower) || std::find(coordinates.begin(), coordinates.end(), lower) != coordinates.end();
  return is_known ? lower : trimmed;
}

PointTable make_table(const TextColumns& columns, std::vector<std::string> names)
{
  if (columns.rows() > 0 && columns.count < 3) {
    throw InvalidInput("has " + std::to_string(columns.count) + " columns where a point needs x, y and z; add them");
  }
  if (names.empty()) {
    names = guess_names(columns);
  }
  std::vector<Field> fields;
  for (std::size_t column = 0; column < names.size(); ++column) {
    const bool fits_byte = is_color_name(names[column]) && is_byte_column(columns, column);
    fields.push_back({names[column], fits_byte ? ScalarType::uint8 : ScalarType::float64});
  }
  PointTable table(std::move(fields));
  table.resize(columns.rows());
  for (std::size_t column = 0; column < names.size(); ++column) {
    const Field& field = *table.find(names[column]);
    for (std::size_t row = 0; row < columns.rows(); ++row) {
      table.set_value(row, field, columns(row, column));
    }
  }
  return table;
}

}  // namespace pds
