// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/edge_flips.h>
#include <algorithm>
#include <array>
#include <cmath>
#include "face_kernel.h"
#include "mesh_fans.h"
#include "parallel_parts.h"

namespace pds
{
namespace
{

using Eigen::Vector3d;

constexpr int rounds = 3;  // a flip makes others possible; a fourth round would gain little

constexpr double least_gain = 0.0005;    // squared radii: what the mean square of the points' distances must fall by
constexpr double angle_price = 0.003;    // likewise, for each unit that the cosine of the smallest angle grows by
constexpr double largest_rest = 0.8;     // of the squared distances: what falls less may be chance
constexpr double largest_cosine = 0.94;  // of the smallest angle: 20 degrees
constexpr double fold_cosine = -0.5;     // of the normals of two faces that enclose 60 degrees
constexpr double aside_cosine = 0.17;    // likewise, of 100: as fold_removal.cpp has it, a fold and no crease

// Where the diagonals are a gap g apart, the mean square of what a flip changes is g^2 / 6. Where the surface is beyond
// the new diagonal distances change more than that: half of it is asked for.
constexpr double least_gap2 = 3;  // over the price

// Between the diagonals, 0.5 is half way; normals at creases are means. Two in three edges are ruled out by this.
constexpr double least_height = 0.25;
constexpr double least_upright = 0.2;  // cosine: steeper normals tell nothing about heights

constexpr std::size_t point_stride = 4;  // every fourth point: about seven for the two faces
// Farther from all faces at its seed a point is off the mesh's rim, or on another sheet.
constexpr double farthest2 = 0.3;  // squared radii

constexpr std::size_t faces_per_block = 1024;
constexpr std::size_t seeds_per_block = 64;

/** \brief Cosine of the smallest angle of a triangle. */
double cosine_of_smallest_angle(const Vector3d& a, const Vector3d& b, const Vector3d& c)
{
  const double ab2 = (b - a).squaredNorm();
  const double bc2 = (c - b).squaredNorm();
  const double ca2 = (a - c).squaredNorm();
  // It is opposite the shortest side.
  const double shortest2 = std::min({ab2, bc2, ca2});
  return (ab2 + bc2 + ca2 - 2 * shortest2) / (2 * std::sqrt(ab2 * bc2 * ca2 / shortest2));
}

/** \brief Of points near two faces, the squared distances from them, and from what they may be replaced by. */
struct Distances
{
  double now = 0;
  double flipped = 0;
  std::size_t points = 0;

  Distances& operator+=(const Distances& more)
  {
    now += more.now;
    flipped += more.flipped;
    points += more.points;
    return *this;
  }
};

/** \brief The edge (c, d) of (c, d, b) and (d, c, a) instead of the edge (a, b) of (a, b, c) and (b, a, d). */
struct Flip
{
  std::array<std::uint32_t, 2> face;
  std::array<std::uint32_t, 4> corner;   ///< a, b, c, d
  std::array<FacePlane, 2> plane;        ///< of the new faces
  std::array<Distances, 4> distances{};  ///< of the points in the cell of each corner
  double price = 0;                      ///< what the mean squared distance must fall by
  double gain = 0;                       ///< by what the sum of the squared distances falls

  [[nodiscard]] std::array<Triangle, 2> triangles() const
  {
    const auto& [a, b, c, d] = corner;
    return {Triangle{c, d, b}, Triangle{d, c, a}};
  }
};

/** \brief Flips the edges of a mesh round by round. */
class EdgeFlipper
{
 public:
  EdgeFlipper(const SeedGeometry& seeds,
              const PointArray<Eigen::Vector3f>& points,
              const PoissonDiskSampling& sampling,
              const GeodesicVoronoi& voronoi,
              const Parallel& parallel,
              std::vector<Triangle>& triangles)
      : position_(seeds.position),
        normal_(seeds.normal),
        points_(points),
        per_radius_(1 / sampling.radius),
        voronoi_(voronoi),
        parallel_(parallel),
        triangles_(triangles),
        fans_(triangles, seeds.position.size(), parallel, rounds),  // a round changes a vertex's fan once at most
        plane_(triangles.size()),
        fresh_(triangles.size(), 1)
  {
  }

  /** \brief Flips what is better flipped, the best first, and no two edges that have a corner in common.
   * \return the number of edges flipped */
  std::size_t flip_round()
  {
    parallel_.each(triangles_.size(), faces_per_block, [&](std::size_t f) {
      if (fresh_[f] != 0) plane_[f] = plane_of(triangles_[f]);
    });
    std::vector<Flip> flips = find_flips();
    measure(flips);
    flips.erase(std::remove_if(flips.begin(), flips.end(), [](Flip& flip) { return !is_worth_its_price(flip); }),
                flips.end());
    std::sort(flips.begin(), flips.end(),
              [](const Flip& x, const Flip& y) { return x.gain != y.gain ? x.gain > y.gain : x.face < y.face; });
    return carry_out(flips);
  }

 private:
  [[nodiscard]] FacePlane plane_of(const Triangle& t) const
  {
    return {position_[t[0]], position_[t[1]], position_[t[2]]};
  }
  [[nodiscard]] double cosine_of_smallest_angle(const Triangle& t) const
  {
    return pds::cosine_of_smallest_angle(position_[t[0]], position_[t[1]], position_[t[2]]);
  }

  /** \brief Edges that may be flipped, as far as can be said without the points. */
  [[nodiscard]] std::vector<Flip> find_flips() const
  {
    using Flips = std::vector<Flip>;
    const auto find = [&](std::size_t begin, std::size_t end, Flips& flips) {
      for (auto face = static_cast<std::uint32_t>(begin); face < end; ++face)
        for (std::size_t side = 0; side < 3; ++side) {
          const std::uint32_t other = fans_.across(face, side);
          if (other == TriangleComplex::no_face || other < face) continue;
          if (fresh_[face] == 0 && fresh_[other] == 0) continue;
          Flip flip = flip_at(face, side, other);
          if (is_possible(flip)) flips.push_back(flip);
        }
    };
    Flips flips;
    for (const Flips& part : parallel_parts<Flips>(triangles_.size(), faces_per_block, parallel_, find))
      append(flips, part);
    return flips;
  }

  [[nodiscard]] Flip flip_at(std::uint32_t face, std::size_t side, std::uint32_t other) const
  {
    const Triangle& t = triangles_[face];
    const Triangle& o = triangles_[other];
    const std::uint32_t a = t[side];
    const std::uint32_t b = t[(side + 1) % 3];
    Flip flip;
    flip.face = {face, other};
    flip.corner = {a, b, t[(side + 2) % 3], o[0] + o[1] + o[2] - a - b};
    return flip;
  }

  /** \brief Looks at the shape of the four faces. Sets the price and the planes. */
  bool is_possible(Flip& flip) const
  {
    const auto& [a, b, c, d] = flip.corner;
    const Vector3d across = (position_[b] - position_[a]).cross(position_[d] - position_[c]);
    const double gap = across.dot(position_[c] - position_[a]);
    // Between the diagonals, the distance of a point changes by less than their gap.
    const auto pays = [&](double price) { return gap * gap >= least_gap2 * price * across.squaredNorm(); };
    if (!pays(least_gain) || !is_foretold(flip, across / across.norm(), gap / across.norm())) return false;
    const auto [first, second] = flip.triangles();
    const double cosine = std::max(cosine_of_smallest_angle(first), cosine_of_smallest_angle(second));
    if (cosine > largest_cosine) return false;
    const double cosine_now = std::max(cosine_of_smallest_angle(triangles_[flip.face[0]]),
                                       cosine_of_smallest_angle(triangles_[flip.face[1]]));
    flip.price = least_gain + angle_price * std::max(0.0, cosine - cosine_now);
    if (!pays(flip.price) || has_edge(c, d)) return false;
    flip.plane = {plane_of(first), plane_of(second)};
    return !folds(flip);
  }

  /** \brief True if the surface is rather at the other diagonal by what the normals at the corners tell: each gives the
   * slope at one end of a diagonal, and the cubic with these slopes its height in the middle.
   * \param up unit, across both diagonals
   * \param gap from this diagonal up to the other */
  [[nodiscard]] bool is_foretold(const Flip& flip, const Vector3d& up, double gap) const
  {
    const auto middle_height = [&](std::uint32_t from, std::uint32_t to) {
      const Vector3d way = position_[to] - position_[from];
      const auto rise = [&](std::uint32_t v) {
        const double upright = normal_[v].dot(up);
        return std::abs(upright) > least_upright ? -normal_[v].dot(way) / upright : 0.0;
      };
      return (rise(from) - rise(to)) / 8;
    };
    const auto& [a, b, c, d] = flip.corner;
    const double height = 0.5 * (middle_height(a, b) + gap + middle_height(c, d));
    return height / gap >= least_height;
  }

  [[nodiscard]] bool has_edge(std::uint32_t c, std::uint32_t d) const
  {
    return std::any_of(fans_.begin(c), fans_.end(c), [&](std::uint32_t face) {
      const Triangle& t = triangles_[face];
      return t[0] == d || t[1] == d || t[2] == d;
    });
  }

  /** \brief True if a new face folds onto the other one or one beside it, more than the old ones do. */
  [[nodiscard]] bool folds(const Flip& flip) const
  {
    double now = plane_[flip.face[0]].normal().dot(plane_[flip.face[1]].normal());
    double flipped = flip.plane[0].normal().dot(flip.plane[1].normal());
    for (const std::uint32_t face : flip.face)
      for (std::size_t side = 0; side < 3; ++side) {
        const std::uint32_t beside = fans_.across(face, side);
        if (beside == TriangleComplex::no_face || beside == flip.face[0] || beside == flip.face[1]) continue;
        const Vector3d& normal = plane_[beside].normal();
        now = std::min(now, normal.dot(plane_[face].normal()));
        flipped = std::min(flipped, normal.dot(flip.plane[is_at_b(flip, face, side) ? 0 : 1].normal()));
      }
    return flipped < std::min(now, fold_cosine) || is_aside(flip);
  }

  /** \brief True if a new face turns away from the other one and from all beside it: one that is turned over. */
  [[nodiscard]] bool is_aside(const Flip& flip) const
  {
    const double between = flip.plane[0].normal().dot(flip.plane[1].normal());
    std::array<double, 2> flattest{between, between};
    for (const std::uint32_t face : flip.face)
      for (std::size_t side = 0; side < 3; ++side) {
        const std::uint32_t beside = fans_.across(face, side);
        if (beside == TriangleComplex::no_face || beside == flip.face[0] || beside == flip.face[1]) continue;
        const std::size_t now_of = is_at_b(flip, face, side) ? 0 : 1;
        flattest[now_of] = std::max(flattest[now_of], plane_[beside].normal().dot(flip.plane[now_of].normal()));
      }
    return std::min(flattest[0], flattest[1]) < aside_cosine;
  }

  /** \brief True if a side of one of the two old faces is at b: the first new face has it then, else the second. */
  [[nodiscard]] bool is_at_b(const Flip& flip, std::uint32_t face, std::size_t side) const
  {
    const Triangle& t = triangles_[face];
    return t[side] == flip.corner[1] || t[(side + 1) % 3] == flip.corner[1];
  }

  /** \brief Measures how far the points are from the faces now and flipped. Each point of a cell counts for the face
   * at its seed that it is nearest to. */
  void measure(std::vector<Flip>& flips) const
  {
    std::vector<std::array<std::uint32_t, 3>> flip_of(triangles_.size(), {no_flip, no_flip, no_flip});
    std::vector<std::uint8_t> concerned(position_.size());
    for (std::uint32_t number = 0; number < flips.size(); ++number) {
      const Flip& flip = flips[number];
      for (const std::uint32_t v : flip.corner) concerned[v] = 1;
      flip_of[flip.face[0]][MeshFans::corner_of(triangles_[flip.face[0]], flip.corner[0])] = number;
      flip_of[flip.face[1]][MeshFans::corner_of(triangles_[flip.face[1]], flip.corner[1])] = number;
    }
    parallel_.each(position_.size(), seeds_per_block, [&](std::size_t seed) {
      if (concerned[seed] != 0) measure_cell(static_cast<std::uint32_t>(seed), flips, flip_of);
    });
  }

  void measure_cell(std::uint32_t seed,
                    std::vector<Flip>& flips,
                    const std::vector<std::array<std::uint32_t, 3>>& flip_of) const
  {
    FacedPoints points{};
    for (std::size_t i = voronoi_.cell_begin[seed]; i < voronoi_.cell_begin[seed + 1];) {
      std::size_t count = 0;
      for (; count < face_lanes && i < voronoi_.cell_begin[seed + 1]; ++count, i += point_stride) {
        const Vector3d point = points_[voronoi_.cell_point[i]].cast<double>() * per_radius_;
        points.x[count] = point.x();
        points.y[count] = point.y();
        points.z[count] = point.z();
      }
      find_nearest_faces(instruction_set_, fans_.begin(seed), fans_.end(seed), plane_, farthest2, points);
      for (std::size_t l = 0; l < count; ++l) measure_point(seed, points, l, flips, flip_of);
    }
  }

  void measure_point(std::uint32_t seed,
                     const FacedPoints& points,
                     std::size_t lane,
                     std::vector<Flip>& flips,
                     const std::vector<std::array<std::uint32_t, 3>>& flip_of) const
  {
    const std::uint32_t* nearest = fans_.begin(seed) + points.nearest[lane];
    if (nearest == fans_.end(seed)) return;
    for (const std::uint32_t number : flip_of[*nearest]) {
      if (number == no_flip) continue;
      Flip& flip = flips[number];
      const auto distance2 = [&](const FacePlane& plane) {
        return plane.distance2(points.x[lane], points.y[lane], points.z[lane]);
      };
      const double flipped = std::min({farthest2, distance2(flip.plane[0]), distance2(flip.plane[1])});
      const auto* const corner = std::find(flip.corner.begin(), flip.corner.end(), seed);
      flip.distances[static_cast<std::size_t>(corner - flip.corner.begin())] += {points.distance2[lane], flipped, 1};
    }
  }

  static bool is_worth_its_price(Flip& flip)
  {
    Distances all;
    for (const Distances& part : flip.distances) all += part;
    flip.gain = all.now - all.flipped;
    return flip.gain > flip.price * static_cast<double>(all.points) && all.flipped < largest_rest * all.now;
  }

  std::size_t carry_out(const std::vector<Flip>& flips)
  {
    fresh_.assign(fresh_.size(), 0);
    std::vector<std::uint8_t> touched(position_.size());
    std::size_t count = 0;
    for (const Flip& flip : flips) {
      // Those that have to wait are looked at again in the next round.
      for (const std::uint32_t face : flip.face) fresh_[face] = 1;
      const auto is_touched = [&](std::uint32_t v) { return touched[v] != 0; };
      if (std::any_of(flip.corner.begin(), flip.corner.end(), is_touched)) continue;
      for (const std::uint32_t v : flip.corner) touched[v] = 1;
      fans_.flip(flip.face, flip.corner, triangles_);
      ++count;
    }
    return count;
  }

  static constexpr std::uint32_t no_flip = 0xffffffffU;

  const std::vector<Vector3d>& position_;
  const std::vector<Vector3d>& normal_;
  const PointArray<Eigen::Vector3f>& points_;
  double per_radius_;
  const GeodesicVoronoi& voronoi_;
  const Parallel& parallel_;
  std::vector<Triangle>& triangles_;
  MeshFans fans_;
  std::vector<FacePlane> plane_;
  InstructionSet instruction_set_ = best_instruction_set();
  std::vector<std::uint8_t> fresh_;  ///< by face: 1 if it is new, or waits to be flipped
};

}  // namespace

void flip_edges(const SeedGeometry& seeds,
                const PointArray<Eigen::Vector3f>& points,
                const PoissonDiskSampling& sampling,
                const GeodesicVoronoi& voronoi,
                const Parallel& parallel,
                std::vector<Triangle>& triangles)
{
  EdgeFlipper flipper(seeds, points, sampling, voronoi, parallel, triangles);
  for (int round = 0; round < rounds && flipper.flip_round() > 0; ++round) {
  }
}

}  // namespace pds
