// SPDX-License-Identifier: BSD-3-Clause
#include "plane_parts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace pds
{
namespace
{

constexpr std::size_t cubes_per_block = 512;

// Standard deviation of points along their plane, in radii, if that is one: a strip 0.4 wide. The plane through two
// lines says nothing about sheets.
constexpr double least_width = 0.125;
// Rise of the way from a piece to one beside it, over its plane: a crease of less than 53 degrees, or a ball with a
// radius of more than one. The way to another sheet is steeper.
constexpr float steepest = 0.5F;

/** \brief Cells of the Morton curve through the box, with sides closest to the radius: as many as can be numbered, in
 * the middle of the points, which is where coordinates are zero. Strays farther away make no difference to these. */
VoxelGrid cells_of_curve(const Bounds& bounds, double radius)
{
  constexpr double most_cells = 1 << 20;
  const double side = std::ldexp(bounds.extent(), -static_cast<int>(std::lround(std::log2(bounds.extent() / radius))));
  const Eigen::Array3d skipped = ((-bounds.low.array() / side).floor() - most_cells / 2).max(0.0);
  return VoxelGrid(bounds.low + (skipped * side).matrix(), side, std::min(bounds.extent() / side, most_cells));
}

/** \brief Second moments of points in steps of a length that keeps products of them from underflow. */
class Moments
{
 public:
  explicit Moments(float step) : per_unit_(1 / step) {}

  void add(const Eigen::Vector3f& p)
  {
    if (count_ == 0) origin_ = p;
    const Eigen::Vector3f d = (p - origin_) * per_unit_;
    count_ += 1;
    mean_ += d;
    xx_ += d.x() * d.x(), xy_ += d.x() * d.y(), xz_ += d.x() * d.z();
    yy_ += d.y() * d.y(), yz_ += d.y() * d.z(), zz_ += d.z() * d.z();
  }

  /** \brief To be called when all have been added: makes them those about the mean. */
  void center()
  {
    mean_ /= count_;
    xx_ = xx_ / count_ - mean_.x() * mean_.x(), xy_ = xy_ / count_ - mean_.x() * mean_.y();
    xz_ = xz_ / count_ - mean_.x() * mean_.z(), yy_ = yy_ / count_ - mean_.y() * mean_.y();
    yz_ = yz_ / count_ - mean_.y() * mean_.z(), zz_ = zz_ / count_ - mean_.z() * mean_.z();
  }

  [[nodiscard]] Eigen::Vector3f mean() const { return origin_ + mean_ / per_unit_; }

  /** \brief By Sylvester's law: as many as there are negative pivots in the elimination of covariance - limit. */
  [[nodiscard]] int eigenvalues_below(float limit) const
  {
    const float xx = xx_ - limit, yy = yy_ - limit, zz = zz_ - limit;
    const float second = yy - xy_ * xy_ / xx;
    const float coupling = yz_ - xy_ * xz_ / xx;
    const float third = zz - xz_ * xz_ / xx - coupling * coupling / second;
    return (xx < 0 ? 1 : 0) + (second < 0 ? 1 : 0) + (third < 0 ? 1 : 0);
  }

  /** \brief The longest column of the adjugate points along the least eigenvalue's vector, if that value is small. */
  [[nodiscard]] Eigen::Vector3f normal() const
  {
    const Eigen::Vector3f x(xx_, xy_, xz_), y(xy_, yy_, yz_), z(xz_, yz_, zz_);
    const Eigen::Vector3f a = y.cross(z), b = z.cross(x), c = x.cross(y);
    if (a.x() >= b.y() && a.x() >= c.z()) return a.normalized();
    return b.y() >= c.z() ? b.normalized() : c.normalized();
  }

 private:
  float per_unit_;
  float count_ = 0;
  Eigen::Vector3f origin_ = Eigen::Vector3f::Zero();
  Eigen::Vector3f mean_ = Eigen::Vector3f::Zero();
  float xx_ = 0, xy_ = 0, xz_ = 0, yy_ = 0, yz_ = 0, zz_ = 0;
};

/** \brief Eight directions of a plane, and which of them something lies in, within 45 degrees. */
class Compass
{
 public:
  void mark(float x, float y)
  {
    constexpr float cosine = 0.70710678F;  // of 45 degrees, and of the diagonals
    const std::array<float, 4> along{x, cosine * (x + y), y, cosine * (y - x)};
    const float least = cosine * std::sqrt(x * x + y * y);
    for (unsigned k = 0; k < 4; ++k) {
      if (along[k] >= least) marks_ |= 1U << k;
      if (-along[k] >= least) marks_ |= 16U << k;
    }
  }
  [[nodiscard]] bool complete() const { return marks_ == 255U; }

 private:
  unsigned marks_ = 0;
};

}  // namespace

PlaneParts::PlaneParts(const PointArray<Eigen::Vector3f>& position,
                       std::size_t begin,
                       std::size_t end,
                       const Bounds& bounds,
                       double radius,
                       double thickest,
                       const Parallel& parallel)
    : grid_(cells_of_curve(bounds, radius)), cubes_(position, begin, end, grid_, parallel), pieces_(cubes_.voxels())
{
  parallel.each(cubes(), cubes_per_block,
                [&](std::size_t cube) { pieces_[cube] = describe(position, cube, radius, thickest); });
}

PlaneParts::Piece PlaneParts::describe(const PointArray<Eigen::Vector3f>& position,
                                       std::size_t cube,
                                       double radius,
                                       double thickest) const
{
  const double in_radii = thickest / radius;
  const auto square = [](double deviation) { return static_cast<float>(deviation * deviation); };
  Moments moments(static_cast<float>(radius));
  cubes_.for_points(cube, [&](std::uint32_t i) { moments.add(position[i]); });
  moments.center();
  Shape shape = Shape::plane;
  if (moments.eigenvalues_below(square(in_radii)) == 0)
    shape = Shape::thick;
  else if (moments.eigenvalues_below(square(least_width)) > 1)
    shape = Shape::narrow;
  return {cubes_.number(cube), moments.mean(), moments.normal(), shape};
}

PlaneParts::Counts PlaneParts::count_points(const Parallel& parallel) const
{
  return parallel.sum(cubes(), cubes_per_block, [&](std::size_t begin, std::size_t end) {
    Counts counts;
    for (std::size_t cube = begin; cube < end; ++cube) {
      if (pieces_[cube].shape == Shape::plane) counts.plane += cubes_.points(cube);
      if (pieces_[cube].shape == Shape::narrow) counts.narrow += cubes_.points(cube);
    }
    return counts;
  });
}

PointArray<std::uint8_t> PlaneParts::find_midst(const Parallel& parallel) const
{
  PointArray<Shape> shape(cubes());
  parallel.blocks(cubes(), cubes_per_block, [&](std::size_t begin, std::size_t end, unsigned) {
    for_neighbors(begin, end, [&](std::size_t cube, const std::uint32_t* neighbors, std::size_t count) {
      shape[cube] = goes_on_all_around(pieces_[cube], neighbors, count) ? Shape::inner : pieces_[cube].shape;
    });
  });
  PointArray<std::uint8_t> midst(cubes());
  parallel.blocks(cubes(), cubes_per_block, [&](std::size_t begin, std::size_t end, unsigned) {
    for_neighbors(begin, end, [&](std::size_t cube, const std::uint32_t* neighbors, std::size_t count) {
      // The corner of a cube that the surface just cuts is narrow: that says nothing.
      const auto harmless = [&](std::uint32_t n) { return shape[n] == Shape::inner || shape[n] == Shape::narrow; };
      midst[cube] = shape[cube] == Shape::inner && std::all_of(neighbors, neighbors + count, harmless) ? 1 : 0;
    });
  });
  return midst;
}

bool PlaneParts::goes_on_all_around(const Piece& piece, const std::uint32_t* neighbors, std::size_t count) const
{
  if (piece.shape != Shape::plane) return false;
  const Eigen::Vector3f u = piece.normal.unitOrthogonal();
  const Eigen::Vector3f v = piece.normal.cross(u);
  Compass compass;
  for (std::size_t n = 0; n < count; ++n) {
    const Piece& neighbor = pieces_[neighbors[n]];
    if (neighbor.shape == Shape::thick) return false;
    const Eigen::Vector3f way = neighbor.middle - piece.middle;
    const float x = u.dot(way), y = v.dot(way), rise = piece.normal.dot(way);
    if (rise * rise > steepest * steepest * (x * x + y * y)) return false;
    compass.mark(x, y);
  }
  return compass.complete();
}

/** \brief Calls body(cube, neighbors, count) with the cubes that touch each one from \a begin to \a end and hold
 * points.
 *
 * In the order of their numbers, those of a column of three are one after the other, and columns move on with the cube.
 */
template <typename Body>
void PlaneParts::for_neighbors(std::size_t begin, std::size_t end, const Body& body) const
{
  constexpr std::size_t columns = 9;
  constexpr std::size_t most_neighbors = 26;
  std::array<std::uint64_t, columns> to_column{};
  std::array<std::size_t, columns> at{};
  for (std::size_t c = 0; c < columns; ++c) {
    const auto x = static_cast<std::int64_t>(c / 3) - 1, y = static_cast<std::int64_t>(c % 3) - 1;
    to_column[c] = static_cast<std::uint64_t>(grid_.step(x, y, -1));
    const auto first = std::lower_bound(pieces_.begin(), pieces_.end(), pieces_[begin].cube + to_column[c],
                                        [](const Piece& piece, std::uint64_t number) { return piece.cube < number; });
    at[c] = static_cast<std::size_t>(first - pieces_.begin());
  }
  std::array<std::uint32_t, most_neighbors> neighbors{};
  for (std::size_t cube = begin; cube < end; ++cube) {
    std::size_t count = 0;
    for (std::size_t c = 0; c < columns; ++c) {
      const std::uint64_t first = pieces_[cube].cube + to_column[c];
      while (at[c] < pieces_.size() && pieces_[at[c]].cube < first) ++at[c];
      for (std::size_t n = at[c]; n < pieces_.size() && pieces_[n].cube <= first + 2; ++n)
        if (n != cube) neighbors[count++] = static_cast<std::uint32_t>(n);
    }
    body(cube, neighbors.data(), count);
  }
}

}  // namespace pds
