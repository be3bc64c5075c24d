// SPDX-License-Identifier: BSD-3-Clause
// What PoissonDiskReconstruction gives back, and that it behaves as PCL's other surface classes do.
#include <pcl/conversions.h>

#include <boost/preprocessor/seq/enum.hpp>
#include <stdexcept>
#include <string>
#include <thread>

#include "test_clouds.h"

namespace pcl_test
{
namespace
{

using pcl::PointXYZ;
using pcl::PoissonDiskStatus;
using Reconstruction = pcl::PoissonDiskReconstruction<PointXYZ>;

/** \brief Output that a careless caller passes in again. */
std::vector<pcl::Vertices> stalePolygons()
{
  pcl::Vertices stale;
  stale.vertices = {123456, 234567, 345678};
  return {stale, stale};
}

TEST(PoissonDiskReconstruction, BothOverloadsDescribeTheSameTriangles)
{
  const auto cloud = makeSphere<PointXYZ>();
  Reconstruction reconstruction;
  reconstruction.setInputCloud(cloud);
  pcl::PolygonMesh mesh;
  reconstruction.reconstruct(mesh);
  const pcl::Indices seeds = reconstruction.getSeedIndices();
  std::vector<pcl::Vertices> polygons;
  reconstruction.reconstruct(polygons);

  expectClosedSurface(mesh.polygons);
  EXPECT_EQ(renumbered(triangles(mesh.polygons), seeds), triangles(polygons));
  EXPECT_EQ(reconstruction.getSeedIndices(), seeds);
}

TEST(PoissonDiskReconstruction, MeshHoldsTheSeedsAndNothingElse)
{
  const auto cloud = makeSphere<PointXYZ>();
  Reconstruction reconstruction;
  reconstruction.setInputCloud(cloud);
  pcl::PolygonMesh mesh;
  reconstruction.reconstruct(mesh);
  pcl::PointCloud<PointXYZ> vertices;
  pcl::fromPCLPointCloud2(mesh.cloud, vertices);

  const pcl::Indices& seeds = reconstruction.getSeedIndices();
  ASSERT_EQ(vertices.size(), seeds.size());
  EXPECT_TRUE(vertices.is_dense);
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    EXPECT_EQ(vertices[i].getVector3fMap(), cloud->at(static_cast<std::size_t>(seeds[i])).getVector3fMap());
  }
  std::set<pcl::index_t> used;
  for (const Triangle& triangle : triangles(mesh.polygons)) used.insert(triangle.begin(), triangle.end());
  EXPECT_EQ(used.size(), vertices.size()) << "a vertex without a triangle, or the other way round";
}

// pcl::copyPointCloud ignores the order of the indices in this case.
TEST(PoissonDiskReconstruction, KeepsTheOrderIfEveryPointIsASeed)
{
  const auto cloud = makeSphere<PointXYZ>(500);
  Reconstruction reconstruction;
  reconstruction.setInputCloud(cloud);
  reconstruction.setRadius(1e-6);
  pcl::PolygonMesh mesh;
  reconstruction.reconstruct(mesh);
  ASSERT_EQ(reconstruction.getAllSeedIndices().size(), cloud->size());
  pcl::PointCloud<PointXYZ> vertices;
  pcl::fromPCLPointCloud2(mesh.cloud, vertices);

  const pcl::Indices& seeds = reconstruction.getSeedIndices();
  ASSERT_EQ(vertices.size(), seeds.size());
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    EXPECT_EQ(vertices[i].getVector3fMap(), cloud->at(static_cast<std::size_t>(seeds[i])).getVector3fMap());
  }
}

TEST(PoissonDiskReconstruction, ReplacesStaleOutput)
{
  const auto cloud = makeSphere<PointXYZ>();
  const Outcome expected = reconstructFresh<PointXYZ>(cloud);
  Reconstruction reconstruction;
  reconstruction.setInputCloud(cloud);
  std::vector<pcl::Vertices> polygons = stalePolygons();
  reconstruction.reconstruct(polygons);
  EXPECT_EQ(triangles(polygons), expected.mesh);

  pcl::PolygonMesh mesh;
  mesh.polygons = stalePolygons();
  reconstruction.reconstruct(mesh);
  EXPECT_EQ(renumbered(triangles(mesh.polygons), expected.seeds), expected.mesh);
}

TEST(PoissonDiskReconstruction, CopiesTheHeader)
{
  const auto cloud = makeSphere<PointXYZ>();
  cloud->header.frame_id = "scanner";
  cloud->header.stamp = 42;
  cloud->header.seq = 7;
  Reconstruction reconstruction;
  reconstruction.setInputCloud(cloud);
  pcl::PolygonMesh mesh;
  reconstruction.reconstruct(mesh);
  for (const pcl::PCLHeader& header : {mesh.header, mesh.cloud.header}) {
    EXPECT_EQ(header.frame_id, "scanner");
    EXPECT_EQ(header.stamp, 42u);
    EXPECT_EQ(header.seq, 7u);
  }
}

TEST(PoissonDiskReconstruction, WorksThroughPointersToItsBases)
{
  const auto cloud = makeSphere<PointXYZ>();
  const Outcome expected = reconstructFresh<PointXYZ>(cloud);
  const pcl::MeshConstruction<PointXYZ>::Ptr base(new Reconstruction);
  base->setInputCloud(cloud);
  std::vector<pcl::Vertices> polygons;
  base->reconstruct(polygons);
  EXPECT_EQ(triangles(polygons), expected.mesh);

  pcl::PolygonMesh mesh;
  static_cast<pcl::PCLSurfaceBase<PointXYZ>&>(*base).reconstruct(mesh);
  EXPECT_EQ(renumbered(triangles(mesh.polygons), expected.seeds), expected.mesh);
}

TEST(PoissonDiskReconstruction, ReportsMissingInput)
{
  Reconstruction reconstruction;
  EXPECT_EQ(reconstruction.getStatus(), PoissonDiskStatus::not_run);
  pcl::PolygonMesh mesh;
  mesh.polygons = stalePolygons();
  reconstruction.reconstruct(mesh);
  EXPECT_EQ(reconstruction.getStatus(), PoissonDiskStatus::no_input);
  EXPECT_FALSE(reconstruction.getStatusMessage().empty());
  EXPECT_TRUE(mesh.polygons.empty());

  std::vector<pcl::Vertices> polygons = stalePolygons();
  static_cast<pcl::MeshConstruction<PointXYZ>&>(reconstruction).reconstruct(polygons);
  EXPECT_EQ(reconstruction.getStatus(), PoissonDiskStatus::no_input);
  EXPECT_TRUE(polygons.empty());
}

TEST(PoissonDiskReconstruction, TooFewPointsGiveAnEmptyMesh)
{
  for (const std::size_t size : {0u, 1u, 2u}) {
    const auto cloud = makeSphere<PointXYZ>(size);
    Reconstruction reconstruction;
    reconstruction.setInputCloud(cloud);
    pcl::PolygonMesh mesh;
    mesh.polygons = stalePolygons();
    reconstruction.reconstruct(mesh);
    EXPECT_EQ(reconstruction.getStatus(), PoissonDiskStatus::success) << size;
    EXPECT_TRUE(mesh.polygons.empty()) << size;
    EXPECT_EQ(mesh.cloud.width * mesh.cloud.height, 0u) << size;
    EXPECT_EQ(reconstruction.getVoronoiLabels().size(), size);
    EXPECT_EQ(reconstruction.getVoronoiDistances().size(), size);
  }
}

TEST(PoissonDiskReconstruction, WrongSettingsGiveAStatusAndNoMesh)
{
  using Setting = std::pair<const char*, void (*)(Reconstruction&)>;
  const Setting wrong_settings[] = {
      {"k", [](Reconstruction& r) { r.setKSearch(0); }},
      {"radius factor", [](Reconstruction& r) { r.setRadiusFactor(-1.0); }},
      {"radius", [](Reconstruction& r) { r.setRadius(std::nan("")); }},
      {"adaptive", [](Reconstruction& r) { r.setAdaptiveCoefficient(-0.1); }},
      {"voronoi threshold", [](Reconstruction& r) { r.setVoronoiThreshold(2.0); }},
      {"hole size", [](Reconstruction& r) { r.setHoleSize(-1.0); }},
  };
  const auto cloud = makeSphere<PointXYZ>(2000);
  for (const auto& [name, set_wrong] : wrong_settings) {
    Reconstruction reconstruction;
    reconstruction.setInputCloud(cloud);
    std::vector<pcl::Vertices> polygons;
    reconstruction.reconstruct(polygons);
    ASSERT_EQ(reconstruction.getStatus(), PoissonDiskStatus::success) << name;

    set_wrong(reconstruction);
    reconstruction.reconstruct(polygons);
    EXPECT_EQ(reconstruction.getStatus(), PoissonDiskStatus::invalid_option) << name;
    EXPECT_FALSE(reconstruction.getStatusMessage().empty()) << name;
    EXPECT_TRUE(polygons.empty()) << name;
    EXPECT_TRUE(reconstruction.getSeedIndices().empty()) << name << ": result of the run before";
    EXPECT_TRUE(reconstruction.getVoronoiLabels().empty()) << name << ": result of the run before";
    EXPECT_EQ(reconstruction.getReport().faces, 0u) << name << ": result of the run before";
  }
}

TEST(PoissonDiskReconstruction, SettersAndGettersAgreeAndRunsKeepSettings)
{
  Reconstruction reconstruction;
  const pds::Options defaults;
  EXPECT_EQ(reconstruction.getKSearch(), defaults.k_neighbors);
  EXPECT_EQ(reconstruction.getRadiusFactor(), defaults.radius_factor);
  EXPECT_EQ(reconstruction.getRadius(), defaults.radius);
  EXPECT_EQ(reconstruction.getAdaptiveCoefficient(), defaults.adaptive);
  EXPECT_EQ(reconstruction.getVoronoiThreshold(), defaults.voronoi_threshold);
  EXPECT_EQ(reconstruction.getHoleSize(), defaults.hole_size);
  EXPECT_EQ(reconstruction.getGeodesicSolver(), defaults.geodesic_solver);
  EXPECT_EQ(reconstruction.getNumberOfThreads(), defaults.threads);
  EXPECT_EQ(reconstruction.getSeed(), defaults.seed);

  reconstruction.setKSearch(12);
  reconstruction.setRadiusFactor(2.5);
  reconstruction.setRadius(0.2);
  reconstruction.setAdaptiveCoefficient(0.1);
  reconstruction.setVoronoiThreshold(0.2);
  reconstruction.setHoleSize(12.0);
  reconstruction.setGeodesicSolver(Reconstruction::GeodesicSolver::dijkstra);
  reconstruction.setNumberOfThreads(2);
  reconstruction.setSeed(99);
  reconstruction.setInputCloud(makeSphere<PointXYZ>());
  std::vector<pcl::Vertices> polygons;
  reconstruction.reconstruct(polygons);
  ASSERT_EQ(reconstruction.getStatus(), PoissonDiskStatus::success);

  EXPECT_EQ(reconstruction.getKSearch(), 12);
  EXPECT_EQ(reconstruction.getRadiusFactor(), 2.5);
  EXPECT_EQ(reconstruction.getRadius(), 0.2);
  EXPECT_EQ(reconstruction.getAdaptiveCoefficient(), 0.1);
  EXPECT_EQ(reconstruction.getVoronoiThreshold(), 0.2);
  EXPECT_EQ(reconstruction.getHoleSize(), 12.0);
  EXPECT_EQ(reconstruction.getGeodesicSolver(), Reconstruction::GeodesicSolver::dijkstra);
  EXPECT_EQ(reconstruction.getNumberOfThreads(), 2u);
  EXPECT_EQ(reconstruction.getSeed(), 99u);
  EXPECT_EQ(reconstruction.getSearchMethod(), nullptr);
  // The settings reached the core.
  EXPECT_EQ(reconstruction.getReport().k, 12);
  EXPECT_DOUBLE_EQ(reconstruction.getReport().radius, 0.2);
  EXPECT_EQ(reconstruction.getReport().threads, 2u);
  reconstruction.setNumberOfThreads();
  EXPECT_EQ(reconstruction.getNumberOfThreads(), 0u);
}

TEST(PoissonDiskReconstruction, ReuseEqualsAFreshObject)
{
  const auto wall = makeOrganizedWall(100, 80);
  const auto sphere = makeSphere<PointXYZ>();
  const auto small_sphere = makeSphere<PointXYZ>(3000, 5);
  Reconstruction reused;
  for (const auto& cloud : {wall, sphere, small_sphere, sphere, wall}) {
    reused.setInputCloud(cloud);
    const Outcome outcome = reconstruct(reused);
    EXPECT_EQ(outcome.status, PoissonDiskStatus::success);
    EXPECT_FALSE(outcome.mesh.empty());
    EXPECT_TRUE(outcome == reconstructFresh<PointXYZ>(cloud));
  }
}

// The copy shares the indices that the base class makes up; clouds of different size would make both resize them.
TEST(PoissonDiskReconstruction, TwoThreadsAndACopiedObjectDoNotDisturbEachOther)
{
  const auto sphere = makeSphere<PointXYZ>();
  const auto square = makeSquare<PointXYZ>(6000);
  const Outcome expected_sphere = reconstructFresh<PointXYZ>(sphere);
  const Outcome expected_square = reconstructFresh<PointXYZ>(square);

  Reconstruction first;
  first.setInputCloud(sphere);
  reconstruct(first);
  Reconstruction second = first;
  second.setInputCloud(square);
  constexpr int rounds = 4;
  const auto run = [](Reconstruction& reconstruction, const Outcome& expected, int& equal) {
    for (int i = 0; i < rounds; ++i) equal += reconstruct(reconstruction) == expected ? 1 : 0;
  };
  int equal_spheres = 0;
  int equal_squares = 0;
  std::thread thread(run, std::ref(first), std::cref(expected_sphere), std::ref(equal_spheres));
  run(second, expected_square, equal_squares);
  thread.join();
  EXPECT_EQ(equal_spheres, rounds);
  EXPECT_EQ(equal_squares, rounds);
}

TEST(PoissonDiskReconstruction, VoronoiDiagramBelongsToTheSeeds)
{
  const auto cloud = makeSphere<PointXYZ>();
  Reconstruction reconstruction;
  reconstruction.setInputCloud(cloud);
  pcl::PolygonMesh mesh;
  reconstruction.reconstruct(mesh);
  const pcl::Indices& seeds = reconstruction.getAllSeedIndices();
  const auto& labels = reconstruction.getVoronoiLabels();
  const auto& distances = reconstruction.getVoronoiDistances();
  ASSERT_EQ(labels.size(), cloud->size());
  ASSERT_EQ(distances.size(), cloud->size());

  const double radius = reconstruction.getReport().radius;
  const double rounding = 1e-5 * radius;
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    ASSERT_GE(labels[i], 0);
    ASSERT_LT(static_cast<std::size_t>(labels[i]), seeds.size());
    const PointXYZ& seed = cloud->at(static_cast<std::size_t>(seeds[static_cast<std::size_t>(labels[i])]));
    const double chord = (seed.getVector3fMap() - (*cloud)[i].getVector3fMap()).norm();
    EXPECT_GE(distances[i], chord - rounding);
    EXPECT_LE(distances[i], radius + rounding);
  }
  for (std::size_t seed = 0; seed < seeds.size(); ++seed) {
    EXPECT_EQ(labels[static_cast<std::size_t>(seeds[seed])], static_cast<pcl::index_t>(seed));
    EXPECT_EQ(distances[static_cast<std::size_t>(seeds[seed])], 0.0f);
  }
  const pcl::Indices& used = reconstruction.getSeedIndices();
  ASSERT_LE(used.size(), seeds.size());
  EXPECT_TRUE(std::equal(used.begin(), used.end(), seeds.begin()));

  const pcl::Indices& witnesses = reconstruction.getWitnessPoints();
  EXPECT_FALSE(witnesses.empty());
  EXPECT_TRUE(std::is_sorted(witnesses.begin(), witnesses.end()));
  EXPECT_LT(static_cast<std::size_t>(witnesses.back()), cloud->size());
}

TEST(PoissonDiskReconstruction, BoundaryLoopRunsAlongTheRim)
{
  Reconstruction reconstruction;
  reconstruction.setInputCloud(makeSquare<PointXYZ>());
  pcl::PolygonMesh mesh;
  reconstruction.reconstruct(mesh);
  ASSERT_EQ(reconstruction.getBoundaryLoops().size(), 1u);
  DirectedEdges rim;
  const DirectedEdges edges = directedEdges(triangles(mesh.polygons));
  for (const auto& edge : edges) {
    if (edges.count({edge.second, edge.first}) == 0) rim.insert(edge);
  }
  const pcl::Indices& loop = reconstruction.getBoundaryLoops().front();
  DirectedEdges loop_edges;
  for (std::size_t i = 0; i < loop.size(); ++i) loop_edges.insert({loop[i], loop[(i + 1) % loop.size()]});
  EXPECT_EQ(loop_edges, rim);
}

TEST(PoissonDiskReconstruction, ReportsProgressAndSurvivesAThrowingCallback)
{
  Reconstruction reconstruction;
  reconstruction.setInputCloud(makeSphere<PointXYZ>());
  std::vector<double> fractions;
  reconstruction.setProgressCallback([&](const char* stage, double fraction) {
    EXPECT_STRNE(stage, "");
    fractions.push_back(fraction);
  });
  std::vector<pcl::Vertices> polygons;
  reconstruction.reconstruct(polygons);
  ASSERT_GE(fractions.size(), 3u);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_GE(fractions.front(), 0.0);
  EXPECT_LE(fractions.back(), 1.0);

  reconstruction.setProgressCallback([](const char*, double) { throw std::runtime_error("cancelled by the user"); });
  reconstruction.reconstruct(polygons);
  EXPECT_EQ(reconstruction.getStatus(), PoissonDiskStatus::failed);
  EXPECT_EQ(reconstruction.getStatusMessage(), "cancelled by the user");
  EXPECT_TRUE(polygons.empty());
}

template <typename PointT>
class EveryPointType : public ::testing::Test
{
};
using XyzPointTypes = ::testing::Types<BOOST_PP_SEQ_ENUM(PCL_XYZ_POINT_TYPES)>;
TYPED_TEST_SUITE(EveryPointType, XyzPointTypes);

// Links only if the library holds the instantiation: this file does not see the implementation.
TYPED_TEST(EveryPointType, IsPrecompiled)
{
  pcl::PoissonDiskReconstruction<TypeParam> reconstruction;
  reconstruction.setInputCloud(makeSphere<TypeParam>(3000));
  pcl::PolygonMesh mesh;
  reconstruction.reconstruct(mesh);
  expectClosedSurface(mesh.polygons);
}

}  // namespace
}  // namespace pcl_test
