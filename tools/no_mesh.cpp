// SPDX-License-Identifier: BSD-3-Clause
#include "no_mesh.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace pds
{

namespace
{

/** Says which coordinate reaches far beyond where most points are, as damaged numbers do; empty if none does. */
std::string wild_coordinate(const PointTable& points)
{
  constexpr double widest = 1000;  // times the middle half of the coordinates; of scans it is some ten
  for (const char* name : position_fields) {
    std::vector<double> values;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (const double value = points.value(i, *points.find(name)); std::isfinite(value)) {
        values.push_back(value);
      }
    }
    std::sort(values.begin(), values.end());
    const double lower = values[values.size() / 4];
    const double upper = values[values.size() * 3 / 4];
    if (upper > lower && (values.back() - values.front()) / widest > upper - lower) {
      return fmt::format("{} reaches from {} to {}, but of half of the points only from {} to {}", name, values.front(),
                         values.back(), lower, upper);
    }
  }
  return "";
}

}  // namespace

std::string why_no_mesh(const PointTable& points, const Report& report, Dimension dimension)
{
  if (report.valid_points == 0) {
    return "none of the points has finite coordinates; check the file's x, y and z";
  }
  if (report.valid_points - report.merged_points <= 1) {
    return "all points are in one place; check the file's x, y and z";
  }
  if (const std::string wild = wild_coordinate(points); !wild.empty()) {
    return fmt::format(
        "no mesh came out of {} points: {}; take out the stray points, or copy the file again if it is damaged",
        report.valid_points, wild);
  }
  if (dimension == Dimension::curve) {
    return fmt::format(
        "no curves came out of {} points: they look like a line at no scale, or there are too few for the radius; take "
        "--dimension 2 or auto, or a smaller -f or -r",
        report.valid_points);
  }
  const bool every_point_is_a_seed = report.seeds + report.merged_points == report.valid_points;
  if (every_point_is_a_seed) {
    return fmt::format("no faces: radius {} is below the spacing of the {} points; use a larger -r or -f",
                       report.radius, report.valid_points);
  }
  return fmt::format(
      "no faces came out of {} points with radius {}: too few points for this radius, all on a line, or in lines "
      "farther "
      "apart than their {} neighbours reach; use a smaller -f or -r, a larger -k, or remove stray points far away",
      report.valid_points, report.radius, report.k);
}

}  // namespace pds
