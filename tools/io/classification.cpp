// SPDX-License-Identifier: BSD-3-Clause
#include "io/classification.h"

#include <pcl_pds_recon/options.h>

#include <algorithm>
#include <array>
#include <boost/algorithm/string/case_conv.hpp>
#include <boost/algorithm/string/join.hpp>
#include <set>
#include <string>
#include <utility>

namespace pds
{

namespace
{

const Field& classification_field(const PointTable& points)
{
  constexpr std::array<const char*, 3> names = {"classification", "class", "scalar_classification"};
  for (const char* name : names) {
    for (const Field& field : points.fields()) {
      if (boost::algorithm::to_lower_copy(field.name) == name) {
        return field;
      }
    }
  }
  throw InvalidInput("has no field 'classification' to choose classes by; leave --class out");
}

[[noreturn]] void throw_none(const std::set<double>& present)
{
  constexpr std::size_t most_listed = 32;
  std::vector<std::string> names;
  for (const double number : present) {
    names.push_back(std::to_string(static_cast<long long>(number)));
    if (names.size() == most_listed) {
      names.emplace_back("...");
      break;
    }
  }
  throw InvalidInput("has no points of the classes of --class; it holds " + boost::algorithm::join(names, ", "));
}

}  // namespace

PointTable select_classes(PointTable points, const std::vector<std::uint8_t>& classes)
{
  const Field field = classification_field(points);
  std::vector<std::uint32_t> indices;
  std::set<double> others;
  for (std::size_t row = 0; row < points.size(); ++row) {
    const double number = points.value(row, field);
    if (std::find(classes.begin(), classes.end(), number) != classes.end()) {
      indices.push_back(static_cast<std::uint32_t>(row));
    } else if (number == number && (others.empty() || others.count(number) == 0)) {
      others.insert(number);
    }
  }
  if (indices.empty()) {
    throw_none(others);
  }
  if (indices.size() == points.size()) {
    return points;
  }
  PointTable selected = points.select(indices, indices.size());
  selected.sensor_origin = points.sensor_origin;
  selected.not_read = points.not_read;
  return selected;
}

}  // namespace pds
