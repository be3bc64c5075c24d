// SPDX-License-Identifier: BSD-3-Clause
#include <numeric>

#include "core_testing.h"
#include "lattices.h"

/** \brief Meshes of a wanted number of vertices or distance, levels of detail, and even triangles. */
namespace pds_test
{
namespace
{

constexpr std::size_t cloud_size = 20000;

TEST(VertexCount, IsHitWithinHalfAPercentOrTwo)
{
  const Points ring = torus(cloud_size);
  for (const std::uint64_t wanted : {12U, 100U, 333U, 1000U, 2000U})
    for (const double adaptive : {0.0, 0.25}) {
      pds::Options options;
      options.vertices = wanted;
      options.adaptive = adaptive;
      const pds::Reconstruction mesh = reconstruct(ring, options);
      expect_sound(mesh, ring);
      EXPECT_LE(std::abs(static_cast<double>(mesh.report.vertices) - static_cast<double>(wanted)),
                std::max(2.0, 0.005 * static_cast<double>(wanted)))
          << wanted << " vertices, adaptive " << adaptive;
    }
}

/** \brief The most vertices that are not refused, as the refusal says. */
std::uint64_t most_vertices(const Points& points)
{
  pds::Options options;
  options.vertices = points.size();
  try {
    static_cast<void>(reconstruct(points, options));
  } catch (const pds::InvalidInput& error) {
    const std::string message = error.what();
    return std::stoull(message.substr(message.find("ask for ") + 8));
  }
  return 0;
}

TEST(VertexCount, IsHitOnLattices)
{
  const Points lattices[] = {flat_grid(150, 130),         turned(flat_grid(150, 130)), hexagonal_grid(130, 130),
                             cube_of_grids(50),           turned(cube_of_grids(45)),   voxel_sphere(35),
                             hills_on_grid(130, 1.0 / 3), hills_on_grid(130, 1e-6)};
  for (const Points& lattice : lattices) {
    const std::uint64_t most = most_vertices(lattice);
    EXPECT_GT(most, 1000U);
    for (const std::uint64_t wanted : {std::uint64_t{12}, std::uint64_t{100}, std::uint64_t{333}, most / 2, most}) {
      SCOPED_TRACE(testing::Message() << "lattice " << &lattice - lattices << ", " << wanted << " vertices");
      pds::Options options;
      options.vertices = wanted;
      const pds::Reconstruction mesh = reconstruct(lattice, options);
      expect_sound(mesh, lattice);
      EXPECT_EQ(mesh.report.components, 1U);
      EXPECT_LE(std::abs(static_cast<double>(mesh.report.vertices) - static_cast<double>(wanted)),
                std::max(2.0, 0.005 * static_cast<double>(wanted)))
          << mesh.report.vertices;
    }
  }
}

TEST(VertexCount, OnALatticeDependsOnNeitherThreadsNorInputOrder)
{
  const Points lattice = turned(cube_of_grids(45));
  pds::Options options;
  options.vertices = 700;
  options.threads = 1;
  const pds::Reconstruction reference = reconstruct(lattice, options);
  std::vector<std::uint32_t> order(lattice.size());
  std::iota(order.begin(), order.end(), 0U);
  Random(5).shuffle(order);
  Points shuffled;
  for (const std::uint32_t i : order) shuffled.push_back(lattice[i]);
  options.threads = 3;
  const pds::Reconstruction other = reconstruct(shuffled, options);
  EXPECT_EQ(vertex_positions(other, shuffled), vertex_positions(reference, lattice));
  EXPECT_EQ(other.triangles, reference.triangles);
}

TEST(VertexCount, BeyondWhatThePointsCarryIsRefused)
{
  pds::Options options;
  options.vertices = cloud_size / 2;
  try {
    static_cast<void>(reconstruct(torus(cloud_size), options));
    ADD_FAILURE() << "was accepted";
  } catch (const pds::InvalidInput& error) {
    EXPECT_EQ(std::string(error.what()).rfind("vertices: 10000 are too many for 20000 points", 0), 0U) << error.what();
  }
}

TEST(MaxError, IsKeptWithFewVertices)
{
  const Points ring = torus(cloud_size);
  std::size_t more = 0;
  for (const double error : {0.008, 0.015, 0.03}) {
    pds::Options options;
    options.max_error = error;
    const pds::Reconstruction mesh = reconstruct(ring, options);
    expect_sound(mesh, ring);
    EXPECT_LE(mesh.report.p99_distance, error);
    EXPECT_GT(mesh.report.p99_distance, 0.8 * error);
    if (more > 0) {
      EXPECT_LT(mesh.report.vertices, more);
    }
    more = mesh.report.vertices;
  }
}

TEST(MaxError, BeyondThePointsIsRefused)
{
  pds::Options options;
  options.max_error = 1e-9;
  EXPECT_THROW(static_cast<void>(reconstruct(torus(cloud_size), options)), pds::InvalidInput);
}

TEST(Levels, AreNestedAndSound)
{
  const Points points = joined(torus(cloud_size), saddle(8000));
  pds::Options options;
  options.threads = 1;
  const std::vector<pds::Reconstruction> levels = pds::reconstruct_levels(view_of(points), options, 3);
  ASSERT_EQ(levels.size(), 3U);
  for (std::size_t level = 0; level < levels.size(); ++level) {
    SCOPED_TRACE(level);
    expect_sound(levels[level], points);
    if (level == 0) continue;
    const auto vertices = [&](const pds::Reconstruction& mesh) {
      return std::set<std::uint32_t>(mesh.seeds.begin(),
                                     mesh.seeds.begin() + static_cast<std::ptrdiff_t>(mesh.report.vertices));
    };
    const std::set<std::uint32_t> finer = vertices(levels[level - 1]);
    const std::set<std::uint32_t> own = vertices(levels[level]);
    EXPECT_TRUE(std::includes(finer.begin(), finer.end(), own.begin(), own.end()));
    EXPECT_LT(own.size(), finer.size() / 3);
    EXPECT_GT(own.size(), finer.size() / 6);
  }
  options.threads = 3;
  EXPECT_EQ(pds::reconstruct_levels(view_of(points), options, 3).back().triangles, levels.back().triangles);
}

TEST(Levels, AreRefusedOutOfRangeOrRelaxed)
{
  const Points points = sphere(300);
  pds::Options options;
  EXPECT_THROW(static_cast<void>(pds::reconstruct_levels(view_of(points), options, 0)), pds::InvalidOption);
  EXPECT_THROW(static_cast<void>(pds::reconstruct_levels(view_of(points), options, 17)), pds::InvalidOption);
  options.relax = 1;
  EXPECT_THROW(static_cast<void>(pds::reconstruct_levels(view_of(points), options, 2)), pds::InvalidOption);
}

/** \brief How even the faces are. */
struct Evenness
{
  double mean_smallest_angle = 0;  ///< degrees
  double narrow_share = 0;         ///< of the faces: with an angle below 25 degrees
};

Evenness evenness(const pds::Reconstruction& mesh, const Points& points)
{
  const Points vertices = vertex_positions(mesh, points);
  const auto count = static_cast<double>(mesh.triangles.size());
  Evenness evenness;
  for (const auto& t : mesh.triangles) {
    double smallest = pi;
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector3d u = vertices[t[(i + 1) % 3]] - vertices[t[i]];
      const Eigen::Vector3d v = vertices[t[(i + 2) % 3]] - vertices[t[i]];
      smallest = std::min(smallest, std::atan2(u.cross(v).norm(), u.dot(v)));
    }
    evenness.mean_smallest_angle += smallest * 180 / pi / count;
    evenness.narrow_share += smallest < 25 * pi / 180 ? 1 / count : 0;
  }
  return evenness;
}

TEST(Relaxation, EvensOutTheTriangles)
{
  const Points points = torus(2 * cloud_size);
  EXPECT_LT(evenness(reconstruct(points), points).mean_smallest_angle, 46.0);
  const std::pair<unsigned, double> expected_angles[] = {{1, 49.5}, {15, 50.5}};
  for (const auto& [steps, expected] : expected_angles) {
    pds::Options options;
    options.relax = steps;
    const pds::Reconstruction mesh = reconstruct(points, options);
    const MeshFacts facts = examine(mesh.triangles, vertex_positions(mesh, points));
    EXPECT_EQ(facts.nonmanifold_edges + facts.nonmanifold_vertices + facts.inconsistent_edges + facts.folded_edges, 0U);
    EXPECT_TRUE(mesh.report.closed);
    EXPECT_EQ(mesh.report.euler, 0);
    EXPECT_GE(evenness(mesh, points).mean_smallest_angle, expected) << steps;
    EXPECT_LT(evenness(mesh, points).narrow_share, 0.001) << steps;
  }
}

TEST(Relaxation, KeepsTheRim)
{
  const Points points = plane(cloud_size);
  pds::Options options;
  const double area = examine(reconstruct(points).triangles, vertex_positions(reconstruct(points), points)).area;
  options.relax = 5;
  const pds::Reconstruction mesh = reconstruct(points, options);
  const MeshFacts facts = examine(mesh.triangles, vertex_positions(mesh, points));
  EXPECT_EQ(facts.boundary_loops, 1U);
  EXPECT_GT(facts.area, 0.995 * area);
}

TEST(Relaxation, DependsOnNeitherThreadsNorInputOrder)
{
  const Points points = joined(cube(8000), saddle(8000));
  pds::Options options;
  options.relax = 3;
  options.threads = 1;
  const pds::Reconstruction reference = reconstruct(points, options);
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0U);
  Random(3).shuffle(order);
  Points shuffled;
  for (const std::uint32_t i : order) shuffled.push_back(points[i]);
  options.threads = 3;
  const pds::Reconstruction other = reconstruct(shuffled, options);
  EXPECT_EQ(vertex_positions(other, shuffled), vertex_positions(reference, points));
  EXPECT_EQ(other.triangles, reference.triangles);
}

}  // namespace
}  // namespace pds_test
