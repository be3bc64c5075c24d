// SPDX-License-Identifier: BSD-3-Clause
// The results beside the mesh: Voronoi diagram, witness points, boundary loops.
#include "test_clouds.h"

namespace pcl_test
{
namespace
{

using pcl::PointXYZ;
using Reconstruction = pcl::PoissonDiskReconstruction<PointXYZ>;

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

}  // namespace
}  // namespace pcl_test
