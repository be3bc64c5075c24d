// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/curve_shape.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include "point_grid.h"

namespace pds
{
namespace
{

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Vectors = PointArray<Eigen::Vector3f>;  ///< by point

constexpr std::size_t block = 1024;  // points per block: each looks at some hundred others

// Root of the ratio of the two largest variances: a straight piece of 2 r with noise of deviation s has 1.7 s / r, a
// piece of a circle of radius a 0.26 r / a, a disk 1 and the rim of one 0.53.
constexpr double line_thickness = 0.25;
constexpr double noisy_thickness = 0.03;
constexpr double line_share = 0.8;          // of the neighbourhoods; curves may have corners
constexpr std::size_t most_samples = 256;   // of a component's neighbourhoods
constexpr double first_radius = 2.0;        // intervals: about as far as the neighbours reach on a line
constexpr double wider = 1.4142;            // from one radius to the next
constexpr double widest = 1.0 / 3;          // of the component's extent; beyond it everything has ends
constexpr std::size_t enough_points = 128;  // for a fit: more cost time and tell nothing new

/** \brief Mean and variances of the points within a radius. */
struct Neighborhood
{
  std::size_t count = 0;
  double thickness = 0;
};

Neighborhood look_around(const Vectors& position, const PointGrid& grid, std::uint32_t i, double radius)
{
  const Eigen::Vector3f center = position[i];
  std::size_t count = 0;
  Vector3d sum(0, 0, 0);
  Matrix3d squares = Matrix3d::Zero();
  grid.visit_near(center, [&](std::uint32_t j) {
    const Vector3d d = (position[j] - center).cast<double>() / radius;
    if (d.squaredNorm() > 1) return;
    ++count;
    sum += d;
    squares += d * d.transpose();
  });
  if (count < 3) return {count, 0};
  const Vector3d mean = sum / static_cast<double>(count);
  Eigen::SelfAdjointEigenSolver<Matrix3d> solver;
  solver.computeDirect(squares / static_cast<double>(count) - mean * mean.transpose(), Eigen::EigenvaluesOnly);
  const Vector3d& variance = solver.eigenvalues();
  return {count, variance[2] > 0 ? std::sqrt(std::max(variance[1], 0.0) / variance[2]) : 1.0};
}

double mean_neighbor_distance(const Vectors& position, const NeighborGraph& graph, const NeighborSpan& members)
{
  double sum = 0;
  std::size_t count = 0;
  for (const std::uint32_t i : members) {
    for (const std::uint32_t j : graph.nearest(i)) sum += static_cast<double>((position[i] - position[j]).norm());
    count += graph.nearest(i).size();
  }
  return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

double extent(const Vectors& position, const NeighborSpan& members)
{
  Eigen::Vector3f low = position[*members.begin()];
  Eigen::Vector3f high = low;
  for (const std::uint32_t i : members) {
    low = low.cwiseMin(position[i]);
    high = high.cwiseMax(position[i]);
  }
  return static_cast<double>((high - low).norm());
}

/** \brief Every stride-th one: ranks follow a Morton curve, so these lie evenly among the others. */
std::vector<std::uint32_t> every(std::size_t stride, const NeighborSpan& members)
{
  std::vector<std::uint32_t> chosen;
  for (std::size_t m = 0; m < members.size(); m += stride) chosen.push_back(members.begin()[m]);
  return chosen;
}

/** \brief What the sampled points of a component see within a radius. */
struct View
{
  double thin_share = 0;        ///< of the points: they see a line
  double median_thickness = 0;  ///< of the neighbourhoods
  double crowd = 0;             ///< points in a neighbourhood, on average
};

View look_around(const Vectors& position, const NeighborSpan& members, double radius, const Parallel& parallel)
{
  const std::vector<std::uint32_t> all(members.begin(), members.end());
  const std::vector<std::uint32_t> samples = every((all.size() + most_samples - 1) / most_samples, members);
  const PointGrid grid(position, all, radius);
  std::vector<Neighborhood> seen(samples.size());
  constexpr std::size_t samples_per_block = 16;
  parallel.each(samples.size(), samples_per_block,
                [&](std::size_t s) { seen[s] = look_around(position, grid, samples[s], radius); });
  View view;
  std::vector<double> thickness;
  for (const Neighborhood& n : seen) {
    thickness.push_back(n.thickness);
    view.thin_share += n.thickness <= line_thickness ? 1 : 0;
    view.crowd += static_cast<double>(n.count);
  }
  view.thin_share /= static_cast<double>(seen.size());
  view.crowd /= static_cast<double>(seen.size());
  const auto middle = thickness.begin() + static_cast<std::ptrdiff_t>(thickness.size() / 2);
  std::nth_element(thickness.begin(), middle, thickness.end());
  view.median_thickness = *middle;
  return view;
}

LineScale find_line_scale(const Vectors& position,
                          const NeighborGraph& graph,
                          const NeighborSpan& members,
                          const LineLimits& limits,
                          const Parallel& parallel)
{
  const double interval = mean_neighbor_distance(position, graph, members);
  const double size = extent(position, members);
  if (interval <= 0) return {};
  for (double radius = first_radius * interval; radius <= limits.most_intervals * interval; radius *= wider) {
    if (limits.least_length * radius > size) break;
    const View view = look_around(position, members, radius, parallel);
    if (view.thin_share >= line_share) {
      const bool noisy = view.median_thickness > noisy_thickness;
      return {radius, noisy ? radius / 2 : interval, noisy, static_cast<std::size_t>(view.crowd)};
    }
    if (radius * wider > widest * size) break;
  }
  return {};
}

/** \brief Fits a parabola to the points around one. Holds the working memory of one thread. */
class ParabolaFit
{
 public:
  ParabolaFit(const Vectors& position, const PointGrid& grid, double radius)
      : position_(position), grid_(grid), radius_(radius)
  {
  }

  /** \brief The place of a point on the parabola. */
  [[nodiscard]] Eigen::Vector3f center(std::uint32_t i)
  {
    collect(i);
    const Eigen::Vector3f direction = main_direction();
    Matrix3f products = Matrix3f::Zero();
    Matrix3f right = Matrix3f::Zero();
    for (const Near& n : near_) {
      const float t = direction.dot(n.place);
      const Eigen::Vector3f powers(1, t, t * t);
      const Eigen::Vector3f weighted = n.weight * powers;
      products += weighted * powers.transpose();
      right += weighted * n.place.transpose();
    }
    // The point is where t is 0: of the coefficients, no more than the constant one is needed.
    const Vector3d fitted = products.cast<double>().ldlt().solve(right.cast<double>()).row(0);
    if (!fitted.allFinite()) return position_[i];
    const Vector3d along = direction.cast<double>();
    return (position_[i].cast<double>() + radius_ * (fitted - along * along.dot(fitted))).cast<float>();
  }

 private:
  using Matrix3f = Eigen::Matrix3f;
  struct Near
  {
    Eigen::Vector3f place;  ///< relative to the point, in radii
    float weight;           ///< fades towards the rim, so that what a point sees changes little from one to the next
  };

  void collect(std::uint32_t i)
  {
    near_.clear();
    const auto scale = static_cast<float>(1 / radius_);
    grid_.visit_near(position_[i], [&](std::uint32_t j) {
      const Eigen::Vector3f place = (position_[j] - position_[i]) * scale;
      const float rest = 1 - place.squaredNorm();
      if (rest > 0) near_.push_back({place, rest * rest});
    });
  }

  /** \brief In which the points around spread most. */
  [[nodiscard]] Eigen::Vector3f main_direction() const
  {
    float total = 0;
    Eigen::Vector3f sum(0, 0, 0);
    Matrix3f squares = Matrix3f::Zero();
    for (const Near& n : near_) {
      const Eigen::Vector3f weighted = n.weight * n.place;
      total += n.weight;
      sum += weighted;
      squares += weighted * n.place.transpose();
    }
    if (total <= 0) return Eigen::Vector3f::UnitX();
    const Vector3d mean = sum.cast<double>() / static_cast<double>(total);
    Eigen::SelfAdjointEigenSolver<Matrix3d> solver;
    solver.computeDirect(squares.cast<double>() / static_cast<double>(total) - mean * mean.transpose());
    return solver.eigenvectors().col(2).cast<float>();
  }

  const Vectors& position_;
  const PointGrid& grid_;
  double radius_;
  std::vector<Near> near_;
};

}  // namespace

std::vector<LineScale> find_line_scales(const OrderedPoints& points,
                                        const NeighborGraph& graph,
                                        const PointComponents& components,
                                        const LineLimits& limits,
                                        const Parallel& parallel)
{
  std::vector<LineScale> scales;
  for (std::size_t c = 0; c < components.size(); ++c)
    scales.push_back(find_line_scale(points.position, graph, components.points_of(c), limits, parallel));
  return scales;
}

PointArray<Eigen::Vector3f> center_on_curves(const OrderedPoints& points,
                                             const PointComponents& components,
                                             const std::vector<LineScale>& scales,
                                             const Parallel& parallel)
{
  Vectors centered = points.position;
  for (std::size_t c = 0; c < components.size(); ++c) {
    const LineScale& scale = scales[c];
    if (!scale.noisy) continue;
    const NeighborSpan members = components.points_of(c);
    const PointGrid grid(points.position, every(std::max<std::size_t>(scale.crowd / enough_points, 1), members),
                         scale.radius);
    parallel.blocks(members.size(), block, [&](std::size_t begin, std::size_t end, unsigned) {
      ParabolaFit fit(points.position, grid, scale.radius);
      for (std::size_t m = begin; m < end; ++m) {
        const std::uint32_t i = members.begin()[m];
        // Within the box, which is what later stages count on.
        centered[i] = fit.center(i).cwiseMax(-0.5F).cwiseMin(0.5F);
      }
    });
  }
  return centered;
}

std::vector<std::uint32_t> find_ends(const OrderedPoints& points,
                                     const NeighborGraph& graph,
                                     const std::vector<std::uint8_t>& rank,
                                     double radius,
                                     const Parallel& parallel)
{
  constexpr double end_share = 0.125;  // of the radius: what an end may lose of its length to a point of higher rank
  std::vector<std::uint8_t> is_last(points.size());
  parallel.each(points.size(), block, [&](std::size_t i) {
    const NeighborSpan row = graph.nearest(i);
    if (row.size() == 0) return;
    const Eigen::Vector3f along = points.position[*(row.end() - 1)] - points.position[i];
    is_last[i] = std::all_of(row.begin(), row.end(),
                             [&](std::uint32_t j) { return (points.position[j] - points.position[i]).dot(along) > 0; });
  });
  const auto within = [&](std::uint32_t i, std::uint32_t j, double reach) {
    return static_cast<double>((points.position[i] - points.position[j]).norm()) <= reach;
  };
  std::vector<std::uint32_t> ends;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (is_last[i] == 0) continue;
    std::uint32_t best = i;
    for (const std::uint32_t j : graph.nearest(i))
      if (rank[j] > rank[best] && within(i, j, end_share * radius)) best = j;
    if (std::none_of(ends.begin(), ends.end(), [&](std::uint32_t end) { return within(best, end, radius); }))
      ends.push_back(best);
  }
  std::sort(ends.begin(), ends.end());
  return ends;
}

}  // namespace pds
