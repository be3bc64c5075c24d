// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/edge_weights.h>

#include <algorithm>
#include <cstdio>

#include "core_testing.h"
#include "count_search.h"
#include "lattices.h"

/** \brief The search for a number of seeds, without the mesh. */
namespace pds_test
{
namespace
{

struct Found
{
  pds::PoissonDiskSampling sampling;
  pds::SteadyCount steady;
  int samplings = 0;
};

Found search_for(std::uint64_t wanted, const Stages& stages, std::uint64_t seed)
{
  // k neighbours, at 2/3 of their reach in the mean, and 0.65 seeds on a squared radius.
  const double area =
      static_cast<double>(stages.points.size()) * std::pow(1.5 * stages.graph.sampling_interval, 2) * pi / 15;
  pds::VertexCountSearch search(wanted, std::sqrt(0.65 * area / static_cast<double>(wanted)));
  const pds::EdgeWeights uniform;
  const std::vector<std::uint8_t> no_features(stages.points.size());
  Found found;
  do {
    found.steady = search.steady();
    found.sampling =
        pds::sample_poisson_disks(stages.points, stages.graph, stages.surface, uniform, no_features, search.radius(),
                                  pds::GeodesicSolver::fast_marching, seed, stages.parallel, {}, search.steady());
    ++found.samplings;
  } while (!search.sampled(found.sampling));
  return found;
}

constexpr double rounding = 1e-5;  // relative, of single-precision distances

void expect_found(const Found& found, std::uint64_t wanted, int most_samplings)
{
  const pds::PoissonDiskSampling& sampling = found.sampling;
  EXPECT_LE(std::abs(static_cast<double>(sampling.seeds.size()) - static_cast<double>(wanted)),
            std::max(1.0, 0.0025 * static_cast<double>(wanted)));
  EXPECT_LE(found.samplings, most_samplings);
  for (const std::uint32_t s : sampling.seeds)
    ASSERT_GE(static_cast<double>(sampling.nearest[s].distance[1]), sampling.radius * (1 - rounding));
  for (const pds::NearestSeeds& nearest : sampling.nearest)
    ASSERT_LE(static_cast<double>(nearest.distance[0]), sampling.radius * (1 + rounding));
}

/** \brief Searches for several counts with several seeds, and prints how many samplings that takes. */
void expect_hits(const char* name, const Points& points, int most_samplings)
{
  const Stages stages(points);
  int searches = 0, samplings = 0, most = 0;
  for (const std::uint64_t wanted : {50U, 150U, 400U, 800U, 1000U, 1200U, 1500U})
    for (const std::uint64_t seed : {0U, 1U}) {
      SCOPED_TRACE(testing::Message() << name << ", " << wanted << " seeds, lots " << seed);
      const Found found = search_for(wanted, stages, seed);
      expect_found(found, wanted, most_samplings);
      ++searches;
      samplings += found.samplings;
      most = std::max(most, found.samplings);
    }
  std::printf("%s: %.1f samplings in the mean, %d at most\n", name, 1.0 * samplings / searches, most);
}

TEST(CountSearch, HitsOnLatticesInFewSamplings)
{
  expect_hits("flat grid", flat_grid(130, 120), 12);
  expect_hits("flat grid, turned", turned(flat_grid(130, 120)), 12);
  expect_hits("hexagonal grid", hexagonal_grid(130, 130), 12);
  expect_hits("cube of grids", cube_of_grids(50), 12);
  expect_hits("cube of grids, turned", turned(cube_of_grids(50)), 12);
}

TEST(CountSearch, HitsWhereDistancesAreNearlyEqual)
{
  expect_hits("voxels of a sphere", voxel_sphere(35), 30);
  expect_hits("hills on a grid", hills_on_grid(120, 1e-6), 30);
  expect_hits("hills on a grid, in steps", hills_on_grid(120, 0.5), 30);
}

TEST(CountSearch, LeavesRandomPointsOneRadius)
{
  for (const Points& points : {torus(small_cloud), cube(small_cloud)}) {
    const Stages stages(points);
    for (const std::uint64_t wanted : {50U, 150U, 400U, 800U, 1200U}) {
      const Found found = search_for(wanted, stages, 0);
      EXPECT_EQ(found.steady.spread, 0.0) << wanted;
      EXPECT_EQ(found.steady.radius_of_cells, 0.0) << wanted;
    }
  }
}

}  // namespace
}  // namespace pds_test
