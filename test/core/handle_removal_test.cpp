// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/handle_removal.h>

#include "core_testing.h"

namespace pds_test
{
namespace
{

using pds::TriangleComplex;

const std::vector<pds::SeedPair> no_pairs;
const pds::BorderingCells no_borders(no_pairs);

/** \brief A torus of so many vertices around the tube and along it, a unit apart around. */
struct TorusGrid
{
  TorusGrid(std::uint32_t around, std::uint32_t along) : around_(around), along_(along)
  {
    const double tube = 1 / (2 * std::sin(pi / around));
    const double axis = along / (2 * pi);
    for (std::uint32_t i = 0; i < along; ++i)
      for (std::uint32_t j = 0; j < around; ++j) {
        const double u = 2 * pi * i / along;
        const double v = 2 * pi * j / around;
        const double r = axis + tube * std::cos(v);
        position.emplace_back(r * std::cos(u), r * std::sin(u), tube * std::sin(v));
      }
  }

  void fill(TriangleComplex& complex) const
  {
    for (std::uint32_t i = 0; i < along_; ++i)
      for (std::uint32_t j = 0; j < around_; ++j) {
        const auto at = [this](std::uint32_t s, std::uint32_t t) { return s % along_ * around_ + t % around_; };
        EXPECT_EQ(complex.add({at(i, j), at(i + 1, j), at(i + 1, j + 1)}, 0.7), TriangleComplex::Verdict::legal);
        EXPECT_EQ(complex.add({at(i, j), at(i + 1, j + 1), at(i, j + 1)}, 0.7), TriangleComplex::Verdict::legal);
      }
  }

  Points position;

 private:
  std::uint32_t around_, along_;
};

MeshFacts examine_complex(const TriangleComplex& complex)
{
  Triangles triangles;
  for (const std::uint32_t f : complex.faces()) triangles.push_back(complex.oriented(f));
  return examine(triangles, complex.position());
}

TEST(HandleRemoval, CutsATubeOfSixEdgesAndNoWiderOne)
{
  for (const std::uint32_t around : {4U, 6U, 7U}) {
    const TorusGrid torus(around, 60);
    TriangleComplex complex(torus.position);
    torus.fill(complex);
    EXPECT_EQ(pds::remove_small_handles(complex, no_borders, {}), around <= 6 ? 1U : 0U);
    const MeshFacts facts = examine_complex(complex);
    EXPECT_EQ(facts.euler(), around <= 6 ? 2 : 0) << around;
    EXPECT_EQ(facts.boundary_loops, 0U);
    EXPECT_EQ(facts.components, 1U);
    EXPECT_EQ(facts.nonmanifold_edges + facts.nonmanifold_vertices + facts.inconsistent_edges + facts.folded_edges, 0U);
  }
}

TEST(HandleRemoval, TakesHolesForNoHandles)
{
  const TorusGrid torus(6, 60);
  TriangleComplex complex(torus.position);
  torus.fill(complex);
  // An open tube: its ends are holes, and a loop around it divides it.
  for (const std::uint32_t v : {0U, 1U, 2U, 3U, 4U, 5U}) {
    std::vector<std::uint32_t> around;
    for (const std::uint32_t f : complex.faces_at(v)) around.push_back(f);
    for (const std::uint32_t f : around) complex.remove(f);
  }
  EXPECT_EQ(pds::remove_small_handles(complex, no_borders, {}), 0U);
  EXPECT_EQ(examine_complex(complex).boundary_loops, 2U);
}

}  // namespace
}  // namespace pds_test
