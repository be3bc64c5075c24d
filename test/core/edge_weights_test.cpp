// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Eigenvalues>
#include <array>

#include "core_testing.h"
#include "plane_kernel.h"

namespace pds_test
{
namespace
{

/** \brief The sampling interval in the unit of the input. */
double interval_of(const Stages& stages) { return stages.graph.sampling_interval * stages.points.unit; }

/** \brief Covariance of a point and its own neighbours over the square of its reach. */
Eigen::Matrix3d covariance(const Stages& stages, std::size_t i)
{
  std::vector<Eigen::Vector3d> points{Eigen::Vector3d::Zero()};
  for (const std::uint32_t j : stages.graph.nearest(i))
    points.push_back((stages.points.position[j] - stages.points.position[i]).cast<double>());
  const double reach = points.back().norm();
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (Eigen::Vector3d& p : points) mean += (p /= reach) / static_cast<double>(points.size());
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p : points) sum += (p - mean) * (p - mean).transpose();
  return sum / static_cast<double>(points.size());
}

/** \brief Checks that normals are eigenvectors of the least eigenvalue, also where there are many of them. */
void expect_principal_axes(const Points& input)
{
  const Stages stages(input);
  const pds::SurfaceEstimate surface = pds::estimate_surface(stages.points, stages.graph, stages.parallel);
  for (std::size_t i = 0; i < stages.points.size(); ++i) {
    const Eigen::Matrix3d matrix = covariance(stages, i);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(matrix);
    const double least = std::max(0.0, solver.eigenvalues()[0]);
    const Eigen::Vector3d normal = surface.normal[i].cast<double>();
    constexpr double rounding = 2e-6;  // of single precision, some sums
    const double variation = static_cast<double>(surface.curvature[i]) * static_cast<double>(surface.curvature[i]);
    ASSERT_NEAR(normal.norm(), 1.0, rounding) << "point " << i;
    ASSERT_NEAR(variation, least / matrix.trace(), rounding) << "point " << i;
    ASSERT_NEAR(normal.dot(matrix * normal), least, rounding * matrix.trace()) << "point " << i;
  }
}

TEST(SurfaceEstimate, FindsPrincipalAxes)
{
  for (const Points& input : {torus(3000), cube(3000), saddle(3000), swiss_roll(3000)}) expect_principal_axes(input);
}

TEST(SurfaceEstimate, FindsPrincipalAxesOfScatter)
{
  Random random(4);
  Points input;
  while (input.size() < 3000) input.push_back(random.in_box(1));
  expect_principal_axes(input);
}

TEST(SurfaceEstimate, FindsPrincipalAxesOfLattices)
{
  for (const int layers : {1, 2, 14}) {
    Points input;
    for (int x = 0; x < 14; ++x)
      for (int y = 0; y < 14; ++y)
        for (int z = 0; z < layers; ++z) input.emplace_back(x, y, z);
    expect_principal_axes(input);
  }
}

TEST(SurfaceEstimate, FindsADirectionAcrossALine)
{
  for (const Eigen::Vector3d& direction : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0.3, -0.2, 0.7)}) {
    Points input;
    for (int i = 0; i < 300; ++i) input.push_back(i * direction);
    expect_principal_axes(input);
  }
}

TEST(SurfaceEstimate, FindsPrincipalAxesOfSpecksInAHugeBox)
{
  for (const double size : {1e-12, 1e-20}) {
    Points input = sphere(1000);
    for (Eigen::Vector3d& p : input) p *= size;
    input.emplace_back(1, 0, 0);
    expect_principal_axes(input);
  }
}

TEST(SurfaceEstimate, TellsTheInsideFromTheRim)
{
  Random random(11);
  Points square;
  while (square.size() < 20000) square.emplace_back(random.uniform(), random.uniform(), 0);
  const Stages stages(square);
  const pds::SurfaceEstimate surface = pds::estimate_surface(stages.points, stages.graph, stages.parallel);
  const double interval = interval_of(stages);
  std::size_t inner = 0, inner_inside = 0, rim = 0, rim_inside = 0;
  for (std::size_t i = 0; i < stages.points.size(); ++i) {
    const Eigen::Vector3d& p = square[stages.points.input_index[i]];
    const double from_rim = std::min({p.x(), p.y(), 1 - p.x(), 1 - p.y()});
    inner += from_rim > 3 * interval ? 1 : 0;
    inner_inside += from_rim > 3 * interval ? surface.inside[i] : 0;
    rim += from_rim < 0.2 * interval ? 1 : 0;
    rim_inside += from_rim < 0.2 * interval ? surface.inside[i] : 0;
  }
  EXPECT_GT(static_cast<double>(inner_inside), 0.88 * static_cast<double>(inner)) << "of " << inner;
  EXPECT_LT(static_cast<double>(rim_inside), 0.25 * static_cast<double>(rim)) << "of " << rim;
}

TEST(SurfaceEstimate, HasNoNormalWithoutTwoNeighbors)
{
  const Stages stages({{0, 0, 0}, {1, 0, 0}});
  const pds::SurfaceEstimate surface = pds::estimate_surface(stages.points, stages.graph, stages.parallel);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(surface.normal[i], Eigen::Vector3f(0, 0, 0));
    EXPECT_EQ(surface.curvature[i], 0.0F);
  }
}

TEST(SurfaceEstimate, IsTheSameForEveryInstructionSet)
{
  const Stages stages(joined(cube(5003), saddle(1000)));
  const auto fitted = [&](pds::InstructionSet set) {
    pds::SurfaceEstimate surface;
    surface.normal.resize(stages.points.size());
    surface.curvature.resize(stages.points.size());
    surface.inside.resize(stages.points.size());
    pds::fit_planes(set, stages.points, stages.graph, 0, stages.points.size(), surface);
    return surface;
  };
  const pds::SurfaceEstimate expected = fitted(pds::InstructionSet::baseline);
  for (const pds::InstructionSet set : {pds::InstructionSet::avx2, pds::InstructionSet::avx512}) {
    if (set > pds::best_instruction_set()) continue;
    const pds::SurfaceEstimate surface = fitted(set);
    EXPECT_EQ(surface.normal, expected.normal);
    EXPECT_EQ(surface.curvature, expected.curvature);
    EXPECT_EQ(surface.inside, expected.inside);
  }
}

constexpr double chance_rims = 0.003;  // share of the points inside at which chance leaves gaps that look like rims

std::vector<std::uint8_t> feature_ranks(const Stages& stages)
{
  return pds::feature_ranks(stages.points, stages.surface, stages.graph, stages.parallel);
}

TEST(FeatureRanks, RiseTowardsEdgesAndCorners)
{
  const Points points = cube(50000);
  const Stages stages(points);
  const std::vector<std::uint8_t> ranks = feature_ranks(stages);
  enum Place
  {
    flat,
    beside_edge,
    on_edge,
    at_corner,
    places
  };
  std::array<double, places> sum{};
  std::array<int, places> count{};
  int flat_found = 0;
  for (std::size_t i = 0; i < ranks.size(); ++i) {
    // Distances to the three nearest sides of the cube; a point is on one of them.
    Eigen::Array3d gap = (1 - points[stages.points.input_index[i]].array().abs()) / interval_of(stages);
    std::sort(gap.data(), gap.data() + 3);
    const Place place = gap[1] > 3 ? flat : gap[1] > 0.5 ? beside_edge : gap[2] > 0.5 ? on_edge : at_corner;
    sum[place] += ranks[i];
    ++count[place];
    flat_found += place == flat && ranks[i] >= pds::crease_rank ? 1 : 0;
  }
  for (int place = flat; place < at_corner; ++place)
    EXPECT_LT(1.5 * sum[place] / count[place], sum[place + 1] / count[place + 1]);
  EXPECT_GT(sum[on_edge] / count[on_edge], pds::crease_rank);
  EXPECT_LT(flat_found, chance_rims * count[flat]);
}

TEST(FeatureRanks, AreHighOnRims)
{
  const Points points = plane(20000);
  const Stages stages(points);
  const std::vector<std::uint8_t> ranks = feature_ranks(stages);
  int rim = 0, rim_found = 0, inner = 0, inner_found = 0;
  for (std::size_t i = 0; i < ranks.size(); ++i) {
    const Eigen::Vector3d& p = points[stages.points.input_index[i]];
    const double from_rim = (1 - std::max(std::abs(p.x()), std::abs(p.y()))) / interval_of(stages);
    const int found = ranks[i] >= pds::crease_rank ? 1 : 0;
    rim += from_rim < 0.3 ? 1 : 0;
    rim_found += from_rim < 0.3 ? found : 0;
    inner += from_rim > 3 ? 1 : 0;
    inner_found += from_rim > 3 ? found : 0;
  }
  EXPECT_GT(rim_found, 0.6 * rim);
  EXPECT_LT(inner_found, chance_rims * inner);
}

TEST(FeatureRanks, AreAllTheSameWithoutNeighbors)
{
  const Stages stages({{0, 0, 0}});
  EXPECT_EQ(feature_ranks(stages), std::vector<std::uint8_t>{0});
}

TEST(FeatureRanks, FindHardlyAnyCreasesOrRimsOnSmoothShapes)
{
  for (const Points& points : {sphere(20000), torus(20000)}) {
    const Stages stages(points);
    const std::vector<std::uint8_t> ranks = feature_ranks(stages);
    const auto found = std::count_if(ranks.begin(), ranks.end(), [](int rank) { return rank >= pds::crease_rank; });
    EXPECT_LT(static_cast<double>(found), chance_rims * static_cast<double>(ranks.size()));
  }
}

TEST(MeanWeightedInterval, IsTheMeanOfTheEdgesOfAllRows)
{
  const Stages stages(torus(20000));
  std::vector<float> weight;
  for (std::size_t i = 0; i < stages.points.size(); ++i) weight.push_back(1 + static_cast<float>(i % 5));
  double sum = 0;
  for (std::size_t i = 0; i < stages.points.size(); ++i)
    for (const std::uint32_t j : stages.graph.nearest(i))
      sum += 0.5 * static_cast<double>(weight[i] + weight[j]) *
             static_cast<double>((stages.points.position[i] - stages.points.position[j]).norm());
  const double mean = sum / static_cast<double>(15 * stages.points.size());
  const pds::EdgeWeights weights(weight);
  EXPECT_NEAR(pds::mean_weighted_interval(stages.points, stages.graph, weights, stages.parallel), mean, 1e-6 * mean);
  EXPECT_EQ(pds::mean_weighted_interval(stages.points, stages.graph, weights, pds::Parallel(3)),
            pds::mean_weighted_interval(stages.points, stages.graph, weights, pds::Parallel(1)));
  EXPECT_EQ(pds::mean_weighted_interval(stages.points, stages.graph, {}, stages.parallel),
            stages.graph.sampling_interval);
}

}  // namespace
}  // namespace pds_test
