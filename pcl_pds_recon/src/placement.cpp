// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/placement.h>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include "face_quadrics.h"
#include "mesh_fans.h"

namespace pds
{
namespace
{

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::size_t block = 512;  // vertices or faces per block

// Faces turn as their corners move, and points come to lie on others: the quadrics are measured anew, first from a
// share of the points, because a later pass corrects what they get wrong. A vertex takes several passes to slide into a
// crease. Noise is fitted in them as well, so that more of them do harm there.
const std::vector<std::size_t> clean_strides = {4, 2, 1, 1, 1, 1, 1};
const std::vector<std::size_t> noisy_strides = {4, 2, 1};

// Damped Jacobi iterations of a pass. The system is like the mass matrix of linear elements, whose eigenvalues relative
// to its diagonal are 1/2 to 2: each iteration leaves 0.6 of the error, eight leave less than 2 %.
constexpr int iterations = 8;
constexpr double damping = 0.8;

// How far vertices are likely to move, in radii. A move of u is worth what the fit gains by it over the variance of the
// points about the faces, less u^2 over twice the square of this: where that variance is small, as on the flanks of a
// crease, a vertex goes where they meet, however little they differ.
constexpr double likely_move = 0.1;
constexpr double least_hold = 1e-4;  // of the quadric's trace: on a plane nothing but rounding says where to go

// Noise turns the faces, and a vertex would go wherever they happen to meet.
constexpr double noisy_least_eigenvalue = 0.01;  // of the largest: directions that faces within 6 degrees show
constexpr double noisy_hold = 0.02;              // likewise: holds back what noise makes of others

constexpr double largest_turn_cosine = 0.5;  // of 60 degrees: how far a face may turn
constexpr double fold_cosine = -0.76;  // of the normals of two faces that enclose 40 degrees, as hole filling allows
constexpr int halvings = 4;            // of a move that folds a face, before the vertex stays

/** \brief Solves the quadrics of all faces for the moves of their corners. */
class QuadricSystem
{
 public:
  QuadricSystem(const std::vector<FaceQuadric>& quadrics,
                const std::vector<Triangle>& triangles,
                const MeshFans& fans,
                std::size_t vertex_count,
                bool noisy,
                const Parallel& parallel)
      : quadrics_(quadrics),
        triangles_(triangles),
        fans_(fans),
        vertex_count_(vertex_count),
        noisy_(noisy),
        parallel_(parallel)
  {
  }

  [[nodiscard]] std::vector<Vector3d> solve() const
  {
    std::vector<Matrix3d> inverse(vertex_count_);
    std::vector<double> hold(vertex_count_);
    parallel_.each(vertex_count_, block, [&](std::size_t v) { inverse[v] = held_inverse(v, hold[v]); });
    std::vector<Vector3d> move(vertex_count_, Vector3d::Zero());
    std::vector<Vector3d> next(vertex_count_);
    for (int i = 0; i < iterations; ++i) {
      parallel_.each(vertex_count_, block, [&](std::size_t v) {
        next[v] = move[v] + damping * (inverse[v] * (descent(v, move) - hold[v] * move[v]));
      });
      move.swap(next);
    }
    return move;
  }

 private:
  /** \brief The quadrics of a vertex's faces, as a function of its own move u: u.weight.u - 2 pull.u + square. */
  struct VertexQuadric
  {
    Matrix3d weight = Matrix3d::Zero();
    Vector3d pull = Vector3d::Zero();
    double square = 0;
    std::size_t points = 0;
  };

  [[nodiscard]] VertexQuadric quadric_of(std::size_t vertex) const
  {
    VertexQuadric sum;
    for (const std::uint32_t* f = fans_.begin(vertex); f != fans_.end(vertex); ++f) {
      const FaceQuadric& quadric = quadrics_[*f];
      const auto corner = static_cast<Eigen::Index>(corner_of(*f, vertex));
      sum.weight += quadric.weight(corner, corner) * quadric.normal * quadric.normal.transpose();
      sum.pull += quadric.pull[corner] * quadric.normal;
      sum.square += quadric.square;
      sum.points += quadric.points;
    }
    return sum;
  }

  /** \brief Inverse of the vertex's own quadric and of what holds it where it is.
   * \param hold weight of the squared length of the move */
  Matrix3d held_inverse(std::size_t vertex, double& hold) const
  {
    const VertexQuadric quadric = quadric_of(vertex);
    hold = 0;
    if (!(quadric.weight.trace() > 0)) return Matrix3d::Zero();
    if (noisy_) return truncated_inverse(quadric.weight, hold);
    const auto inverse = [&]() -> Matrix3d { return (quadric.weight + hold * Matrix3d::Identity()).inverse(); };
    hold = least_hold * quadric.weight.trace();
    const double rest = std::max(0.0, quadric.square - quadric.pull.dot(inverse() * quadric.pull));
    hold += rest / static_cast<double>(quadric.points) / (likely_move * likely_move);
    return inverse();
  }

  /** \brief The same in noise: only in the directions that the faces show clearly. */
  static Matrix3d truncated_inverse(const Matrix3d& weight, double& hold)
  {
    Eigen::SelfAdjointEigenSolver<Matrix3d> solver;
    solver.computeDirect(weight);
    const double largest = solver.eigenvalues()[2];
    hold = noisy_hold * largest;
    Matrix3d inverse = Matrix3d::Zero();
    for (Eigen::Index i = 0; i < 3; ++i) {
      const double eigenvalue = solver.eigenvalues()[i];
      const Vector3d direction = solver.eigenvectors().col(i);
      if (eigenvalue > noisy_least_eigenvalue * largest)
        inverse += direction * direction.transpose() / (eigenvalue + hold);
    }
    return inverse;
  }

  /** \brief Half the negative gradient of the quadrics at a vertex. */
  [[nodiscard]] Vector3d descent(std::size_t vertex, const std::vector<Vector3d>& move) const
  {
    Vector3d sum = Vector3d::Zero();
    for (const std::uint32_t* f = fans_.begin(vertex); f != fans_.end(vertex); ++f) {
      const FaceQuadric& quadric = quadrics_[*f];
      const Triangle& t = triangles_[*f];
      const auto corner = static_cast<Eigen::Index>(corner_of(*f, vertex));
      const Vector3d along(quadric.normal.dot(move[t[0]]), quadric.normal.dot(move[t[1]]),
                           quadric.normal.dot(move[t[2]]));
      sum += (quadric.pull[corner] - quadric.weight.col(corner).dot(along)) * quadric.normal;
    }
    return sum;
  }

  [[nodiscard]] std::size_t corner_of(std::uint32_t face, std::size_t vertex) const
  {
    return MeshFans::corner_of(triangles_[face], static_cast<std::uint32_t>(vertex));
  }

  const std::vector<FaceQuadric>& quadrics_;
  const std::vector<Triangle>& triangles_;
  const MeshFans& fans_;
  std::size_t vertex_count_;
  bool noisy_;
  const Parallel& parallel_;
};

/** \brief Keeps moved vertices in their cells and faces from folding. */
class MoveGuard
{
 public:
  MoveGuard(const std::vector<Vector3d>& start,
            const std::vector<Triangle>& triangles,
            const MeshFans& fans,
            const Parallel& parallel)
      : start_(start), triangles_(triangles), fans_(fans), parallel_(parallel), normal_at_start_(normals(start))
  {
  }

  /** \brief Brings vertices back that are farther from their seed than half way to the next one. */
  void keep_in_cells(std::vector<Vector3d>& position) const
  {
    parallel_.each(position.size(), block, [&](std::size_t v) {
      double nearest2 = std::numeric_limits<double>::infinity();
      for (const std::uint32_t* f = fans_.begin(v); f != fans_.end(v); ++f)
        for (const std::uint32_t other : triangles_[*f])
          if (other != v) nearest2 = std::min(nearest2, (start_[other] - start_[v]).squaredNorm());
      const Vector3d move = position[v] - start_[v];
      const double excess = 2 * move.norm() / std::sqrt(nearest2);
      if (excess > 1) position[v] = start_[v] + move / excess;
    });
  }

  /** \brief Halves the moves at faces that fold or turn over until there are none. */
  void keep_from_folding(std::vector<Vector3d>& position) const
  {
    std::vector<std::uint8_t> bad(triangles_.size());
    std::vector<int> tries(position.size());
    for (bool any = true; any;) {
      const std::vector<Vector3d> normal = normals(position);
      parallel_.each(triangles_.size(), block, [&](std::size_t f) { bad[f] = is_bad(f, normal) ? 1 : 0; });
      any = std::find(bad.begin(), bad.end(), 1) != bad.end();
      if (!any) return;
      parallel_.each(position.size(), block, [&](std::size_t v) {
        if (std::none_of(fans_.begin(v), fans_.end(v), [&](std::uint32_t f) { return bad[f] != 0; })) return;
        const double kept = ++tries[v] > halvings ? 0.0 : 0.5;
        position[v] = start_[v] + kept * (position[v] - start_[v]);
      });
    }
  }

 private:
  [[nodiscard]] std::vector<Vector3d> normals(const std::vector<Vector3d>& position) const
  {
    std::vector<Vector3d> normal(triangles_.size());
    parallel_.each(triangles_.size(), block, [&](std::size_t f) {
      const Triangle& t = triangles_[f];
      normal[f] = (position[t[1]] - position[t[0]]).cross(position[t[2]] - position[t[0]]).normalized();
    });
    return normal;
  }

  /** \brief What was bad at the start is not held against the moves unless they make it worse. */
  [[nodiscard]] bool is_bad(std::size_t face, const std::vector<Vector3d>& normal) const
  {
    if (normal[face] == normal_at_start_[face]) return false;
    if (!(normal[face].dot(normal_at_start_[face]) >= largest_turn_cosine)) return true;
    for (std::size_t side = 0; side < 3; ++side) {
      const std::uint32_t other = fans_.across(face, side);
      if (other == TriangleComplex::no_face) continue;
      const double limit = std::min(fold_cosine, normal_at_start_[face].dot(normal_at_start_[other]));
      if (normal[face].dot(normal[other]) < limit) return true;
    }
    return false;
  }

  const std::vector<Vector3d>& start_;
  const std::vector<Triangle>& triangles_;
  const MeshFans& fans_;
  const Parallel& parallel_;
  std::vector<Vector3d> normal_at_start_;
};

}  // namespace

std::vector<Vector3d> place_vertices(const SeedGeometry& seeds,
                                     const std::vector<Triangle>& triangles,
                                     const PointArray<Eigen::Vector3f>& points,
                                     const PoissonDiskSampling& sampling,
                                     const GeodesicVoronoi& voronoi,
                                     bool noisy,
                                     const Parallel& parallel)
{
  std::vector<Vector3d> position = seeds.position;
  const MeshFans fans(triangles, position.size(), parallel);
  const MoveGuard guard(seeds.position, triangles, fans, parallel);
  for (const std::size_t stride : noisy ? noisy_strides : clean_strides) {
    const std::vector<FaceQuadric> quadrics =
        measure_face_quadrics(position, triangles, fans, points, sampling, voronoi, stride, parallel);
    const std::vector<Vector3d> move =
        QuadricSystem(quadrics, triangles, fans, position.size(), noisy, parallel).solve();
    parallel.each(position.size(), block, [&](std::size_t v) { position[v] += move[v]; });
    guard.keep_in_cells(position);
  }
  guard.keep_from_folding(position);
  return position;
}

}  // namespace pds
