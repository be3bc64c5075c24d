// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/side_mending.h>

#include <algorithm>

#include "core_testing.h"

/** \brief Faces that are against the sides that the mesh shows. */
namespace pds_test
{
namespace
{

using Eigen::Vector3d;

const std::vector<pds::SeedPair> no_pairs;
const pds::BorderingCells no_borders(no_pairs);

constexpr std::uint32_t side = 20;  // vertices along a side of the grid

std::uint32_t at(std::uint32_t x, std::uint32_t y) { return y * side + x; }

/** \brief A flat grid a unit wide, of cells that lie flat. */
struct Grid
{
  Grid()
  {
    for (std::uint32_t y = 0; y < side; ++y)
      for (std::uint32_t x = 0; x < side; ++x) seeds.position.emplace_back(x, y, 0);
    seeds.normal.assign(seeds.position.size(), Vector3d::UnitZ());
    for (std::size_t v = 0; v < seeds.normal.size(); v += 2) seeds.normal[v] *= -1;  // of arbitrary sign
    seeds.curvature.assign(seeds.position.size(), 0);
  }

  [[nodiscard]] pds::TriangleComplex complex() const
  {
    pds::TriangleComplex filled(seeds.position);
    for (std::uint32_t y = 0; y + 1 < side; ++y)
      for (std::uint32_t x = 0; x + 1 < side; ++x) {
        filled.add({at(x, y), at(x + 1, y), at(x + 1, y + 1)}, 0.0);
        filled.add({at(x, y), at(x + 1, y + 1), at(x, y + 1)}, 0.0);
      }
    return filled;
  }

  pds::SeedGeometry seeds;
};

/** \brief A grid with a vertex that noise has brought over the next ones. */
Grid grid_with_a_stray_vertex()
{
  Grid grid;
  grid.seeds.position[at(9, 9)] = {10.7, 9.4, 0.3};
  return grid;
}

Triangles faces_of(const pds::TriangleComplex& complex)
{
  Triangles triangles;
  for (const std::uint32_t f : complex.faces()) triangles.push_back(complex.oriented(f));
  for (pds::Triangle& t : triangles) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

std::size_t faces_turned_down(const pds::TriangleComplex& complex)
{
  const Points& p = complex.position();
  const Triangles all = faces_of(complex);
  const auto down = std::count_if(all.begin(), all.end(), [&](const pds::Triangle& t) {
    return (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).z() < 0;
  });
  return std::min(static_cast<std::size_t>(down), all.size() - static_cast<std::size_t>(down));
}

TEST(SideMending, PutsFacesOnTheSideOfThoseAround)
{
  const Grid grid = grid_with_a_stray_vertex();
  pds::TriangleComplex complex = grid.complex();
  ASSERT_EQ(faces_turned_down(complex), 2U);

  EXPECT_EQ(pds::mend_sides(complex, grid.seeds, no_borders, {}), 2U);
  EXPECT_EQ(faces_turned_down(complex), 0U);
  const MeshFacts facts = examine(faces_of(complex), complex.position());
  EXPECT_EQ(facts.boundary_loops, 1U);
  EXPECT_EQ(facts.euler(), 1);
  EXPECT_EQ(facts.nonmanifold_edges + facts.nonmanifold_vertices + facts.inconsistent_edges, 0U);
}

TEST(SideMending, PutsBackWhatNothingReplaces)
{
  const Grid grid = grid_with_a_stray_vertex();
  pds::TriangleComplex complex = grid.complex();
  const Triangles before = faces_of(complex);
  pds::FillLimits limits;
  limits.perimeter = 0.1;
  limits.smallest_angle = 0.01;  // those that come back fold
  EXPECT_EQ(pds::mend_sides(complex, grid.seeds, no_borders, limits), 2U);
  EXPECT_EQ(faces_of(complex), before);
}

TEST(SideMending, BelievesNoCellThatStandsOnItsFaces)
{
  Grid grid = grid_with_a_stray_vertex();
  grid.seeds.normal.assign(grid.seeds.normal.size(), Vector3d::UnitX());
  pds::TriangleComplex complex = grid.complex();
  const Triangles before = faces_of(complex);
  EXPECT_EQ(pds::mend_sides(complex, grid.seeds, no_borders, {}), 0U);
  EXPECT_EQ(faces_of(complex), before);
}

}  // namespace
}  // namespace pds_test
