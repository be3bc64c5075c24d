// SPDX-License-Identifier: BSD-3-Clause
#include "mesh_facts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace pds_test
{
namespace
{

using Eigen::Vector3d;
using Edge = std::pair<std::uint32_t, std::uint32_t>;
using Triangle = Triangles::value_type;

struct Side
{
  std::size_t face;
  std::uint32_t apex;
  bool ascending;
};
using Sides = std::map<Edge, std::vector<Side>>;

Sides sides_of(const Triangles& triangles)
{
  Sides sides;
  for (std::size_t f = 0; f < triangles.size(); ++f)
    for (std::size_t e = 0; e < 3; ++e) {
      const std::uint32_t from = triangles[f][e];
      const std::uint32_t to = triangles[f][(e + 1) % 3];
      sides[std::minmax(from, to)].push_back({f, triangles[f][(e + 2) % 3], from < to});
    }
  return sides;
}

/** \brief Groups of things joined by links: sizes of the groups, in order of their first member. */
template <typename Key>
std::vector<std::size_t> group_sizes(const std::map<Key, std::vector<Key>>& links)
{
  std::vector<std::size_t> sizes;
  std::set<Key> seen;
  for (const auto& [start, unused] : links) {
    if (!seen.insert(start).second) continue;
    std::vector<Key> group{start};
    for (std::size_t i = 0; i < group.size(); ++i)
      for (const Key& next : links.at(group[i]))
        if (seen.insert(next).second) group.push_back(next);
    sizes.push_back(group.size());
  }
  return sizes;
}

void count_components(const Triangles& triangles, const Sides& sides, MeshFacts& facts)
{
  std::map<std::size_t, std::vector<std::size_t>> links;
  for (std::size_t f = 0; f < triangles.size(); ++f) links[f];
  for (const auto& [edge, around] : sides)
    for (std::size_t i = 1; i < around.size(); ++i) {
      links[around[0].face].push_back(around[i].face);
      links[around[i].face].push_back(around[0].face);
    }
  const std::vector<std::size_t> sizes = group_sizes(links);
  facts.components = sizes.size();
  if (!sizes.empty()) facts.largest_component = *std::max_element(sizes.begin(), sizes.end());
}

/** \brief Loops of boundary edges: what is connected by them, which is a cycle each if the mesh is manifold. */
void count_loops(const Sides& sides, MeshFacts& facts)
{
  std::map<std::uint32_t, std::vector<std::uint32_t>> links;
  for (const auto& [edge, around] : sides)
    if (around.size() == 1) {
      links[edge.first].push_back(edge.second);
      links[edge.second].push_back(edge.first);
    }
  facts.boundary_loops = group_sizes(links).size();
}

/** \brief A vertex is manifold if the edges opposite to it form one path or one cycle. */
void count_vertices(const Triangles& triangles, MeshFacts& facts)
{
  std::map<std::uint32_t, std::map<std::uint32_t, std::vector<std::uint32_t>>> link;
  for (const Triangle& t : triangles)
    for (std::size_t c = 0; c < 3; ++c) {
      link[t[c]][t[(c + 1) % 3]].push_back(t[(c + 2) % 3]);
      link[t[c]][t[(c + 2) % 3]].push_back(t[(c + 1) % 3]);
    }
  facts.vertices = link.size();
  for (const auto& [vertex, around] : link) {
    const bool branches =
        std::any_of(around.begin(), around.end(), [](const auto& entry) { return entry.second.size() > 2; });
    if (branches || group_sizes(around).size() != 1) ++facts.nonmanifold_vertices;
  }
}

/** \brief Angle that the faces with these apices enclose at the edge (a, b), radians; pi is flat. */
double enclosed_angle(const Vector3d& a, const Vector3d& b, const Vector3d& p, const Vector3d& q)
{
  const Vector3d n = (b - a).cross(p - a);
  const Vector3d m = (b - a).cross(q - a);
  return std::atan2(n.cross(m).norm(), n.dot(m));
}

void measure(const Triangles& triangles, const std::vector<Vector3d>& position, MeshFacts& facts)
{
  std::set<Triangle> known;
  for (Triangle t : triangles) {
    const Vector3d& a = position[t[0]];
    const Vector3d& b = position[t[1]];
    const Vector3d& c = position[t[2]];
    const double twice_area = (b - a).cross(c - a).norm();
    const double longest = std::sqrt(std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()}));
    facts.longest_edge = std::max(facts.longest_edge, longest);
    facts.area += 0.5 * twice_area;
    facts.volume += a.dot(b.cross(c)) / 6.0;
    constexpr double least_height = 1e-12;  // of the longest edge
    if (!(twice_area > least_height * longest * longest)) ++facts.degenerate_faces;
    std::sort(t.begin(), t.end());
    if (!known.insert(t).second) ++facts.duplicate_faces;
  }
}

/** \brief Where the segment (p, q) pierces the triangle (a, b, c); touching does not count. */
bool pierces(const Vector3d& p, const Vector3d& q, const Vector3d& a, const Vector3d& b, const Vector3d& c)
{
  const auto side = [](const Vector3d& u, const Vector3d& v, const Vector3d& w, const Vector3d& x) {
    return (v - u).cross(w - u).dot(x - u);
  };
  if (side(a, b, c, p) * side(a, b, c, q) >= 0) return false;
  const double ab = side(p, q, a, b);
  const double bc = side(p, q, b, c);
  const double ca = side(p, q, c, a);
  return (ab > 0 && bc > 0 && ca > 0) || (ab < 0 && bc < 0 && ca < 0);
}

}  // namespace

MeshFacts examine(const Triangles& triangles, const std::vector<Vector3d>& original)
{
  MeshFacts facts;
  if (triangles.empty()) return facts;
  // To the size of one, so that no square overflows or vanishes.
  std::vector<Vector3d> position = original;
  double scale = 0;
  for (Vector3d& p : position) {
    p -= original[triangles[0][0]];
    scale = std::max(scale, p.cwiseAbs().maxCoeff());
  }
  if (scale > 0)
    for (Vector3d& p : position) p /= scale;
  const Sides sides = sides_of(triangles);
  facts.faces = triangles.size();
  facts.edges = sides.size();
  for (const auto& [edge, around] : sides) {
    if (around.size() > 2) ++facts.nonmanifold_edges;
    if (around.size() != 2) continue;
    if (around[0].ascending == around[1].ascending) ++facts.inconsistent_edges;
    constexpr double fold = 30 * 3.14159265358979323846 / 180;
    if (enclosed_angle(position[edge.first], position[edge.second], position[around[0].apex],
                       position[around[1].apex]) < fold)
      ++facts.folded_edges;
  }
  count_components(triangles, sides, facts);
  count_loops(sides, facts);
  count_vertices(triangles, facts);
  measure(triangles, position, facts);
  facts.longest_edge *= scale;
  facts.area *= scale * scale;
  facts.volume *= scale * scale * scale;
  return facts;
}

std::size_t count_piercing_edges(const Triangles& triangles, const std::vector<Vector3d>& position)
{
  std::vector<Eigen::AlignedBox3d> box;
  for (const Triangle& t : triangles) {
    box.emplace_back(position[t[0]]);
    box.back().extend(position[t[1]]).extend(position[t[2]]);
  }
  std::size_t count = 0;
  for (const auto& [edge, unused] : sides_of(triangles)) {
    Eigen::AlignedBox3d edge_box(position[edge.first]);
    edge_box.extend(position[edge.second]);
    for (std::size_t f = 0; f < triangles.size(); ++f) {
      const Triangle& t = triangles[f];
      if (!box[f].intersects(edge_box)) continue;
      if (std::count(t.begin(), t.end(), edge.first) + std::count(t.begin(), t.end(), edge.second) > 0) continue;
      if (pierces(position[edge.first], position[edge.second], position[t[0]], position[t[1]], position[t[2]])) ++count;
    }
  }
  return count;
}

}  // namespace pds_test
