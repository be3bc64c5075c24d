// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/geodesic_disk.h>
#include <pcl_pds_recon/geodesic_voronoi.h>

#include <algorithm>
#include <tuple>

#include "core_testing.h"

namespace pds_test
{
namespace
{

using pds::NearestSeeds;
using pds::PoissonDiskSampling;

constexpr double rounding = 1e-5;  // relative, of single-precision distances

/** \brief A cloud with a metric, sampled, and for each point its distances from all seeds that reach it, ascending. */
class SamplingTest : public testing::TestWithParam<double>
{
 protected:
  struct FromSeed
  {
    float distance;
    std::uint32_t seed;
    bool operator<(const FromSeed& other) const
    {
      return std::tie(distance, seed) < std::tie(other.distance, other.seed);
    }
  };

  SamplingTest() : stages_(joined(torus(12000), cube(6000)))
  {
    weights_ = pds::curvature_weights(stages_.surface, stages_.graph, GetParam(), {}, stages_.parallel);
    EXPECT_EQ(weights_.uniform(), GetParam() == 0);
    sampling_ = sample(0, 2);
  }

  [[nodiscard]] PoissonDiskSampling sample(std::uint64_t seed, unsigned threads) const
  {
    return stages_.sample(3.0, weights_, seed, threads);
  }

  /** \brief Disks of all seeds, grown afresh to the reach. */
  [[nodiscard]] std::vector<std::vector<FromSeed>> grow_all(const PoissonDiskSampling& sampling) const
  {
    std::vector<std::vector<FromSeed>> from(stages_.points.size());
    WholeCloudDisk disk(stages_, weights_);
    const auto reach = static_cast<float>(pds::disk_reach * sampling.radius);
    for (std::uint32_t s = 0; s < sampling.seeds.size(); ++s)
      for (const auto& r : disk.grow(sampling.seeds[s], reach)) from[r.point].push_back({r.distance, s});
    for (auto& row : from) std::sort(row.begin(), row.end());
    return from;
  }

  /** \brief How many points may have a distance of their own: measured from the point instead of from the seed it
   * differs a little, and a dart whose own disk shows a seed within the radius keeps the distance it found. */
  static std::size_t few(std::size_t points) { return points / 200; }

  void expect_poisson_disks(const PoissonDiskSampling& sampling) const
  {
    const auto from = grow_all(sampling);
    EXPECT_TRUE(std::is_sorted(sampling.seeds.begin(), sampling.seeds.end()));
    for (const std::uint32_t point : sampling.seeds) {
      EXPECT_EQ(from[point].front().distance, 0.0F);
      if (from[point].size() > 1) {
        EXPECT_GT(static_cast<double>(from[point][1].distance), sampling.radius * (1 - rounding));
      }
    }
    std::size_t covered_backwards = 0;
    for (std::size_t i = 0; i < from.size(); ++i) {
      const float nearest = sampling.nearest[i].distance[0];
      EXPECT_LE(static_cast<double>(nearest), sampling.radius * (1 + rounding));
      if (static_cast<double>(from[i].front().distance) > sampling.radius) ++covered_backwards;
    }
    EXPECT_LE(covered_backwards, few(from.size()));
  }

  Stages stages_;
  pds::EdgeWeights weights_;
  PoissonDiskSampling sampling_;
};

INSTANTIATE_TEST_SUITE_P(Metrics, SamplingTest, testing::Values(0.0, 0.25), [](const auto& test) {
  return test.param == 0 ? "uniform" : "adaptive";
});

TEST_P(SamplingTest, KeepsSeedsApartAndCoversAllPoints) { expect_poisson_disks(sampling_); }

TEST_P(SamplingTest, GivesTheSameForAnyNumberOfThreads)
{
  for (const unsigned threads : {1U, 3U, 8U}) {
    const PoissonDiskSampling other = sample(0, threads);
    EXPECT_EQ(other.seeds, sampling_.seeds);
    for (std::size_t i = 0; i < other.nearest.size(); ++i) {
      EXPECT_EQ(other.nearest[i].seed, sampling_.nearest[i].seed);
      EXPECT_EQ(other.nearest[i].distance, sampling_.nearest[i].distance);
    }
  }
}

TEST_P(SamplingTest, GivesAnotherSetForAnotherSeed)
{
  const PoissonDiskSampling other = sample(1, 2);
  EXPECT_NE(other.seeds, sampling_.seeds);
  EXPECT_NEAR(static_cast<double>(other.seeds.size()), static_cast<double>(sampling_.seeds.size()),
              0.05 * static_cast<double>(sampling_.seeds.size()));
  expect_poisson_disks(other);
}

/** \brief Radii of the points' own, between that which seeds keep and a greater one: their number is in between, too.
 */
TEST_P(SamplingTest, DrawnRadiiAreWithinTheirSpread)
{
  constexpr double spread = 0.2;
  const auto sample = [this](double factor, const pds::SteadyCount& steady, unsigned threads = 2) {
    return stages_.sample(factor, weights_, 0, threads, steady);
  };
  const PoissonDiskSampling drawn = sample(3.0, {spread, 0});
  const PoissonDiskSampling greatest = sample(3.0 * (1 + spread), {});
  EXPECT_LT(drawn.seeds.size(), 0.95 * static_cast<double>(sampling_.seeds.size()));
  EXPECT_GT(drawn.seeds.size(), 1.05 * static_cast<double>(greatest.seeds.size()));
  const auto from = grow_all(drawn);
  for (const std::uint32_t point : drawn.seeds)
    if (from[point].size() > 1) {
      EXPECT_GT(static_cast<double>(from[point][1].distance), drawn.radius * (1 - rounding));
    }
  for (const NearestSeeds& nearest : drawn.nearest)
    EXPECT_LE(static_cast<double>(nearest.distance[0]), (1 + spread) * drawn.radius * (1 + rounding));
  for (const unsigned threads : {1U, 8U}) EXPECT_EQ(sample(3.0, {spread, 0}, threads).seeds, drawn.seeds);
}

TEST_P(SamplingTest, CellsOfAGreaterRadiusWillDo)
{
  const pds::SteadyCount steady{0, 1.5 * sampling_.radius};
  const PoissonDiskSampling other = stages_.sample(3.0, weights_, 0, 2, steady);
  EXPECT_NE(other.seeds, sampling_.seeds);
  expect_poisson_disks(other);
  for (const unsigned threads : {1U, 8U})
    EXPECT_EQ(stages_.sample(3.0, weights_, 0, threads, steady).seeds, other.seeds);
}

TEST_P(SamplingTest, NamesNoSeedTwiceForAPoint)
{
  std::size_t twice = 0;
  for (const NearestSeeds& nearest : sampling_.nearest)
    for (std::size_t a = 0; a < NearestSeeds::capacity; ++a)
      for (std::size_t b = 0; b < a; ++b)
        if (nearest.seed[a] != NearestSeeds::none && nearest.seed[a] == nearest.seed[b]) ++twice;
  EXPECT_EQ(twice, 0U);
}

TEST_P(SamplingTest, FindsTheNearestSeeds)
{
  const auto from = grow_all(sampling_);
  std::size_t nearer = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    bool all_equal = true;
    for (std::size_t s = 0; s < std::min(from[i].size(), NearestSeeds::capacity); ++s) {
      ASSERT_LE(sampling_.nearest[i].distance[s], from[i][s].distance) << "point " << i << ", seed " << s;
      all_equal = all_equal && sampling_.nearest[i].distance[s] == from[i][s].distance;
    }
    nearer += all_equal ? 0 : 1;
  }
  EXPECT_LE(nearer, few(from.size()));
}

TEST_P(SamplingTest, VoronoiCellsAreAPartition)
{
  const pds::GeodesicVoronoi voronoi =
      pds::build_geodesic_voronoi(stages_.points, stages_.graph, weights_, sampling_, 0.1, stages_.parallel);
  ASSERT_EQ(voronoi.cell_begin.size(), sampling_.seeds.size() + 1);
  ASSERT_EQ(voronoi.cell_begin.back(), stages_.points.size());
  pds::PointArray<std::uint32_t> all = voronoi.cell_point;
  for (std::size_t s = 0; s < sampling_.seeds.size(); ++s) {
    const auto begin = voronoi.cell_point.begin() + static_cast<std::ptrdiff_t>(voronoi.cell_begin[s]);
    const auto end = voronoi.cell_point.begin() + static_cast<std::ptrdiff_t>(voronoi.cell_begin[s + 1]);
    EXPECT_TRUE(std::is_sorted(begin, end));
    EXPECT_TRUE(std::binary_search(begin, end, sampling_.seeds[s])) << "a seed is in its own cell";
    for (auto p = begin; p != end; ++p) EXPECT_EQ(sampling_.nearest[*p].seed[0], s);
  }
  std::sort(all.begin(), all.end());
  EXPECT_EQ(std::adjacent_find(all.begin(), all.end()), all.end());
}

TEST_P(SamplingTest, WitnessesLieBetweenTheirTwoNearestSeeds)
{
  const auto from = grow_all(sampling_);
  for (const double threshold : {0.1, 0.3}) {
    const pds::GeodesicVoronoi voronoi =
        pds::build_geodesic_voronoi(stages_.points, stages_.graph, weights_, sampling_, threshold, stages_.parallel);
    std::size_t witnesses = 0;
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < from.size(); ++i) {
      const bool between = from[i].size() > 1 && from[i][1].distance <= static_cast<float>(sampling_.radius) &&
                           from[i][1].distance - from[i][0].distance < static_cast<float>(threshold * sampling_.radius);
      wrong += (voronoi.witness[i] != 0) == between ? 0 : 1;
      witnesses += between ? 1 : 0;
    }
    EXPECT_GT(witnesses, 100U);
    EXPECT_LE(wrong, few(from.size()));
  }
}

TEST_P(SamplingTest, PairsAndTriplesAreOrderedAndDistinct)
{
  const pds::GeodesicVoronoi voronoi =
      pds::build_geodesic_voronoi(stages_.points, stages_.graph, weights_, sampling_, 0.1, stages_.parallel);
  const auto pair_key = [](const pds::SeedPair& p) { return std::make_tuple(p.a, p.b); };
  const auto triple_key = [](const pds::SeedTriple& t) { return std::make_tuple(t.a, t.b, t.c); };
  for (std::size_t i = 0; i < voronoi.pairs.size(); ++i) {
    const pds::SeedPair& p = voronoi.pairs[i];
    EXPECT_LT(p.a, p.b);
    EXPECT_LT(p.b, sampling_.seeds.size());
    EXPECT_GE(static_cast<double>(p.path), sampling_.radius * (1 - 0.05)) << "seeds are about a radius apart";
    if (i > 0) {
      EXPECT_LT(pair_key(voronoi.pairs[i - 1]), pair_key(p));
    }
  }
  std::size_t repeated = 0;
  for (std::size_t i = 0; i < voronoi.triples.size(); ++i) {
    const pds::SeedTriple& t = voronoi.triples[i];
    repeated += t.a < t.b && t.b < t.c ? 0 : 1;
    EXPECT_GE(t.votes, 1U);
    if (i > 0) {
      EXPECT_LT(triple_key(voronoi.triples[i - 1]), triple_key(t));
    }
  }
  EXPECT_EQ(repeated, 0U) << "triples of three different seeds, ascending";
}

TEST_P(SamplingTest, VoronoiDiagramDoesNotDependOnThreads)
{
  const auto build = [this](unsigned threads) {
    return pds::build_geodesic_voronoi(stages_.points, stages_.graph, weights_, sampling_, 0.1, pds::Parallel(threads));
  };
  const pds::GeodesicVoronoi one = build(1);
  for (const unsigned threads : {2U, 3U, 8U}) {
    const pds::GeodesicVoronoi other = build(threads);
    ASSERT_EQ(other.pairs.size(), one.pairs.size());
    ASSERT_EQ(other.triples.size(), one.triples.size());
    for (std::size_t i = 0; i < one.pairs.size(); ++i)
      EXPECT_TRUE(other.pairs[i].a == one.pairs[i].a && other.pairs[i].b == one.pairs[i].b &&
                  other.pairs[i].witnesses == one.pairs[i].witnesses && other.pairs[i].path == one.pairs[i].path);
    for (std::size_t i = 0; i < one.triples.size(); ++i) EXPECT_EQ(other.triples[i].votes, one.triples[i].votes);
  }
}

}  // namespace
}  // namespace pds_test
