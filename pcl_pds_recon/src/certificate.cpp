// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/certificate.h>
#include <algorithm>
#include <numeric>
#include <tuple>
#include "bucket_sort.h"
#include "parallel_parts.h"

namespace pds
{
namespace
{

constexpr std::size_t block = 2048;  // faces or vertices per block

using DirectedEdge = std::pair<std::uint32_t, std::uint32_t>;

/** \brief One side of a face, at the lower end of its edge. */
struct Side
{
  std::uint32_t high;
  std::uint32_t face;
  bool ascending;  ///< the face runs from the lower to the higher end

  bool operator<(const Side& other) const { return std::tie(high, face) < std::tie(other.high, other.face); }
};

class DisjointSets
{
 public:
  void reset(std::size_t count)
  {
    parent_.resize(count);
    std::iota(parent_.begin(), parent_.end(), 0U);
    sets_ = count;
  }
  void join(std::uint32_t a, std::uint32_t b)
  {
    a = find(a);
    b = find(b);
    if (a == b) return;
    parent_[std::max(a, b)] = std::min(a, b);
    --sets_;
  }
  [[nodiscard]] std::size_t sets() const { return sets_; }

 private:
  std::uint32_t find(std::uint32_t i)
  {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  std::vector<std::uint32_t> parent_;
  std::size_t sets_ = 0;
};

/** \brief What sorting the sides by their edges shows. */
struct EdgeCounts
{
  std::size_t edges = 0;
  std::size_t nonmanifold = 0;
  std::size_t inconsistent = 0;
  std::vector<DirectedEdge> boundary;
  std::vector<DirectedEdge> joined;  ///< faces that share an edge

  /** \brief Counts the edges of which this vertex is the lower end; sorts its sides. */
  void count(std::uint32_t low, Side* begin, Side* end)
  {
    std::sort(begin, end);
    for (const Side* side = begin; side != end;) {
      const Side* last = side + 1;
      for (; last != end && last->high == side->high; ++last) joined.emplace_back(side->face, last->face);
      ++edges;
      if (last - side > 2) ++nonmanifold;
      if (last - side == 2 && side->ascending == side[1].ascending) ++inconsistent;
      if (last - side == 1)
        boundary.push_back(side->ascending ? DirectedEdge(low, side->high) : DirectedEdge(side->high, low));
      side = last;
    }
  }
};

EdgeCounts count_edges(const std::vector<Triangle>& triangles, std::size_t vertex_count, const Parallel& parallel)
{
  BucketSort by_low_end(vertex_count);
  const auto each_side = [&](const auto& action) {
    parallel.each(triangles.size(), block, [&](std::size_t f) {
      for (std::size_t e = 0; e < 3; ++e) action(f, triangles[f][e], triangles[f][(e + 1) % 3]);
    });
  };
  each_side([&](std::size_t, std::uint32_t from, std::uint32_t to) { by_low_end.count(std::min(from, to)); });
  const std::vector<std::size_t> begin = by_low_end.begins();
  std::vector<Side> sides(begin.back());
  each_side([&](std::size_t f, std::uint32_t from, std::uint32_t to) {
    sides[by_low_end.place(std::min(from, to))] = {std::max(from, to), static_cast<std::uint32_t>(f), from < to};
  });

  EdgeCounts sum;
  for (const EdgeCounts& part : parallel_parts<EdgeCounts>(
           vertex_count, block, parallel, [&](std::size_t first, std::size_t last, EdgeCounts&counts) {
             for (std::size_t v = first; v < last; ++v)
               counts.count(static_cast<std::uint32_t>(v), sides.data() + begin[v], sides.data() + begin[v + 1]);
           })) {
    sum.edges += part.edges;
    sum.nonmanifold += part.nonmanifold;
    sum.inconsistent += part.inconsistent;
    append(sum.boundary, part.boundary);
    append(sum.joined, part.joined);
  }
  return sum;
}

/** \brief A vertex is manifold if its faces' opposite edges, its link, form one path or one cycle. */
class LinkCheck
{
 public:
  bool is_single_fan(const DirectedEdge* begin, const DirectedEdge* end)
  {
    ends_.clear();
    for (const DirectedEdge* edge = begin; edge != end; ++edge) {
      ends_.push_back(edge->first);
      ends_.push_back(edge->second);
    }
    std::sort(ends_.begin(), ends_.end());
    for (std::size_t i = 2; i < ends_.size(); ++i)
      if (ends_[i] == ends_[i - 2]) return false;
    ends_.erase(std::unique(ends_.begin(), ends_.end()), ends_.end());
    joined_.reset(ends_.size());
    for (const DirectedEdge* edge = begin; edge != end; ++edge) joined_.join(place(edge->first), place(edge->second));
    return joined_.sets() == 1;
  }

 private:
  [[nodiscard]] std::uint32_t place(std::uint32_t end) const
  {
    return static_cast<std::uint32_t>(std::find(ends_.begin(), ends_.end(), end) - ends_.begin());
  }

  std::vector<std::uint32_t> ends_;
  DisjointSets joined_;
};

/** \brief Vertices that have a face, and those of them that are not manifold. */
struct VertexCounts
{
  std::size_t used = 0;
  std::size_t nonmanifold = 0;
};

VertexCounts count_vertices(const std::vector<Triangle>& triangles, std::size_t vertex_count, const Parallel& parallel)
{
  BucketSort by_vertex(vertex_count);
  parallel.each(triangles.size(), block, [&](std::size_t f) {
    for (const std::uint32_t v : triangles[f]) by_vertex.count(v);
  });
  const std::vector<std::size_t> begin = by_vertex.begins();
  std::vector<DirectedEdge> link(begin.back());
  parallel.each(triangles.size(), block, [&](std::size_t f) {
    const Triangle& t = triangles[f];
    for (std::size_t i = 0; i < 3; ++i) link[by_vertex.place(t[i])] = {t[(i + 1) % 3], t[(i + 2) % 3]};
  });
  VertexCounts sum;
  for (const VertexCounts& part : parallel_parts<VertexCounts>(
           vertex_count, block, parallel, [&](std::size_t first, std::size_t last, VertexCounts&counts) {
             LinkCheck check;
             for (std::size_t v = first; v < last; ++v) {
               if (begin[v] == begin[v + 1]) continue;
               ++counts.used;
               if (!check.is_single_fan(link.data() + begin[v], link.data() + begin[v + 1])) ++counts.nonmanifold;
             }
           })) {
    sum.used += part.used;
    sum.nonmanifold += part.nonmanifold;
  }
  return sum;
}

/** \brief Chains directed boundary edges; at a vertex with several, in order of their ends. */
std::vector<std::vector<std::uint32_t>> chain_loops(std::vector<DirectedEdge> edges)
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

Certificate certify(const std::vector<Triangle>& triangles, std::size_t vertex_count, const Parallel& parallel)
{
  EdgeCounts edges = count_edges(triangles, vertex_count, parallel);
  const VertexCounts vertices = count_vertices(triangles, vertex_count, parallel);
  DisjointSets faces;
  faces.reset(triangles.size());
  for (const auto& [f, g] : edges.joined) faces.join(f, g);

  Certificate c;
  c.vertices = vertices.used;
  c.faces = triangles.size();
  c.edges = edges.edges;
  c.components = faces.sets();
  c.nonmanifold_edges = edges.nonmanifold;
  c.nonmanifold_vertices = vertices.nonmanifold;
  c.inconsistent_edges = edges.inconsistent;
  c.euler = static_cast<long long>(c.vertices) - static_cast<long long>(c.edges) + static_cast<long long>(c.faces);
  c.boundary_loops = chain_loops(std::move(edges.boundary));
  return c;
}

}  // namespace pds
