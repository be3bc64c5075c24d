// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/geodesic_disk.h>

#include <algorithm>
#include <functional>
#include <iostream>

#include "core_testing.h"

namespace pds_test
{
namespace
{

using pds::GeodesicDisk;
using pds::GeodesicSolver;
using Reached = std::vector<GeodesicDisk::Reached>;
using TrueDistance = std::function<double(const Eigen::Vector3d&, const Eigen::Vector3d&)>;

const pds::EdgeWeights uniform_weights;

/** \brief How much longer than a path of edges a distance may be: edges are chords, which cut the surface's bends. At
 * the spacing of these points on the innermost turn of the roll that makes 0.2 percent. */
constexpr float cut_bends = 1.003F;

Reached grown(const Stages& stages,
              std::uint32_t source,
              double limit,
              const pds::EdgeWeights& weights = uniform_weights,
              GeodesicSolver solver = GeodesicSolver::fast_marching)
{
  return WholeCloudDisk(stages, weights, solver).grow(source, static_cast<float>(limit));
}

struct RelativeError
{
  double mean = 0;
  double max = 0;
};

/** \brief Relative error of disks about points that pass the filter, so far from a rim that no geodesic bends there. */
RelativeError measure_error(const Points& input,
                            double radius_in_intervals,
                            const TrueDistance& truth,
                            const std::function<bool(const Eigen::Vector3d&)>& is_source)
{
  const Stages stages(input);
  const double limit = radius_in_intervals * stages.graph.sampling_interval;
  RelativeError error;
  std::size_t count = 0;
  for (std::uint32_t source = 0; source < stages.points.size(); source += 251) {
    const Eigen::Vector3d& from = input[stages.points.input_index[source]];
    if (!is_source(from)) continue;
    for (const GeodesicDisk::Reached& r : grown(stages, source, limit)) {
      if (r.point == source) continue;
      const Eigen::Vector3d& to = input[stages.points.input_index[r.point]];
      const double distance = static_cast<double>(r.distance) * stages.points.unit;
      constexpr double rounding = 1e-6;  // of single-precision coordinates, relative to the cloud
      EXPECT_GE(distance, (to - from).norm() - rounding);
      const double relative = std::abs(distance / truth(from, to) - 1);
      error.mean += relative;
      error.max = std::max(error.max, relative);
      ++count;
    }
  }
  EXPECT_GT(count, 500U);
  error.mean /= static_cast<double>(count);
  return error;
}

void expect_accurate(const std::string& shape,
                     const Points& input,
                     const TrueDistance& truth,
                     const std::function<bool(const Eigen::Vector3d&)>& is_source)
{
  for (const int intervals : {3, 5, 10}) {
    const RelativeError error = measure_error(input, intervals, truth, is_source);
    const std::string name = shape + "_" + std::to_string(intervals) + "_intervals";
    testing::Test::RecordProperty(name + "_mean", std::to_string(error.mean));
    testing::Test::RecordProperty(name + "_max", std::to_string(error.max));
    std::cout << name << ": mean relative error " << error.mean << ", max " << error.max << '\n';
    EXPECT_LE(error.mean, 0.01) << name;
  }
}

TEST(GeodesicDisk, IsAccurateOnThePlane)
{
  expect_accurate(
      "plane", plane(20000), [](const auto& a, const auto& b) { return (a - b).norm(); },
      [](const auto& p) { return std::max(std::abs(p.x()), std::abs(p.y())) < 0.6; });
}

TEST(GeodesicDisk, IsAccurateOnTheSphere)
{
  expect_accurate(
      "sphere", sphere(20000), [](const auto& a, const auto& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); },
      [](const auto&) { return true; });
}

TEST(GeodesicDisk, IsAccurateOnTheCylinder)
{
  const auto truth = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    const double angle = std::atan2(a.x() * b.y() - a.y() * b.x(), a.x() * b.x() + a.y() * b.y());
    return std::hypot(cylinder_radius * angle, a.z() - b.z());
  };
  Points side;
  for (const Eigen::Vector3d& p : cylinder(25000))
    if (p.z() > 0 && p.z() < cylinder_height) side.push_back(p);
  expect_accurate("cylinder", side, truth, [](const auto& p) { return std::abs(p.z() - 1) < 0.6; });
}

TEST(GeodesicDisk, ReachesEachPointOnceWithinTheLimit)
{
  const Stages stages(torus(8000));
  const double limit = 6 * stages.graph.sampling_interval;
  for (std::uint32_t source = 0; source < 8000; source += 500) {
    const Reached reached = grown(stages, source, limit);
    ASSERT_FALSE(reached.empty());
    EXPECT_EQ(reached.front().point, source);
    EXPECT_EQ(reached.front().distance, 0.0F);
    EXPECT_LE(reached.back().distance, static_cast<float>(limit));
    std::set<std::uint32_t> distinct;
    for (const auto& r : reached) distinct.insert(r.point);
    EXPECT_EQ(distinct.size(), reached.size());
  }
}

/** \brief Dijkstra's distances by relaxing all edges until nothing changes. */
std::vector<float> shortest_paths(const Stages& stages, std::uint32_t source)
{
  std::vector<float> distance(stages.points.size(), std::numeric_limits<float>::infinity());
  distance[source] = 0;
  for (bool changed = true; changed;) {
    changed = false;
    for (std::uint32_t i = 0; i < distance.size(); ++i)
      for (const std::uint32_t j : stages.graph.neighbors(i)) {
        const float path = distance[i] + (stages.points.position[i] - stages.points.position[j]).norm();
        if (path >= distance[j]) continue;
        distance[j] = path;
        changed = true;
      }
  }
  return distance;
}

TEST(GeodesicDisk, DijkstraFindsShortestPathsAndIsNeverBelowFastMarching)
{
  const Stages stages(swiss_roll(4000));
  const double limit = 12 * stages.graph.sampling_interval;
  for (std::uint32_t source = 0; source < 4000; source += 800) {
    const std::vector<float> truth = shortest_paths(stages, source);
    std::vector<float> marched(stages.points.size(), std::numeric_limits<float>::infinity());
    for (const auto& r : grown(stages, source, limit)) marched[r.point] = r.distance;
    const Reached paths = grown(stages, source, limit, uniform_weights, GeodesicSolver::dijkstra);
    EXPECT_EQ(static_cast<long>(paths.size()),
              std::count_if(truth.begin(), truth.end(), [&](float d) { return d <= static_cast<float>(limit); }));
    for (const auto& r : paths) {
      EXPECT_FLOAT_EQ(r.distance, truth[r.point]);
      EXPECT_LE(marched[r.point], r.distance * cut_bends);
    }
  }
}

TEST(GeodesicDisk, ContainsEverySmallerDisk)
{
  const Stages stages(saddle(6000));
  const double limit = 4 * stages.graph.sampling_interval;
  WholeCloudDisk disk(stages, uniform_weights);
  for (std::uint32_t source = 0; source < 6000; source += 300) {
    const Reached large = disk.grow(source, static_cast<float>(3 * limit));  // grows the object's tables, too
    const Reached small = disk.grow(source, static_cast<float>(limit));
    ASSERT_LT(small.size(), large.size());
    for (std::size_t i = 0; i < small.size(); ++i) {
      EXPECT_EQ(small[i].point, large[i].point);
      EXPECT_EQ(small[i].distance, large[i].distance);
    }
    EXPECT_GT(large[small.size()].distance, static_cast<float>(limit));
  }
}

TEST(GeodesicDisk, StaysOnItsConnectedPart)
{
  Points far = plane(500, 0, 2);
  for (Eigen::Vector3d& p : far) p.x() += 50;
  const Stages stages(joined(plane(500), far));
  const Reached reached = grown(stages, stages.points.rank_of_input[3], 100);
  EXPECT_EQ(reached.size(), 500U);
  for (const auto& r : reached) EXPECT_LT(stages.points.input_index[r.point], 500U);
}

TEST(GeodesicDisk, ScalesWithAConstantWeight)
{
  const Stages stages(torus(5000));
  const double limit = 5 * stages.graph.sampling_interval;
  const Reached plain = grown(stages, 77, limit);
  for (const float weight : {2.0F, 1.7F}) {
    const pds::EdgeWeights weights(std::vector<float>(stages.points.size(), weight));
    std::vector<float> distance(stages.points.size(), -1.0F);
    for (const auto& r : grown(stages, 77, static_cast<double>(weight) * limit * 1.0001, weights))
      distance[r.point] = r.distance;
    for (const auto& r : plain) EXPECT_NEAR(distance[r.point], weight * r.distance, 1e-5F * weight * r.distance);
  }
}

TEST(GeodesicDisk, IntegratesAWeightThatVaries)
{
  // The weight grows linearly with x, so the x axis is a geodesic and the distance along it the integral of the weight.
  const Points input = plane(20000);
  const Stages stages(input);
  const auto place = [&](std::uint32_t i) { return input[stages.points.input_index[i]]; };
  const auto weight_at = [](double x) { return 1.5 + 0.5 * x; };
  std::vector<float> weight;
  const Eigen::Vector3d start(-0.5, 0, 0);
  std::uint32_t source = 0;
  for (std::uint32_t i = 0; i < stages.points.size(); ++i) {
    weight.push_back(static_cast<float>(weight_at(place(i).x())));
    if ((place(i) - start).norm() < (place(source) - start).norm()) source = i;
  }
  std::size_t ahead = 0;
  for (const auto& r : grown(stages, source, 2.0 / stages.points.unit, pds::EdgeWeights(weight))) {
    const double way = place(r.point).x() - place(source).x();
    if (way < 0.3 || std::abs(place(r.point).y() - place(source).y()) > 0.02) continue;
    const double expected = way * weight_at(place(source).x() + way / 2);
    EXPECT_NEAR(static_cast<double>(r.distance) * stages.points.unit, expected, 0.01 * expected);
    ++ahead;
  }
  EXPECT_GT(ahead, 10U);
}

}  // namespace
}  // namespace pds_test
