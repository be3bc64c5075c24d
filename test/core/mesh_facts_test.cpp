// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "mesh_facts.h"
#include "shapes.h"

/** \brief The judge itself: it must see each defect that the other tests trust it to see. */
namespace pds_test
{
namespace
{

const Points corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};

TEST(MeshFacts, MeasuresATetrahedron)
{
  const MeshFacts facts = examine({{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}, corners);
  EXPECT_EQ(facts.vertices, 4U);
  EXPECT_EQ(facts.edges, 6U);
  EXPECT_EQ(facts.euler(), 2);
  EXPECT_EQ(facts.boundary_loops, 0U);
  EXPECT_NEAR(facts.volume, 1.0 / 6, 1e-12);
  EXPECT_NEAR(facts.area, 1.5 + std::sqrt(3.0) / 2, 1e-12);
  EXPECT_NEAR(facts.longest_edge, std::sqrt(2.0), 1e-12);
}

TEST(MeshFacts, MeasuresAtAnySize)
{
  for (const double scale : {1e-310, 1e-100, 1e100}) {
    Points scaled = corners;
    for (Eigen::Vector3d& p : scaled) p *= scale;
    const MeshFacts facts = examine({{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}, scaled);
    EXPECT_EQ(facts.degenerate_faces + facts.folded_edges, 0U) << scale;
    EXPECT_NEAR(facts.longest_edge / scale, std::sqrt(2.0), 1e-9);
  }
}

TEST(MeshFacts, SeesDefects)
{
  EXPECT_EQ(examine({{0, 1, 2}, {0, 1, 3}, {1, 0, 4}}, corners).nonmanifold_edges, 1U);
  EXPECT_EQ(examine({{0, 1, 2}, {0, 1, 3}}, corners).inconsistent_edges, 1U);
  EXPECT_EQ(examine({{0, 1, 2}, {1, 2, 0}}, corners).duplicate_faces, 1U);
  EXPECT_EQ(examine({{0, 1, 1}}, corners).degenerate_faces, 1U);
  EXPECT_EQ(examine({{0, 1, 2}}, {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}).degenerate_faces, 1U);
  const Points bow{{0, 0, 0}, {1, 1, 0}, {1, -1, 0}, {-1, 1, 0}, {-1, -1, 0}};
  const MeshFacts pinched = examine({{0, 2, 1}, {0, 3, 4}}, bow);
  EXPECT_EQ(pinched.nonmanifold_vertices, 1U);
  EXPECT_EQ(pinched.components, 2U);
}

TEST(MeshFacts, SeesFoldsOfLessThan30Degrees)
{
  for (const int enclosed : {5, 29, 31, 180}) {
    const double angle = enclosed * pi / 180;
    const Points hinge{{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, std::cos(angle), std::sin(angle)}};
    EXPECT_EQ(examine({{0, 1, 2}, {1, 0, 3}}, hinge).folded_edges, enclosed < 30 ? 1U : 0U) << enclosed;
  }
}

TEST(MeshFacts, SeesPiercingEdges)
{
  Points position{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0.5, 0.5, -1}, {0.5, 0.5, 1}, {3, 3, 1}};
  const Triangles crossing{{0, 1, 2}, {3, 4, 5}};
  EXPECT_GE(count_piercing_edges(crossing, position), 1U);
  for (const std::size_t i : {3U, 4U, 5U}) position[i].z() += 2;
  EXPECT_EQ(count_piercing_edges(crossing, position), 0U);
}

}  // namespace
}  // namespace pds_test
