// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/triangle_complex.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace pds
{

using Eigen::Vector3d;

TriangleComplex::TriangleComplex(const std::vector<Vector3d>& position)
    : position_(position), faces_at_(position.size())
{
}

std::array<TriangleComplex::Edge, 3> TriangleComplex::edges_of(const Triangle& t)
{
  return {Edge{t[0], t[1], t[2]}, Edge{t[1], t[2], t[0]}, Edge{t[2], t[0], t[1]}};
}

bool TriangleComplex::runs_along(const Triangle& t, std::uint32_t a, std::uint32_t b)
{
  return (t[0] == a && t[1] == b) || (t[1] == a && t[2] == b) || (t[2] == a && t[0] == b);
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

bool TriangleComplex::flat(const Triangle& t) const
{
  constexpr double smallest_height = 1e-4;  // of the longest edge; below it the normal is noise
  const Vector3d ab = position_[t[1]] - position_[t[0]];
  const Vector3d ac = position_[t[2]] - position_[t[0]];
  const double longest2 = std::max({ab.squaredNorm(), ac.squaredNorm(), (ab - ac).squaredNorm()});
  return !(ab.cross(ac).norm() > smallest_height * longest2);
}

std::uint32_t TriangleComplex::find_face(std::uint32_t a, std::uint32_t b, std::uint32_t except) const
{
  for (const std::uint32_t f : faces_at_[a])
    if (f != except && (face_[f][0] == b || face_[f][1] == b || face_[f][2] == b)) return f;
  return no_face;
}

std::uint32_t TriangleComplex::other_face(std::uint32_t face, std::uint32_t a, std::uint32_t b) const
{
  return find_face(a, b, face);
}

bool TriangleComplex::has_edge(std::uint32_t a, std::uint32_t b) const { return find_face(a, b, no_face) != no_face; }

int TriangleComplex::face_count(std::uint32_t a, std::uint32_t b) const
{
  const std::uint32_t first = find_face(a, b, no_face);
  if (first == no_face) return 0;
  return find_face(a, b, first) == no_face ? 1 : 2;
}

/** The new face adds the edge (x, y) to the link of the vertex. */
bool TriangleComplex::link_stays_simple(std::uint32_t vertex, std::uint32_t x, std::uint32_t y) const
{
  const std::vector<std::uint32_t>& around = faces_at_[vertex];
  if (around.empty()) return true;
  // Walk the path that starts at x; it ends at y only if the new edge closes a cycle, which must then hold all faces.
  std::uint32_t at = x;
  std::uint32_t face = find_face(vertex, x, no_face);
  if (face == no_face && find_face(vertex, y, no_face) == no_face) {
    // A fan of its own: fine, unless the vertex is closed already.
    const Triangle& t = face_[around.front()];
    const std::uint32_t first = t[0] == vertex ? t[1] : t[0];
    std::size_t steps = 0;
    std::uint32_t f = around.front();
    for (at = first; f != no_face && steps <= around.size(); ++steps) {
      const Triangle& corner = face_[f];
      at = corner[0] + corner[1] + corner[2] - vertex - at;
      if (at == first) return false;
      f = other_face(f, vertex, at);
    }
    return true;
  }
  std::size_t steps = 0;
  while (face != no_face) {
    const Triangle& t = face_[face];
    at = t[0] + t[1] + t[2] - vertex - at;
    face = other_face(face, vertex, at);
    ++steps;
  }
  return at != y || steps == around.size();
}

TriangleComplex::Root TriangleComplex::root_of(std::uint32_t face) const
{
  bool flipped = false;
  while (parent_[face] != face) {
    flipped ^= flip_[face] != 0;
    face = parent_[face];
  }
  return {face, flipped};
}

/** Two faces agree if they run along their common edge in opposite directions. */
bool TriangleComplex::orientable_with(const Triangle& t, const std::array<std::uint32_t, 3>& across) const
{
  std::array<Root, 3> root{};
  const auto edges = edges_of(t);
  for (std::size_t e = 0; e < 3; ++e) {
    if (across[e] == no_face) continue;
    root[e] = root_of(across[e]);
    // The orientation of the root that makes t, as given, fit this neighbour.
    root[e].flipped ^= runs_along(face_[across[e]], edges[e].from, edges[e].to);
    for (std::size_t d = 0; d < e; ++d)
      if (across[d] != no_face && root[d].face == root[e].face && root[d].flipped != root[e].flipped) return false;
  }
  return true;
}

TriangleComplex::Verdict TriangleComplex::judge(const Triangle& t, double smallest_angle) const
{
  if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0] || flat(t)) return Verdict::degenerate;
  const double largest_cosine = std::cos(smallest_angle);
  std::array<std::uint32_t, 3> across{};
  const auto edges = edges_of(t);
  for (std::size_t e = 0; e < 3; ++e) {
    across[e] = find_face(edges[e].from, edges[e].to, no_face);
    if (across[e] != no_face && other_face(across[e], edges[e].from, edges[e].to) != no_face) return Verdict::edge_full;
  }
  for (const Edge& e : edges)
    if (!link_stays_simple(e.apex, e.from, e.to)) return Verdict::link_broken;
  for (std::size_t e = 0; e < 3; ++e) {
    if (across[e] == no_face) continue;
    const Triangle& other = face_[across[e]];
    const std::uint32_t apex = other[0] + other[1] + other[2] - edges[e].from - edges[e].to;
    if (apex == edges[e].apex || fold_cosine(position_[edges[e].from], position_[edges[e].to], position_[edges[e].apex],
                                             position_[apex]) > largest_cosine)
      return Verdict::folded;
  }
  return orientable_with(t, across) ? Verdict::legal : Verdict::one_sided;
}

/** Union by size: the way to a root is never longer than the logarithm of the number of faces. */
void TriangleComplex::join(std::uint32_t face)
{
  const Triangle& t = face_[face];
  parent_[face] = face;
  flip_[face] = 0;
  size_[face] = 1;
  for (const Edge& e : edges_of(t)) {
    const std::uint32_t other = other_face(face, e.from, e.to);
    if (other == no_face || other > face) continue;
    Root mine = root_of(face);
    Root theirs = root_of(other);
    if (mine.face == theirs.face) continue;
    const bool opposed = runs_along(face_[other], e.from, e.to);
    if (size_[mine.face] > size_[theirs.face]) std::swap(mine, theirs);
    undo_.push_back({mine.face, size_[theirs.face]});
    parent_[mine.face] = theirs.face;
    flip_[mine.face] = static_cast<std::uint8_t>(mine.flipped ^ theirs.flipped ^ opposed);
    size_[theirs.face] += size_[mine.face];
  }
}

TriangleComplex::Verdict TriangleComplex::add(const Triangle& triangle, double smallest_angle)
{
  const Verdict verdict = judge(triangle, smallest_angle);
  if (verdict != Verdict::legal) return verdict;
  const auto face = static_cast<std::uint32_t>(face_.size());
  face_.push_back(triangle);
  present_.push_back(1);
  parent_.push_back(face);
  flip_.push_back(0);
  size_.push_back(1);
  for (const std::uint32_t v : triangle) faces_at_[v].push_back(face);
  join(face);
  return verdict;
}

void TriangleComplex::remove(std::uint32_t face)
{
  present_[face] = 0;
  for (const std::uint32_t v : face_[face]) {
    std::vector<std::uint32_t>& around = faces_at_[v];
    around.erase(std::find(around.begin(), around.end(), face));
  }
}

void TriangleComplex::begin_trial()
{
  trial_begin_ = face_.size();
  undo_.clear();
}

void TriangleComplex::undo_trial()
{
  for (auto link = undo_.rbegin(); link != undo_.rend(); ++link) {
    size_[parent_[link->face]] = link->parent_size;
    parent_[link->face] = link->face;
    flip_[link->face] = 0;
  }
  undo_.clear();
  for (std::size_t f = trial_begin_; f < face_.size(); ++f) remove(static_cast<std::uint32_t>(f));
  face_.resize(trial_begin_);
  present_.resize(trial_begin_);
  parent_.resize(trial_begin_);
  flip_.resize(trial_begin_);
  size_.resize(trial_begin_);
}

void TriangleComplex::rebuild_orientation()
{
  for (std::uint32_t f = 0; f < face_.size(); ++f) {
    parent_[f] = f;
    flip_[f] = 0;
    size_[f] = 1;
  }
  for (std::uint32_t f = 0; f < face_.size(); ++f)
    if (present_[f] != 0) join(f);
  undo_.clear();
}

std::vector<std::uint32_t> TriangleComplex::faces() const
{
  std::vector<std::uint32_t> present;
  for (std::uint32_t f = 0; f < face_.size(); ++f)
    if (present_[f] != 0) present.push_back(f);
  return present;
}

Triangle TriangleComplex::oriented(std::uint32_t face) const
{
  Triangle t = face_[face];
  if (root_of(face).flipped) std::swap(t[1], t[2]);
  return t;
}

std::vector<std::vector<std::uint32_t>> TriangleComplex::fans(std::uint32_t vertex) const
{
  std::vector<std::vector<std::uint32_t>> result;
  std::vector<std::uint32_t> left = faces_at_[vertex];
  std::sort(left.begin(), left.end());
  while (!left.empty()) {
    std::vector<std::uint32_t> fan{left.front()};
    left.erase(left.begin());
    for (std::size_t i = 0; i < fan.size(); ++i)
      for (const std::uint32_t end : face_[fan[i]]) {
        if (end == vertex) continue;
        const std::uint32_t next = other_face(fan[i], vertex, end);
        const auto place = std::find(left.begin(), left.end(), next);
        if (next == no_face || place == left.end()) continue;
        fan.push_back(next);
        left.erase(place);
      }
    result.push_back(std::move(fan));
  }
  return result;
}

std::size_t TriangleComplex::remove_pinches()
{
  std::size_t removed = 0;
  std::vector<std::uint32_t> pending(position_.size());
  for (std::uint32_t v = 0; v < pending.size(); ++v) pending[v] = v;
  while (!pending.empty()) {
    std::vector<std::uint32_t> touched;
    for (const std::uint32_t v : pending) {
      const auto all = fans(v);
      if (all.size() < 2) continue;
      const auto largest =
          std::max_element(all.begin(), all.end(), [](const auto& x, const auto& y) { return x.size() < y.size(); });
      for (auto fan = all.begin(); fan != all.end(); ++fan) {
        if (fan == largest) continue;
        for (const std::uint32_t f : *fan) {
          touched.insert(touched.end(), face_[f].begin(), face_[f].end());
          remove(f);
          ++removed;
        }
      }
    }
    std::sort(touched.begin(), touched.end());
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
    pending.swap(touched);
  }
  return removed;
}

std::size_t TriangleComplex::remove_folds(double smallest_angle)
{
  const double largest_cosine = std::cos(smallest_angle);
  std::size_t removed = 0;
  for (const std::uint32_t f : faces())
    for (const Edge& e : edges_of(face_[f])) {
      if (present_[f] == 0) break;
      const std::uint32_t other = other_face(f, e.from, e.to);
      if (other == no_face) continue;
      const std::uint32_t apex = face_[other][0] + face_[other][1] + face_[other][2] - e.from - e.to;
      if (fold_cosine(position_[e.from], position_[e.to], position_[e.apex], position_[apex]) <= largest_cosine)
        continue;
      remove(f);
      remove(other);
      removed += 2;
    }
  return removed;
}

std::vector<std::vector<std::uint32_t>> TriangleComplex::components() const
{
  std::vector<std::vector<std::uint32_t>> result;
  std::vector<std::uint8_t> seen(face_.size());
  for (const std::uint32_t start : faces()) {
    if (seen[start] != 0) continue;
    std::vector<std::uint32_t> component{start};
    seen[start] = 1;
    for (std::size_t i = 0; i < component.size(); ++i)
      for (const Edge& e : edges_of(face_[component[i]])) {
        const std::uint32_t other = other_face(component[i], e.from, e.to);
        if (other == no_face || seen[other] != 0) continue;
        seen[other] = 1;
        component.push_back(other);
      }
    std::sort(component.begin(), component.end());
    result.push_back(std::move(component));
  }
  return result;
}

}  // namespace pds
