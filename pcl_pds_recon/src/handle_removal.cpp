// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/handle_removal.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

#include "refilling.h"

namespace pds
{
namespace
{

constexpr std::size_t longest_loop =
    6;  // edges; a handle or tunnel of two radii across, twice the noise that is mended
constexpr std::size_t longest_first = 24;  // found far from its root, a loop is up to four times as long as need be
constexpr std::size_t roots_of_loop = 4;   // where shorter loops than one are looked for
constexpr std::uint32_t none = TriangleComplex::no_face;

/** \brief The edges of a complex, and loops along them that do not divide it. Each hole counts as a face. */
class LoopFinder
{
 public:
  explicit LoopFinder(const TriangleComplex& complex) : begin_(complex.vertex_count() + 1)
  {
    const std::vector<std::uint32_t> faces = complex.faces();
    const std::uint32_t first_hole = faces.empty() ? 0 : faces.back() + 1;
    std::vector<std::uint32_t> hole_at(complex.vertex_count());
    std::uint32_t hole = first_hole;
    for (const Polygon& loop : boundary_loops(complex)) {
      for (const std::uint32_t v : loop) hole_at[v] = hole;
      ++hole;
    }
    face_count_ = hole;
    for (const std::uint32_t f : faces) {
      const Triangle t = complex.oriented(f);
      for (std::size_t e = 0; e < 3; ++e) {
        const std::uint32_t to = t[(e + 1) % 3];
        const std::uint32_t other = complex.other_face(f, t[e], to);
        if (other == none || f < other) edges_.push_back({{t[e], to}, {f, other == none ? hole_at[t[e]] : other}});
      }
    }
    join_vertices();
  }

  /** \brief Two loops, around and through it, for each handle of the components of the roots, shortest first. Those
   * near a root are the shortest there are. */
  [[nodiscard]] std::vector<Polygon> loops(const std::vector<std::uint32_t>& roots) const
  {
    std::vector<std::uint32_t> parent(begin_.size() - 1, none);
    std::vector<std::uint32_t> depth(begin_.size() - 1, none);
    for (const std::uint32_t root : roots) grow_tree(root, parent, depth);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> far_first;  // ascending by minus the depth
    for (std::uint32_t e = 0; e < edges_.size(); ++e) {
      const auto [a, b] = edges_[e].end;
      if (depth[a] != none && parent[a] != b && parent[b] != a)
        far_first.emplace_back(std::numeric_limits<std::uint32_t>::max() - depth[a] - depth[b], e);
    }
    std::sort(far_first.begin(), far_first.end());
    std::vector<std::uint32_t> tree_of(face_count_);
    std::iota(tree_of.begin(), tree_of.end(), 0U);
    const auto tree = [&tree_of](std::uint32_t face) {
      while (tree_of[face] != face) face = tree_of[face] = tree_of[tree_of[face]];
      return face;
    };
    std::vector<Polygon> found;
    for (const auto& [order, e] : far_first) {
      const std::uint32_t left = tree(edges_[e].side[0]);
      const std::uint32_t right = tree(edges_[e].side[1]);
      if (left != right)
        tree_of[left] = right;
      else
        found.push_back(close_loop(edges_[e].end, parent, depth));
    }
    std::stable_sort(found.begin(), found.end(), [](const auto& x, const auto& y) { return x.size() < y.size(); });
    return found;
  }

 private:
  struct Edge
  {
    std::pair<std::uint32_t, std::uint32_t> end;
    std::array<std::uint32_t, 2> side;
  };

  void join_vertices()
  {
    for (const Edge& e : edges_) {
      ++begin_[e.end.first + 1];
      ++begin_[e.end.second + 1];
    }
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    neighbor_.resize(begin_.back());
    for (const Edge& e : edges_) {
      neighbor_[next[e.end.first]++] = e.end.second;
      neighbor_[next[e.end.second]++] = e.end.first;
    }
  }

  void grow_tree(std::uint32_t root, std::vector<std::uint32_t>& parent, std::vector<std::uint32_t>& depth) const
  {
    depth[root] = 0;
    std::vector<std::uint32_t> found{root};
    for (std::size_t i = 0; i < found.size(); ++i)
      for (std::size_t n = begin_[found[i]]; n < begin_[found[i] + 1]; ++n) {
        const std::uint32_t v = neighbor_[n];
        if (depth[v] != none) continue;
        depth[v] = depth[found[i]] + 1;
        parent[v] = found[i];
        found.push_back(v);
      }
  }

  /** \brief The edge and the way through the tree from one end to the other. */
  static Polygon close_loop(std::pair<std::uint32_t, std::uint32_t> edge,
                            const std::vector<std::uint32_t>& parent,
                            const std::vector<std::uint32_t>& depth)
  {
    auto [a, b] = edge;
    Polygon from_a{a};
    Polygon from_b{b};
    while (a != b) {
      const bool climb_a = depth[a] >= depth[b];
      std::uint32_t& at = climb_a ? a : b;
      at = parent[at];
      if (a != b) (climb_a ? from_a : from_b).push_back(at);
    }
    if (from_b.back() == a) from_b.pop_back();
    if (from_a.back() != a) from_a.push_back(a);
    from_a.insert(from_a.end(), from_b.rbegin(), from_b.rend());
    return from_a;
  }

  std::vector<Edge> edges_;
  std::uint32_t face_count_ = 0;    ///< numbers of faces, and of holes behind them
  std::vector<std::size_t> begin_;  ///< by vertex, where its neighbours begin
  std::vector<std::uint32_t> neighbor_;
};

/** \brief Two loops for each handle of the complex, shortest first. */
std::vector<Polygon> handle_loops(const TriangleComplex& complex, const LoopFinder& finder)
{
  std::vector<std::uint32_t> roots;
  for (const std::vector<std::uint32_t>& component : complex.components())
    roots.push_back(complex.oriented(component.front())[0]);
  return finder.loops(roots);
}

/** \brief A loop as short as they come near this one. */
Polygon shortened(const LoopFinder& finder, Polygon loop)
{
  for (bool shorter = true; shorter && loop.size() > longest_loop;) {
    shorter = false;
    const Polygon before = loop;
    for (std::size_t i = 0; i < roots_of_loop; ++i)
      for (Polygon& other : finder.loops({before[i * before.size() / roots_of_loop]})) {
        if (other.size() >= loop.size()) break;
        loop = std::move(other);
        shorter = true;
      }
  }
  return loop;
}

/** \brief Removes one handle.
 * \return false if there is none that is small enough */
bool remove_handle(TriangleComplex& complex, const BorderingCells& bordering, const FillLimits& limits)
{
  const LoopFinder finder(complex);
  const std::vector<Polygon> all = handle_loops(complex, finder);
  for (const Polygon& first : all) {
    if (first.size() > longest_first) break;
    const Polygon loop = shortened(finder, first);
    if (loop.size() > longest_loop) continue;
    TriangleComplex trial = complex;
    if (refill_around(trial, loop, bordering, limits) && handle_loops(trial, LoopFinder(trial)).size() < all.size())
      return refill_around(complex, loop, bordering, limits);
  }
  return false;
}

}  // namespace

std::size_t remove_small_handles(TriangleComplex& complex, const BorderingCells& bordering, const FillLimits& limits)
{
  FillLimits of_cut = limits;
  of_cut.perimeter = std::numeric_limits<double>::infinity();  // the loop is short
  std::size_t removed = 0;
  while (remove_handle(complex, bordering, of_cut)) ++removed;
  return removed;
}

}  // namespace pds
