// SPDX-License-Identifier: BSD-3-Clause
#include "voronoi_table.h"

namespace pds
{

namespace
{

void mark(PointTable& table, const char* name, const std::vector<std::uint32_t>& points)
{
  const Field& field = *table.find(name);
  for (const std::uint32_t point : points) {
    table.set_value(point, field, 1);
  }
}

}  // namespace

PointTable make_voronoi_table(const PointTable& points, const Reconstruction& result)
{
  PointTable table = points.with_fields({{"label", ScalarType::int32},
                                         {"distance", ScalarType::float32},
                                         {"witness", ScalarType::uint8},
                                         {"seed", ScalarType::uint8}});
  const Field& label = *table.find("label");
  const Field& distance = *table.find("distance");
  for (std::size_t row = 0; row < table.size(); ++row) {
    const std::uint32_t seed = result.voronoi.label[row];
    table.set_value(row, label, seed == no_label ? -1.0 : static_cast<double>(seed));
    table.set_value(row, distance, static_cast<double>(result.voronoi.distance[row]));
  }
  mark(table, "witness", result.witness_points);
  mark(table, "seed", result.seeds);
  return table;
}

}  // namespace pds
