// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/seed_graph.h>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

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

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/** \brief True if the open segments ab and cd cross. */
bool segments_cross(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d)
{
  const double c_side = cross(b - a, c - a);
  const double d_side = cross(b - a, d - a);
  const double a_side = cross(d - c, a - c);
  const double b_side = cross(d - c, b - c);
  return c_side * d_side < 0 && a_side * b_side < 0;
}

class PlanarGraphBuilder
{
 public:
  explicit PlanarGraphBuilder(const SeedGeometry& seeds) : seeds_(seeds), neighbors_(seeds.position.size()) {}

  void insert_unless_crossing(std::uint32_t a, std::uint32_t b)
  {
    if (crosses_accepted(a, b)) return;
    neighbors_[a].push_back(b);
    neighbors_[b].push_back(a);
  }

  std::vector<std::vector<std::uint32_t>> neighbors() && { return std::move(neighbors_); }

 private:
  [[nodiscard]] bool crosses_accepted(std::uint32_t a, std::uint32_t b) const
  {
    const Vector3d origin = seeds_.position[a];
    const Vector3d& na = seeds_.normal[a];
    const Vector3d& nb = seeds_.normal[b];
    Vector3d normal = na.dot(nb) < 0 ? Vector3d(na - nb) : Vector3d(na + nb);
    // The plane contains the edge.
    const Vector3d along = (seeds_.position[b] - origin).normalized();
    normal -= normal.dot(along) * along;
    if (normal.norm() < smallest_normal) return false;
    const TangentPlane plane(normal.normalized());
    const auto flat = [&](std::uint32_t s) { return plane.project(seeds_.position[s] - origin); };
    const Vector2d flat_a = flat(a);
    const Vector2d flat_b = flat(b);
    // An edge that crosses ab in the surface has an end next to a or b.
    for (const std::uint32_t end : {a, b})
      for (const std::uint32_t c : neighbors_[end]) {
        if (c == a || c == b) continue;
        for (const std::uint32_t d : neighbors_[c])
          if (d != a && d != b && segments_cross(flat_a, flat_b, flat(c), flat(d))) return true;
      }
    return false;
  }

  static constexpr double smallest_normal = 1e-6;  // of unit vectors' sum; below it there is no common plane
  const SeedGeometry& seeds_;
  std::vector<std::vector<std::uint32_t>> neighbors_;
};

void sort_counter_clockwise(const SeedGeometry& seeds, std::uint32_t seed, std::vector<std::uint32_t>& neighbors)
{
  const TangentPlane plane(seeds.normal[seed]);
  std::vector<std::pair<double, std::uint32_t>> by_angle;
  for (const std::uint32_t other : neighbors) {
    const Vector2d direction = plane.project(seeds.position[other] - seeds.position[seed]);
    by_angle.emplace_back(std::atan2(direction.y(), direction.x()), other);
  }
  std::sort(by_angle.begin(), by_angle.end());
  std::transform(by_angle.begin(), by_angle.end(), neighbors.begin(), [](const auto& entry) { return entry.second; });
}

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
  seeds.curvature.assign(count, 0.0);
  constexpr std::size_t block = 256;
  parallel.each(count, block, [&](std::size_t s) {
    // From the input itself: faces are judged where they will be, not where single precision puts them.
    const Vector3d input = cloud.positions[points.input_index[sampling.seeds[s]]];
    seeds.position[s] = (input - points.origin) / points.unit / sampling.radius;
    Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
    for (std::size_t i = voronoi.cell_begin[s]; i < voronoi.cell_begin[s + 1]; ++i) {
      const Vector3d normal = surface.normal[voronoi.cell_point[i]].cast<double>();
      moment += normal * normal.transpose();
      seeds.curvature[s] += static_cast<double>(surface.curvature[voronoi.cell_point[i]]);
    }
    seeds.curvature[s] /= static_cast<double>(voronoi.cell_begin[s + 1] - voronoi.cell_begin[s]);
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.computeDirect(moment);
    seeds.normal[s] = solver.eigenvectors().col(2);
  });
  return seeds;
}

SeedGraph build_seed_graph(const SeedGeometry& seeds, const std::vector<SeedPair>& pairs)
{
  std::vector<std::uint32_t> order(pairs.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t x, std::uint32_t y) {
    if (pairs[x].witnesses != pairs[y].witnesses) return pairs[x].witnesses > pairs[y].witnesses;
    if (pairs[x].path != pairs[y].path) return pairs[x].path < pairs[y].path;
    return x < y;
  });
  PlanarGraphBuilder builder(seeds);
  for (const std::uint32_t i : order) builder.insert_unless_crossing(pairs[i].a, pairs[i].b);
  SeedGraph graph{std::move(builder).neighbors()};
  for (std::uint32_t s = 0; s < graph.neighbors.size(); ++s) sort_counter_clockwise(seeds, s, graph.neighbors[s]);
  return graph;
}

}  // namespace pds
