// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <pcl_pds_recon/mesh_inspection.h>
#include <pcl_pds_recon/options.h>

#include "meshes.h"

#include <cmath>

namespace pds
{
namespace
{

/** A strip of 2 n triangles around the z axis, closed with \a half_turns. */
TriangleMesh make_band(std::uint32_t n, int half_turns)
{
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double angle = 2 * 3.14159265358979 * i / n;
    const double turn = half_turns * angle / 2;
    for (const double side : {-0.3, 0.3})
      mesh.vertices.emplace_back((1 + side * std::cos(turn)) * std::cos(angle),
                                 (1 + side * std::cos(turn)) * std::sin(angle), side * std::sin(turn));
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const bool crosses = i + 1 == n && half_turns % 2 != 0;
    const std::uint32_t next = 2 * ((i + 1) % n);
    const std::uint32_t low = crosses ? next + 1 : next;
    const std::uint32_t high = crosses ? next : next + 1;
    mesh.faces.push_back({2 * i, low, 2 * i + 1});
    mesh.faces.push_back({2 * i + 1, low, high});
  }
  return mesh;
}

TEST(MeshInspection, OfASphere)
{
  const MeshInspection found = inspect_mesh(make_sphere(1, 2));
  EXPECT_EQ(found.vertices, 66U);
  EXPECT_EQ(found.faces, 128U);
  EXPECT_EQ(found.edges, 192U);
  EXPECT_EQ(found.components, 1U);
  EXPECT_EQ(found.euler, 2);
  EXPECT_EQ(found.genus, 0);
  EXPECT_TRUE(found.closed);
  EXPECT_TRUE(found.orientable);
  EXPECT_EQ(found.boundary_edges + found.boundary_loops + found.nonmanifold_edges + found.nonmanifold_vertices +
                found.inconsistent_edges + found.duplicate_faces + found.degenerate_faces + found.unreferenced_vertices,
            0U);
}

TEST(MeshInspection, OfATorusHasGenusOne)
{
  TriangleMesh torus;
  constexpr std::uint32_t n = 6;
  torus.vertices.resize(n * n);
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < n; ++j) {
      torus.vertices[n * i + j] = {std::cos(i) * (2 + std::cos(j)), std::sin(i) * (2 + std::cos(j)), std::sin(j)};
      const std::uint32_t right = (i + 1) % n;
      const std::uint32_t up = (j + 1) % n;
      torus.faces.push_back({n * i + j, n * right + j, n * right + up});
      torus.faces.push_back({n * i + j, n * right + up, n * i + up});
    }
  EXPECT_EQ(inspect_mesh(torus).genus, 1);
  TriangleMesh open = torus;
  open.faces.pop_back();
  EXPECT_EQ(inspect_mesh(open).genus, 1);
  EXPECT_EQ(inspect_mesh(open).boundary_loops, 1U);
  append(torus, torus);
  EXPECT_EQ(inspect_mesh(torus).genus, 2);
  EXPECT_EQ(inspect_mesh(torus).components, 2U);
}

TEST(MeshInspection, TellsAMoebiusStripFromABand)
{
  const MeshInspection band = inspect_mesh(make_band(12, 0));
  EXPECT_TRUE(band.orientable);
  EXPECT_EQ(band.boundary_loops, 2U);
  EXPECT_EQ(band.genus, 0);
  const MeshInspection moebius = inspect_mesh(make_band(12, 1));
  EXPECT_FALSE(moebius.orientable);
  EXPECT_EQ(moebius.boundary_loops, 1U);
  EXPECT_FALSE(moebius.genus);
  EXPECT_EQ(moebius.inconsistent_edges, 1U);
}

TEST(MeshInspection, CountsLoopsOfFacesTurnedAtRandom)
{
  TriangleMesh plane = make_plane(0, 6);
  for (std::size_t f = 0; f < plane.faces.size(); f += 3) std::swap(plane.faces[f][0], plane.faces[f][1]);
  const MeshInspection found = inspect_mesh(plane);
  EXPECT_GT(found.inconsistent_edges, 0U);
  EXPECT_TRUE(found.orientable);
  EXPECT_EQ(found.boundary_loops, 1U);
  EXPECT_EQ(found.boundary_edges, 24U);
  EXPECT_EQ(found.genus, 0);
}

TEST(MeshInspection, PullsApartFansThatMeetInAVertex)
{
  TriangleMesh pinched;  // two squares that touch in vertex 0
  pinched.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {-1, 0, 0}, {-1, -1, 0}, {0, -1, 0}};
  pinched.faces = {{0, 1, 2}, {0, 2, 3}, {0, 4, 5}, {0, 5, 6}};
  const MeshInspection found = inspect_mesh(pinched);
  EXPECT_EQ(found.nonmanifold_vertices, 1U);
  EXPECT_EQ(found.boundary_loops, 2U);
  EXPECT_EQ(found.components, 2U);
  EXPECT_EQ(found.genus, 0);
}

TEST(MeshInspection, CountsWhatIsWrong)
{
  TriangleMesh mesh = make_plane(0, 2);
  mesh.vertices.emplace_back(5, 5, 5);  // no face
  mesh.faces.push_back({1, 0, 4});      // the first one, turned over
  mesh.faces.push_back({3, 3, 4});      // names a vertex twice
  mesh.faces.push_back({0, 1, 2});      // on a line
  const MeshInspection found = inspect_mesh(mesh);
  EXPECT_EQ(found.faces, 10U);
  EXPECT_EQ(found.unreferenced_vertices, 1U);
  EXPECT_EQ(found.duplicate_faces, 1U);
  EXPECT_EQ(found.degenerate_faces, 2U);
  EXPECT_GT(found.nonmanifold_edges, 0U);
  EXPECT_FALSE(found.genus);
}

TEST(MeshInspection, OfACloudOrNothingIsAllZero)
{
  const MeshInspection found = inspect_mesh(make_lattice_cloud(0, 2));
  EXPECT_EQ(found.unreferenced_vertices, 4U);
  EXPECT_EQ(found.faces + found.components + found.boundary_loops, 0U);
  EXPECT_FALSE(found.closed);
  EXPECT_FALSE(inspect_mesh({}).genus);
}

TEST(MeshInspection, RefusesVerticesThatAreNotThere)
{
  TriangleMesh mesh = make_plane(0, 2);
  mesh.faces.push_back({0, 1, 9});
  EXPECT_THROW(static_cast<void>(inspect_mesh(mesh)), InvalidInput);
}

TEST(Weld, JoinsCoincidentVertices)
{
  TriangleMesh soup;
  for (const Triangle& face : make_sphere(1, 1).faces) {
    TriangleMesh one;
    for (const std::uint32_t v : face) one.vertices.push_back(make_sphere(1, 1).vertices[v]);
    one.faces = {{0, 1, 2}};
    append(soup, one);
  }
  EXPECT_EQ(inspect_mesh(soup).components, 32U);
  weld(soup);
  EXPECT_TRUE(inspect_mesh(soup).closed);
  EXPECT_EQ(inspect_mesh(soup).genus, 0);
}

}  // namespace
}  // namespace pds
