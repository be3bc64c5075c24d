// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/sheet_separation.h>

#include <array>

#include "core_testing.h"

/** \brief Sheets that are nearer to each other than neighbours reach stay apart, and noise is no sheet. */
namespace pds_test
{
namespace
{

/** \brief Mean distance to the 15 nearest of so many random points on so large a surface. */
double interval_of(double area, std::size_t count)
{
  return 2.0 / 3.0 * std::sqrt(15 * area / (pi * static_cast<double>(count)));
}

enum class Layout
{
  random,
  jittered,
  poisson_disk
};

/** \brief Points of a rectangle from the origin, one in each cell of a grid. */
Points jittered_rectangle(double width, double height, double points_per_area, Random& random)
{
  const double side = 1 / std::sqrt(points_per_area);
  const auto columns = static_cast<std::size_t>(std::lround(width / side));
  const auto rows = static_cast<std::size_t>(std::lround(height / side));
  Points points;
  for (std::size_t i = 0; i < columns; ++i)
    for (std::size_t j = 0; j < rows; ++j)
      points.emplace_back((static_cast<double>(i) + random.uniform(0.1, 0.9)) * width / static_cast<double>(columns),
                          (static_cast<double>(j) + random.uniform(0.1, 0.9)) * height / static_cast<double>(rows), 0);
  return points;
}

/** \brief Some points of the unit square, so far apart that hardly any more have room. */
Points poisson_disk_square(double points_per_area, Random& random)
{
  constexpr double filling = 0.65;  // points per area times the squared distance
  constexpr double darts_per_point = 30;
  const double apart = std::sqrt(filling / points_per_area);
  const auto cells = static_cast<std::size_t>(1 / apart);
  const auto cell_of = [&](double x) { return static_cast<std::size_t>(x * static_cast<double>(cells)); };
  std::vector<Points> cell((cells + 2) * (cells + 2));  // one more on each side
  Points points;
  for (double darts = darts_per_point * points_per_area; darts > 0; --darts) {
    const Eigen::Vector3d dart(random.uniform(0, 1), random.uniform(0, 1), 0);
    const std::size_t home = (cell_of(dart.y()) + 1) * (cells + 2) + cell_of(dart.x()) + 1;
    bool has_room = true;
    for (const std::size_t row : {home - cells - 2, home, home + cells + 2})
      for (const std::size_t near : {row - 1, row, row + 1})
        for (const Eigen::Vector3d& p : cell[near]) has_room = has_room && (p - dart).norm() >= apart;
    if (!has_room) continue;
    cell[home].push_back(dart);
    points.push_back(dart);
  }
  return points;
}

/** \brief Points of a rectangle from the origin, at random or one in each cell of a grid. */
Points rectangle(double width, double height, double points_per_area, Layout layout, Random& random)
{
  if (layout == Layout::jittered) return jittered_rectangle(width, height, points_per_area, random);
  const auto count = static_cast<std::size_t>(width * height * points_per_area);
  Points points;
  while (points.size() < count) points.emplace_back(random.uniform(0, width), random.uniform(0, height), 0);
  return points;
}

Points unit_square(double points_per_area, Layout layout, Random& random)
{
  return layout == Layout::poisson_disk ? poisson_disk_square(points_per_area, random)
                                        : rectangle(1, 1, points_per_area, layout, random);
}

constexpr double spacing = 0.69;  ///< 1 over the square root of the points per area, in intervals

struct Pair
{
  double gap;    ///< in intervals of one sheet
  double noise;  ///< likewise
  Layout layout;

  friend std::ostream& operator<<(std::ostream& stream, const Pair& pair)
  {
    constexpr std::array<const char*, 3> names = {", random", ", jittered", ", Poisson-disk samples"};
    return stream << pair.gap << " intervals apart, noise " << pair.noise
                  << names.at(static_cast<std::size_t>(pair.layout));
  }
};

/** \brief The unit square twice, the lower one first. */
Points two_squares(const Pair& pair, std::size_t count, unsigned seed = 1)
{
  Random random(seed);
  const auto density = static_cast<double>(count);
  Points lower = unit_square(density, pair.layout, random);
  Points upper = unit_square(density, pair.layout, random);
  const double interval = interval_of(1, lower.size());
  for (Eigen::Vector3d& p : upper) p.z() = pair.gap * interval;
  Points points = joined(lower, upper);
  for (Eigen::Vector3d& p : points) p.z() += pair.noise * interval * random.normal();
  return points;
}

Points two_spheres(const Pair& pair, std::size_t count)
{
  const double interval = interval_of(4 * pi, count);
  Points points = sphere(count, 1);
  const double radius = 1 + pair.gap * interval;
  for (const Eigen::Vector3d& p : sphere(static_cast<std::size_t>(static_cast<double>(count) * radius * radius), 2))
    points.emplace_back(radius * p);
  Random random(3);
  for (Eigen::Vector3d& p : points) p *= 1 + pair.noise * interval * random.normal();
  return points;
}

class TwoSquares : public testing::TestWithParam<Pair>
{
};

class TwoSpheres : public testing::TestWithParam<Pair>
{
};

INSTANTIATE_TEST_SUITE_P(Clean,
                         TwoSquares,
                         testing::Values(Pair{0.8, 0, Layout::random},
                                         Pair{1, 0, Layout::random},
                                         Pair{1, 0, Layout::jittered},
                                         Pair{1.5, 0, Layout::random},
                                         Pair{1.5, 0, Layout::jittered},
                                         Pair{2, 0, Layout::random},
                                         Pair{3, 0, Layout::random}));

INSTANTIATE_TEST_SUITE_P(Noisy,
                         TwoSquares,
                         testing::Values(Pair{2, 0.3, Layout::jittered},
                                         Pair{2, 0.3, Layout::poisson_disk},
                                         Pair{2 * spacing, 0.3 * spacing, Layout::jittered},
                                         Pair{2 * spacing, 0.3 * spacing, Layout::poisson_disk},
                                         Pair{3, 0.3, Layout::jittered}));

INSTANTIATE_TEST_SUITE_P(Clean,
                         TwoSpheres,
                         testing::Values(Pair{0.8, 0, Layout::random},
                                         Pair{1, 0, Layout::random},
                                         Pair{1.5, 0, Layout::random},
                                         Pair{2, 0, Layout::random},
                                         Pair{3, 0, Layout::random}));

INSTANTIATE_TEST_SUITE_P(Noisy, TwoSpheres, testing::Values(Pair{2, 0.3, Layout::random}));

TEST_P(TwoSquares, StayTwo)
{
  const Points points = two_squares(GetParam(), small_cloud);
  const pds::Reconstruction mesh = reconstruct(points);
  const MeshFacts facts = expect_sound(mesh, points);
  EXPECT_EQ(facts.components, 2U);
  EXPECT_EQ(facts.boundary_loops, 2U);
  EXPECT_EQ(facts.euler(), 2);
  EXPECT_GT(facts.area, 1.8);  // the rims lie within the squares
  EXPECT_LT(facts.area, 2.02);
}

TEST_P(TwoSpheres, StayTwo)
{
  const Points points = two_spheres(GetParam(), small_cloud);
  const pds::Reconstruction mesh = reconstruct(points);
  const MeshFacts facts = expect_sound(mesh, points);
  EXPECT_EQ(facts.components, 2U);
  EXPECT_EQ(facts.boundary_loops, 0U);
  EXPECT_EQ(facts.euler(), 4);
}

TEST(NoisySheets, AreTheSameForAnyOrderAndNumberOfThreads)
{
  Points points = two_squares({2, 0.3, Layout::jittered}, small_cloud);
  pds::Options options;
  options.threads = 1;
  const pds::Reconstruction one = reconstruct(points, options);
  const Points of_one = vertex_positions(one, points);
  Random(5).shuffle(points);
  options.threads = 3;
  const pds::Reconstruction three = reconstruct(points, options);
  EXPECT_EQ(one.report.components, 2U);
  EXPECT_EQ(of_one, vertex_positions(three, points));
  EXPECT_EQ(one.triangles, three.triangles);
}

/** \brief Points at random leave rims ragged: there one pair is joined. */
TEST(NoisySheets, StayTwoInNearlyAllRandomSamples)
{
  constexpr unsigned samples = 16;
  unsigned apart = 0;
  for (unsigned seed = 1; seed <= samples; ++seed) {
    const pds::Reconstruction mesh = reconstruct(two_squares({2, 0.3, Layout::random}, small_cloud, seed));
    apart += mesh.report.components == 2 ? 1 : 0;
  }
  EXPECT_GE(apart, samples - 1);
}

/** \brief The surface of a plate of 6 x 2 with three square holes through it: genus 3. */
Points three_holed_plate(double thickness, double points_per_area, Layout layout, unsigned seed)
{
  Random random(seed);
  const auto in_hole = [](const Eigen::Vector3d& p) {
    return std::abs(p.y() - 1) < 0.5 && std::abs(std::fmod(p.x(), 2) - 1) < 0.5;
  };
  Points points;
  for (const double z : {0.0, thickness})
    for (const Eigen::Vector3d& p : rectangle(6, 2, points_per_area, layout, random))
      if (!in_hole(p)) points.emplace_back(p.x(), p.y(), z);
  const auto add_wall = [&](const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    const double length = (to - from).norm();
    for (const Eigen::Vector3d& p : rectangle(length, thickness, points_per_area, layout, random)) {
      const Eigen::Vector2d at = from + p.x() / length * (to - from);
      points.emplace_back(at.x(), at.y(), p.y());
    }
  };
  const auto add_walls = [&](double left, double right, double bottom, double top) {
    add_wall({left, bottom}, {right, bottom});
    add_wall({right, bottom}, {right, top});
    add_wall({right, top}, {left, top});
    add_wall({left, top}, {left, bottom});
  };
  add_walls(0, 6, 0, 2);
  for (const double middle : {1.0, 3.0, 5.0}) add_walls(middle - 0.5, middle + 0.5, 0.5, 1.5);
  return points;
}

constexpr unsigned plates = 16;

/** \brief Reconstructs a plate two intervals thick. */
MeshFacts mesh_of_plate(Layout layout, unsigned seed)
{
  SCOPED_TRACE(seed);
  constexpr double points_per_area = 4000;
  const double interval = interval_of(1, static_cast<std::size_t>(points_per_area));
  const Points points = three_holed_plate(2 * interval, points_per_area, layout, seed);
  return expect_sound(reconstruct(points), points);
}

/** \brief Of 2 - 2 genus, each boundary loop closed by a disk. */
long long euler_of_closed(const MeshFacts& facts)
{
  return facts.euler() + static_cast<long long>(facts.boundary_loops);
}

TEST(ThinPlate, IsClosedAndKeepsItsHoles)
{
  for (unsigned seed = 1; seed <= plates; ++seed) {
    const MeshFacts facts = mesh_of_plate(Layout::jittered, seed);
    EXPECT_EQ(facts.components, 1U);
    EXPECT_EQ(facts.boundary_loops, 0U);
    EXPECT_EQ(facts.euler(), -4);
  }
}

TEST(ThinPlate, IsClosedAndKeepsItsHolesIfPointsAreAtRandom)
{
  for (unsigned seed = 1; seed <= plates; ++seed) {
    const MeshFacts facts = mesh_of_plate(Layout::random, seed);
    EXPECT_EQ(facts.components, 1U);
    EXPECT_EQ(facts.boundary_loops, 0U);
    EXPECT_EQ(facts.euler(), -4);
  }
}

/** \brief A sphere as a scanner sees it from all around, each scan put where it should be but for an error of its own.
 * \param error in spacings of the points of one scan */
Points misfitting_scans(double error, unsigned scans, std::size_t points_of_scan)
{
  Random random(7);
  const auto direction = [&random] {
    return Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
  };
  const double spacing_of_scan = std::sqrt(2 * pi / static_cast<double>(points_of_scan));
  Points points;
  for (unsigned scan = 0; scan < scans; ++scan) {
    const double height = 1 - (2.0 * scan + 1) / scans;  // of sensors evenly spread along a spiral
    const double golden_angle = pi * (3 - std::sqrt(5.0));
    const double width = std::sqrt(1 - height * height);
    const Eigen::Vector3d sensor(width * std::cos(scan * golden_angle), width * std::sin(scan * golden_angle), height);
    const Eigen::Vector3d shift = error * spacing_of_scan * direction();
    for (const Eigen::Vector3d& p : sphere(2 * points_of_scan, scan + 1))
      if (p.dot(sensor) > 0.25) points.emplace_back(p + shift);  // rays that graze the surface give no points
  }
  return points;
}

TEST(MisfittingScans, AreOneSurface)
{
  for (const double error : {0.5, 0.7, 1.0}) {
    SCOPED_TRACE(error);
    const Points points = misfitting_scans(error, 12, 15000);
    const MeshFacts facts = expect_sound(reconstruct(points), points);
    EXPECT_EQ(facts.components, 1U);
    EXPECT_EQ(euler_of_closed(facts), 2);
    EXPECT_LE(facts.boundary_loops, error < 1 ? 0U : 1U);
  }
}

/** \brief The first stages up to the separation. */
struct ListedCloud
{
  explicit ListedCloud(const pds::PointCloudView& view)
      : cloud(view),
        points(pds::order_points(view, parallel)),
        graph(pds::list_neighbors(points, view, 15, parallel)),
        surface(pds::estimate_surface(points, graph, parallel))
  {
  }

  pds::SheetCounts count(const std::vector<std::uint8_t>& candidate = {})
  {
    return pds::separate_sheets(cloud, points, graph, surface, parallel, candidate);
  }
  std::size_t separate(const std::vector<std::uint8_t>& candidate = {}) { return count(candidate).parted; }

  pds::Parallel parallel{2};
  pds::PointCloudView cloud;
  pds::OrderedPoints points;
  pds::NeighborGraph graph;
  pds::SurfaceEstimate surface;
};

/** \brief How many points list one of the other sheet: the one whose points come first in the input, or the other. */
std::size_t rows_of_both(const ListedCloud& listed, std::size_t points_of_first)
{
  std::size_t count = 0;
  const auto is_of_first = [&](std::uint32_t j) { return listed.points.input_index[j] < points_of_first; };
  for (std::uint32_t i = 0; i < listed.points.size(); ++i) {
    const pds::NeighborSpan row = listed.graph.nearest(i);
    count += std::any_of(row.begin(), row.end(), [&](auto j) { return is_of_first(j) != is_of_first(i); }) ? 1 : 0;
  }
  return count;
}

TEST(SheetSeparation, TellsLayersOfMisfittingScansFromNoise)
{
  const Points layers = misfitting_scans(0.7, 12, 15000);
  const pds::SheetCounts of_layers = ListedCloud(view_of(layers)).count();
  EXPECT_GT(of_layers.too_near, layers.size() / 20);
  EXPECT_LT(of_layers.parted, layers.size() / 1000);

  const double interval = interval_of(4 * pi, small_cloud);
  Random random(2);
  Points noise = sphere(small_cloud);
  for (Eigen::Vector3d& p : noise) p *= 1 + interval * random.normal();
  EXPECT_LT(ListedCloud(view_of(noise)).count().too_near, noise.size() / 1000);
}

TEST(SheetSeparation, LeavesNoRowWithPointsOfBothSheets)
{
  const Points input = two_squares({1, 0, Layout::random}, small_cloud);
  ListedCloud listed(view_of(input));
  EXPECT_GT(rows_of_both(listed, small_cloud), input.size() * 9 / 10);
  EXPECT_GT(listed.separate(), input.size() / 2);
  EXPECT_LE(rows_of_both(listed, small_cloud), input.size() / 1000);
}

TEST(SheetSeparation, JoinsEveryEdgeOnceFromEitherEnd)
{
  const Points input = two_squares({1, 0, Layout::random}, small_cloud);
  ListedCloud listed(view_of(input));
  ASSERT_GT(listed.separate(), 0U);
  pds::join_neighbors(listed.points, listed.cloud, listed.graph, listed.parallel);
  for (std::uint32_t i = 0; i < input.size(); ++i)
    for (const std::uint32_t j : listed.graph.neighbors(i)) {
      const pds::NeighborRange back = listed.graph.neighbors(j);
      ASSERT_EQ(std::count(back.begin(), back.end(), i), 1) << i << " " << j;
    }
}

TEST(SheetSeparation, FindsNoneInNoiseBendsAndCreases)
{
  const double interval = interval_of(4 * pi, small_cloud);
  Random random(2);
  for (const double noise : {0.1, 0.3, 1.0}) {
    Points points = sphere(small_cloud);
    for (Eigen::Vector3d& p : points) p *= 1 + noise * interval * random.normal();
    EXPECT_LE(ListedCloud(view_of(points)).separate(), small_cloud / 500) << noise;
  }
  EXPECT_LE(ListedCloud(view_of(cube(small_cloud))).separate(), small_cloud / 1000);
  EXPECT_EQ(ListedCloud(view_of(sphere(300))).separate(), 0U);
}

TEST(SheetSeparation, FindsSheetsThatAreFartherApartThanNoiseIsThick)
{
  for (const Layout layout : {Layout::jittered, Layout::random}) {
    Points points = two_squares({2, 0.3, layout}, small_cloud);
    const std::size_t of_sheets = points.size();
    Random random(3);
    const double noise = 0.3 * interval_of(1, small_cloud);
    // One sheet of four times their area is beside them.
    for (const Eigen::Vector3d& p : rectangle(2, 2, static_cast<double>(small_cloud), layout, random))
      points.emplace_back(p.x() + 1.1, p.y(), noise * random.normal());
    ListedCloud listed(view_of(points));
    EXPECT_GT(listed.separate(), of_sheets / 3);
    EXPECT_LE(rows_of_both(listed, of_sheets / 2), of_sheets / 50);
  }
}

TEST(SheetSeparation, LooksAtCandidatesOnly)
{
  const Points input = two_squares({1, 0, Layout::random}, small_cloud);
  ListedCloud listed(view_of(input));
  std::vector<std::uint8_t> candidate(input.size());
  EXPECT_EQ(listed.separate(candidate), 0U);
  const auto x_of = [&](std::size_t i) { return input[listed.points.input_index[i]].x(); };
  for (std::size_t i = 0; i < candidate.size(); ++i) candidate[i] = x_of(i) < 0.8 ? 1 : 0;
  EXPECT_GT(listed.separate(candidate), input.size() / 2);
  for (std::size_t i = 0; i < candidate.size(); ++i)
    if (x_of(i) > 0.85) {
      EXPECT_NE(listed.graph.reach[i].rank, pds::Reach::parted);
    }
}

TEST(SheetSeparation, BelievesNormalsThatSheetsAreLayersOfOneSide)
{
  const Points points = two_squares({1, 0, Layout::jittered}, small_cloud);
  std::vector<Eigen::Vector3d> normals(points.size(), Eigen::Vector3d::UnitZ());
  pds::PointCloudView cloud = view_of(points);
  cloud.normals = pds::Vector3View(normals.front().data(), sizeof(Eigen::Vector3d));
  EXPECT_EQ(ListedCloud(cloud).separate(), 0U);
  std::fill(normals.begin(), normals.begin() + static_cast<std::ptrdiff_t>(points.size() / 2),
            Eigen::Vector3d(-Eigen::Vector3d::UnitZ()));
  EXPECT_GT(ListedCloud(cloud).separate(), points.size() / 2);
}

}  // namespace
}  // namespace pds_test
