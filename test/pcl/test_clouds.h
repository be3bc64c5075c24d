// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <pcl/PolygonMesh.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/surface/poisson_disk_reconstruction.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace pcl_test
{

using Triangle = std::array<pcl::index_t, 3>;

/** \brief Enough points for a few hundred vertices, few enough for a run of a tenth of a second. */
constexpr std::size_t default_size = 10000;

/** \brief Number in [-1, 1), the same with every standard library, unlike std::uniform_real_distribution. */
inline double symmetricUniform(std::mt19937& engine) { return static_cast<double>(engine()) / 2147483648.0 - 1.0; }

/** \brief Random points of the unit sphere. */
template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr makeSphere(std::size_t size = default_size, std::uint32_t seed = 1)
{
  typename pcl::PointCloud<PointT>::Ptr cloud(new pcl::PointCloud<PointT>);
  std::mt19937 engine(seed);
  while (cloud->size() < size) {
    const Eigen::Vector3d p(symmetricUniform(engine), symmetricUniform(engine), symmetricUniform(engine));
    if (p.norm() > 1.0 || p.norm() < 0.1) continue;
    PointT point{};
    point.getVector3fMap() = p.normalized().cast<float>();
    cloud->push_back(point);
  }
  return cloud;
}

/** \brief Random points of the square [-1, 1)^2 in the plane z = 0. */
template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr makeSquare(std::size_t size = default_size, std::uint32_t seed = 1)
{
  typename pcl::PointCloud<PointT>::Ptr cloud(new pcl::PointCloud<PointT>);
  std::mt19937 engine(seed);
  for (std::size_t i = 0; i < size; ++i) {
    PointT point{};
    point.x = static_cast<float>(symmetricUniform(engine));
    point.y = static_cast<float>(symmetricUniform(engine));
    cloud->push_back(point);
  }
  return cloud;
}

/** \brief Organised view of a wavy wall, \a width times \a height jittered pixels, every 50th without a return. */
inline pcl::PointCloud<pcl::PointXYZ>::Ptr makeOrganizedWall(std::uint32_t width, std::uint32_t height)
{
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>(width, height));
  std::mt19937 engine(7);
  constexpr double pixel = 0.01;
  for (std::uint32_t row = 0; row < height; ++row) {
    for (std::uint32_t column = 0; column < width; ++column) {
      const double x = pixel * (column + 0.3 * symmetricUniform(engine));
      const double y = pixel * (row + 0.3 * symmetricUniform(engine));
      const double z = 2.0 + 0.05 * std::sin(5.0 * x);
      const bool has_return = (row * width + column) % 50 != 0;
      auto position = (*cloud)(column, row).getVector3fMap();
      if (has_return) {
        position = Eigen::Vector3d(x, y, z).cast<float>();
      } else {
        position.setConstant(std::nanf(""));
      }
    }
  }
  cloud->is_dense = false;
  return cloud;
}

/** \brief Indices of the upper half of a cloud, each twice and in descending order. */
inline pcl::IndicesPtr upperHalfTwice(const pcl::PointCloud<pcl::PointXYZ>& cloud)
{
  pcl::IndicesPtr indices(new pcl::Indices);
  for (std::size_t i = cloud.size(); i-- > 0;) {
    if (cloud[i].z > 0.0f) indices->insert(indices->end(), 2, static_cast<pcl::index_t>(i));
  }
  return indices;
}

inline std::vector<Triangle> triangles(const std::vector<pcl::Vertices>& polygons)
{
  std::vector<Triangle> result;
  for (const auto& polygon : polygons) {
    EXPECT_EQ(polygon.vertices.size(), 3u);
    if (polygon.vertices.size() == 3) {
      result.push_back({polygon.vertices[0], polygon.vertices[1], polygon.vertices[2]});
    }
  }
  return result;
}

/** \brief Triangles of another numbering: each corner c becomes map[c]. */
inline std::vector<Triangle> renumbered(std::vector<Triangle> list, const pcl::Indices& map)
{
  for (Triangle& triangle : list) {
    for (pcl::index_t& corner : triangle) corner = map.at(static_cast<std::size_t>(corner));
  }
  return list;
}

using DirectedEdges = std::set<std::pair<pcl::index_t, pcl::index_t>>;

/** \brief Edges in the direction in which the triangles run through them; each may be run through only once. */
inline DirectedEdges directedEdges(const std::vector<Triangle>& list)
{
  DirectedEdges edges;
  for (const Triangle& triangle : list) {
    for (std::size_t i = 0; i < 3; ++i) {
      const bool is_new = edges.insert({triangle[i], triangle[(i + 1) % 3]}).second;
      EXPECT_TRUE(is_new) << "two triangles run the same way through edge " << triangle[i] << " "
                          << triangle[(i + 1) % 3];
    }
  }
  return edges;
}

/** \brief A mesh that is there, and oriented and manifold at its edges. */
inline void expectSurface(const std::vector<pcl::Vertices>& polygons)
{
  EXPECT_FALSE(polygons.empty());
  directedEdges(triangles(polygons));
}

/** \brief The same, and without a rim. */
inline void expectClosedSurface(const std::vector<pcl::Vertices>& polygons)
{
  EXPECT_FALSE(polygons.empty());
  const DirectedEdges edges = directedEdges(triangles(polygons));
  const bool closed = std::all_of(edges.begin(), edges.end(), [&](const auto& edge) {
    return edges.count({edge.second, edge.first}) == 1;
  });
  EXPECT_TRUE(closed);
}

/** \brief Output that a careless caller passes in again. */
inline std::vector<pcl::Vertices> stalePolygons()
{
  pcl::Vertices stale;
  stale.vertices = {123456, 234567, 345678};
  return {stale, stale};
}

/** \brief Everything that a run with given options leaves behind, for comparison with another run. */
struct Outcome
{
  pcl::PoissonDiskStatus status;
  std::vector<Triangle> mesh;
  pcl::Indices seeds, all_seeds, witnesses;
  std::vector<pcl::index_t> labels;
  std::vector<pcl::Indices> loops;

  bool operator==(const Outcome& other) const
  {
    return status == other.status && mesh == other.mesh && seeds == other.seeds && all_seeds == other.all_seeds &&
           witnesses == other.witnesses && labels == other.labels && loops == other.loops;
  }
};

template <typename PointT>
Outcome reconstruct(pcl::PoissonDiskReconstruction<PointT>& reconstruction)
{
  std::vector<pcl::Vertices> polygons;
  reconstruction.reconstruct(polygons);
  return {reconstruction.getStatus(),        triangles(polygons),
          reconstruction.getSeedIndices(),   reconstruction.getAllSeedIndices(),
          reconstruction.getWitnessPoints(), reconstruction.getVoronoiLabels(),
          reconstruction.getBoundaryLoops()};
}

/** \brief The outcome of a fresh object with default options. */
template <typename PointT>
Outcome reconstructFresh(const typename pcl::PointCloud<PointT>::ConstPtr& cloud)
{
  pcl::PoissonDiskReconstruction<PointT> reconstruction;
  reconstruction.setInputCloud(cloud);
  return reconstruct(reconstruction);
}

}  // namespace pcl_test
