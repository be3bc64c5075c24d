// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include <pcl_pds_recon/geodesic_voronoi.h>
#include <pcl_pds_recon/point_array.h>
#include <pcl_pds_recon/poisson_disk_sampling.h>
#include <pcl_pds_recon/seed_graph.h>
#include <pcl_pds_recon/triangle_complex.h>

namespace pds
{

/** \brief Moves the vertices to where the mesh fits the points best.
 *
 * Each vertex goes to the least-squares optimum of the quadrics of its faces: sums over the points of the Voronoi cells
 * beside it of their squared distances from the planes of the faces that they are nearest to. That puts a vertex into
 * the middle of noise, beyond a bend by half of its sagitta, and onto the crease that its faces cut off; where the
 * faces say nothing about a direction, it does not move along it. A vertex stays in its cell, and none moves so far
 * that a face folds onto another one or turns over. O(points).
 *
 * \param points positions by rank, in units of position
 * \param triangles oriented and manifold; vertices are seeds
 * \param noisy whether the cloud was found to be so: then vertices follow only what faces show clearly
 * \return a position for every seed, in radii; seeds without a face stay where they are
 */
[[nodiscard]] std::vector<Eigen::Vector3d> place_vertices(const SeedGeometry& seeds,
                                                          const std::vector<Triangle>& triangles,
                                                          const PointArray<Eigen::Vector3f>& points,
                                                          const PoissonDiskSampling& sampling,
                                                          const GeodesicVoronoi& voronoi,
                                                          bool noisy,
                                                          const Parallel& parallel);

}  // namespace pds
