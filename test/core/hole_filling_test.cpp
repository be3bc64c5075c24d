// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/hole_filling.h>

#include <algorithm>

#include "core_testing.h"

namespace pds_test
{
namespace
{

using pds::FillLimits;
using pds::TriangleComplex;

const std::vector<pds::SeedPair> no_pairs;
const pds::BorderingCells no_borders(no_pairs);

/** \brief Three concentric rings of vertices in the plane, triangulated, and the hole within the innermost. */
struct Annulus
{
  /** \param width of each of the two bands */
  explicit Annulus(std::uint32_t corners, double width = 1) : corners_(corners)
  {
    for (const double ring : {1.0, 2.0, 3.0})
      for (std::uint32_t i = 0; i < corners; ++i) {
        const double angle = 2 * pi * (i + 0.5 * ring) / corners;
        const double radius = (1.0 / (2 * std::sin(pi / corners))) + (ring - 1) * width;  // sides of length 1
        seeds.position.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
      }
    seeds.normal.assign(seeds.position.size(), Eigen::Vector3d::UnitZ());
    seeds.curvature.assign(seeds.position.size(), 0.0);
  }

  void fill(TriangleComplex& complex) const
  {
    for (std::uint32_t ring = 0; ring < 2; ++ring)
      for (std::uint32_t i = 0; i < corners_; ++i) {
        const std::uint32_t inner = ring * corners_ + i;
        const std::uint32_t inner_next = ring * corners_ + (i + 1) % corners_;
        const std::uint32_t outer = inner + corners_;
        const std::uint32_t outer_next = inner_next + corners_;
        EXPECT_EQ(complex.add({inner, outer, inner_next}, 0.7), TriangleComplex::Verdict::legal);
        EXPECT_EQ(complex.add({inner_next, outer, outer_next}, 0.7), TriangleComplex::Verdict::legal);
      }
  }

  pds::SeedGeometry seeds;

 private:
  std::uint32_t corners_;
};

MeshFacts examine_complex(const TriangleComplex& complex)
{
  Triangles triangles;
  for (const std::uint32_t f : complex.faces()) triangles.push_back(complex.oriented(f));
  return examine(triangles, complex.position());
}

TEST(HoleFilling, FindsBoundaryLoopsWithTheHoleOnTheLeft)
{
  const Annulus annulus(6);
  TriangleComplex complex(annulus.seeds.position);
  annulus.fill(complex);
  const auto loops = pds::boundary_loops(complex);
  ASSERT_EQ(loops.size(), 2U);
  for (const pds::Polygon& loop : loops) {
    EXPECT_EQ(loop.size(), 6U);
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::uint32_t from = loop[i];
      const std::uint32_t to = loop[(i + 1) % loop.size()];
      ASSERT_EQ(complex.face_count(from, to), 1);
      std::size_t against = 0;  // the face on the other side runs the edge in the other direction
      for (const std::uint32_t f : complex.faces_at(from)) {
        const pds::Triangle t = complex.oriented(f);
        for (std::size_t e = 0; e < 3; ++e) against += t[e] == to && t[(e + 1) % 3] == from ? 1 : 0;
      }
      EXPECT_EQ(against, 1U);
    }
  }
}

TEST(HoleFilling, FillsTheHoleThatAHubLeft)
{
  for (const std::uint32_t corners : {4U, 5U, 6U}) {
    const Annulus annulus(corners);
    TriangleComplex complex(annulus.seeds.position);
    annulus.fill(complex);
    FillLimits limits;
    limits.perimeter = corners + 0.01;  // the hole, and not the rim
    pds::fill_holes(complex, annulus.seeds, no_borders, {}, limits);
    const MeshFacts facts = examine_complex(complex);
    EXPECT_EQ(facts.boundary_loops, 1U) << corners;
    EXPECT_EQ(facts.faces, 4 * corners + corners - 2) << corners;
    EXPECT_EQ(facts.nonmanifold_edges + facts.nonmanifold_vertices + facts.inconsistent_edges + facts.folded_edges, 0U);
  }
}

TEST(HoleFilling, LeavesAHoleThatIsTooLong)
{
  const Annulus annulus(6);
  TriangleComplex complex(annulus.seeds.position);
  annulus.fill(complex);
  FillLimits limits;
  limits.perimeter = 5.99;
  EXPECT_EQ(pds::fill_holes(complex, annulus.seeds, no_borders, {}, limits), 0U);
  EXPECT_EQ(examine_complex(complex).boundary_loops, 2U);
}

TEST(HoleFilling, FillsAnyHoleAcrossWhichCellsBorder)
{
  const Annulus annulus(6);
  FillLimits limits;
  limits.perimeter = 5.5;
  // Chords of the hole 0 ... 5: the first set triangulates it, the second halves it into parts of perimeter 5, the
  // third leaves a part of perimeter 5.7.
  const std::vector<pds::SeedPair> all{{0, 2, 1, 2}, {0, 3, 1, 2}, {0, 4, 1, 2}};
  const std::vector<pds::SeedPair> halving{{0, 3, 1, 2}};
  const std::vector<pds::SeedPair> too_few{{0, 2, 1, 2}};
  for (const auto& [pairs, loops] : {std::pair(all, 1U), std::pair(halving, 1U), std::pair(too_few, 2U)}) {
    TriangleComplex complex(annulus.seeds.position);
    annulus.fill(complex);
    pds::fill_holes(complex, annulus.seeds, pds::BorderingCells(pairs), {}, limits);
    EXPECT_EQ(examine_complex(complex).boundary_loops, loops);
  }
}

TEST(HoleFilling, ClosesTearsOfAnyLength)
{
  const Annulus annulus(8);
  FillLimits limits;
  limits.perimeter = 5;  // even two halves of the hole are longer
  const std::vector<pds::SeedPair> at_six_corners{{0, 3, 1, 2}, {1, 4, 1, 2}, {2, 6, 1, 2}};
  const std::vector<pds::SeedPair> at_three{{0, 3, 1, 2}, {0, 4, 1, 2}};
  for (const auto& [pairs, loops] : {std::pair(at_six_corners, 1U), std::pair(at_three, 2U)}) {
    TriangleComplex complex(annulus.seeds.position);
    annulus.fill(complex);
    EXPECT_EQ(pds::fill_holes(complex, annulus.seeds, pds::BorderingCells(pairs), {}, limits), 2 - loops);
    EXPECT_EQ(examine_complex(complex).boundary_loops, loops);
  }
}

TEST(HoleFilling, FillsGapsThatAreSmallBesideTheirComponent)
{
  struct Case
  {
    std::uint32_t corners;  // and perimeter
    double width;
    std::size_t loops;
  };
  // A hole of 18 sides has an area of 26 squared radii. The plate around it has 600 times that, or 300 times; a hole of
  // 24 sides has 46, more than a circle of one and a half times 15 around.
  for (const Case& c : {Case{18, 36, 1}, Case{18, 25, 2}, Case{24, 60, 2}}) {
    const Annulus annulus(c.corners, c.width);
    TriangleComplex complex(annulus.seeds.position);
    annulus.fill(complex);
    EXPECT_EQ(pds::fill_holes(complex, annulus.seeds, no_borders, {}, {}), 0U) << "longer than the limit";
    EXPECT_EQ(pds::fill_gaps(complex, annulus.seeds, no_borders, {}), 2 - c.loops);
    EXPECT_EQ(examine_complex(complex).boundary_loops, c.loops) << c.corners << " corners, width " << c.width;
  }
}

TEST(HoleFilling, KeepsToTheSideThatTheNormalsTell)
{
  const std::vector<Eigen::Vector3d> corners{{-1, 0, 0}, {0, -1, 0}, {1, 0, 0}, {0, 1, 0}};
  std::vector<Eigen::Vector3d> outward(corners.size(), Eigen::Vector3d::UnitZ());
  outward[2] = {std::sqrt(1 - 0.04), 0, -0.2};  // 102 degrees off the square
  FillLimits limits;
  for (const double facing : {-0.25, -0.15}) {
    TriangleComplex complex(corners, pds::Parallel(1), outward);
    limits.facing = facing;
    EXPECT_EQ(pds::fill_polygon(complex, no_borders, {0, 1, 2, 3}, limits), facing < -0.2);
  }
}

TEST(HoleFilling, KnowsWhichCellsBorder)
{
  const std::vector<pds::SeedPair> pairs{{0, 2, 1, 1}, {0, 5, 1, 1}, {3, 4, 1, 1}};
  const pds::BorderingCells bordering(pairs);
  EXPECT_TRUE(bordering(0, 5));
  EXPECT_TRUE(bordering(4, 3));
  EXPECT_FALSE(bordering(2, 3));
  EXPECT_FALSE(bordering(4, 5));
}

TEST(HoleFilling, FillsNothingIfTheLimitIsZero)
{
  const Annulus annulus(4);
  TriangleComplex complex(annulus.seeds.position);
  annulus.fill(complex);
  FillLimits limits;
  limits.perimeter = 0;
  EXPECT_EQ(pds::fill_holes(complex, annulus.seeds, no_borders, {{0, 1, 2, 3}}, limits), 0U);
  EXPECT_EQ(examine_complex(complex).boundary_loops, 2U);
}

TEST(HoleFilling, ChoosesTheDelaunayDiagonal)
{
  // A rhombus: its short diagonal has the smaller circumcircles.
  pds::SeedGeometry seeds;
  seeds.position = {{-1, 0, 0}, {0, -0.6, 0}, {1, 0, 0}, {0, 0.6, 0}};
  seeds.normal.assign(4, Eigen::Vector3d::UnitZ());
  TriangleComplex complex(seeds.position);
  EXPECT_TRUE(pds::fill_polygon(complex, no_borders, {0, 1, 2, 3}, {}));
  EXPECT_TRUE(complex.has_edge(1, 3));
  EXPECT_FALSE(complex.has_edge(0, 2));
}

TEST(HoleFilling, LeavesTheComplexAsItWasIfAPolygonCannotBeFilled)
{
  const Annulus annulus(6);
  TriangleComplex complex(annulus.seeds.position);
  annulus.fill(complex);
  const std::vector<std::uint32_t> before = complex.faces();
  FillLimits limits;
  limits.chord = 0.5;  // shorter than any chord of the hole
  EXPECT_FALSE(pds::fill_polygon(complex, no_borders, {0, 5, 4, 3, 2, 1}, limits));
  EXPECT_EQ(complex.faces(), before);
  EXPECT_FALSE(pds::fill_polygon(complex, no_borders, {0, 1}, limits)) << "no polygon";
}

}  // namespace
}  // namespace pds_test
