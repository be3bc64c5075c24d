// SPDX-License-Identifier: BSD-3-Clause
// Point fields are carried to the mesh, decide between coincident points, and orient open surfaces.
#include <pcl/common/io.h>

#include <cstring>

#include "test_clouds.h"

namespace pcl_test
{
namespace
{

using pcl::PointXYZ;

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

TEST(PoissonDiskReconstructionFields, QuadricPlacementTakesMeansOverCells)
{
  const auto cloud = makeSphere<pcl::PointXYZRGBNormal>();
  for (auto& point : *cloud) {
    point.getNormalVector3fMap() = point.getVector3fMap();
    point.r = point.x > 0 ? 255 : 1;
    point.a = 7;
    point.curvature = point.z;
  }
  pcl::PoissonDiskReconstruction<pcl::PointXYZRGBNormal> reconstruction;
  reconstruction.setInputCloud(cloud);
  reconstruction.setPlacement(pds::Placement::quadric);
  pcl::PolygonMesh mesh;
  reconstruction.reconstruct(mesh);
  expectClosedSurface(mesh.polygons);
  pcl::PointCloud<pcl::PointXYZRGBNormal> vertices;
  pcl::fromPCLPointCloud2(mesh.cloud, vertices);
  ASSERT_EQ(vertices.size(), reconstruction.getSeedIndices().size());
  std::vector<double> curvature(vertices.size());
  std::vector<double> red(vertices.size());
  std::vector<double> points(vertices.size());
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    const auto cell = static_cast<std::size_t>(reconstruction.getVoronoiLabels()[i]);
    if (cell >= vertices.size()) continue;
    curvature[cell] += static_cast<double>((*cloud)[i].curvature);
    red[cell] += (*cloud)[i].r;
    ++points[cell];
  }
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    EXPECT_NEAR(vertices[v].curvature, curvature[v] / points[v], 1e-6);
    EXPECT_NEAR(vertices[v].r, red[v] / points[v], 0.5001);
    EXPECT_EQ(vertices[v].a, 7);
    EXPECT_NEAR(vertices[v].getNormalVector3fMap().norm(), 1.0f, 1e-5f);
    EXPECT_GT(vertices[v].getNormalVector3fMap().dot(vertices[v].getVector3fMap()), 0.95f);
  }
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

TEST(PoissonDiskReconstructionOrientation, FacesTheViewpointsOfThePoints)
{
  const auto square = makeSquare<pcl::PointWithViewpoint>();
  square->sensor_origin_ << 0.0f, 0.0f, -10.0f, 0.0f;  // the points' own viewpoints outweigh it
  for (const float height : {10.0f, -10.0f}) {
    for (auto& point : *square) point.vp_z = height;
    EXPECT_GT(height * upwardArea(*square), 30.0);
  }
}

}  // namespace
}  // namespace pcl_test
