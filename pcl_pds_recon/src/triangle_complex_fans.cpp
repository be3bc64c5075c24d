// SPDX-License-Identifier: BSD-3-Clause
// What concerns the faces of a complex as a whole: fans, orientation, components.
#include <pcl_pds_recon/triangle_complex.h>
#include <algorithm>

namespace pds
{

std::vector<std::uint32_t> TriangleComplex::faces() const
{
  std::vector<std::uint32_t> present;
  present.reserve(face_.size());
  for (std::uint32_t f = 0; f < face_.size(); ++f)
    if (face_[f].present) present.push_back(f);
  return present;
}

Triangle TriangleComplex::oriented(std::uint32_t face) const
{
  Triangle t = face_[face].corner;
  if (orientation_.root_of(face).flipped) std::swap(t[1], t[2]);
  return t;
}

bool TriangleComplex::is_pinched(std::uint32_t vertex) const
{
  const std::uint32_t first = first_at_[vertex];
  if (first == no_face) return false;
  // Both ways round from the first face; in a closed fan the first way meets it again.
  std::size_t fan = 1;
  const std::size_t corner = corner_of(first, vertex);
  for (const std::size_t start : {corner + 1, corner + 2}) {
    std::uint32_t at = face_[first].corner[start % 3];
    for (std::uint32_t f = other_face(first, vertex, at); f != no_face; ++fan) {
      if (f == first) return fan != count_faces_at(vertex);
      at = apex_of(f, vertex, at);
      f = other_face(f, vertex, at);
    }
  }
  return fan != count_faces_at(vertex);
}

std::vector<std::uint8_t> TriangleComplex::find_pinched() const
{
  std::vector<std::uint8_t> pinched(vertex_count());
  parallel_.each(pinched.size(), block, [&](std::size_t v) { pinched[v] = is_pinched(static_cast<std::uint32_t>(v)); });
  return pinched;
}

/** By their lowest faces. */
std::vector<std::vector<std::uint32_t>> TriangleComplex::fans(std::uint32_t vertex) const
{
  std::vector<std::uint32_t> left;
  for (const std::uint32_t f : faces_at(vertex)) left.push_back(f);
  std::sort(left.begin(), left.end());
  std::vector<std::vector<std::uint32_t>> result;
  while (!left.empty()) {
    std::vector<std::uint32_t> fan{left.front()};
    left.erase(left.begin());
    for (std::size_t i = 0; i < fan.size(); ++i)
      for (const std::uint32_t end : face_[fan[i]].corner) {
        if (end == vertex) continue;
        const auto place = std::find(left.begin(), left.end(), other_face(fan[i], vertex, end));
        if (place == left.end()) continue;
        fan.push_back(*place);
        left.erase(place);
      }
    result.push_back(std::move(fan));
  }
  return result;
}

std::size_t TriangleComplex::keep_largest_fan(std::uint32_t vertex, std::vector<std::uint32_t>& touched)
{
  std::size_t removed = 0;
  const auto all = fans(vertex);
  const auto largest =
      std::max_element(all.begin(), all.end(), [](const auto& x, const auto& y) { return x.size() < y.size(); });
  for (auto fan = all.begin(); fan != all.end(); ++fan) {
    if (fan == largest) continue;
    for (const std::uint32_t f : *fan) {
      touched.insert(touched.end(), face_[f].corner.begin(), face_[f].corner.end());
      remove(f);
      ++removed;
    }
  }
  return removed;
}

std::size_t TriangleComplex::remove_pinches()
{
  const std::vector<std::uint8_t> pinched = find_pinched();
  std::vector<std::uint32_t> pending;
  for (std::uint32_t v = 0; v < pinched.size(); ++v)
    if (pinched[v] != 0) pending.push_back(v);
  std::size_t removed = 0;
  while (!pending.empty()) {
    std::vector<std::uint32_t> touched;
    for (const std::uint32_t v : pending)
      if (is_pinched(v)) removed += keep_largest_fan(v, touched);
    std::sort(touched.begin(), touched.end());
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
    pending.swap(touched);
  }
  return removed;
}

/** Calls visit(face, from) for the faces that edges join to \a start, \a start first; from is where it was found. */
template <typename Visit>
void TriangleComplex::walk_component(std::uint32_t start, std::vector<std::uint8_t>& seen, const Visit& visit) const
{
  std::vector<std::pair<std::uint32_t, std::uint32_t>> found{{start, start}};
  seen[start] = 1;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto [face, from] = found[i];
    visit(face, from);
    for (const std::uint32_t other : face_[face].across) {
      if (other == no_face || seen[other] != 0) continue;
      seen[other] = 1;
      found.emplace_back(other, face);
    }
  }
}

void TriangleComplex::rebuild_orientation()
{
  if (!removed_since_rebuild_) return;
  removed_since_rebuild_ = false;
  std::vector<std::uint8_t> seen(face_.size());
  std::vector<std::uint8_t> flipped(face_.size());
  for (std::uint32_t f = 0; f < face_.size(); ++f) orientation_.isolate(f);
  for (std::uint32_t start = 0; start < face_.size(); ++start) {
    if (!face_[start].present || seen[start] != 0) continue;
    walk_component(start, seen, [&](std::uint32_t face, std::uint32_t from) {
      if (face == from) return;
      const Face& known = face_[from];
      const std::size_t side =
          static_cast<std::size_t>(std::find(known.across.begin(), known.across.end(), face) - known.across.begin());
      const bool opposed = runs_along(face, known.corner[side], known.corner[(side + 1) % 3]);
      flipped[face] = static_cast<std::uint8_t>(flipped[from] ^ static_cast<std::uint8_t>(opposed));
      orientation_.hang(face, start, flipped[face] != 0);
    });
  }
  orientation_.begin_trial();
}

std::vector<std::vector<std::uint32_t>> TriangleComplex::components() const
{
  std::vector<std::vector<std::uint32_t>> result;
  std::vector<std::uint8_t> seen(face_.size());
  std::vector<std::uint32_t> component_of(face_.size());
  for (std::uint32_t f = 0; f < face_.size(); ++f) {
    if (!face_[f].present) continue;
    if (seen[f] == 0) {
      const auto component = static_cast<std::uint32_t>(result.size());
      walk_component(f, seen, [&](std::uint32_t face, std::uint32_t) { component_of[face] = component; });
      result.emplace_back();
    }
    result[component_of[f]].push_back(f);
  }
  return result;
}

}  // namespace pds
