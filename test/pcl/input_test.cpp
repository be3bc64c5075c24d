// SPDX-License-Identifier: BSD-3-Clause
// What PoissonDiskReconstruction takes in: subsets, invalid points, point fields, orientation hints.
#include <pcl/common/io.h>
#include <pcl/conversions.h>

#include <cstring>
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

/** \brief Indices of the upper half of a cloud, each twice and in descending order. */
pcl::IndicesPtr upperHalfTwice(const pcl::PointCloud<PointXYZ>& cloud)
{
  pcl::IndicesPtr indices(new pcl::Indices);
  for (std::size_t i = cloud.size(); i-- > 0;) {
    if (cloud[i].z > 0.0f) indices->insert(indices->end(), 2, static_cast<pcl::index_t>(i));
  }
  return indices;
}

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

/** \brief Expects that every vertex has all the fields of the input point that it is. */
template <typename PointT>
void expectAllFieldsCarried(const pcl::PointCloud<PointT>& cloud,
                            const pcl::PolygonMesh& mesh,
                            const pcl::Indices& seeds)
{
  const std::vector<pcl::PCLPointField> fields = pcl::getFields<PointT>();
  ASSERT_EQ(mesh.cloud.fields.size(), fields.size());
  ASSERT_EQ(mesh.cloud.width * mesh.cloud.height, seeds.size());
  ASSERT_FALSE(seeds.empty());
  for (std::size_t f = 0; f < fields.size(); ++f) {
    const pcl::PCLPointField& field = mesh.cloud.fields[f];
    EXPECT_EQ(field.name, fields[f].name);
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      const auto* expected = reinterpret_cast<const std::uint8_t*>(&cloud[static_cast<std::size_t>(seeds[i])]);
      const std::uint8_t* vertex = &mesh.cloud.data[i * mesh.cloud.point_step];
      const auto bytes = static_cast<std::size_t>(pcl::getFieldSize(field.datatype));
      EXPECT_EQ(std::memcmp(vertex + field.offset, expected + fields[f].offset, bytes), 0) << field.name;
    }
  }
}

TEST(PoissonDiskReconstructionFields, ColourAndNormalsAreCarried)
{
  const auto cloud = makeSphere<pcl::PointXYZRGBNormal>();
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    auto& point = (*cloud)[i];
    point.getNormalVector3fMap() = point.getVector3fMap();
    point.rgba = static_cast<std::uint32_t>(0x12345 * i);
    point.curvature = static_cast<float>(i);
  }
  pcl::PoissonDiskReconstruction<pcl::PointXYZRGBNormal> reconstruction;
  reconstruction.setInputCloud(cloud);
  pcl::PolygonMesh mesh;
  reconstruction.reconstruct(mesh);
  expectClosedSurface(mesh.polygons);
  expectAllFieldsCarried(*cloud, mesh, reconstruction.getSeedIndices());
}

TEST(PoissonDiskReconstructionFields, IntensityIsCarried)
{
  const auto cloud = makeSphere<pcl::PointXYZI>();
  for (std::size_t i = 0; i < cloud->size(); ++i) (*cloud)[i].intensity = static_cast<float>(i) + 0.5f;
  pcl::PoissonDiskReconstruction<pcl::PointXYZI> reconstruction;
  reconstruction.setInputCloud(cloud);
  pcl::PolygonMesh mesh;
  reconstruction.reconstruct(mesh);
  expectClosedSurface(mesh.polygons);
  expectAllFieldsCarried(*cloud, mesh, reconstruction.getSeedIndices());
}

/** \brief Every point of a sphere twice, with two intensities, in one of two orders; padding as the engine has it. */
pcl::PointCloud<pcl::PointXYZI>::Ptr makeDoubledSphere(bool reversed, std::uint32_t padding_seed)
{
  const auto sphere = makeSphere<pcl::PointXYZI>(5000);
  const pcl::PointCloud<pcl::PointXYZI>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZI>);
  std::mt19937 engine(padding_seed);
  for (pcl::PointXYZI point : *sphere) {
    for (const float intensity : {1.0f, 2.0f}) {
      point.data[3] = static_cast<float>(symmetricUniform(engine));
      for (int i = 1; i < 4; ++i) point.data_c[i] = static_cast<float>(symmetricUniform(engine));
      point.intensity = intensity;
      cloud->push_back(point);
    }
  }
  if (reversed) std::reverse(cloud->begin(), cloud->end());
  return cloud;
}

TEST(PoissonDiskReconstructionFields, RepresentativeOfCoincidentPointsDependsOnFieldsAlone)
{
  using Record = std::array<float, 4>;
  const auto vertices = [](const pcl::PointCloud<pcl::PointXYZI>::Ptr& cloud) {
    std::vector<Record> records;
    for (const pcl::index_t seed : reconstructFresh<pcl::PointXYZI>(cloud).seeds) {
      const auto& point = (*cloud)[static_cast<std::size_t>(seed)];
      records.push_back({point.x, point.y, point.z, point.intensity});
    }
    return records;
  };
  const std::vector<Record> expected = vertices(makeDoubledSphere(false, 1));
  ASSERT_FALSE(expected.empty());
  EXPECT_EQ(vertices(makeDoubledSphere(false, 2)), expected) << "other padding";
  EXPECT_EQ(vertices(makeDoubledSphere(true, 3)), expected) << "other order";
}

/** \brief Sum of the z components of the triangles' area vectors: positive if they face up. */
template <typename PointT>
double upwardArea(const pcl::PointCloud<PointT>& cloud)
{
  double sum = 0.0;
  for (const Triangle& triangle : reconstructFresh<PointT>(cloud.makeShared()).mesh) {
    const Eigen::Vector3f a = cloud[static_cast<std::size_t>(triangle[0])].getVector3fMap();
    const Eigen::Vector3f b = cloud[static_cast<std::size_t>(triangle[1])].getVector3fMap();
    const Eigen::Vector3f c = cloud[static_cast<std::size_t>(triangle[2])].getVector3fMap();
    sum += 0.5 * static_cast<double>((b - a).cross(c - a).z());
  }
  return sum;
}

TEST(PoissonDiskReconstructionOrientation, FollowsTheNormals)
{
  const auto square = makeSquare<pcl::PointNormal>();
  square->sensor_origin_ << 0.0f, 0.0f, -10.0f, 0.0f;  // the normals outweigh it
  for (const float direction : {1.0f, -1.0f}) {
    for (auto& point : *square) point.normal_z = direction;
    EXPECT_GT(direction * upwardArea(*square), 3.0);  // of 4
  }
}

TEST(PoissonDiskReconstructionOrientation, FacesTheSensorWithoutNormals)
{
  const auto plain = makeSquare<PointXYZ>();
  const auto unset_normals = makeSquare<pcl::PointNormal>();
  for (const float height : {10.0f, -10.0f}) {
    plain->sensor_origin_ << 0.0f, 0.0f, height, 0.0f;
    unset_normals->sensor_origin_ = plain->sensor_origin_;
    EXPECT_GT(height * upwardArea(*plain), 30.0);
    EXPECT_GT(height * upwardArea(*unset_normals), 30.0) << "normals that nobody set are not normals";
  }
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
