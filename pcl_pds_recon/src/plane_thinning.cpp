// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/thinning.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>
#include "plane_parts.h"
#include "representatives.h"

namespace pds
{
namespace
{

constexpr std::size_t block = 16384;  // points per block
constexpr std::size_t cubes_per_block = 512;

// To find the points that can be left out takes a fifteenth of the run; unless a fifth of all is, that hardly pays.
constexpr double least_share_left_out = 0.2;
// Before all points are looked at, some stretches along the curve tell how many may be there. Where so many are,
// at least this share of points is on planes, as far as can be told.
constexpr double least_share_on_planes = 0.85;
constexpr std::size_t stretches = 4;
constexpr std::size_t stretch = 8192;  // points

/** \brief Puts squares over the plane of a cube's points and chooses the point closest to the middle of each. */
class SquareThinning
{
 public:
  SquareThinning(const PlaneParts& parts, const PointArray<Eigen::Vector3f>& position, double radius)
      : parts_(parts), position_(position), squares_per_unit_(static_cast<float>(squares_per_radius_of_plane / radius))
  {
  }

  void thin(std::size_t cube, Representatives& representative)
  {
    find_squares(cube);
    for (const Place& place : places_) squares_[place.square].offer(place);
    for (const Place& place : places_) representative[place.point] = squares_[place.square].nearest;
  }

 private:
  // The plane through a cube with a side of 1.4 radii reaches 1.2 radii far from the middle. What lies beyond the outer
  // squares counts to them.
  static constexpr int squares_per_side = 8;

  /** \brief A point in the plane; coordinates in squares. */
  struct Place
  {
    Eigen::Vector2f at;
    std::uint32_t point;
    std::uint32_t square;
  };

  struct Square
  {
    Eigen::Vector2f sum = Eigen::Vector2f::Zero();
    float count = 0;
    float least =
        std::numeric_limits<float>::infinity();  ///< squared distance of the nearest from the mean, in squares
    std::uint32_t nearest = 0;

    void add(const Eigen::Vector2f& at)
    {
      sum += at;
      count += 1;
    }
    void offer(const Place& place)
    {
      const float distance = (place.at * count - sum).squaredNorm();
      if (distance >= least) return;
      least = distance;
      nearest = place.point;
    }
  };

  void find_squares(std::size_t cube)
  {
    const Eigen::Vector3f& middle = parts_.middle(cube);
    const Eigen::Vector3f u = parts_.normal(cube).unitOrthogonal() * squares_per_unit_;
    const Eigen::Vector3f v = parts_.normal(cube).cross(u);
    squares_.fill({});
    places_.clear();
    parts_.for_points(cube, [&](std::uint32_t i) {
      const Eigen::Vector3f way = position_[i] - middle;
      const Eigen::Vector2f at(u.dot(way), v.dot(way));
      const auto square = static_cast<std::uint32_t>(index(at.x()) * squares_per_side + index(at.y()));
      places_.push_back({at, i, square});
      squares_[square].add(at);
    });
  }

  static int index(float coordinate)
  {
    constexpr int half = squares_per_side / 2;
    return std::clamp(static_cast<int>(coordinate + half), 0, squares_per_side - 1);
  }

  const PlaneParts& parts_;
  const PointArray<Eigen::Vector3f>& position_;
  float squares_per_unit_;
  std::array<Square, std::size_t{squares_per_side} * squares_per_side> squares_;
  std::vector<Place> places_;
};

Bounds bounds_of(const PointArray<Eigen::Vector3f>& position, const Parallel& parallel)
{
  return parallel.sum(position.size(), block, [&](std::size_t begin, std::size_t end) {
    Eigen::Vector3f low = position[begin], high = position[begin];
    for (std::size_t i = begin + 1; i < end; ++i) {
      low = low.cwiseMin(position[i]);
      high = high.cwiseMax(position[i]);
    }
    return Bounds{low.cast<double>(), high.cast<double>()};
  });
}

/** \brief False if plane parts seem to be too small a share of a large cloud. */
bool may_pay(const PointArray<Eigen::Vector3f>& position,
             const Bounds& bounds,
             double radius,
             double thickest,
             const Parallel& parallel)
{
  if (position.size() < 4 * stretches * stretch) return true;
  PlaneParts::Counts counts;
  for (std::size_t s = 0; s < stretches; ++s) {
    const std::size_t begin = s * (position.size() / stretches);
    counts += PlaneParts(position, begin, begin + stretch, bounds, radius, thickest, parallel).count_points(parallel);
  }
  const auto telling = static_cast<double>(stretches * stretch - counts.narrow);
  return static_cast<double>(counts.plane) >= least_share_on_planes * telling;
}

Representatives choose_representatives(const PointArray<Eigen::Vector3f>& position,
                                       const PlaneParts& parts,
                                       double radius,
                                       const Parallel& parallel)
{
  const PointArray<std::uint8_t> midst = parts.find_midst(parallel);
  Representatives representative(position.size());
  parallel.blocks(parts.cubes(), cubes_per_block, [&](std::size_t begin, std::size_t end, unsigned) {
    SquareThinning squares(parts, position, radius);
    for (std::size_t cube = begin; cube < end; ++cube) {
      if (midst[cube] != 0)
        squares.thin(cube, representative);
      else
        parts.for_points(cube, [&](std::uint32_t i) { representative[i] = i; });
    }
  });
  return representative;
}

}  // namespace

OrderedPoints thin_plane_parts(OrderedPoints points, double radius, double thickest, const Parallel& parallel)
{
  const PointArray<Eigen::Vector3f>& position = points.position;
  if (points.size() < fewest_points_to_thin_planes) return points;
  const Bounds bounds = bounds_of(position, parallel);
  if (!(radius > 0 && radius < bounds.extent()) || !may_pay(position, bounds, radius, thickest, parallel))
    return points;
  const PlaneParts parts(position, 0, points.size(), bounds, radius, thickest, parallel);
  const Representatives representative = choose_representatives(position, parts, radius, parallel);
  const auto left_out = static_cast<double>(points.size() - count_representatives(representative, parallel));
  if (left_out < least_share_left_out * static_cast<double>(points.size())) return points;
  return keep_representatives(std::move(points), representative, parallel);
}

}  // namespace pds
