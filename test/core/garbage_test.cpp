// SPDX-License-Identifier: BSD-3-Clause
#include <functional>
#include <limits>

#include "core_testing.h"

/** \brief Clouds that are no surface: no crash, no defect, numbers that are numbers. */
namespace pds_test
{
namespace
{

struct Garbage
{
  const char* name;
  std::function<Points(Random&)> make;

  friend void PrintTo(const Garbage& cloud, std::ostream* stream) { *stream << cloud.name; }
};

template <typename Make>
Points repeat(std::size_t count, const Make& make)
{
  Points points;
  for (std::size_t i = 0; i < count; ++i) points.push_back(make(i));
  return points;
}

Eigen::Vector3d normal_vector(Random& random)
{
  const double x = random.normal();
  const double y = random.normal();
  return {x, y, random.normal()};
}

const Garbage garbage[] = {
    {"ball",
     [](Random& r) {
       return repeat(
           4000, [&](std::size_t) { return Eigen::Vector3d(normal_vector(r).normalized() * std::cbrt(r.uniform())); });
     }},
    {"clusters",
     [](Random& r) {
       return repeat(4000, [&](std::size_t i) {
         const auto cluster = static_cast<double>(i % 7);
         const Eigen::Vector3d center(cluster, cluster * cluster, 10 * std::sin(cluster));
         return Eigen::Vector3d(center + (0.01 + 0.3 * cluster) * normal_vector(r));
       });
     }},
    {"lattice",
     [](Random& r) {
       return repeat(4000, [&](std::size_t) { return Eigen::Vector3d((8 * r.in_box(1)).array().round()); });
     }},
    {"line",
     [](Random& r) {
       return repeat(500, [&](std::size_t) { return Eigen::Vector3d(Eigen::Vector3d(1, 2, 3) * r.uniform()); });
     }},
    {"noisy_lines",
     [](Random& r) {
       return repeat(3000, [&](std::size_t i) {
         Eigen::Vector3d p = 0.002 * normal_vector(r);
         p[static_cast<Eigen::Index>(i % 3)] += r.uniform(-1, 1);
         return p;
       });
     }},
    {"spiral",
     [](Random& r) {
       return repeat(3000, [&](std::size_t) {
         const double t = 40 * r.uniform();
         return Eigen::Vector3d(std::cos(t), std::sin(t), 0.01 * t);
       });
     }},
    {"coplanar_grid",
     [](Random&) {
       return repeat(2500, [](std::size_t i) {
         return Eigen::Vector3d(static_cast<double>(i % 50), static_cast<double>(i / 50), 7);
       });
     }},
    {"sphere_of_noise",
     [](Random& r) {
       return repeat(
           6000, [&](std::size_t) { return Eigen::Vector3d(normal_vector(r).normalized() * (1 + 0.1 * r.normal())); });
     }},
    {"thin_plate",
     [](Random& r) {
       return repeat(
           6000, [&](std::size_t) { return Eigen::Vector3d(r.in_box(1).cwiseProduct(Eigen::Vector3d(1, 1, 0.04))); });
     }},
    {"crossing_planes",
     [](Random& r) {
       return repeat(6000, [&](std::size_t i) {
         Eigen::Vector3d p = r.in_box(1);
         p[static_cast<Eigen::Index>(i % 3)] = 0;
         return p;
       });
     }},
    {"uneven_density",
     [](Random& r) {
       return repeat(6000, [&](std::size_t) {
         const double x = std::pow(r.uniform(), 4);
         return Eigen::Vector3d(x, x * r.uniform(), 0.1 * x * x);
       });
     }},
    {"far_outliers",
     [](Random& r) {
       Points points = sphere(3000);
       for (int i = 0; i < 5; ++i) points.push_back(1e30 * normal_vector(r));
       return points;
     }},
    {"denormal",
     [](Random& r) { return repeat(1000, [&](std::size_t) { return Eigen::Vector3d(1e-310 * normal_vector(r)); }); }},
    {"not_finite",
     [](Random& r) {
       Points points = sphere(3000);
       for (Eigen::Vector3d& p : points)
         if (r.below(3) == 0)
           p[static_cast<Eigen::Index>(r.below(3))] =
               r.below(2) == 0 ? std::numeric_limits<double>::infinity() : std::numeric_limits<double>::quiet_NaN();
       return points;
     }},
    {"coincident_in_float",
     [](Random& r) {
       Points points = sphere(2000);
       for (std::size_t i = 0; i < 500; ++i) points.push_back(points[i] + 1e-12 * r.in_box(1));
       points.emplace_back(1000, 0, 0);
       return points;
     }},
    {"many_copies_of_few",
     [](Random& r) {
       const Points few = sphere(12);
       return repeat(3000, [&](std::size_t) { return few[r.below(few.size())]; });
     }},
};

class GarbageTest : public testing::TestWithParam<Garbage>
{
};

INSTANTIATE_TEST_SUITE_P(Clouds, GarbageTest, testing::ValuesIn(garbage), [](const auto& test) {
  return std::string(test.param.name);
});

TEST_P(GarbageTest, GivesASoundMesh)
{
  const std::uint64_t seeds = large_cloud < 100000 ? 1 : 2;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    Random random(seed);
    const Points points = GetParam().make(random);
    for (const double adaptive : {0.0, 0.25, 2.0})
      for (const double factor : {1.5, 3.0, 6.0}) {
        SCOPED_TRACE("seed " + std::to_string(seed) + ", adaptive " + std::to_string(adaptive) + ", factor " +
                     std::to_string(factor));
        pds::Options options;
        options.adaptive = adaptive;
        options.radius_factor = factor;
        options.k_neighbors = factor < 2 ? 4 : 15;
        expect_sound(reconstruct(points, options), points);
      }
  }
}

TEST(Degenerate, TooFewPointsGiveAnEmptyMesh)
{
  for (std::size_t count = 0; count <= 3; ++count) {
    SCOPED_TRACE(count);
    const Points points = sphere(count);
    const pds::Reconstruction mesh = reconstruct(points);
    expect_sound(mesh, points);
    EXPECT_TRUE(mesh.triangles.empty() || count == 3);
    EXPECT_FALSE(mesh.report.closed);
    EXPECT_EQ(mesh.report.valid_points, count);
    EXPECT_EQ(mesh.voronoi.label.size(), count);
    EXPECT_TRUE(std::isfinite(mesh.report.min_seed_distance));
    EXPECT_TRUE(std::isfinite(mesh.report.coverage_radius));
  }
}

TEST(Degenerate, AFewPointsGiveASoundMesh)
{
  for (std::size_t count = 4; count <= 20; ++count)
    for (std::uint64_t seed = 1; seed <= 10; ++seed)
      for (const double radius : {0.0, 0.05}) {
        SCOPED_TRACE(std::to_string(count) + " points, seed " + std::to_string(seed));
        const Points points = sphere(count, seed);
        pds::Options options;
        options.radius = radius;
        expect_sound(reconstruct(points, options), points);
      }
}

TEST(Degenerate, CoincidentPointsGiveAnEmptyMesh)
{
  const Points points(100, Eigen::Vector3d(1, 2, 3));
  const pds::Reconstruction mesh = reconstruct(points);
  expect_sound(mesh, points);
  EXPECT_TRUE(mesh.triangles.empty());
  EXPECT_EQ(mesh.report.merged_points, 99U);
  EXPECT_EQ(mesh.report.sampling_interval, 0.0);
}

TEST(Degenerate, NothingFiniteGivesAnEmptyMesh)
{
  const Points points(10, Eigen::Vector3d::Constant(std::nan("")));
  const pds::Reconstruction mesh = reconstruct(points);
  expect_sound(mesh, points);
  EXPECT_TRUE(mesh.triangles.empty());
  EXPECT_EQ(mesh.report.valid_points, 0U);
  for (const std::uint32_t label : mesh.voronoi.label) EXPECT_EQ(label, pds::no_label);
}

TEST(Degenerate, CollinearPointsGiveAnEmptyMesh)
{
  const Eigen::Vector3d directions[] = {{1, 0, 0}, {1, 1, 0}, {3, -2, 0.7}};
  for (const Eigen::Vector3d& direction : directions) {
    Points points;
    for (int i = 0; i < 400; ++i) points.push_back(0.01 * i * direction);
    for (const double adaptive : {0.0, 0.25}) {
      pds::Options options;
      options.adaptive = adaptive;
      const pds::Reconstruction mesh = reconstruct(points, options);
      expect_sound(mesh, points);
      EXPECT_TRUE(mesh.triangles.empty());
      EXPECT_GT(mesh.report.seeds, 1U);
    }
  }
}

TEST(Degenerate, ARadiusLargerThanTheCloudGivesOneSeed)
{
  const Points points = sphere(1000);
  pds::Options options;
  for (const double radius : {10.0, 1e30, 1e308}) {
    options.radius = radius;
    const pds::Reconstruction mesh = reconstruct(points, options);
    expect_sound(mesh, points);
    EXPECT_EQ(mesh.report.seeds, 1U);
    EXPECT_TRUE(mesh.triangles.empty());
  }
}

TEST(Degenerate, ARadiusBelowTheSpacingMakesEveryPointASeed)
{
  const Points points = sphere(1000);
  pds::Options options;
  for (const double radius : {1e-6, 1e-300}) {
    options.radius = radius;
    const pds::Reconstruction mesh = reconstruct(points, options);
    expect_sound(mesh, points);
    EXPECT_EQ(mesh.report.seeds, points.size());
  }
}

}  // namespace
}  // namespace pds_test
