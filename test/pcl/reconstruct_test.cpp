// SPDX-License-Identifier: BSD-3-Clause
// What PoissonDiskReconstruction gives back, and that it behaves as PCL's other surface classes do.
#include <pcl/conversions.h>

#include <boost/preprocessor/seq/enum.hpp>
#include <thread>

#include "test_clouds.h"

namespace pcl_test
{
namespace
{

using pcl::PointXYZ;
using pcl::PoissonDiskStatus;
using Reconstruction = pcl::PoissonDiskReconstruction<PointXYZ>;

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
  cloud->push_back(PointXYZ(std::nanf(""), 0.0f, 0.0f));
  cloud->is_dense = false;
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
  constexpr float spacing = 0.1F;
  pcl::PointCloud<PointXYZ>::Ptr cloud(new pcl::PointCloud<PointXYZ>);
  for (int row = 0; row < 20; ++row) {
    for (int column = 0; column < 25; ++column) {
      const auto x = static_cast<float>(column);
      const auto y = static_cast<float>(row);
      cloud->push_back(PointXYZ(spacing * x, spacing * y, 0.01F * x * y * spacing));
    }
  }
  Reconstruction reconstruction;
  reconstruction.setInputCloud(cloud);
  reconstruction.setRadius(0.9 * static_cast<double>(spacing));
  pcl::PolygonMesh mesh;
  reconstruction.reconstruct(mesh);
  ASSERT_EQ(reconstruction.getAllSeedIndices().size(), cloud->size());
  pcl::PointCloud<PointXYZ> vertices;
  pcl::fromPCLPointCloud2(mesh.cloud, vertices);

  const pcl::Indices& seeds = reconstruction.getSeedIndices();
  ASSERT_GT(seeds.size(), 0U);
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
  using Base = pcl::MeshConstruction<PointXYZ>;
  const Base::Ptr base(new Reconstruction);
  base->setInputCloud(cloud);
  std::vector<pcl::Vertices> polygons;
  base->reconstruct(polygons);
  EXPECT_EQ(triangles(polygons), expected.mesh);

  pcl::PolygonMesh mesh;
  static_cast<pcl::PCLSurfaceBase<PointXYZ>&>(*base).reconstruct(mesh);
  EXPECT_EQ(renumbered(triangles(mesh.polygons), expected.seeds), expected.mesh);

  // By its full name the base's own function runs, which prepares the output in another way and may choose a tree.
  mesh.polygons = stalePolygons();
  base->Base::reconstruct(mesh);
  EXPECT_EQ(renumbered(triangles(mesh.polygons), expected.seeds), expected.mesh);
  EXPECT_EQ(base->getSearchMethod(), nullptr);
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

// Copies share the indices that the base class makes up and resizes in place.
TEST(PoissonDiskReconstruction, ACopiedObjectDoesNotTouchTheIndicesOfTheOther)
{
  Reconstruction first;
  first.setInputCloud(makeSphere<PointXYZ>(3000));
  reconstruct(first);
  Reconstruction second = first;
  second.setInputCloud(makeSphere<PointXYZ>(2000));
  reconstruct(second);
  EXPECT_EQ(first.getIndices()->size(), 3000u);
  EXPECT_EQ(second.getIndices()->size(), 2000u);
}

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
