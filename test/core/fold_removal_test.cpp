// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/fold_removal.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core_testing.h"

namespace pds_test
{
namespace
{

using Eigen::Vector3d;
using pds::TriangleComplex;

const std::vector<pds::SeedPair> no_pairs;
const pds::BorderingCells no_borders(no_pairs);

constexpr std::uint32_t side = 20;  // vertices along a side of the grid

std::uint32_t at(std::uint32_t x, std::uint32_t y) { return y * side + x; }

/** \brief A flat grid a unit wide, and vertices for what is put on it. */
Points grid_and(const Points& more)
{
  Points position;
  for (std::uint32_t y = 0; y < side; ++y)
    for (std::uint32_t x = 0; x < side; ++x) position.emplace_back(x, y, 0);
  position.insert(position.end(), more.begin(), more.end());
  return position;
}

void fill_grid(TriangleComplex& complex)
{
  for (std::uint32_t y = 0; y + 1 < side; ++y)
    for (std::uint32_t x = 0; x + 1 < side; ++x) {
      complex.add({at(x, y), at(x + 1, y), at(x + 1, y + 1)}, 0.7);
      complex.add({at(x, y), at(x + 1, y + 1), at(x, y + 1)}, 0.7);
    }
}

std::uint32_t face_of(const TriangleComplex& complex, std::uint32_t a, std::uint32_t b, std::uint32_t c)
{
  for (const std::uint32_t f : complex.faces_at(a)) {
    const pds::Triangle t = complex.oriented(f);
    if (std::count(t.begin(), t.end(), b) + std::count(t.begin(), t.end(), c) == 2) return f;
  }
  return TriangleComplex::no_face;
}

std::set<std::set<std::uint32_t>> corners_of(const TriangleComplex& complex)
{
  std::set<std::set<std::uint32_t>> faces;
  for (const std::uint32_t f : complex.faces()) {
    const pds::Triangle t = complex.oriented(f);
    faces.emplace(t.begin(), t.end());
  }
  return faces;
}

MeshFacts examine_complex(const TriangleComplex& complex)
{
  Triangles triangles;
  for (const std::uint32_t f : complex.faces()) triangles.push_back(complex.oriented(f));
  return examine(triangles, complex.position());
}

/** \brief Least angle between two faces, degrees. */
double sharpest_angle(const TriangleComplex& complex)
{
  const Points& p = complex.position();
  double largest = -1;
  for (const std::uint32_t f : complex.faces()) {
    const pds::Triangle t = complex.oriented(f);
    for (std::size_t e = 0; e < 3; ++e) {
      const std::uint32_t other = complex.other_face(f, t[e], t[(e + 1) % 3]);
      if (other == TriangleComplex::no_face) continue;
      const pds::Triangle o = complex.oriented(other);
      const std::uint32_t apex = o[0] + o[1] + o[2] - t[e] - t[(e + 1) % 3];
      largest = std::max(largest, TriangleComplex::fold_cosine(p[t[e]], p[t[(e + 1) % 3]], p[t[(e + 2) % 3]], p[apex]));
    }
  }
  return std::acos(largest) * 180 / pi;
}

TEST(FoldRemoval, TurnsAFaceThatIsFoldedOver)
{
  // A vertex within one face, as the mesh has it, leans out over the edge to the next.
  const Points position = grid_and({Vector3d(9.7, 9.4, 0.5)});
  const std::uint32_t leaning = side * side;
  TriangleComplex complex(position);
  fill_grid(complex);
  const std::uint32_t a = at(9, 9);
  const std::uint32_t b = at(10, 10);
  const std::uint32_t c = at(9, 10);
  complex.remove(face_of(complex, a, b, c));
  for (const pds::Triangle& t : {pds::Triangle{a, b, leaning}, {b, c, leaning}, {c, a, leaning}})
    ASSERT_EQ(complex.add(t, 0.0), TriangleComplex::Verdict::legal);
  ASSERT_LT(sharpest_angle(complex), 90);

  EXPECT_EQ(pds::remove_folds(complex, no_borders, {}), 1U);
  EXPECT_GE(sharpest_angle(complex), 100);
  const MeshFacts facts = examine_complex(complex);
  EXPECT_EQ(facts.boundary_loops, 1U);
  EXPECT_EQ(facts.euler(), 1);
  EXPECT_EQ(facts.nonmanifold_edges + facts.nonmanifold_vertices + facts.inconsistent_edges, 0U);
}

TEST(FoldRemoval, DropsAPatchThatHangsOnUpsideDown)
{
  Points over;
  for (std::uint32_t y = 5; y < 9; ++y) over.emplace_back(1, y, 0.5);
  const Points position = grid_and(over);
  TriangleComplex complex(position);
  fill_grid(complex);
  const std::size_t faces = complex.faces().size();
  for (std::uint32_t i = 0; i < 3; ++i) {
    const std::uint32_t patch = side * side + i;
    ASSERT_EQ(complex.add({at(0, 5 + i), at(0, 6 + i), patch}, 0.0), TriangleComplex::Verdict::legal);
    ASSERT_EQ(complex.add({at(0, 6 + i), patch + 1, patch}, 0.0), TriangleComplex::Verdict::legal);
  }
  EXPECT_EQ(pds::remove_folds(complex, no_borders, {}), 1U);
  EXPECT_EQ(complex.faces().size(), faces);
  EXPECT_EQ(examine_complex(complex).boundary_loops, 1U);
}

/** \brief Faces along the rim of the grid that lean to it by 70 degrees.
 * \param edges of the rim that they hang on by */
Points leaning_patch(std::uint32_t edges)
{
  constexpr double lean = 70 * pi / 180;
  Points outer;
  for (std::uint32_t y = 5; y <= 5 + edges; ++y) outer.emplace_back(-std::cos(lean), y, std::sin(lean));
  return outer;
}

std::size_t faces_left_of_patch(std::uint32_t edges)
{
  const Points position = grid_and(leaning_patch(edges));
  TriangleComplex complex(position);
  fill_grid(complex);
  const std::size_t faces = complex.faces().size();
  for (std::uint32_t i = 0; i < edges; ++i) {
    const std::uint32_t outer = side * side + i;
    EXPECT_EQ(complex.add({at(0, 5 + i), at(0, 6 + i), outer}, 0.0), TriangleComplex::Verdict::legal);
    EXPECT_EQ(complex.add({at(0, 6 + i), outer + 1, outer}, 0.0), TriangleComplex::Verdict::legal);
  }
  pds::remove_folds(complex, no_borders, {});
  return complex.faces().size() - faces;
}

TEST(FoldRemoval, DropsAPatchThatOneEdgeHolds)
{
  EXPECT_EQ(faces_left_of_patch(1), 0U);
  EXPECT_EQ(faces_left_of_patch(3), 6U);
}

TEST(FoldRemoval, PutsBackWhatItCannotMend)
{
  const Points position = grid_and({Vector3d(9.7, 9.4, 0.5)});
  TriangleComplex complex(position);
  fill_grid(complex);
  const std::uint32_t leaning = side * side;
  complex.remove(face_of(complex, at(9, 9), at(10, 10), at(9, 10)));
  complex.add({at(9, 9), at(10, 10), leaning}, 0.0);
  complex.add({at(10, 10), at(9, 10), leaning}, 0.0);
  complex.add({at(9, 10), at(9, 9), leaning}, 0.0);
  const auto before = corners_of(complex);
  pds::FillLimits nothing;
  nothing.area = 0;
  EXPECT_EQ(pds::remove_folds(complex, no_borders, nothing), 0U);
  EXPECT_EQ(corners_of(complex), before);
}

TEST(FoldRemoval, KeepsWhatIsLargerThanASpeckOrByItself)
{
  // A wall five wide and four high on the rim, leaning back over the grid, and a tetrahedron.
  constexpr std::uint32_t wide = 5;
  constexpr std::uint32_t high = 4;
  Points more;
  for (std::uint32_t row = 1; row <= high; ++row)
    for (std::uint32_t i = 0; i <= wide; ++i) more.emplace_back(0.5 * row, 5 + i, row);
  for (const Vector3d& corner : {Vector3d(0, 0, 9), Vector3d(1, 0, 9), Vector3d(0, 1, 9), Vector3d(0, 0, 10)})
    more.push_back(corner);
  const Points position = grid_and(more);
  TriangleComplex complex(position);
  fill_grid(complex);
  const auto wall = [](std::uint32_t row, std::uint32_t i) {
    return row == 0 ? at(0, 5 + i) : side * side + (row - 1) * (wide + 1) + i;
  };
  for (std::uint32_t row = 0; row < high; ++row)
    for (std::uint32_t i = 0; i < wide; ++i) {
      ASSERT_EQ(complex.add({wall(row, i), wall(row, i + 1), wall(row + 1, i)}, 0.0), TriangleComplex::Verdict::legal);
      ASSERT_EQ(complex.add({wall(row, i + 1), wall(row + 1, i + 1), wall(row + 1, i)}, 0.0),
                TriangleComplex::Verdict::legal);
    }
  const auto v = static_cast<std::uint32_t>(position.size()) - 4;
  for (const pds::Triangle& t :
       {pds::Triangle{v, v + 2, v + 1}, {v, v + 1, v + 3}, {v + 1, v + 2, v + 3}, {v + 2, v, v + 3}})
    ASSERT_EQ(complex.add(t, 0.0), TriangleComplex::Verdict::legal);
  ASSERT_LT(sharpest_angle(complex), 80);
  const auto faces = corners_of(complex);
  EXPECT_EQ(pds::remove_folds(complex, no_borders, {}), 0U);
  EXPECT_EQ(corners_of(complex), faces);
}

}  // namespace
}  // namespace pds_test
