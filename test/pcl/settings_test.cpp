// SPDX-License-Identifier: BSD-3-Clause
// Settings, and what happens when they or the input are wrong.
#include <stdexcept>
#include <string>

#include "test_clouds.h"

namespace pcl_test
{
namespace
{

using pcl::PointXYZ;
using pcl::PoissonDiskStatus;
using Reconstruction = pcl::PoissonDiskReconstruction<PointXYZ>;

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

TEST(PoissonDiskReconstruction, MissingInputLeavesNoResultOfTheRunBefore)
{
  Reconstruction reconstruction;
  reconstruction.setInputCloud(makeSphere<PointXYZ>());
  std::vector<pcl::Vertices> polygons;
  reconstruction.reconstruct(polygons);
  ASSERT_FALSE(reconstruction.getSeedIndices().empty());
  reconstruction.setInputCloud(nullptr);
  reconstruction.reconstruct(polygons);
  EXPECT_TRUE(polygons.empty());
  EXPECT_TRUE(reconstruction.getSeedIndices().empty());
  EXPECT_TRUE(reconstruction.getVoronoiLabels().empty());
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
  EXPECT_EQ(reconstruction.getNumberOfVertices(), defaults.vertices);
  EXPECT_EQ(reconstruction.getMaximumError(), defaults.max_error);
  EXPECT_EQ(reconstruction.getRelaxationSteps(), defaults.relax);
  EXPECT_EQ(reconstruction.getPlacement(), defaults.placement);
  EXPECT_EQ(reconstruction.getDimension(), defaults.dimension);
  EXPECT_EQ(reconstruction.getNumberOfThreads(), defaults.threads);
  EXPECT_EQ(reconstruction.getSeed(), defaults.seed);

  reconstruction.setKSearch(12);
  reconstruction.setRadiusFactor(2.5);
  reconstruction.setRadius(0.2);
  reconstruction.setAdaptiveCoefficient(0.1);
  reconstruction.setVoronoiThreshold(0.2);
  reconstruction.setHoleSize(12.0);
  reconstruction.setGeodesicSolver(Reconstruction::GeodesicSolver::dijkstra);
  reconstruction.setPlacement(Reconstruction::Placement::quadric);
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

  reconstruction.setNumberOfVertices(200);
  reconstruction.setRelaxationSteps(1);
  reconstruction.reconstruct(polygons);
  EXPECT_EQ(reconstruction.getRelaxationSteps(), 1u);
  EXPECT_NEAR(static_cast<double>(reconstruction.getReport().vertices), 200, 2);
  reconstruction.setNumberOfVertices(0);
  reconstruction.setMaximumError(0.02);
  reconstruction.reconstruct(polygons);
  EXPECT_EQ(reconstruction.getMaximumError(), 0.02);
  EXPECT_LE(reconstruction.getReport().p99_distance, 0.02);
  EXPECT_GT(reconstruction.getReport().p99_distance, 0.01);
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

}  // namespace
}  // namespace pcl_test
