// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/rim_joining.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>
#include "joined_parts.h"
#include "polygon_triangulation.h"
#include "seed_grid.h"
#include "surface_integrals.h"

namespace pds
{
namespace
{

using Eigen::Vector3d;

// Lengths are in radii.
constexpr double narrow = 2.5;              // a gap across which the surface may be taken to go on
constexpr double highest_step = 1.0 / 3.0;  // in such a gap: an interval at the default factor; sheets may be as near
constexpr double longest_chord = longest_dual_edge;   // between seeds, which lie behind the rims of their cells
constexpr double in_plane = 0.7;                      // cosine: a face within 45 degrees of the plane of a cell
constexpr std::ptrdiff_t least_corners_in_plane = 2;  // of three; the last cell before a gap may have no plane
constexpr double smooth_angle = 2.2;                  // radians between faces at an edge: the surface goes on

/** \brief A chord between two vertices on rims. */
struct Chord
{
  double length;
  std::uint32_t a, b;
};

bool operator<(const Chord& x, const Chord& y) { return std::tie(x.length, x.a, x.b) < std::tie(y.length, y.a, y.b); }

class RimJoiner
{
 public:
  RimJoiner(TriangleComplex& complex,
            const SeedGeometry& seeds,
            const BorderingCells& bordering,
            const FillLimits& limits)
      : complex_(complex), seeds_(seeds), bordering_(bordering), limits_(limits), parts_(complex)
  {
  }

  std::size_t join()
  {
    const std::vector<Chord> chords = find_chords();
    std::size_t joints = 0;
    for (const int least_shut : {0, 1, 2}) {
      tried_.assign(seeds_.position.size(), 0);
      for (const Chord& chord : chords)
        if (least_shut_of(chord) == least_shut && join_along(chord, least_shut)) {
          ++joints;
          if (least_shut == 0) parts_.hang_together(parts_.part_of(chord.a), parts_.part_of(chord.b));
        }
    }
    parts_.drop_specks();
    return joints;
  }

 private:
  using Neighbors = std::vector<std::uint32_t>;

  [[nodiscard]] double length(std::uint32_t a, std::uint32_t b) const
  {
    return (seeds_.position[a] - seeds_.position[b]).norm();
  }

  /** \brief The vertices that rim edges join to this one: two on a rim, else none. */
  [[nodiscard]] Neighbors rim_neighbors(std::uint32_t v) const
  {
    Neighbors found;
    for (const std::uint32_t f : complex_.faces_at(v))
      for (const std::uint32_t other : complex_.oriented(f))
        if (other != v && complex_.other_face(f, v, other) == TriangleComplex::no_face) found.push_back(other);
    std::sort(found.begin(), found.end());
    return found;
  }

  /** \brief Chords at which a joint may begin, shortest first. */
  [[nodiscard]] std::vector<Chord> find_chords() const
  {
    std::vector<std::uint32_t> all(seeds_.position.size());
    std::iota(all.begin(), all.end(), 0U);
    std::vector<std::uint32_t> rim;
    std::copy_if(all.begin(), all.end(), std::back_inserter(rim),
                 [this](std::uint32_t v) { return !rim_neighbors(v).empty(); });
    const SeedGrid seeds(seeds_.position, all, longest_chord);
    std::vector<Chord> chords;
    const SeedGrid on_rim(seeds_.position, rim, longest_chord);
    for (const std::uint32_t a : rim)
      on_rim.visit_near(seeds_.position[a], longest_chord, [&](std::uint32_t b) {
        if (a < b && !complex_.has_edge(a, b) && (bordering_(a, b) || is_narrow(a, b, seeds)))
          chords.push_back({length(a, b), a, b});
      });
    std::sort(chords.begin(), chords.end());
    return chords;
  }

  /** \brief And no other seed is nearer to the middle of the chord than its ends: it would be of something between. Nor
   * does the chord lead from one sheet to another above it: where the surface bends, the steps off the planes of its
   * two ends cancel out. */
  [[nodiscard]] bool is_narrow(std::uint32_t a, std::uint32_t b, const SeedGrid& seeds) const
  {
    if (length(a, b) >= narrow) return false;
    const Vector3d across = seeds_.position[b] - seeds_.position[a];
    const double side = seeds_.normal[a].dot(seeds_.normal[b]) < 0 ? -1 : 1;
    if (std::abs(across.dot(seeds_.normal[a] + side * seeds_.normal[b])) / 2 > highest_step) return false;
    bool empty = true;
    seeds.visit_near((seeds_.position[a] + seeds_.position[b]) / 2, length(a, b) / 2,
                     [&](std::uint32_t s) { empty = empty && (s == a || s == b); });
    return empty;
  }

  /** \brief How many ends of a joint that begins with the chord have to be shut. */
  [[nodiscard]] int least_shut_of(const Chord& chord) const
  {
    if (!complex_.joined(*complex_.faces_at(chord.a).begin(), *complex_.faces_at(chord.b).begin())) return 0;
    return parts_.part_of(chord.a) == parts_.part_of(chord.b) ? 2 : 1;
  }

  /** \brief Joins a rim edge at one end of the chord to one at the other, the nearest pair that fits.
   * \param least_shut ends of the joint that have to be shut */
  bool join_along(const Chord& chord, int least_shut)
  {
    if (tried_[chord.a] != 0 && tried_[chord.b] != 0) return false;
    std::vector<Chord> others;
    for (const std::uint32_t a : rim_neighbors(chord.a))
      for (const std::uint32_t b : rim_neighbors(chord.b))
        if (a != b && a != chord.b && b != chord.a && length(a, b) < gap_chord) others.push_back({length(a, b), a, b});
    std::sort(others.begin(), others.end());
    return std::any_of(others.begin(), others.end(),
                       [&](const Chord& other) { return join(chord, other, least_shut); });
  }

  bool join(const Chord& chord, const Chord& other, int least_shut)
  {
    const std::uint32_t part = parts_.part_of(chord.a);
    const std::uint32_t other_part = parts_.part_of(chord.b);
    // Where it is clear which sides go on into each other, they may do so around a crease, as a leg into a body.
    const double at_rims = parts_.outsides_are_clear(part, other_part) ? limits_.smallest_angle : smooth_angle;
    complex_.begin_trial();
    const bool falling = length(chord.a, other.b) < length(other.a, chord.b);
    const Chord diagonal = falling ? Chord{0, chord.a, other.b} : Chord{0, chord.b, other.a};
    const std::uint32_t before = falling ? chord.b : chord.a;
    const std::uint32_t behind = falling ? other.a : other.b;
    const bool begun = is_untwisted(diagonal, before, behind) && add({diagonal.a, diagonal.b, before}, at_rims) &&
                       add({diagonal.a, diagonal.b, behind}, at_rims);
    std::vector<std::uint32_t> passed;
    if (begun && parts_.outsides_agree(part, other_part)) {
      int shut = 0;
      for (const Chord& end : {chord, other}) shut += is_shut(zip(end.a, end.b, passed)) ? 1 : 0;
      if (shut >= least_shut) return true;
    }
    complex_.undo_trial();
    for (const std::uint32_t v : passed) tried_[v] = 1;
    return false;
  }

  /** \brief The two faces at the diagonal are one surface that does not turn over between the rims. */
  [[nodiscard]] bool is_untwisted(const Chord& diagonal, std::uint32_t before, std::uint32_t behind) const
  {
    const std::vector<Vector3d>& p = seeds_.position;
    return TriangleComplex::fold_cosine(p[diagonal.a], p[diagonal.b], p[before], p[behind]) <= std::cos(smooth_angle);
  }

  /** \brief Adds faces between the rims that go on from the two ends of a rim edge, as long as they fit.
   * \param passed gets the vertices between which there are faces now
   * \return a vertex of the rim that is left, if one is: that of what is open beyond */
  std::optional<std::uint32_t> zip(std::uint32_t left, std::uint32_t right, std::vector<std::uint32_t>& passed)
  {
    passed.insert(passed.end(), {left, right});
    while (complex_.face_count(left, right) == 1) {
      const std::optional<std::uint32_t> after_left = beyond(left, right);
      const std::optional<std::uint32_t> after_right = beyond(right, left);
      if (!after_left || !after_right) return left;
      const auto step = [&](std::uint32_t& from, std::uint32_t to, std::uint32_t opposite) {
        if (length(to, opposite) > longest_chord || !add({left, right, to}, smooth_angle)) return false;
        passed.push_back(from = to);
        return true;
      };
      const bool left_first = length(*after_left, right) < length(left, *after_right);
      if (left_first ? !step(left, *after_left, right) && !step(right, *after_right, left)
                     : !step(right, *after_right, left) && !step(left, *after_left, right))
        return left;
    }
    return {};
  }

  /** \brief Nothing is open beyond an end of a joint, or only a hole that will be filled. */
  [[nodiscard]] bool is_shut(const std::optional<std::uint32_t>& rim) const
  {
    if (!rim) return true;
    const Polygon hole = loop_through(complex_, *rim);
    return !hole.empty() && perimeter(complex_, hole, limits_) <= limits_.perimeter;
  }

  /** \brief Where the rim goes on from \a at, coming from \a from. */
  [[nodiscard]] std::optional<std::uint32_t> beyond(std::uint32_t at, std::uint32_t from) const
  {
    const Neighbors beside = rim_neighbors(at);
    if (beside.size() != 2) return {};
    return beside[0] == from ? beside[1] : beside[0];
  }

  bool add(const Triangle& t, double smallest_angle)
  {
    const Vector3d across = area_vector(t, seeds_.position).normalized();
    return std::count_if(t.begin(), t.end(),
                         [&](std::uint32_t v) { return std::abs(across.dot(seeds_.normal[v])) > in_plane; }) >=
               least_corners_in_plane &&
           complex_.add(t, smallest_angle) == TriangleComplex::Verdict::legal;
  }

  TriangleComplex& complex_;
  const SeedGeometry& seeds_;
  const BorderingCells& bordering_;
  const FillLimits& limits_;
  JoinedParts parts_;
  std::vector<std::uint8_t> tried_;  ///< by vertex: it is in a joint that was given up
};

}  // namespace

std::size_t join_rims(TriangleComplex& complex,
                      const SeedGeometry& seeds,
                      const BorderingCells& bordering,
                      const FillLimits& limits)
{
  return RimJoiner(complex, seeds, bordering, limits).join();
}

}  // namespace pds
