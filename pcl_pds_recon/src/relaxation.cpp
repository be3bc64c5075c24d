// SPDX-License-Identifier: BSD-3-Clause
#include "relaxation.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace pds
{
namespace
{

using Eigen::Vector3d;

constexpr double overshoot = 1.7;      // of a step beyond the centroid: a step of 1 stops short of evenness
constexpr double longest_lead = 0.12;  // radii: goals farther from their seeds than points lie apart would wander off
constexpr double least_gap = 0.75;     // of the mean distance to the seeds beside: closer ones make slivers
constexpr int choices = 3;             // of points for even triangles; a fourth hardly changes anything

/** \brief Area and area times centroid, summed up. */
struct AreaMoment
{
  double area = 0;
  Vector3d moment = Vector3d::Zero();

  /** \param normal unit; a triangle that runs the other way about it counts as negative */
  void add(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& normal)
  {
    const double signed_area = 0.5 * (b - a).cross(c - a).dot(normal);
    area += signed_area;
    moment += signed_area * (a + b + c) / 3.0;
  }
};

/** \brief Adds the part of the Voronoi cell of corner a that lies on the triangle. */
void add_corner_of_cell(const Vector3d& a, const Vector3d& b, const Vector3d& c, AreaMoment& cell)
{
  const Vector3d u = b - a;
  const Vector3d v = c - a;
  const Vector3d normal = u.cross(v);
  const double normal2 = normal.squaredNorm();
  if (normal2 <= 0) return;
  const Vector3d center = a + (u.squaredNorm() * v.cross(normal) + v.squaredNorm() * normal.cross(u)) / (2 * normal2);
  const Vector3d unit = normal / std::sqrt(normal2);
  cell.add(a, a + 0.5 * u, center, unit);
  cell.add(a, center, a + 0.5 * v, unit);
}

/** \brief True if faces lie all around the seed. */
bool is_inner(std::uint32_t seed, const std::vector<Triangle>& triangles, const MeshFans& fans)
{
  return !fans.empty(seed) && std::all_of(fans.begin(seed), fans.end(seed), [&](std::uint32_t face) {
    const std::size_t corner = MeshFans::corner_of(triangles[face], seed);
    return fans.across(face, corner) != TriangleComplex::no_face &&
           fans.across(face, (corner + 2) % 3) != TriangleComplex::no_face;
  });
}

std::optional<Vector3d> centroid_of_cell(std::uint32_t seed,
                                         const std::vector<Vector3d>& position,
                                         const std::vector<Triangle>& triangles,
                                         const MeshFans& fans)
{
  if (!is_inner(seed, triangles, fans)) return std::nullopt;
  AreaMoment cell;
  for (const std::uint32_t* f = fans.begin(seed); f != fans.end(seed); ++f) {
    const Triangle& t = triangles[*f];
    const std::size_t corner = MeshFans::corner_of(t, seed);
    add_corner_of_cell(position[seed], position[t[(corner + 1) % 3]], position[t[(corner + 2) % 3]], cell);
  }
  if (cell.area <= 0) return std::nullopt;
  return cell.moment / cell.area;
}

/** \brief True if a seed at a new place would be much nearer to one next to it than these are on the average. */
bool crowds(std::uint32_t seed,
            const Vector3d& place,
            const std::vector<Vector3d>& position,
            const std::vector<Triangle>& triangles,
            const MeshFans& fans)
{
  double nearest = std::numeric_limits<double>::infinity();
  double sum = 0;
  int count = 0;
  for (const std::uint32_t* f = fans.begin(seed); f != fans.end(seed); ++f) {
    const Vector3d& other = position[triangles[*f][(MeshFans::corner_of(triangles[*f], seed) + 1) % 3]];
    nearest = std::min(nearest, (other - place).norm());
    sum += (other - position[seed]).norm();
    ++count;
  }
  return nearest * count < least_gap * sum;
}

/** \brief Sine of the smallest angle of a triangle. */
double smallest_sine(const Vector3d& a, const Vector3d& b, const Vector3d& c)
{
  const std::array<double, 3> squared = {(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()};
  const double product = squared[0] * squared[1] * squared[2];
  const double doubled_area = (b - a).cross(c - a).norm();
  return product > 0 ? doubled_area * std::sqrt(*std::min_element(squared.begin(), squared.end()) / product) : 0;
}

/** \brief Sum of the smallest sines of the triangles at a seed, if it were at \a place and the others at \a position.
 */
double evenness(std::uint32_t seed,
                const Vector3d& place,
                const std::vector<Vector3d>& position,
                const std::vector<Triangle>& triangles,
                const MeshFans& fans)
{
  double sum = 0;
  for (const std::uint32_t* f = fans.begin(seed); f != fans.end(seed); ++f) {
    const Triangle& t = triangles[*f];
    const std::size_t corner = MeshFans::corner_of(t, seed);
    sum += smallest_sine(place, position[t[(corner + 1) % 3]], position[t[(corner + 2) % 3]]);
  }
  return sum;
}

}  // namespace

/** Seeds that were added since are where they should be. */
std::vector<Vector3d> Relaxation::goals_of(const SeedGeometry& seeds, const PoissonDiskSampling& sampling) const
{
  std::vector<Vector3d> goals = seeds.position;
  auto goal = goals_.begin();
  for (std::size_t s = 0; s < goals.size(); ++s) {
    while (goal != goals_.end() && goal->rank < sampling.seeds[s]) ++goal;
    if (goal != goals_.end() && goal->rank == sampling.seeds[s]) goals[s] = goal->position;
  }
  return goals;
}

std::vector<std::uint32_t> Relaxation::step(const SeedGeometry& seeds,
                                            const std::vector<Triangle>& triangles,
                                            const OrderedPoints& points,
                                            const PoissonDiskSampling& sampling,
                                            const GeodesicVoronoi& voronoi,
                                            bool is_last,
                                            const Parallel& parallel)
{
  constexpr std::size_t block = 512;
  const MeshFans fans(triangles, seeds.position.size(), parallel);
  const std::vector<Vector3d> before = goals_of(seeds, sampling);
  goals_.resize(before.size());
  parallel.each(goals_.size(), block, [&](std::size_t s) {
    Goal& goal = goals_[s];
    goal = {sampling.seeds[s], before[s]};
    const auto centroid = centroid_of_cell(static_cast<std::uint32_t>(s), before, triangles, fans);
    if (!centroid) return;
    goal.position += overshoot * (*centroid - goal.position);
    if (crowds(static_cast<std::uint32_t>(s), goal.position, seeds.position, triangles, fans)) {
      goal.position = before[s];
      return;
    }
    const Vector3d position = goal.position * sampling.radius;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = voronoi.cell_begin[s]; i < voronoi.cell_begin[s + 1]; ++i) {
      const std::uint32_t point = voronoi.cell_point[i];
      const double distance = (points.position[point].cast<double>() - position).squaredNorm();
      if (distance >= least) continue;
      least = distance;
      goal.rank = point;
    }
    const Vector3d seed = points.position[goal.rank].cast<double>() / sampling.radius;
    const Vector3d lead = goal.position - seed;
    goal.position = seed + lead * std::min(1.0, longest_lead / std::max(lead.norm(), 1e-30));
  });
  if (is_last) even_out(triangles, fans, points, sampling, voronoi);
  std::sort(goals_.begin(), goals_.end(), [](const Goal& a, const Goal& b) { return a.rank < b.rank; });
  std::vector<std::uint32_t> ranks;
  for (const Goal& goal : goals_) ranks.push_back(goal.rank);
  return ranks;
}

/** One seed after the other, so that each sees where those beside it are by then. */
void Relaxation::even_out(const std::vector<Triangle>& triangles,
                          const MeshFans& fans,
                          const OrderedPoints& points,
                          const PoissonDiskSampling& sampling,
                          const GeodesicVoronoi& voronoi)
{
  const auto place_of = [&](std::uint32_t rank) -> Vector3d {
    return points.position[rank].cast<double>() / sampling.radius;
  };
  std::vector<Vector3d> position;
  for (const Goal& goal : goals_) position.push_back(place_of(goal.rank));
  for (int choice = 0; choice < choices; ++choice) {
    for (std::uint32_t s = 0; s < goals_.size(); ++s) {
      if (!is_inner(s, triangles, fans)) continue;
      double best = evenness(s, position[s], position, triangles, fans);
      for (std::size_t i = voronoi.cell_begin[s]; i < voronoi.cell_begin[s + 1]; ++i) {
        const Vector3d place = place_of(voronoi.cell_point[i]);
        const double even = evenness(s, place, position, triangles, fans);
        if (even <= best) continue;
        best = even;
        position[s] = place;
        goals_[s].rank = voronoi.cell_point[i];
      }
    }
  }
}

}  // namespace pds
