// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/triangle_complex.h>

#include <algorithm>

#include "core_testing.h"

namespace pds_test
{
namespace
{

using pds::Triangle;
using pds::TriangleComplex;
using Verdict = pds::TriangleComplex::Verdict;

constexpr double any_angle = 0.0;
constexpr double degree = pi / 180;

Triangles oriented_faces(const TriangleComplex& complex)
{
  Triangles triangles;
  for (const std::uint32_t f : complex.faces()) triangles.push_back(complex.oriented(f));
  return triangles;
}

/** \brief The corners of a regular tetrahedron (0 ... 3) and of another one beside it (4 ... 7). */
Points two_tetrahedra()
{
  Points p{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  for (std::size_t i = 0; i < 4; ++i) p.push_back(p[i] + Eigen::Vector3d(5, 0, 0));
  return p;
}

/** \brief A hub (0) with \a count spokes around it in the plane. */
Points wheel(std::size_t count)
{
  Points p{{0, 0, 0}};
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 2 * pi * static_cast<double>(i) / static_cast<double>(count);
    p.emplace_back(std::cos(angle), std::sin(angle), 0);
  }
  return p;
}

TEST(TriangleComplex, ClosesATetrahedron)
{
  const Points position = two_tetrahedra();
  TriangleComplex complex(position);
  for (const Triangle& t : Triangles{{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}})
    EXPECT_EQ(complex.add(t, any_angle), Verdict::legal);
  const MeshFacts facts = examine(oriented_faces(complex), position);
  EXPECT_EQ(facts.boundary_loops, 0U);
  EXPECT_EQ(facts.inconsistent_edges, 0U) << "although the faces came in mixed directions";
  EXPECT_EQ(facts.euler(), 2);
}

TEST(TriangleComplex, RefusesAThirdFaceAtAnEdge)
{
  const Points position{{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, -1, 0}, {0.5, 0, 1}};
  TriangleComplex complex(position);
  EXPECT_EQ(complex.add({0, 1, 2}, any_angle), Verdict::legal);
  EXPECT_EQ(complex.add({1, 0, 3}, any_angle), Verdict::legal);
  EXPECT_EQ(complex.face_count(0, 1), 2);
  EXPECT_EQ(complex.add({0, 1, 4}, any_angle), Verdict::edge_full);
  EXPECT_EQ(complex.faces().size(), 2U) << "a refused face leaves no trace";
  EXPECT_FALSE(complex.has_edge(0, 4));
}

TEST(TriangleComplex, RefusesDegenerateTriangles)
{
  const Points position{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {0, 0, 0}};
  TriangleComplex complex(position);
  EXPECT_EQ(complex.add({0, 1, 1}, any_angle), Verdict::degenerate);
  EXPECT_EQ(complex.add({0, 1, 2}, any_angle), Verdict::degenerate) << "collinear";
  EXPECT_EQ(complex.add({0, 4, 1}, any_angle), Verdict::degenerate) << "coincident corners";
  EXPECT_EQ(complex.add({0, 1, 3}, any_angle), Verdict::legal);
}

TEST(TriangleComplex, RefusesTheSameFaceTwice)
{
  const Points position = two_tetrahedra();
  TriangleComplex complex(position);
  EXPECT_EQ(complex.add({0, 1, 2}, any_angle), Verdict::legal);
  EXPECT_NE(complex.add({0, 1, 2}, any_angle), Verdict::legal);
  EXPECT_NE(complex.add({2, 1, 0}, any_angle), Verdict::legal);
}

TEST(TriangleComplex, RefusesAnythingBesideAClosedFan)
{
  Points position = wheel(6);
  position.emplace_back(0.1, 0, 1);
  position.emplace_back(-0.1, 0.1, 1);
  TriangleComplex complex(position);
  for (std::uint32_t i = 1; i <= 6; ++i) EXPECT_EQ(complex.add({0, i, i % 6 + 1}, any_angle), Verdict::legal);
  EXPECT_EQ(complex.add({0, 7, 8}, any_angle), Verdict::link_broken);
}

TEST(TriangleComplex, RefusesToCloseAFanBesideAnother)
{
  Points position = wheel(6);
  position.emplace_back(0.1, 0, 1);
  position.emplace_back(-0.1, 0.1, 1);
  TriangleComplex complex(position);
  EXPECT_EQ(complex.add({0, 7, 8}, any_angle), Verdict::legal);
  for (std::uint32_t i = 1; i < 6; ++i) EXPECT_EQ(complex.add({0, i, i + 1}, any_angle), Verdict::legal);
  EXPECT_EQ(complex.add({0, 6, 1}, any_angle), Verdict::link_broken);
}

TEST(TriangleComplex, KeepsTheLargestFanOfAPinchedVertex)
{
  Points position = wheel(6);
  TriangleComplex complex(position);
  EXPECT_EQ(complex.add({0, 1, 2}, any_angle), Verdict::legal);
  EXPECT_EQ(complex.add({0, 3, 4}, any_angle), Verdict::legal);
  EXPECT_EQ(complex.add({0, 4, 5}, any_angle), Verdict::legal);
  EXPECT_EQ(complex.remove_pinches(), 1U);
  EXPECT_FALSE(complex.has_edge(0, 1));
  EXPECT_TRUE(complex.has_edge(0, 4));
  EXPECT_EQ(complex.remove_pinches(), 0U);
}

/** \brief Corners of a band of \a count quadrilaterals with half a twist; corner 2i lies opposite to 2i + 1. */
Points moebius_corners(std::uint32_t count)
{
  Points position;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double angle = 2 * pi * i / count;
    for (const double across : {-0.3, 0.3}) {
      const double r = 1 + across * std::cos(angle / 2);
      position.emplace_back(r * std::cos(angle), r * std::sin(angle), across * std::sin(angle / 2));
    }
  }
  return position;
}

TEST(TriangleComplex, RefusesTheFaceThatWouldMakeABandOneSided)
{
  constexpr std::uint32_t count = 12;
  const Points position = moebius_corners(count);
  TriangleComplex complex(position);
  for (std::uint32_t i = 0; i + 1 < count; ++i) {
    EXPECT_EQ(complex.add({2 * i, 2 * i + 1, 2 * i + 2}, any_angle), Verdict::legal);
    EXPECT_EQ(complex.add({2 * i + 3, 2 * i + 1, 2 * i + 2}, any_angle), Verdict::legal);
  }
  // Half a twist: the last pair is joined to the first crosswise.
  EXPECT_EQ(complex.add({2 * count - 2, 2 * count - 1, 1}, any_angle), Verdict::legal);
  EXPECT_EQ(complex.add({2 * count - 1, 1, 0}, any_angle), Verdict::one_sided);
  EXPECT_EQ(examine(oriented_faces(complex), position).inconsistent_edges, 0U);
}

TEST(TriangleComplex, StartsWithAllFacesOfAClosedSurface)
{
  const Points position = two_tetrahedra();
  TriangleComplex complex(position);
  EXPECT_TRUE(complex.start({{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}, {4, 5, 6}}, any_angle).empty());
  const MeshFacts facts = examine(oriented_faces(complex), position);
  EXPECT_EQ(facts.faces, 5U);
  EXPECT_EQ(facts.inconsistent_edges, 0U) << "although the faces came in mixed directions";
  EXPECT_EQ(complex.add({0, 1, 2}, any_angle), Verdict::edge_full);
}

TEST(TriangleComplex, StartsWithoutWhatBreaksARule)
{
  // A closed fan and another face at its hub; three faces at an edge; a flat one.
  Points position = wheel(6);
  position.insert(position.end(), {{0.1, 0, 1}, {-0.1, 0.1, 1}});
  position.insert(position.end(), {{5, 0, 0}, {6, 0, 0}, {5.5, 1, 0}, {5.5, -1, 0}, {5.5, 0, 1}, {7, 0, 0}});
  Triangles triangles{{0, 7, 8}, {9, 10, 11}, {9, 10, 12}, {9, 10, 13}, {9, 10, 14}};
  for (std::uint32_t i = 1; i <= 6; ++i) triangles.push_back({0, i, i % 6 + 1});
  TriangleComplex complex(position);
  EXPECT_EQ(complex.start(triangles, any_angle), (std::vector<std::uint32_t>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10}));
  EXPECT_EQ(complex.faces(), std::vector<std::uint32_t>{0});
}

TEST(TriangleComplex, DoesNotStartWithAOneSidedBand)
{
  constexpr std::uint32_t count = 12;
  Points position = moebius_corners(count);
  position.insert(position.end(), {{5, 0, 0}, {6, 0, 0}, {5, 1, 0}});
  Triangles band{{2 * count - 2, 2 * count - 1, 1}, {2 * count - 1, 1, 0}};
  for (std::uint32_t i = 0; i + 1 < count; ++i) {
    band.push_back({2 * i, 2 * i + 1, 2 * i + 2});
    band.push_back({2 * i + 3, 2 * i + 1, 2 * i + 2});
  }
  Triangles triangles = band;
  triangles.push_back({2 * count, 2 * count + 1, 2 * count + 2});
  TriangleComplex complex(position);
  EXPECT_EQ(complex.start(triangles, any_angle).size(), band.size());
  EXPECT_EQ(complex.faces(), std::vector<std::uint32_t>{2 * count});
  std::size_t refused = 0;
  for (const Triangle& t : band) refused += complex.add(t, any_angle) == Verdict::one_sided ? 1 : 0;
  EXPECT_EQ(refused, 1U);
}

TEST(TriangleComplex, ForgetsConstraintsOfRemovedFacesWhenTold)
{
  constexpr std::uint32_t count = 12;
  const Points position = moebius_corners(count);
  TriangleComplex complex(position);
  for (std::uint32_t i = 0; i + 1 < count; ++i) {
    complex.add({2 * i, 2 * i + 1, 2 * i + 2}, any_angle);
    complex.add({2 * i + 1, 2 * i + 2, 2 * i + 3}, any_angle);
  }
  complex.add({2 * count - 2, 2 * count - 1, 1}, any_angle);
  for (const std::uint32_t f : complex.faces())
    if (f == 10 || f == 11) complex.remove(f);  // cuts the band on its other side
  EXPECT_EQ(complex.add({2 * count - 1, 1, 0}, any_angle), Verdict::one_sided);
  complex.rebuild_orientation();
  EXPECT_EQ(complex.add({2 * count - 1, 1, 0}, any_angle), Verdict::legal);
  EXPECT_EQ(examine(oriented_faces(complex), position).inconsistent_edges, 0U);
}

/** \brief Two triangles at the edge (0, 1) that enclose \a angle. */
Points hinge(double angle) { return {{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, std::cos(angle), std::sin(angle)}}; }

TEST(TriangleComplex, RefusesAFaceThatFoldsBack)
{
  for (const int enclosed : {10, 39, 41, 90, 180}) {
    const Points position = hinge(enclosed * degree);
    TriangleComplex complex(position);
    EXPECT_EQ(complex.add({0, 1, 2}, 40 * degree), Verdict::legal);
    EXPECT_EQ(complex.add({1, 0, 3}, 40 * degree), enclosed < 40 ? Verdict::folded : Verdict::legal) << enclosed;
  }
}

TEST(TriangleComplex, NamesFacesAcrossEdgesAndComponents)
{
  const Points position = two_tetrahedra();
  TriangleComplex complex(position);
  for (const Triangle& t : Triangles{{0, 1, 2}, {4, 5, 6}, {0, 2, 3}, {5, 6, 7}}) complex.add(t, any_angle);
  EXPECT_EQ(complex.other_face(0, 0, 2), 2U);
  EXPECT_EQ(complex.other_face(0, 2, 0), 2U);
  EXPECT_EQ(complex.other_face(0, 0, 1), TriangleComplex::no_face);
  EXPECT_EQ(complex.components(), (std::vector<std::vector<std::uint32_t>>{{0, 2}, {1, 3}}));
  complex.remove(2);
  EXPECT_EQ(complex.faces(), (std::vector<std::uint32_t>{0, 1, 3}));
  EXPECT_EQ(complex.other_face(0, 0, 2), TriangleComplex::no_face);
}

class TriangleSoup : public testing::TestWithParam<std::uint64_t>
{
};

INSTANTIATE_TEST_SUITE_P(Seeds, TriangleSoup, testing::Range<std::uint64_t>(0, 40));

/** Triangles of nearby and of any points, so that vertices fill up, with removals in between. */
TEST_P(TriangleSoup, BecomesAManifoldInAnyOrder)
{
  Random random(GetParam());
  const std::size_t vertices = 6 + random.below(30);
  Points position;
  for (std::size_t i = 0; i < vertices; ++i) position.push_back(random.in_box(1));
  constexpr double smallest_angle = 0.55;  // radians, above the checker's 30 degrees
  TriangleComplex complex(position);
  std::size_t added = 0;
  for (int round = 0; round < 4000; ++round) {
    const auto corner = [&] { return static_cast<std::uint32_t>(random.below(vertices)); };
    const Triangle t{corner(), corner(), corner()};
    const Verdict foretold = complex.judge(t, smallest_angle);
    const Verdict verdict = complex.add(t, smallest_angle);
    ASSERT_EQ(verdict, foretold);
    added += verdict == Verdict::legal ? 1 : 0;
    if (random.below(200) == 0 && !complex.faces().empty()) {
      complex.remove(complex.faces()[random.below(complex.faces().size())]);
      if (random.below(2) == 0) complex.rebuild_orientation();
    }
    if (round % 500 != 499) continue;
    const MeshFacts facts = examine(oriented_faces(complex), position);
    ASSERT_EQ(facts.nonmanifold_edges + facts.inconsistent_edges + facts.duplicate_faces + facts.degenerate_faces +
                  facts.folded_edges,
              0U);
  }
  EXPECT_GT(added, vertices / 2);
  complex.remove_pinches();
  const MeshFacts facts = examine(oriented_faces(complex), position);
  EXPECT_GT(facts.faces, 0U);
  EXPECT_EQ(facts.nonmanifold_edges + facts.nonmanifold_vertices + facts.inconsistent_edges, 0U);
}

/** Whatever is offered at once: what is taken is manifold, oriented and not folded, and the rest can be offered again.
 */
TEST_P(TriangleSoup, StartsAsAManifold)
{
  Random random(GetParam());
  const std::size_t vertices = 12 + random.below(200);
  Points position;
  for (std::size_t i = 0; i < vertices; ++i) position.push_back(random.in_box(1));
  Triangles triangles;
  for (std::size_t i = 0; i < vertices; ++i) {
    const auto corner = [&] { return static_cast<std::uint32_t>(random.below(vertices)); };
    triangles.push_back({corner(), corner(), corner()});
  }
  constexpr double smallest_angle = 0.55;  // radians, above the checker's 30 degrees
  TriangleComplex complex(position, pds::Parallel(2));
  const std::vector<std::uint32_t> left_out = complex.start(triangles, smallest_angle);
  EXPECT_FALSE(left_out.empty());
  EXPECT_EQ(complex.faces().size() + left_out.size(), triangles.size());
  for (const std::uint32_t f : left_out) complex.add(triangles[f], smallest_angle);
  EXPECT_GT(complex.faces().size(), vertices / 4);
  complex.remove_pinches();
  const MeshFacts facts = examine(oriented_faces(complex), position);
  EXPECT_EQ(facts.nonmanifold_edges + facts.nonmanifold_vertices + facts.inconsistent_edges + facts.duplicate_faces +
                facts.degenerate_faces + facts.folded_edges,
            0U);
}

/** A twin that never saw the trials must be indistinguishable. */
TEST_P(TriangleSoup, ForgetsAnUndoneTrial)
{
  Random random(GetParam());
  constexpr std::uint32_t vertices = 12;
  Points position;
  for (std::size_t i = 0; i < vertices; ++i) position.push_back(random.in_box(1));
  const auto random_triangle = [&random] {
    const auto corner = [&random] { return static_cast<std::uint32_t>(random.below(vertices)); };
    return Triangle{corner(), corner(), corner()};
  };
  TriangleComplex complex(position);
  TriangleComplex twin(position);
  for (int trial = 0; trial < 8; ++trial) {
    complex.begin_trial();
    std::size_t tried = 0;
    for (int i = 0; i < 100; ++i) tried += complex.add(random_triangle(), any_angle) == Verdict::legal ? 1 : 0;
    if (trial == 0) {
      EXPECT_GT(tried, 3U);
    }
    complex.undo_trial();
    for (int i = 0; i < 25; ++i) {
      const Triangle t = random_triangle();
      ASSERT_EQ(complex.add(t, any_angle), twin.add(t, any_angle));
    }
    ASSERT_EQ(complex.faces(), twin.faces());
    for (const std::uint32_t f : twin.faces()) ASSERT_EQ(complex.oriented(f), twin.oriented(f));
    for (std::uint32_t a = 0; a < vertices; ++a)
      for (std::uint32_t b = 0; b < a; ++b)
        for (std::uint32_t c = 0; c < b; ++c)
          ASSERT_EQ(complex.judge({a, b, c}, any_angle), twin.judge({a, b, c}, any_angle));
  }
}

}  // namespace
}  // namespace pds_test
