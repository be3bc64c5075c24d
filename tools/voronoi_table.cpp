// SPDX-License-Identifier: BSD-3-Clause
#include "voronoi_table.h"

#include <cstring>

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

PointTable make_voronoi_table(const PointTable& points, const Reconstruction& result, const Parallel& parallel)
{
  PointTable table = points.with_fields({{"label", ScalarType::int32},
                                         {"distance", ScalarType::float32},
                                         {"witness", ScalarType::uint8},
                                         {"seed", ScalarType::uint8}},
                                        parallel);
  const Field& label = *table.find("label");
  const Field& distance = *table.find("distance");
  constexpr std::size_t block = std::size_t{1} << 14;  // rows; some hundred microseconds
  parallel.each(table.size(), block, [&](std::size_t row) {
    static_assert(static_cast<std::int32_t>(no_label) == -1);
    const auto seed = static_cast<std::int32_t>(result.voronoi.label[row]);
    std::memcpy(table.record(row) + label.offset, &seed, sizeof seed);
    std::memcpy(table.record(row) + distance.offset, &result.voronoi.distance[row], sizeof(float));
  });
  mark(table, "witness", result.witness_points);
  mark(table, "seed", result.seeds);
  return table;
}

}  // namespace pds
