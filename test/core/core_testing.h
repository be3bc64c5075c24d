// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <pcl_pds_recon/edge_weights.h>
#include <pcl_pds_recon/geodesic_disk.h>
#include <pcl_pds_recon/neighbor_graph.h>
#include <pcl_pds_recon/ordered_points.h>
#include <pcl_pds_recon/poisson_disk_sampling.h>
#include <pcl_pds_recon/reconstruction.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "mesh_facts.h"
#include "shapes.h"

namespace pds_test
{

constexpr std::size_t small_cloud = 20000;  // a mesh of it is within 1 % of a smooth shape's area

/** \brief Sanitizers make the largest clouds take minutes, and see as much in smaller ones. */
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr std::size_t large_cloud = 40000;
#else
constexpr std::size_t large_cloud = 100000;
#endif

/** \brief View of points that must stay alive as long as it. */
inline pds::PointCloudView view_of(const Points& points)
{
  pds::PointCloudView cloud;
  cloud.size = points.size();
  if (!points.empty()) cloud.positions = pds::Vector3View(points.front().data(), sizeof(Eigen::Vector3d));
  return cloud;
}

inline pds::Reconstruction reconstruct(const Points& points, const pds::Options& options = {})
{
  return pds::reconstruct(view_of(points), options);
}

/** \brief Where the mesh's vertices are. */
inline Points vertex_positions(const pds::Reconstruction& mesh, const Points& points)
{
  Points positions;
  for (std::size_t v = 0; v < mesh.report.vertices; ++v) positions.push_back(points.at(mesh.seeds.at(v)));
  return positions;
}

/** \brief Checks everything that holds for whatever cloud, and that the report says what is there. */
inline MeshFacts expect_sound_mesh(const pds::Reconstruction& mesh, const Points& points)
{
  const pds::Report& report = mesh.report;
  EXPECT_LE(report.vertices, mesh.seeds.size());
  EXPECT_EQ(std::set<std::uint32_t>(mesh.seeds.begin(), mesh.seeds.end()).size(), mesh.seeds.size());
  for (const auto& t : mesh.triangles)
    for (const std::uint32_t v : t) {
      EXPECT_LT(v, report.vertices);
      if (v >= report.vertices) return {};
    }
  MeshFacts facts = examine(mesh.triangles, vertex_positions(mesh, points));
  EXPECT_EQ(facts.nonmanifold_edges, 0U);
  EXPECT_EQ(facts.nonmanifold_vertices, 0U);
  EXPECT_EQ(facts.inconsistent_edges, 0U);
  EXPECT_EQ(facts.duplicate_faces, 0U);
  EXPECT_EQ(facts.degenerate_faces, 0U);
  EXPECT_EQ(facts.folded_edges, 0U);

  EXPECT_EQ(report.vertices, facts.vertices);
  EXPECT_EQ(report.faces, facts.faces);
  EXPECT_EQ(report.edges, facts.edges);
  EXPECT_EQ(report.components, facts.components);
  EXPECT_EQ(report.boundary_loops, facts.boundary_loops);
  EXPECT_EQ(report.euler, facts.euler());
  EXPECT_EQ(report.closed, facts.faces > 0 && facts.boundary_loops == 0);
  EXPECT_EQ(report.nonmanifold_edges + report.nonmanifold_vertices + report.inconsistent_edges, 0U);
  EXPECT_EQ(report.seeds, mesh.seeds.size());
  EXPECT_EQ(mesh.boundary_loops.size(), facts.boundary_loops);

  EXPECT_TRUE(std::isfinite(report.sampling_interval));
  EXPECT_TRUE(std::isfinite(report.radius));
  return facts;
}

/** \brief Checks the same, and that seeds are Poisson-disk samples, which they are not after relaxation. */
inline MeshFacts expect_sound(const pds::Reconstruction& mesh, const Points& points)
{
  const pds::Report& report = mesh.report;
  constexpr double rounding = 1e-5;  // distances are single precision
  if (report.seeds > 0) {
    EXPECT_GE(report.min_seed_distance, 1.0 - rounding);
  }
  EXPECT_LE(report.coverage_radius, 1.0 + rounding);  // false for NaN
  return expect_sound_mesh(mesh, points);
}

/** \brief Checks that the mesh is one closed, outward surface of this genus. */
inline MeshFacts expect_closed(const pds::Reconstruction& mesh, const Points& points, long long genus)
{
  MeshFacts facts = expect_sound(mesh, points);
  EXPECT_TRUE(mesh.report.closed);
  EXPECT_TRUE(mesh.report.orientable);
  EXPECT_EQ(facts.components, 1U);
  EXPECT_EQ(facts.boundary_loops, 0U);
  EXPECT_EQ(facts.euler(), 2 - 2 * genus);
  EXPECT_EQ(static_cast<long long>(facts.faces), 2 * static_cast<long long>(facts.vertices) - 4 + 4 * genus);
  EXPECT_GT(facts.volume, 0.0);
  return facts;
}

/** \brief The first stages, run once for the tests of the later ones. */
struct Stages
{
  explicit Stages(const Points& input, int k = 15)
      : points(pds::order_points(view_of(input), parallel)),
        graph(pds::build_neighbor_graph(points, view_of(input), k, parallel)),
        surface(pds::estimate_surface(points, graph, parallel))
  {
  }

  [[nodiscard]] pds::PoissonDiskSampling sample(double factor,
                                                const pds::EdgeWeights& weights,
                                                std::uint64_t seed,
                                                unsigned threads,
                                                const pds::SteadyCount& steady = {}) const
  {
    return pds::sample_poisson_disks(points, graph, surface, weights, std::vector<std::uint8_t>(points.size()),
                                     factor * graph.sampling_interval, pds::GeodesicSolver::fast_marching, seed,
                                     pds::Parallel(threads), {}, steady);
  }

  pds::Parallel parallel{2};
  pds::OrderedPoints points;
  pds::NeighborGraph graph;
  pds::SurfaceEstimate surface;
};

/** \brief Grows disks on a whole cloud. */
class WholeCloudDisk
{
 public:
  explicit WholeCloudDisk(const Stages& stages,
                          const pds::EdgeWeights& weights,
                          pds::GeodesicSolver solver = pds::GeodesicSolver::fast_marching)
      : marks_(stages.points.size()), disk_(stages.points, stages.graph, stages.surface, weights, solver, marks_)
  {
    disk_.enter({{0, static_cast<std::uint32_t>(stages.points.size())}});
  }

  /** \brief The points within the limit by ascending distance. */
  std::vector<pds::GeodesicDisk::Reached> grow(std::uint32_t source, float limit)
  {
    std::vector<pds::GeodesicDisk::Reached> reached = disk_.grow(source, limit);
    std::sort(reached.begin(), reached.end(), [](const auto& x, const auto& y) {
      return x.distance < y.distance || (x.distance == y.distance && x.point < y.point);
    });
    return reached;
  }

 private:
  pds::PatchMarks marks_;
  pds::GeodesicDisk disk_;
};

}  // namespace pds_test
