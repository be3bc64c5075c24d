// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/certificate.h>
#include <algorithm>
#include <numeric>
#include <tuple>

namespace pds
{
namespace
{

/** \brief One side of a face: an edge with its direction. */
struct Side
{
  std::uint32_t low, high;
  std::uint32_t face;
  bool ascending;  ///< the face runs from low to high

  bool operator<(const Side& other) const
  {
    return std::tie(low, high, face) < std::tie(other.low, other.high, other.face);
  }
  [[nodiscard]] bool same_edge(const Side& other) const { return low == other.low && high == other.high; }
};

class DisjointSets
{
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }

  std::uint32_t find(std::uint32_t i)
  {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) { parent_[std::max(find(a), find(b))] = std::min(find(a), find(b)); }

  std::size_t count_roots()
  {
    std::size_t roots = 0;
    for (std::uint32_t i = 0; i < parent_.size(); ++i) roots += find(i) == i ? 1 : 0;
    return roots;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

std::vector<Side> sorted_sides(const std::vector<Triangle>& triangles)
{
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (std::uint32_t f = 0; f < triangles.size(); ++f)
    for (std::size_t e = 0; e < 3; ++e) {
      const std::uint32_t from = triangles[f][e];
      const std::uint32_t to = triangles[f][(e + 1) % 3];
      sides.push_back({std::min(from, to), std::max(from, to), f, from < to});
    }
  std::sort(sides.begin(), sides.end());
  return sides;
}

/** \brief A vertex is manifold if its faces' opposite edges form one path or one cycle. */
bool is_single_fan(const std::vector<Triangle>& triangles,
                   const std::vector<std::uint32_t>& around,
                   std::uint32_t vertex)
{
  std::vector<std::pair<std::uint32_t, std::uint32_t>> link;
  for (const std::uint32_t f : around) {
    const Triangle& t = triangles[f];
    const std::size_t corner = t[0] == vertex ? 0 : t[1] == vertex ? 1 : 2;
    link.emplace_back(t[(corner + 1) % 3], t[(corner + 2) % 3]);
  }
  std::vector<std::uint32_t> ends;
  for (const auto& [x, y] : link) {
    ends.push_back(x);
    ends.push_back(y);
  }
  std::sort(ends.begin(), ends.end());
  for (std::size_t i = 2; i < ends.size(); ++i)
    if (ends[i] == ends[i - 2]) return false;
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  const auto place = [&](std::uint32_t v) {
    return static_cast<std::uint32_t>(std::lower_bound(ends.begin(), ends.end(), v) - ends.begin());
  };
  DisjointSets joined(ends.size());
  for (const auto& [x, y] : link) joined.join(place(x), place(y));
  return joined.count_roots() == 1;
}

/** \brief Chains directed boundary edges; at a vertex with several, in order of their ends. */
std::vector<std::vector<std::uint32_t>> chain_loops(std::vector<std::pair<std::uint32_t, std::uint32_t>> edges)
{
  std::sort(edges.begin(), edges.end());
  std::vector<std::uint8_t> used(edges.size());
  std::vector<std::vector<std::uint32_t>> loops;
  for (std::size_t start = 0; start < edges.size(); ++start) {
    if (used[start] != 0) continue;
    std::vector<std::uint32_t> loop;
    for (std::size_t e = start; e < edges.size() && used[e] == 0;) {
      used[e] = 1;
      loop.push_back(edges[e].first);
      const std::uint32_t at = edges[e].second;
      e = static_cast<std::size_t>(std::lower_bound(edges.begin(), edges.end(), std::make_pair(at, 0U)) -
                                   edges.begin());
      while (e < edges.size() && edges[e].first == at && used[e] != 0) ++e;
      if (e < edges.size() && edges[e].first != at) break;
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

}  // namespace

Certificate certify(const std::vector<Triangle>& triangles, std::size_t vertex_count)
{
  Certificate c;
  c.faces = triangles.size();
  const std::vector<Side> sides = sorted_sides(triangles);
  DisjointSets joined(triangles.size());
  std::vector<std::pair<std::uint32_t, std::uint32_t>> boundary;
  for (std::size_t begin = 0; begin < sides.size();) {
    std::size_t end = begin + 1;
    for (; end < sides.size() && sides[end].same_edge(sides[begin]); ++end)
      joined.join(sides[begin].face, sides[end].face);
    const Side& side = sides[begin];
    ++c.edges;
    if (end - begin > 2) ++c.nonmanifold_edges;
    if (end - begin == 2 && side.ascending == sides[begin + 1].ascending) ++c.inconsistent_edges;
    if (end - begin == 1)
      boundary.emplace_back(side.ascending ? side.low : side.high, side.ascending ? side.high : side.low);
    begin = end;
  }
  c.components = joined.count_roots();
  c.boundary_loops = chain_loops(std::move(boundary));

  std::vector<std::vector<std::uint32_t>> around(vertex_count);
  for (std::uint32_t f = 0; f < triangles.size(); ++f)
    for (const std::uint32_t v : triangles[f]) around[v].push_back(f);
  for (std::uint32_t v = 0; v < vertex_count; ++v) {
    if (around[v].empty()) continue;
    ++c.vertices;
    if (!is_single_fan(triangles, around[v], v)) ++c.nonmanifold_vertices;
  }
  c.euler = static_cast<long long>(c.vertices) - static_cast<long long>(c.edges) + static_cast<long long>(c.faces);
  return c;
}

}  // namespace pds
