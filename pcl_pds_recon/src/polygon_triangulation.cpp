// SPDX-License-Identifier: BSD-3-Clause
#include "polygon_triangulation.h"
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace pds
{
namespace
{

using Eigen::Vector3d;

constexpr double infinity = std::numeric_limits<double>::infinity();

double squared_circumradius(const Vector3d& a, const Vector3d& b, const Vector3d& c)
{
  const double area2 = (b - a).cross(c - a).squaredNorm();  // four times the squared area
  const double product = (b - a).squaredNorm() * (c - b).squaredNorm() * (a - c).squaredNorm();
  return area2 > 0 ? product / (4 * area2) : infinity;
}

/** \brief Minimum-weight triangulation of a polygon in space by dynamic programming over its chords. */
class PolygonTriangulation
{
 public:
  /** \param bordering null if any chord will do */
  PolygonTriangulation(const TriangleComplex& complex,
                       const BorderingCells* bordering,
                       const Polygon& polygon,
                       const FillLimits& limits)
      : complex_(complex),
        bordering_(bordering),
        polygon_(polygon),
        limits_(limits),
        n_(polygon.size()),
        largest_cosine_(std::cos(limits.smallest_angle)),
        cost_(n_ * n_, infinity),
        apex_(n_ * n_, 0)
  {
    for (std::size_t i = 0; i + 1 < n_; ++i) cost_[i * n_ + i + 1] = 0;
    for (std::size_t span = 2; span < n_; ++span)
      for (std::size_t i = 0; i + span < n_; ++i) solve(i, i + span);
  }

  [[nodiscard]] bool exists() const { return cost_[n_ - 1] < infinity; }

  [[nodiscard]] std::vector<Triangle> triangles() const
  {
    std::vector<Triangle> result;
    std::vector<std::pair<std::size_t, std::size_t>> stack{{0, n_ - 1}};
    while (!stack.empty()) {
      const auto [i, j] = stack.back();
      stack.pop_back();
      if (j - i < 2) continue;
      const std::size_t m = apex_[i * n_ + j];
      result.push_back({polygon_[i], polygon_[m], polygon_[j]});
      stack.emplace_back(i, m);
      stack.emplace_back(m, j);
    }
    return result;
  }

 private:
  [[nodiscard]] const Vector3d& at(std::size_t i) const { return complex_.position()[polygon_[i]]; }

  [[nodiscard]] bool is_side(std::size_t i, std::size_t j) const { return j == i + 1 || (i == 0 && j == n_ - 1); }

  void solve(std::size_t i, std::size_t j)
  {
    if (!is_side(i, j) && !chord_allowed(i, j)) return;
    for (std::size_t m = i + 1; m < j; ++m) {
      const double below = cost_[i * n_ + m] + cost_[m * n_ + j];
      if (below == infinity || folds(i, m, j) || folds(m, j, i) || (is_side(i, j) && folds_outside(i, j, m))) continue;
      const double cost = below + squared_circumradius(at(i), at(m), at(j));
      if (cost < cost_[i * n_ + j] && complex_.facing({polygon_[i], polygon_[m], polygon_[j]}) >= limits_.facing) {
        cost_[i * n_ + j] = cost;
        apex_[i * n_ + j] = m;
      }
    }
  }

  /** \brief Whether a triangle with this apex folds onto what lies beyond its edge (i, j): another triangle of the
   * filling, or the face outside the polygon. */
  [[nodiscard]] bool folds(std::size_t i, std::size_t j, std::size_t apex) const
  {
    if (j == i + 1) return folds_outside(i, j, apex);
    return TriangleComplex::fold_cosine(at(i), at(j), at(apex), at(apex_[i * n_ + j])) > largest_cosine_;
  }

  [[nodiscard]] bool folds_outside(std::size_t i, std::size_t j, std::size_t apex) const
  {
    const std::uint32_t a = polygon_[i];
    const std::uint32_t b = polygon_[j];
    for (const std::uint32_t f : complex_.faces_at(a)) {
      const Triangle t = complex_.oriented(f);
      if (t[0] != b && t[1] != b && t[2] != b) continue;
      const std::uint32_t outside = t[0] + t[1] + t[2] - a - b;
      if (TriangleComplex::fold_cosine(at(i), at(j), at(apex), complex_.position()[outside]) > largest_cosine_)
        return true;
    }
    return false;
  }

  [[nodiscard]] bool chord_allowed(std::size_t i, std::size_t j) const
  {
    return local_length(complex_, polygon_[i], polygon_[j], limits_) <= limits_.chord &&
           !complex_.has_edge(polygon_[i], polygon_[j]) &&
           (bordering_ == nullptr || (*bordering_)(polygon_[i], polygon_[j]));
  }

  const TriangleComplex& complex_;
  const BorderingCells* bordering_;
  const Polygon& polygon_;
  const FillLimits& limits_;
  std::size_t n_;
  double largest_cosine_;
  std::vector<double> cost_;  ///< of the sub-polygon i ... j, at i * n + j
  std::vector<std::size_t> apex_;
};

}  // namespace

std::vector<Triangle> triangulate(const TriangleComplex& complex,
                                  const BorderingCells* bordering,
                                  const Polygon& polygon,
                                  const FillLimits& limits)
{
  const PolygonTriangulation triangulation(complex, bordering, polygon, limits);
  return triangulation.exists() ? triangulation.triangles() : std::vector<Triangle>{};
}

double local_length(const TriangleComplex& complex, std::uint32_t a, std::uint32_t b, const FillLimits& limits)
{
  const double length = (complex.position()[a] - complex.position()[b]).norm();
  return limits.sparsity == nullptr ? length : length / std::max((*limits.sparsity)[a], (*limits.sparsity)[b]);
}

double perimeter(const TriangleComplex& complex, const Polygon& polygon, const FillLimits& limits)
{
  double sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    sum += local_length(complex, polygon[i], polygon[(i + 1) % polygon.size()], limits);
  return sum;
}

double area_of(const std::vector<Triangle>& triangles, const std::vector<Vector3d>& position)
{
  double sum = 0;
  for (const Triangle& t : triangles)
    sum += 0.5 * (position[t[1]] - position[t[0]]).cross(position[t[2]] - position[t[0]]).norm();
  return sum;
}

}  // namespace pds
