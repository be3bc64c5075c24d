// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/triangle_complex.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace pds
{

using Eigen::Vector3d;

TriangleComplex::TriangleComplex(const std::vector<Vector3d>& position,
                                 const Parallel& parallel,
                                 std::vector<Vector3d> outward)
    : position_(position), parallel_(parallel), outward_(std::move(outward)), first_at_(position.size(), no_face)
{
}

std::size_t TriangleComplex::side_of(std::uint32_t face, std::uint32_t a, std::uint32_t b) const
{
  const std::size_t at_a = corner_of(face, a);
  return face_[face].corner[(at_a + 1) % 3] == b ? at_a : (at_a + 2) % 3;
}

bool TriangleComplex::runs_along(std::uint32_t face, std::uint32_t a, std::uint32_t b) const
{
  return face_[face].corner[(corner_of(face, a) + 1) % 3] == b;
}

double TriangleComplex::fold_cosine(const Vector3d& a, const Vector3d& b, const Vector3d& p, const Vector3d& q)
{
  const Vector3d axis = (b - a).normalized();
  Vector3d to_p = p - a;
  Vector3d to_q = q - a;
  to_p -= to_p.dot(axis) * axis;
  to_q -= to_q.dot(axis) * axis;
  const double lengths = to_p.norm() * to_q.norm();
  return lengths > 0 ? std::min(to_p.dot(to_q) / lengths, 1.0) : 1.0;
}

bool TriangleComplex::degenerate(const Triangle& t) const
{
  if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return true;
  constexpr double smallest_height = 1e-4;  // of the longest edge; below it the normal is noise
  const Vector3d ab = position_[t[1]] - position_[t[0]];
  const Vector3d ac = position_[t[2]] - position_[t[0]];
  const double longest2 = std::max({ab.squaredNorm(), ac.squaredNorm(), (ab - ac).squaredNorm()});
  return !(ab.cross(ac).norm() > smallest_height * longest2);
}

std::uint32_t TriangleComplex::find_face(std::uint32_t a, std::uint32_t b) const
{
  for (std::uint32_t f = first_at_[a]; f != no_face;) {
    const std::size_t corner = corner_of(f, a);
    const Face& face = face_[f];
    if (face.corner[(corner + 1) % 3] == b || face.corner[(corner + 2) % 3] == b) return f;
    f = face.next_at[corner];
  }
  return no_face;
}

int TriangleComplex::face_count(std::uint32_t a, std::uint32_t b) const
{
  const std::uint32_t first = find_face(a, b);
  if (first == no_face) return 0;
  return other_face(first, a, b) == no_face ? 1 : 2;
}

std::size_t TriangleComplex::count_faces_at(std::uint32_t vertex) const
{
  std::size_t count = 0;
  for (const std::uint32_t f : faces_at(vertex)) count += f != no_face ? 1 : 0;
  return count;
}

bool TriangleComplex::fan_closes(std::uint32_t vertex, std::uint32_t first) const
{
  std::uint32_t face = first;
  std::uint32_t at = face_[first].corner[(corner_of(first, vertex) + 1) % 3];
  do {
    at = apex_of(face, vertex, at);
    face = other_face(face, vertex, at);
  } while (face != no_face && face != first);
  return face == first;
}

/** The new face adds an edge to the link of this corner. */
bool TriangleComplex::link_stays_simple(const Triangle& t, std::size_t corner, const ThreeFaces& across) const
{
  const std::uint32_t vertex = t[corner];
  const std::uint32_t after = across[corner];             // at the side to the next corner
  const std::uint32_t before = across[(corner + 2) % 3];  // at the side from the one before
  // A new path: a cycle, if there is one, is the whole link, so that any face will tell.
  if (after == no_face && before == no_face)
    return first_at_[vertex] == no_face || !fan_closes(vertex, first_at_[vertex]);
  if (after == no_face || before == no_face) return true;  // a path gets longer
  // Walk from one side: if that leads to the other, a cycle closes, which must then hold all faces.
  std::uint32_t at = t[(corner + 1) % 3];
  std::size_t steps = 0;
  for (std::uint32_t face = after; face != no_face; ++steps) {
    at = apex_of(face, vertex, at);
    face = other_face(face, vertex, at);
  }
  return at != t[(corner + 2) % 3] || steps == count_faces_at(vertex);
}

bool TriangleComplex::folds(const Triangle& t, const ThreeFaces& across, double smallest_angle) const
{
  const double largest_cosine = std::cos(smallest_angle);
  for (std::size_t e = 0; e < 3; ++e) {
    if (across[e] == no_face) continue;
    const std::uint32_t from = t[e];
    const std::uint32_t to = t[(e + 1) % 3];
    const std::uint32_t apex = t[(e + 2) % 3];
    const std::uint32_t other = apex_of(across[e], from, to);
    if (other == apex ||
        fold_cosine(position_[from], position_[to], position_[apex], position_[other]) > largest_cosine)
      return true;
  }
  return false;
}

/** Two faces agree if they run along their common edge in opposite directions. */
bool TriangleComplex::orientable_with(const Triangle& t, const ThreeFaces& across) const
{
  std::array<OrientationForest::Root, 3> root{};
  for (std::size_t e = 0; e < 3; ++e) {
    if (across[e] == no_face) continue;
    root[e] = orientation_.root_of(across[e]);
    // The orientation of the root that makes t, as given, fit this neighbour.
    root[e].flipped ^= runs_along(across[e], t[e], t[(e + 1) % 3]);
    for (std::size_t d = 0; d < e; ++d)
      if (across[d] != no_face && root[d].face == root[e].face && root[d].flipped != root[e].flipped) return false;
  }
  return true;
}

TriangleComplex::Verdict TriangleComplex::judge(const Triangle& t, double smallest_angle) const
{
  if (degenerate(t)) return Verdict::degenerate;
  return judge_beside(t, {find_face(t[0], t[1]), find_face(t[1], t[2]), find_face(t[2], t[0])}, smallest_angle);
}

TriangleComplex::Verdict TriangleComplex::judge_beside(const Triangle& t,
                                                       const ThreeFaces& across,
                                                       double smallest_angle) const
{
  for (std::size_t e = 0; e < 3; ++e)
    if (across[e] != no_face && other_face(across[e], t[e], t[(e + 1) % 3]) != no_face) return Verdict::edge_full;
  for (std::size_t corner = 0; corner < 3; ++corner)
    if (!link_stays_simple(t, corner, across)) return Verdict::link_broken;
  if (folds(t, across, smallest_angle)) return Verdict::folded;
  if (opposed(t, across)) return Verdict::opposed;
  return orientable_with(t, across) ? Verdict::legal : Verdict::one_sided;
}

TriangleComplex::Verdict TriangleComplex::add(const Triangle& t, double smallest_angle)
{
  const Verdict verdict = judge(t, smallest_angle);
  if (verdict != Verdict::legal) return verdict;
  const auto number = static_cast<std::uint32_t>(face_.size());
  face_.push_back({t});
  orientation_.resize(face_.size());
  Face& face = face_.back();
  for (std::size_t e = 0; e < 3; ++e) {
    const std::uint32_t from = t[e];
    const std::uint32_t to = t[(e + 1) % 3];
    const std::uint32_t other = find_face(from, to);
    if (other == no_face) continue;
    face.across[e] = other;
    face_[other].across[side_of(other, from, to)] = number;
    orientation_.join(number, other, runs_along(other, from, to));
  }
  for (std::size_t corner = 0; corner < 3; ++corner) {
    face.next_at[corner] = first_at_[t[corner]];
    first_at_[t[corner]] = number;
  }
  return verdict;
}

void TriangleComplex::remove(std::uint32_t face)
{
  Face& gone = face_[face];
  gone.present = false;
  removed_since_rebuild_ = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t vertex = gone.corner[i];
    const std::uint32_t other = gone.across[i];
    if (other != no_face) face_[other].across[side_of(other, vertex, gone.corner[(i + 1) % 3])] = no_face;
    std::uint32_t* place = &first_at_[vertex];
    while (*place != face) place = &face_[*place].next_at[corner_of(*place, vertex)];
    *place = gone.next_at[i];
  }
}

void TriangleComplex::begin_trial()
{
  trial_begin_ = face_.size();
  orientation_.begin_trial();
}

void TriangleComplex::undo_trial()
{
  const bool removed_before = removed_since_rebuild_;
  for (std::size_t f = face_.size(); f-- > trial_begin_;) remove(static_cast<std::uint32_t>(f));
  face_.resize(trial_begin_);
  orientation_.undo(trial_begin_);
  removed_since_rebuild_ = removed_before;
}

}  // namespace pds
