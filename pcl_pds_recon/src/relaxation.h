// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_pds_recon/geodesic_voronoi.h>
#include <pcl_pds_recon/ordered_points.h>
#include <pcl_pds_recon/poisson_disk_sampling.h>
#include <pcl_pds_recon/seed_graph.h>
#include <pcl_pds_recon/triangle_complex.h>
#include <Eigen/Core>
#include <cstdint>
#include <vector>
#include "mesh_fans.h"

namespace pds
{

/** \brief Lloyd's relaxation: step by step, each seed moves to the centroid of its Voronoi cell.
 *
 * A seed is the point of its cell that is nearest to where it should be; the latter is what is relaxed, lest seeds stop
 * at the first point that has no better one next to it. The centroid is that of the surface and not of the points,
 * whose random density would pull at the seeds: the cell's corners are the circumcentres of the triangles at its seed.
 * Seeds on the mesh's rim stay, or it would draw back. In the last step the triangles decide: there are many points
 * about as near to the goal, and the seeds take those of their cells that make them most even.
 */
class Relaxation
{
 public:
  /** \brief One step. O(points).
   * \param is_last whether no other follows
   * \return ranks of the new seeds, ascending */
  [[nodiscard]] std::vector<std::uint32_t> step(const SeedGeometry& seeds,
                                                const std::vector<Triangle>& triangles,
                                                const OrderedPoints& points,
                                                const PoissonDiskSampling& sampling,
                                                const GeodesicVoronoi& voronoi,
                                                bool is_last,
                                                const Parallel& parallel);

 private:
  struct Goal
  {
    std::uint32_t rank;        ///< of the seed
    Eigen::Vector3d position;  ///< where it should be, in radii
  };
  [[nodiscard]] std::vector<Eigen::Vector3d> goals_of(const SeedGeometry& seeds,
                                                      const PoissonDiskSampling& sampling) const;

  void even_out(const std::vector<Triangle>& triangles,
                const MeshFans& fans,
                const OrderedPoints& points,
                const PoissonDiskSampling& sampling,
                const GeodesicVoronoi& voronoi);

  std::vector<Goal> goals_;  ///< of the step before, by rank
};

}  // namespace pds
