// SPDX-License-Identifier: BSD-3-Clause
#include "face_quadrics.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace pds
{
namespace
{

using Eigen::Vector3d;

constexpr double flat_area = 1e-12;  // twice the area of a face, in squared radii, below which it has no normal

// Beyond a side by more than this share of the face's height a point is not on the face: it is off the mesh's rim.
constexpr double outermost = 0.3;

/** \brief What the points of one cell contribute to one face. */
struct Share
{
  double weight[6] = {};  ///< upper triangle of the sum of l l^T, row by row
  double pull[3] = {};

  void add(const double* l, double height)
  {
    double* w = weight;
    for (int i = 0; i < 3; ++i) {
      pull[i] += l[i] * height;
      for (int j = i; j < 3; ++j) *w++ += l[i] * l[j];
    }
  }

  void add_to(FaceQuadric& quadric) const
  {
    const double* w = weight;
    for (int i = 0; i < 3; ++i) {
      quadric.pull[i] += pull[i];
      for (int j = i; j < 3; ++j) {
        quadric.weight(i, j) += *w;
        if (j > i) quadric.weight(j, i) += *w;
        ++w;
      }
    }
  }
};

/** \brief A face as seen from one of its corners. */
struct Sector
{
  Vector3d normal, second, third;  ///< product with the way from the corner: height, barycentric coordinates
  std::uint32_t face;
  std::size_t corner;
};

/** \brief Collects what the cells contribute to the faces at their seeds. Holds the working memory of one thread. */
class CellShares
{
 public:
  CellShares(const std::vector<Vector3d>& position,
             const std::vector<Triangle>& triangles,
             const MeshFans& fans,
             std::vector<std::array<Share, 3>>& shares)
      : position_(position), triangles_(triangles), fans_(fans), shares_(shares)
  {
  }

  /** \brief Looks at the faces at a seed. \return false if there are none to be fitted */
  bool enter(std::uint32_t seed)
  {
    sectors_.clear();
    origin_ = position_[seed];
    for (const std::uint32_t* face = fans_.begin(seed); face != fans_.end(seed); ++face) {
      const Triangle& t = triangles_[*face];
      const std::size_t corner = MeshFans::corner_of(t, seed);
      const Vector3d second = position_[t[(corner + 1) % 3]] - origin_;
      const Vector3d third = position_[t[(corner + 2) % 3]] - origin_;
      Vector3d normal = second.cross(third);
      const double area = normal.norm();
      if (area < flat_area) continue;
      normal /= area;
      sectors_.push_back({normal, third.cross(normal) / area, normal.cross(second) / area, *face, corner});
    }
    return !sectors_.empty();
  }

  /** \brief Adds a point to the face that it is nearest to. */
  void add(const Vector3d& point)
  {
    const Vector3d way = point - origin_;
    const Sector* nearest = nullptr;
    double least = std::numeric_limits<double>::infinity();
    double l[3] = {};
    double height = 0;
    for (const Sector& sector : sectors_) {
      const double second = way.dot(sector.second);
      const double third = way.dot(sector.third);
      const double above = way.dot(sector.normal);
      // Beyond a side the distance is only guessed: heights of faces are about a radius.
      const double beyond = std::max(0.0, -std::min(std::min(second, third), 1 - second - third));
      const double distance2 = above * above + beyond * beyond;
      if (distance2 >= least) continue;
      least = distance2;
      nearest = &sector;
      height = above;
      l[0] = 1 - second - third;
      l[1] = second;
      l[2] = third;
    }
    if (std::min(l[0], std::min(l[1], l[2])) < -outermost) return;
    for (double& coordinate : l) coordinate = std::max(coordinate, 0.0);
    const double sum = l[0] + l[1] + l[2];
    double by_corner[3];
    for (std::size_t i = 0; i < 3; ++i) by_corner[(nearest->corner + i) % 3] = l[i] / sum;
    shares_[nearest->face][nearest->corner].add(by_corner, height);
  }

 private:
  const std::vector<Vector3d>& position_;
  const std::vector<Triangle>& triangles_;
  const MeshFans& fans_;
  std::vector<std::array<Share, 3>>& shares_;  ///< by face and corner: of the cell of the seed there
  Vector3d origin_ = Vector3d::Zero();
  std::vector<Sector> sectors_;
};

}  // namespace

std::vector<FaceQuadric> measure_face_quadrics(const std::vector<Vector3d>& position,
                                               const std::vector<Triangle>& triangles,
                                               const MeshFans& fans,
                                               const PointArray<Eigen::Vector3f>& points,
                                               const PoissonDiskSampling& sampling,
                                               const GeodesicVoronoi& voronoi,
                                               std::size_t stride,
                                               const Parallel& parallel)
{
  constexpr std::size_t seeds_per_block = 128;
  constexpr std::size_t faces_per_block = 1024;
  std::vector<std::array<Share, 3>> shares(triangles.size());
  parallel.blocks(position.size(), seeds_per_block, [&](std::size_t begin, std::size_t end, unsigned) {
    CellShares cell(position, triangles, fans, shares);
    for (std::size_t s = begin; s < end; ++s) {
      if (!cell.enter(static_cast<std::uint32_t>(s))) continue;
      for (std::size_t i = voronoi.cell_begin[s]; i < voronoi.cell_begin[s + 1]; i += stride)
        cell.add(points[voronoi.cell_point[i]].cast<double>() / sampling.radius);
    }
  });
  std::vector<FaceQuadric> quadrics(triangles.size());
  parallel.each(triangles.size(), faces_per_block, [&](std::size_t f) {
    const Triangle& t = triangles[f];
    quadrics[f].normal = (position[t[1]] - position[t[0]]).cross(position[t[2]] - position[t[0]]).normalized();
    for (const Share& share : shares[f]) share.add_to(quadrics[f]);
  });
  return quadrics;
}

}  // namespace pds
