// SPDX-License-Identifier: BSD-3-Clause
#include "face_quadrics.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include "face_kernel.h"
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
  double square = 0;
  std::size_t points = 0;

  void add(const double* l, double height)
  {
    square += height * height;
    ++points;
    double* w = weight;
    for (int i = 0; i < 3; ++i) {
      pull[i] += l[i] * height;
      for (int j = i; j < 3; ++j) *w++ += l[i] * l[j];
    }
  }

  void add_to(FaceQuadric& quadric) const
  {
    quadric.square += square;
    quadric.points += points;
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

/** \brief Collects what the cells contribute to the faces at their seeds. */
class CellShares
{
 public:
  CellShares(const std::vector<FacePlane>& plane,
             const std::vector<Triangle>& triangles,
             const MeshFans& fans,
             std::vector<std::array<Share, 3>>& shares)
      : plane_(plane), triangles_(triangles), fans_(fans), shares_(shares)
  {
  }

  /** \brief Adds some points of a seed's cell to the faces there that they are nearest to. None that are found at a
   * face without area count, so a vertex of such a face may stay where it is.
   * \param count of points that are set */
  void add(std::uint32_t seed, FacedPoints& points, std::size_t count)
  {
    constexpr double no_limit = std::numeric_limits<double>::infinity();
    find_nearest_faces(instruction_set_, fans_.begin(seed), fans_.end(seed), plane_, no_limit, points);
    for (std::size_t lane = 0; lane < count; ++lane) {
      const std::uint32_t* nearest = fans_.begin(seed) + points.nearest[lane];
      if (nearest != fans_.end(seed) && plane_[*nearest].valid())
        add(seed, *nearest, {points.x[lane], points.y[lane], points.z[lane]});
    }
  }

 private:
  void add(std::uint32_t seed, std::uint32_t face, const Vector3d& point)
  {
    const FacePlane::View view = plane_[face].view(point);
    double l[] = {view.first, view.second, view.third};
    if (std::min(l[0], std::min(l[1], l[2])) < -outermost) return;
    for (double& coordinate : l) coordinate = std::max(coordinate, 0.0);
    const double sum = l[0] + l[1] + l[2];
    for (double& coordinate : l) coordinate /= sum;
    shares_[face][MeshFans::corner_of(triangles_[face], seed)].add(l, view.height);
  }

  const std::vector<FacePlane>& plane_;
  const std::vector<Triangle>& triangles_;
  const MeshFans& fans_;
  std::vector<std::array<Share, 3>>& shares_;  ///< by face and corner: of the cell of the seed there
  InstructionSet instruction_set_ = best_instruction_set();
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
  std::vector<FacePlane> plane(triangles.size());
  parallel.each(triangles.size(), faces_per_block, [&](std::size_t f) {
    const Triangle& t = triangles[f];
    plane[f] = FacePlane(position[t[0]], position[t[1]], position[t[2]]);
  });
  std::vector<std::array<Share, 3>> shares(triangles.size());
  parallel.blocks(position.size(), seeds_per_block, [&](std::size_t begin, std::size_t end, unsigned) {
    CellShares cell(plane, triangles, fans, shares);
    FacedPoints faced{};
    for (std::size_t s = begin; s < end; ++s)
      for (std::size_t i = voronoi.cell_begin[s]; i < voronoi.cell_begin[s + 1];) {
        std::size_t count = 0;
        for (; count < face_lanes && i < voronoi.cell_begin[s + 1]; ++count, i += stride) {
          const Vector3d point = points[voronoi.cell_point[i]].cast<double>() / sampling.radius;
          faced.x[count] = point.x();
          faced.y[count] = point.y();
          faced.z[count] = point.z();
        }
        cell.add(static_cast<std::uint32_t>(s), faced, count);
      }
  });
  std::vector<FaceQuadric> quadrics(triangles.size());
  parallel.each(triangles.size(), faces_per_block, [&](std::size_t f) {
    quadrics[f].normal = plane[f].normal();
    for (const Share& share : shares[f]) share.add_to(quadrics[f]);
  });
  return quadrics;
}

}  // namespace pds
