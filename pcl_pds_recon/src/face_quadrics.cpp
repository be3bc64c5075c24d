// SPDX-License-Identifier: BSD-3-Clause
#include "face_quadrics.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include "face_plane.h"

namespace pds
{
namespace
{

using Eigen::Vector3d;

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
  FacePlane plane;
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
    for (const std::uint32_t* face = fans_.begin(seed); face != fans_.end(seed); ++face) {
      const Triangle& t = triangles_[*face];
      const std::size_t corner = MeshFans::corner_of(t, seed);
      const FacePlane plane(position_[seed], position_[t[(corner + 1) % 3]], position_[t[(corner + 2) % 3]]);
      if (plane.valid()) sectors_.push_back({plane, *face, corner});
    }
    return !sectors_.empty();
  }

  /** \brief Adds a point to the face that it is nearest to. */
  void add(const Vector3d& point)
  {
    const Sector* nearest = &sectors_.front();
    double least = std::numeric_limits<double>::infinity();
    for (const Sector& sector : sectors_) {
      const double distance2 = sector.plane.distance2(point);
      if (distance2 >= least) continue;
      least = distance2;
      nearest = &sector;
    }
    const FacePlane::View view = nearest->plane.view(point);
    double l[] = {view.first, view.second, view.third};
    if (std::min(l[0], std::min(l[1], l[2])) < -outermost) return;
    for (double& coordinate : l) coordinate = std::max(coordinate, 0.0);
    const double sum = l[0] + l[1] + l[2];
    double by_corner[3];
    for (std::size_t i = 0; i < 3; ++i) by_corner[(nearest->corner + i) % 3] = l[i] / sum;
    shares_[nearest->face][nearest->corner].add(by_corner, view.height);
  }

 private:
  const std::vector<Vector3d>& position_;
  const std::vector<Triangle>& triangles_;
  const MeshFans& fans_;
  std::vector<std::array<Share, 3>>& shares_;  ///< by face and corner: of the cell of the seed there
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
