// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/pick.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <limits>

namespace pds
{

namespace
{

template <typename PositionOf>
std::uint32_t nearest(std::size_t count, const Eigen::Vector3d& place, const PositionOf& position_of)
{
  std::uint32_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < count; ++i) {
    const double distance = (position_of(i) - place).squaredNorm();
    if (distance < least) {  // not so where there is a NaN
      least = distance;
      best = i;
    }
  }
  return best;
}

std::string describe_fields(const PointTable& table, std::size_t row)
{
  std::string text;
  for (const Field& field : table.fields()) {
    text += fmt::format(", {} {:.8g}", field.name, table.value(row, field));
  }
  return text;
}

std::string describe_cell(const ViewData& data, std::uint32_t label)
{
  return fmt::format("cell of {} points", std::count(data.label.begin(), data.label.end(), label));
}

}  // namespace

Pick pick_vertex(const ViewSource& source, const ViewData& data, const Eigen::Vector3d& place)
{
  const auto& vertices = data.mesh.vertices;
  const std::uint32_t vertex = nearest(vertices.size(), place, [&vertices](std::uint32_t i) { return vertices[i]; });
  Pick pick{vertices[vertex], fmt::format("vertex {}", vertex)};
  const std::string deviation = data.deviation.empty() ? "" : fmt::format(", deviation {:.5g}", data.deviation[vertex]);
  if (source.is_reconstructed()) {
    const std::uint32_t row = data.seeds[vertex];
    pick.text += fmt::format(", input point {}, {}", row, describe_cell(data, vertex));
    pick.text += deviation + describe_fields(*source.cloud, row);
    return pick;
  }
  std::size_t row = vertex;
  std::size_t mesh = 0;
  for (; row >= source.meshes[mesh].points.size(); ++mesh) {
    row -= source.meshes[mesh].points.size();
  }
  pick.text = fmt::format("vertex {}", row);
  if (source.meshes.size() > 1) {
    pick.text += " of " + source.mesh_names[mesh];
  }
  pick.text += deviation + describe_fields(source.meshes[mesh].points, row);
  return pick;
}

Pick pick_point(const ViewSource& source, const ViewData& data, const Eigen::Vector3d& place)
{
  const Vector3View& positions = data.cloud.positions;
  const std::uint32_t point = nearest(data.cloud.size, place, [&positions](std::uint32_t i) { return positions[i]; });
  Pick pick{positions[point], fmt::format("input point {}", point)};
  if (!data.label.empty() && data.label[point] < data.seeds.size()) {
    pick.text += fmt::format(", of seed {}, {}", data.label[point], describe_cell(data, data.label[point]));
  }
  pick.text += describe_fields(*source.cloud, point);
  return pick;
}

}  // namespace pds
