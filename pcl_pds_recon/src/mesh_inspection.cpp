// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/certificate.h>
#include <pcl_pds_recon/mesh_inspection.h>
#include <algorithm>
#include <numeric>
#include <tuple>

namespace pds
{
namespace
{

bool names_vertex_twice(const Triangle& face) { return face[0] == face[1] || face[1] == face[2] || face[2] == face[0]; }

bool is_flat(const TriangleMesh& mesh, const Triangle& face)
{
  double longest = 0;
  for (std::size_t e = 0; e < 3; ++e)
    longest = std::max(longest, (mesh.vertices[face[e]] - mesh.vertices[face[(e + 1) % 3]]).squaredNorm());
  return area_normal(mesh, face).norm() <= flat_height * longest;
}

std::size_t count_duplicates(std::vector<Triangle> faces)
{
  for (Triangle& face : faces) std::sort(face.begin(), face.end());
  std::sort(faces.begin(), faces.end());
  return static_cast<std::size_t>(faces.end() - std::unique(faces.begin(), faces.end()));
}

/** \brief One side of a face: an edge with its direction. */
struct Side
{
  std::uint32_t low, high;
  std::uint32_t corner;  ///< 3 times the face, plus the place in it where the side begins
  bool ascending;        ///< it runs from low to high

  [[nodiscard]] std::uint32_t face() const { return corner / 3; }
  [[nodiscard]] std::uint32_t next_corner() const { return 3 * face() + (corner + 1) % 3; }
  [[nodiscard]] std::uint32_t low_corner() const { return ascending ? corner : next_corner(); }
  [[nodiscard]] std::uint32_t high_corner() const { return ascending ? next_corner() : corner; }
};

std::vector<Side> sorted_sides(const std::vector<Triangle>& faces)
{
  std::vector<Side> sides;
  sides.reserve(3 * faces.size());
  for (std::uint32_t corner = 0; corner < 3 * faces.size(); ++corner) {
    const Triangle& face = faces[corner / 3];
    const std::uint32_t from = face[corner % 3];
    const std::uint32_t to = face[(corner + 1) % 3];
    sides.push_back({std::min(from, to), std::max(from, to), corner, from < to});
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.corner) < std::tie(b.low, b.high, b.corner);
  });
  return sides;
}

/** \brief Calls visit(first side, number of sides) for every edge. */
template <typename Visit>
void for_each_edge(const std::vector<Side>& sides, const Visit& visit)
{
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && sides[end].low == sides[begin].low && sides[end].high == sides[begin].high) ++end;
    visit(&sides[begin], end - begin);
  }
}

/** \brief Union-find with parity: things that are joined lie the same way round, or opposite ways. */
class DisjointSets
{
 public:
  explicit DisjointSets(std::size_t count) : parent_(count), flipped_(count)
  {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }

  /** \return false if that contradicts what was said before */
  bool join(std::uint32_t a, std::uint32_t b, bool opposite = false)
  {
    const auto [root_a, flipped_a] = find(a);
    const auto [root_b, flipped_b] = find(b);
    const bool flipped = (flipped_a != flipped_b) != opposite;
    if (root_a == root_b) return !flipped;
    parent_[root_a] = root_b;
    flipped_[root_a] = flipped ? 1 : 0;
    return true;
  }

  /** \return the root, and whether \a i lies the opposite way round */
  std::pair<std::uint32_t, bool> find(std::uint32_t i)
  {
    bool flipped = false;
    while (parent_[i] != i) {
      flipped_[i] ^= flipped_[parent_[i]];  // of a root: 0
      parent_[i] = parent_[parent_[i]];
      flipped = flipped != (flipped_[i] != 0);
      i = parent_[i];
    }
    return {i, flipped};
  }

  [[nodiscard]] std::size_t count_roots() const
  {
    std::size_t roots = 0;
    for (std::uint32_t i = 0; i < parent_.size(); ++i) roots += parent_[i] == i ? 1 : 0;
    return roots;
  }

 private:
  std::vector<std::uint32_t> parent_;
  std::vector<std::uint8_t> flipped_;  ///< relative to the parent
};

/** \brief What needs the fans of faces around the vertices. A vertex of several fans counts as several vertices, so
 * that loops that touch are kept apart. */
void inspect_fans(const std::vector<Triangle>& faces, MeshInspection& result)
{
  const std::vector<Side> sides = sorted_sides(faces);
  DisjointSets turned(faces.size());
  DisjointSets fans(3 * faces.size());  // of corners
  for_each_edge(sides, [&](const Side* side, std::size_t count) {
    if (count == 1) ++result.boundary_edges;
    if (count != 2) return;
    fans.join(side[0].low_corner(), side[1].low_corner());
    fans.join(side[0].high_corner(), side[1].high_corner());
    if (!turned.join(side[0].face(), side[1].face(), side[0].ascending == side[1].ascending)) result.orientable = false;
  });
  const std::size_t fan_count = fans.count_roots();

  std::vector<std::uint32_t> rim;  // fans at the ends of boundary edges
  for_each_edge(sides, [&](const Side* side, std::size_t count) {
    if (count != 1) return;
    rim.push_back(fans.find(side->low_corner()).first);
    rim.push_back(fans.find(side->high_corner()).first);
    fans.join(rim.back(), rim[rim.size() - 2]);
  });
  for (std::uint32_t& fan : rim) fan = fans.find(fan).first;
  std::sort(rim.begin(), rim.end());
  result.boundary_loops = static_cast<std::size_t>(std::unique(rim.begin(), rim.end()) - rim.begin());

  if (!faces.empty() && result.orientable && result.nonmanifold_edges == 0) {
    const auto capped =
        static_cast<long long>(fan_count + result.faces + result.boundary_loops) - static_cast<long long>(result.edges);
    result.genus = static_cast<long long>(result.components) - capped / 2;
  }
}

}  // namespace

MeshInspection inspect_mesh(const TriangleMesh& mesh)
{
  validate(mesh);
  MeshInspection result;
  std::vector<Triangle> faces;
  for (const Triangle& face : mesh.faces) {
    if (!names_vertex_twice(face)) faces.push_back(face);
    if (names_vertex_twice(face) || is_flat(mesh, face)) ++result.degenerate_faces;
  }
  const Certificate certificate = certify(faces, mesh.vertices.size());
  result.vertices = certificate.vertices;
  result.faces = certificate.faces;
  result.edges = certificate.edges;
  result.components = certificate.components;
  result.nonmanifold_edges = certificate.nonmanifold_edges;
  result.nonmanifold_vertices = certificate.nonmanifold_vertices;
  result.inconsistent_edges = certificate.inconsistent_edges;
  result.euler = certificate.euler;
  inspect_fans(faces, result);
  result.closed = !faces.empty() && result.boundary_edges == 0;
  result.duplicate_faces = count_duplicates(faces);
  result.unreferenced_vertices = mesh.vertices.size() - certificate.vertices;
  return result;
}

}  // namespace pds
