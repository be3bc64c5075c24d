// SPDX-License-Identifier: BSD-3-Clause
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>

#include "core_testing.h"

/** \brief What the caller may ask for, and what reconstruct() owes the caller's callbacks. */
namespace pds_test
{
namespace
{

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

struct Field
{
  const char* name;
  std::function<void(pds::Options&, double)> set;
  std::vector<double> good;
  std::vector<double> bad;
};

pds::Options& with_curves(pds::Options& options)
{
  options.dimension = pds::Dimension::automatic;
  return options;
}

const Field fields[] = {
    {"k_neighbors", [](auto& o, double v) { o.k_neighbors = static_cast<int>(v); }, {4, 200}, {3, 0, -1, 201}},
    {"radius_factor", [](auto& o, double v) { o.radius_factor = v; }, {1.5, 1000}, {1.49, 0, -3, 1001, nan, inf}},
    {"radius", [](auto& o, double v) { o.radius = v; }, {0, 1e-3, 5}, {-1, nan, inf}},
    {"adaptive", [](auto& o, double v) { o.adaptive = v; }, {0, 0.3, 2}, {-0.1, 2.1, nan, inf}},
    {"voronoi_threshold", [](auto& o, double v) { o.voronoi_threshold = v; }, {0, 1}, {-0.1, 1.1, nan}},
    {"vertices", [](auto& o, double v) { o.vertices = static_cast<std::uint64_t>(v); }, {0, 4, 20}, {1, 3, 1e15}},
    {"max_error", [](auto& o, double v) { o.max_error = v; }, {0, 0.5}, {-1, nan, inf}},
    {"relax", [](auto& o, double v) { o.relax = static_cast<unsigned>(v); }, {0, 2}, {101}},
    {"vertices", [](auto& o, double v) { with_curves(o).vertices = static_cast<std::uint64_t>(v); }, {}, {100}},
    {"max_error", [](auto& o, double v) { with_curves(o).max_error = v; }, {}, {1}},
    {"adaptive", [](auto& o, double v) { with_curves(o).adaptive = v; }, {}, {0.3}},
    {"relax", [](auto& o, double v) { with_curves(o).relax = static_cast<unsigned>(v); }, {}, {1}},
    {"placement", [](auto& o, double) { with_curves(o).placement = pds::Placement::quadric; }, {}, {0}},
    {"hole_size", [](auto& o, double v) { o.hole_size = v; }, {0, 15, 1e6}, {-1, nan, inf}},
    {"threads", [](auto& o, double v) { o.threads = static_cast<unsigned>(v); }, {0, 1, 1024}, {1025, 4e9}},
};

TEST(Options, AreRefusedOutOfTheirRangeByName)
{
  const Points points = sphere(200);
  for (const Field& field : fields)
    for (const double value : field.bad) {
      pds::Options options;
      field.set(options, value);
      try {
        static_cast<void>(reconstruct(points, options));
        ADD_FAILURE() << field.name << " = " << value << " was accepted";
      } catch (const pds::InvalidOption& error) {
        EXPECT_EQ(std::string(error.what()).rfind(field.name, 0), 0U) << error.what();
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      }
    }
}

TEST(Options, AreAcceptedAtTheEndsOfTheirRange)
{
  const Points points = sphere(300);
  for (const Field& field : fields)
    for (const double value : field.good) {
      SCOPED_TRACE(std::string(field.name) + " = " + std::to_string(value));
      pds::Options options;
      field.set(options, value);
      const pds::Reconstruction mesh = reconstruct(points, options);
      if (options.relax > 0)
        expect_sound_mesh(mesh, points);
      else
        expect_sound(mesh, points);
    }
}

TEST(Options, RadiusIsAbsolute)
{
  const Points points = torus(20000);
  pds::Options options;
  options.radius = 0.11;
  for (const double adaptive : {0.0, 0.25}) {
    options.adaptive = adaptive;
    const pds::Reconstruction mesh = reconstruct(points, options);
    expect_sound(mesh, points);
    EXPECT_DOUBLE_EQ(mesh.report.radius, 0.11);
  }
}

TEST(Options, SeedPicksAnotherEquallyGoodMesh)
{
  const Points points = torus(20000);
  pds::Options options;
  const pds::Reconstruction first = reconstruct(points, options);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    options.seed = seed;
    const pds::Reconstruction other = reconstruct(points, options);
    expect_closed(other, points, 1);
    EXPECT_NE(other.seeds, first.seeds);
  }
}

TEST(Options, WiderVoronoiThresholdFindsMoreWitnesses)
{
  const Points points = torus(10000);
  std::size_t before = 0;
  for (const double threshold : {0.0, 0.05, 0.1, 0.5}) {
    pds::Options options;
    options.voronoi_threshold = threshold;
    const std::size_t witnesses = reconstruct(points, options).witness_points.size();
    EXPECT_TRUE(threshold == 0 ? witnesses == 0 : witnesses > before) << threshold;
    before = witnesses;
  }
}

TEST(Progress, AscendsFromZero)
{
  const Points points = sphere(2000);
  std::vector<double> fractions;
  std::set<std::string> stages;
  static_cast<void>(pds::reconstruct(view_of(points), {}, [&](const char* stage, double fraction) {
    fractions.push_back(fraction);
    stages.insert(stage);
  }));
  ASSERT_GE(fractions.size(), 8U);
  EXPECT_EQ(fractions.front(), 0.0);
  for (std::size_t i = 1; i < fractions.size(); ++i) EXPECT_GT(fractions[i], fractions[i - 1]);
  EXPECT_LT(fractions.back(), 1.0);
  EXPECT_EQ(stages.size(), fractions.size()) << "every stage is announced once";
}

struct Cancelled : std::exception
{
};

TEST(Progress, CanCancelAtEveryStage)
{
  const Points points = sphere(2000);
  for (int stage = 0; stage < 8; ++stage) {
    int calls = 0;
    const auto cancel = [&](const char*, double) {
      if (calls++ == stage) throw Cancelled();
    };
    EXPECT_THROW(static_cast<void>(pds::reconstruct(view_of(points), {}, cancel)), Cancelled) << stage;
  }
}

TEST(Callbacks, ExceptionsReachTheCaller)
{
  const Points points(joined(sphere(500), sphere(500)));
  pds::PointCloudView cloud = view_of(points);
  cloud.neighbor_search = [](std::uint32_t, std::size_t, std::vector<std::uint32_t>&) { throw Cancelled(); };
  EXPECT_THROW(static_cast<void>(pds::reconstruct(cloud, {})), Cancelled);
  cloud = view_of(points);
  cloud.record_less = [](std::uint32_t, std::uint32_t) -> bool { throw Cancelled(); };
  for (const unsigned threads : {1U, 4U}) {
    pds::Options options;
    options.threads = threads;
    EXPECT_THROW(static_cast<void>(pds::reconstruct(cloud, options)), Cancelled);
  }
}

TEST(Callbacks, RecordsChooseTheVertices)
{
  const Points points(joined(sphere(3000), sphere(3000)));
  pds::PointCloudView cloud = view_of(points);
  cloud.record_less = [](std::uint32_t a, std::uint32_t b) { return a > b; };  // the second copy comes first
  for (const std::uint32_t seed : pds::reconstruct(cloud, {}).seeds) EXPECT_GE(seed, 3000U);
  for (const std::uint32_t seed : reconstruct(points).seeds) EXPECT_LT(seed, 3000U);
}

/** \brief Height of the area vector of an open mesh: positive if it faces up. */
double upward(const pds::Reconstruction& mesh, const Points& points)
{
  const Points v = vertex_positions(mesh, points);
  double sum = 0;
  for (const auto& t : mesh.triangles) sum += (v[t[1]] - v[t[0]]).cross(v[t[2]] - v[t[0]]).z();
  return sum;
}

TEST(Orientation, FollowsNormalsThenTheSensor)
{
  const Points points = plane(5000);
  for (const double z : {-1.0, 1.0}) {
    pds::PointCloudView cloud = view_of(points);
    cloud.sensor_origin = Eigen::Vector3d(0, 0, 5 * z);
    EXPECT_GT(upward(pds::reconstruct(cloud, {}), points) * z, 0.0);
    const Points normals(points.size(), Eigen::Vector3d(0, 0, -z));
    cloud.normals = pds::Vector3View(normals.front().data(), sizeof(Eigen::Vector3d));
    EXPECT_LT(upward(pds::reconstruct(cloud, {}), points) * z, 0.0);
  }
}

/** \brief Two scans of a wall each, of which one stood above and one below: nothing but that tells the sides. */
TEST(Orientation, FollowsTheViewpointOfEachScan)
{
  const Points above = plane(5000);
  const Points points = joined(above, plane(5000, -3));
  for (const double side : {-1.0, 1.0}) {
    Points viewpoints(above.size(), {0.5, 0.5, 5 * side});
    viewpoints.resize(points.size(), {0.5, 0.5, -5 * side});
    pds::PointCloudView cloud = view_of(points);
    cloud.viewpoints = pds::Vector3View(viewpoints.front().data(), sizeof(Eigen::Vector3d));
    const pds::Reconstruction mesh = pds::reconstruct(cloud, {});
    EXPECT_EQ(mesh.report.components, 2U);
    const Points v = vertex_positions(mesh, points);
    for (const auto& t : mesh.triangles) {
      const double up = (v[t[1]] - v[t[0]]).cross(v[t[2]] - v[t[0]]).z();
      ASSERT_GT(up * side * (v[t[0]].z() > -1 ? 1 : -1), 0.0);
    }
  }
}

/** \brief Where a point has no viewpoint of its own, that of the cloud counts. */
TEST(Orientation, TakesTheSensorOriginForUnknownViewpoints)
{
  const Points points = plane(5000);
  const Points unknown(points.size(), Eigen::Vector3d::Constant(std::nan("")));
  pds::PointCloudView cloud = view_of(points);
  cloud.viewpoints = pds::Vector3View(unknown.front().data(), sizeof(Eigen::Vector3d));
  EXPECT_GT(upward(pds::reconstruct(cloud, {}), points), 0.0);
  cloud.sensor_origin = Eigen::Vector3d(0, 0, -5);
  EXPECT_LT(upward(pds::reconstruct(cloud, {}), points), 0.0);
}

}  // namespace
}  // namespace pds_test
