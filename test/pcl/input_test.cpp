// SPDX-License-Identifier: BSD-3-Clause
// What PoissonDiskReconstruction takes in: subsets, invalid points, organised clouds.
#include <pcl/common/io.h>

#include <limits>
#include <numeric>

#include "test_clouds.h"

namespace pcl_test
{
namespace
{

using pcl::PointXYZ;
using pcl::PoissonDiskStatus;
using Reconstruction = pcl::PoissonDiskReconstruction<PointXYZ>;

TEST(PoissonDiskReconstructionIndices, SubsetEqualsACloudOfItsOwn)
{
  const auto cloud = makeSphere<PointXYZ>();
  const pcl::IndicesPtr indices = upperHalfTwice(*cloud);
  const pcl::Indices untouched = *indices;
  Reconstruction reconstruction;
  reconstruction.setInputCloud(cloud);
  reconstruction.setIndices(indices);
  const Outcome outcome = reconstruct(reconstruction);
  EXPECT_EQ(*indices, untouched);
  EXPECT_EQ(reconstruction.getIndices(), indices);

  const std::set<pcl::index_t> chosen(indices->begin(), indices->end());
  const pcl::Indices sorted(chosen.begin(), chosen.end());
  const pcl::PointCloud<PointXYZ>::Ptr half(new pcl::PointCloud<PointXYZ>(*cloud, sorted));
  const Outcome expected = reconstructFresh<PointXYZ>(half);
  ASSERT_FALSE(expected.mesh.empty());
  EXPECT_EQ(outcome.mesh, renumbered(expected.mesh, sorted));
  for (std::size_t row = 0; row < sorted.size(); ++row) {
    EXPECT_EQ(outcome.labels[static_cast<std::size_t>(sorted[row])], expected.labels[row]);
  }
  const auto& distances = reconstruction.getVoronoiDistances();
  ASSERT_EQ(outcome.labels.size(), cloud->size());
  ASSERT_EQ(distances.size(), cloud->size());
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    const bool takes_part = chosen.count(static_cast<pcl::index_t>(i)) == 1;
    EXPECT_EQ(outcome.labels[i] != pcl::UNAVAILABLE, takes_part);
    EXPECT_EQ(!std::isnan(distances[i]), takes_part);
  }
  for (const pcl::index_t witness : outcome.witnesses) EXPECT_EQ(chosen.count(witness), 1u);
}

TEST(PoissonDiskReconstructionIndices, OutOfRangeIsAnErrorOfThatRunOnly)
{
  const auto cloud = makeSphere<PointXYZ>();
  const Outcome expected = reconstructFresh<PointXYZ>(cloud);
  for (const pcl::index_t wrong :
       {static_cast<pcl::index_t>(cloud->size()), -1, std::numeric_limits<pcl::index_t>::max()}) {
    const pcl::IndicesPtr indices(new pcl::Indices(cloud->size()));
    std::iota(indices->begin(), indices->end(), 0);
    indices->push_back(wrong);
    const pcl::Indices untouched = *indices;
    Reconstruction reconstruction;
    reconstruction.setInputCloud(cloud);
    reconstruction.setIndices(indices);
    EXPECT_TRUE(reconstruct(reconstruction).mesh.empty());
    EXPECT_EQ(reconstruction.getStatus(), PoissonDiskStatus::invalid_indices);
    EXPECT_NE(reconstruction.getStatusMessage().find(std::to_string(wrong)), std::string::npos);
    EXPECT_EQ(*indices, untouched);

    indices->pop_back();
    EXPECT_TRUE(reconstruct(reconstruction) == expected);
  }
}

TEST(PoissonDiskReconstructionIndices, EmptySelectionGivesAnEmptyMesh)
{
  Reconstruction reconstruction;
  reconstruction.setInputCloud(makeSphere<PointXYZ>());
  reconstruction.setIndices(pcl::IndicesPtr(new pcl::Indices));
  EXPECT_TRUE(reconstruct(reconstruction).mesh.empty());
  EXPECT_EQ(reconstruction.getStatus(), PoissonDiskStatus::success);
  EXPECT_EQ(reconstruction.getVoronoiLabels(),
            std::vector<pcl::index_t>(default_size, static_cast<pcl::index_t>(pcl::UNAVAILABLE)));
}

TEST(PoissonDiskReconstructionIndices, BlockOfAnOrganizedCloud)
{
  const auto wall = makeOrganizedWall(120, 90);
  Reconstruction reconstruction;
  reconstruction.setInputCloud(wall);
  reconstruction.setIndices(10, 20, 60, 80);  // rows from 10, columns from 20
  std::vector<pcl::Vertices> polygons;
  reconstruction.reconstruct(polygons);
  expectSurface(polygons);
  for (const pcl::index_t seed : reconstruction.getSeedIndices()) {
    EXPECT_TRUE(seed / 120 >= 10 && seed / 120 < 70 && seed % 120 >= 20 && seed % 120 < 100) << seed;
  }
}

TEST(PoissonDiskReconstructionInput, SkipsInvalidPointsWhateverIsDenseSays)
{
  const auto clean = makeSphere<PointXYZ>();
  const Outcome expected = reconstructFresh<PointXYZ>(clean);
  const pcl::PointCloud<PointXYZ>::Ptr dirty(new pcl::PointCloud<PointXYZ>);
  pcl::Indices dirty_index;
  const float invalid[] = {std::nanf(""), std::numeric_limits<float>::infinity()};
  for (std::size_t i = 0; i < clean->size(); ++i) {
    if (i % 7 == 0) dirty->push_back(PointXYZ(0.0f, invalid[i % 2], 0.0f));
    dirty_index.push_back(static_cast<pcl::index_t>(dirty->size()));
    dirty->push_back((*clean)[i]);
  }
  dirty->is_dense = true;
  Reconstruction reconstruction;
  reconstruction.setInputCloud(dirty);
  const Outcome outcome = reconstruct(reconstruction);
  EXPECT_EQ(outcome.mesh, renumbered(expected.mesh, dirty_index));
  EXPECT_EQ(reconstruction.getReport().input_points, dirty->size());
  EXPECT_EQ(reconstruction.getReport().valid_points, clean->size());
  EXPECT_EQ(outcome.labels.front(), pcl::UNAVAILABLE);
  EXPECT_TRUE(std::isnan(reconstruction.getVoronoiDistances().front()));
}

TEST(PoissonDiskReconstructionInput, OnlyInvalidPointsGiveAnEmptyMesh)
{
  const auto cloud = makeSphere<PointXYZ>(100);
  for (PointXYZ& point : *cloud) point.x = std::nanf("");
  const Outcome outcome = reconstructFresh<PointXYZ>(cloud);
  EXPECT_EQ(outcome.status, PoissonDiskStatus::success);
  EXPECT_TRUE(outcome.mesh.empty());
}

TEST(PoissonDiskReconstructionInput, OrganizedEqualsUnorganized)
{
  const auto wall = makeOrganizedWall(100, 80);
  const pcl::PointCloud<PointXYZ>::Ptr unorganized(new pcl::PointCloud<PointXYZ>(*wall));
  unorganized->width = static_cast<std::uint32_t>(wall->size());
  unorganized->height = 1;
  const Outcome outcome = reconstructFresh<PointXYZ>(wall);
  EXPECT_FALSE(outcome.mesh.empty());
  EXPECT_TRUE(outcome == reconstructFresh<PointXYZ>(unorganized));
}

// Points added to cloud.points leave width and height behind; PCL's own conversion aborts on that.
TEST(PoissonDiskReconstructionInput, StaleWidthDoesNotMatter)
{
  const auto cloud = makeSphere<PointXYZ>();
  const Outcome expected = reconstructFresh<PointXYZ>(cloud);
  cloud->width = 1;
  Reconstruction reconstruction;
  reconstruction.setInputCloud(cloud);
  pcl::PolygonMesh mesh;
  reconstruction.reconstruct(mesh);
  EXPECT_EQ(renumbered(triangles(mesh.polygons), expected.seeds), expected.mesh);
}

// PCL's point types cannot be told apart by their fields at compile time alone; a wrong layout must not be read as one.
TEST(PoissonDiskAdapter, RejectsCoordinatesThatAreNotSideBySide)
{
  const auto cloud = makeSphere<PointXYZ>(100);
  pcl::detail::PointRecords records;
  records.data = reinterpret_cast<const std::uint8_t*>(cloud->points.data());
  records.stride = sizeof(PointXYZ);
  records.size = cloud->size();
  records.fields = pcl::getFields<PointXYZ>();
  EXPECT_EQ(pcl::detail::reconstructPoissonDisk(records, nullptr, {}, {}, {}).status, PoissonDiskStatus::success);
  std::swap(records.fields[0].name, records.fields[1].name);
  const auto result = pcl::detail::reconstructPoissonDisk(records, nullptr, {}, {}, {});
  EXPECT_EQ(result.status, PoissonDiskStatus::invalid_input);
  EXPECT_FALSE(result.message.empty());
}

}  // namespace
}  // namespace pcl_test
