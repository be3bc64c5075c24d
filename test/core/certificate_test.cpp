// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/certificate.h>

#include <algorithm>

#include "core_testing.h"

namespace pds_test
{
namespace
{

using pds::Certificate;
using pds::certify;

const Triangles tetrahedron{{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};

/** \brief The tetrahedron with its corners renamed. */
Triangles renamed(std::array<std::uint32_t, 4> corner)
{
  Triangles triangles = tetrahedron;
  for (auto& t : triangles)
    for (std::uint32_t& v : t) v = corner[v];
  return triangles;
}

Triangles both(Triangles a, const Triangles& b)
{
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

void expect_flawless(const Certificate& c)
{
  EXPECT_EQ(c.nonmanifold_edges, 0U);
  EXPECT_EQ(c.nonmanifold_vertices, 0U);
  EXPECT_EQ(c.inconsistent_edges, 0U);
}

TEST(Certificate, OfNothing)
{
  const Certificate c = certify({}, 5);
  EXPECT_EQ(c.vertices + c.faces + c.edges + c.components + c.boundary_loops.size(), 0U);
  EXPECT_EQ(c.euler, 0);
  expect_flawless(c);
}

TEST(Certificate, OfATetrahedron)
{
  const Certificate c = certify(tetrahedron, 7);  // three vertices have no face
  EXPECT_EQ(c.vertices, 4U);
  EXPECT_EQ(c.edges, 6U);
  EXPECT_EQ(c.faces, 4U);
  EXPECT_EQ(c.components, 1U);
  EXPECT_EQ(c.euler, 2);
  EXPECT_TRUE(c.boundary_loops.empty());
  expect_flawless(c);
}

TEST(Certificate, OfATriangle)
{
  const Certificate c = certify({{2, 0, 1}}, 3);
  EXPECT_EQ(c.euler, 1);
  ASSERT_EQ(c.boundary_loops.size(), 1U);
  EXPECT_EQ(c.boundary_loops[0], (std::vector<std::uint32_t>{0, 1, 2})) << "in the direction of the face";
  expect_flawless(c);
}

TEST(Certificate, SeesAFlippedFace)
{
  Triangles triangles = tetrahedron;
  std::swap(triangles[2][0], triangles[2][1]);
  const Certificate c = certify(triangles, 4);
  EXPECT_EQ(c.inconsistent_edges, 3U);
  EXPECT_EQ(c.nonmanifold_edges + c.nonmanifold_vertices, 0U);
}

TEST(Certificate, SeesAPinchedVertex)
{
  const Certificate c = certify(both(tetrahedron, renamed({3, 4, 5, 6})), 7);
  EXPECT_EQ(c.nonmanifold_vertices, 1U);
  EXPECT_EQ(c.nonmanifold_edges, 0U);
  EXPECT_EQ(c.components, 2U) << "joined by edges, not by vertices";
}

TEST(Certificate, SeesAnEdgeOfFourFaces)
{
  const Certificate c = certify(both(tetrahedron, renamed({2, 3, 4, 5})), 6);
  EXPECT_EQ(c.nonmanifold_edges, 1U);
  EXPECT_EQ(c.nonmanifold_vertices, 2U);
  EXPECT_EQ(c.components, 1U);
}

TEST(Certificate, OfAMoebiusBandHasOneLoopAndAnInconsistentEdge)
{
  constexpr std::uint32_t count = 5;
  Triangles triangles;
  for (std::uint32_t i = 0; i < count; ++i) {
    const bool last = i + 1 == count;  // there the two rims change places
    const std::uint32_t next_low = last ? 1 : 2 * i + 2;
    const std::uint32_t next_high = last ? 0 : 2 * i + 3;
    triangles.push_back({2 * i, next_low, 2 * i + 1});
    triangles.push_back({2 * i + 1, next_low, next_high});
  }
  const Certificate c = certify(triangles, 2 * count);
  EXPECT_EQ(c.inconsistent_edges, 1U);
  EXPECT_EQ(c.nonmanifold_edges + c.nonmanifold_vertices, 0U);
  EXPECT_EQ(c.euler, 0);
}

TEST(Certificate, OfATorusGridAndOfTheSameWithHoles)
{
  constexpr std::uint32_t side = 6;
  Triangles triangles;
  for (std::uint32_t y = 0; y < side; ++y)
    for (std::uint32_t x = 0; x < side; ++x) {
      const auto at = [&](std::uint32_t dx, std::uint32_t dy) { return (y + dy) % side * side + (x + dx) % side; };
      triangles.push_back({at(0, 0), at(1, 0), at(1, 1)});
      triangles.push_back({at(0, 0), at(1, 1), at(0, 1)});
    }
  const Certificate closed = certify(triangles, side * side);
  EXPECT_EQ(closed.euler, 0);
  EXPECT_EQ(closed.edges, 3 * side * side);
  EXPECT_TRUE(closed.boundary_loops.empty());
  expect_flawless(closed);

  triangles.erase(triangles.begin() + 40);  // two faces that share no vertex
  triangles.erase(triangles.begin() + 3);
  const Certificate open = certify(triangles, side * side);
  EXPECT_EQ(open.euler, -2);
  EXPECT_EQ(open.boundary_loops.size(), 2U);
  for (const auto& loop : open.boundary_loops) EXPECT_EQ(loop.size(), 3U);
  expect_flawless(open);
}

/** Whatever triangles there are, the library's sorting and the tests' maps count the same. */
TEST(Certificate, AgreesWithPlainCountingOnRandomTriangles)
{
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    Random random(seed);
    const std::size_t vertices = 5 + random.below(20);
    Points position;
    for (std::size_t i = 0; i < vertices; ++i) position.push_back(random.in_box(1));
    std::set<std::array<std::uint32_t, 3>> distinct;
    Triangles triangles;
    for (std::size_t i = 0; i < vertices; ++i) {
      std::vector<std::uint32_t> corner(vertices);
      for (std::uint32_t v = 0; v < vertices; ++v) corner[v] = v;
      random.shuffle(corner);
      std::array<std::uint32_t, 3> sorted{corner[0], corner[1], corner[2]};
      std::sort(sorted.begin(), sorted.end());
      if (distinct.insert(sorted).second) triangles.push_back({corner[0], corner[1], corner[2]});
    }
    const Certificate c = certify(triangles, vertices);
    const MeshFacts facts = examine(triangles, position);
    EXPECT_EQ(c.vertices, facts.vertices);
    EXPECT_EQ(c.edges, facts.edges);
    EXPECT_EQ(c.components, facts.components);
    EXPECT_EQ(c.nonmanifold_edges, facts.nonmanifold_edges);
    EXPECT_EQ(c.nonmanifold_vertices, facts.nonmanifold_vertices);
    EXPECT_EQ(c.inconsistent_edges, facts.inconsistent_edges);
    EXPECT_EQ(c.euler, facts.euler());
  }
}

}  // namespace
}  // namespace pds_test
