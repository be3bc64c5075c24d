// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/seed_graph.h>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>
#include "planar_edges.h"

namespace pds
{
namespace
{

using Eigen::Vector2d;
using Eigen::Vector3d;

/** \brief Orthonormal axes of the plane with this normal; any plane if the normal is zero. */
struct TangentPlane
{
  explicit TangentPlane(const Vector3d& normal)
  {
    x = normal.unitOrthogonal();
    y = normal.cross(x);
  }
  [[nodiscard]] Vector2d project(const Vector3d& v) const { return {v.dot(x), v.dot(y)}; }
  Vector3d x, y;
};

/** \brief Grows with the angle of the direction from the x axis, from -2 to 2: enough to sort by, and the same bits on
 * every machine, which atan2 is not. */
double pseudo_angle(const Vector2d& direction)
{
  const double sum = std::abs(direction.x()) + std::abs(direction.y());
  if (!(sum > 0)) return 0;
  const double slope = direction.y() / sum;
  if (direction.x() >= 0) return slope;
  return direction.y() >= 0 ? 2 - slope : -2 - slope;
}

/** \brief Sorts a row of the graph by the angle about the seed's normal. */
class RowSorter
{
 public:
  explicit RowSorter(const SeedGeometry& seeds) : seeds_(seeds) {}

  void sort(std::uint32_t seed, std::uint32_t* begin, std::uint32_t* end)
  {
    const TangentPlane plane(seeds_.normal[seed]);
    by_angle_.clear();
    for (const std::uint32_t* other = begin; other != end; ++other)
      by_angle_.emplace_back(pseudo_angle(plane.project(seeds_.position[*other] - seeds_.position[seed])), *other);
    std::sort(by_angle_.begin(), by_angle_.end());
    std::transform(by_angle_.begin(), by_angle_.end(), begin, [](const auto& entry) { return entry.second; });
  }

 private:
  const SeedGeometry& seeds_;
  std::vector<std::pair<double, std::uint32_t>> by_angle_;
};

}  // namespace

SeedGeometry describe_seeds(const PointCloudView& cloud,
                            const OrderedPoints& points,
                            const SurfaceEstimate& surface,
                            const PoissonDiskSampling& sampling,
                            const GeodesicVoronoi& voronoi,
                            const Parallel& parallel)
{
  const std::size_t count = sampling.seeds.size();
  SeedGeometry seeds;
  seeds.position.resize(count);
  seeds.normal.resize(count);
  seeds.curvature.resize(count);
  constexpr std::size_t block = 256;
  parallel.each(count, block, [&](std::size_t s) {
    // From the input itself: faces are judged where they will be, not where single precision puts them.
    const Vector3d input = cloud.positions[points.input_index[sampling.seeds[s]]];
    seeds.position[s] = (input - points.origin) / points.unit / sampling.radius;
    // The six different entries of the sum of n n^T: xx, yy, zz, xy, yz, zx.
    Vector3d squares = Vector3d::Zero();
    Vector3d products = Vector3d::Zero();
    double curvature = 0;
    for (std::size_t i = voronoi.cell_begin[s]; i < voronoi.cell_begin[s + 1]; ++i) {
      const std::uint32_t point = voronoi.cell_point[i];
      const Vector3d n = surface.normal[point].cast<double>();
      squares += n.cwiseProduct(n);
      products += n.cwiseProduct(Vector3d(n.y(), n.z(), n.x()));
      curvature += static_cast<double>(surface.curvature[point]);
    }
    seeds.curvature[s] = curvature / static_cast<double>(voronoi.cell_begin[s + 1] - voronoi.cell_begin[s]);
    Eigen::Matrix3d moment = squares.asDiagonal();
    moment(1, 0) = products[0];  // the solver reads the lower triangle
    moment(2, 1) = products[1];
    moment(2, 0) = products[2];
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.computeDirect(moment);
    seeds.normal[s] = solver.eigenvectors().col(2);
  });
  return seeds;
}

SeedGraph build_seed_graph(const SeedGeometry& seeds, const std::vector<SeedPair>& pairs, const Parallel& parallel)
{
  constexpr std::size_t block = 1024;
  const std::size_t seed_count = seeds.position.size();
  const PairGraph all(seed_count, pairs, parallel);
  const std::vector<std::uint8_t> chosen = choose_planar_edges(seeds, pairs.size(), all, parallel);

  SeedGraph graph;
  graph.begin.resize(seed_count + 1);
  parallel.each(seed_count, block, [&](std::size_t s) {
    graph.begin[s + 1] = static_cast<std::size_t>(
        std::count_if(all.first(s), all.last(s), [&](const PairGraph::Edge& e) { return chosen[e.pair] != 0; }));
  });
  for (std::size_t s = 0; s < seed_count; ++s) graph.begin[s + 1] += graph.begin[s];
  graph.neighbor.resize(graph.begin.back());
  parallel.blocks(seed_count, block, [&](std::size_t begin, std::size_t end, unsigned) {
    RowSorter sorter(seeds);
    for (std::size_t s = begin; s < end; ++s) {
      std::uint32_t* const row = graph.neighbor.data() + graph.begin[s];
      std::uint32_t* place = row;
      for (const PairGraph::Edge* e = all.first(s); e != all.last(s); ++e)
        if (chosen[e->pair] != 0) *place++ = e->other;
      sorter.sort(static_cast<std::uint32_t>(s), row, place);
    }
  });
  return graph;
}

}  // namespace pds
