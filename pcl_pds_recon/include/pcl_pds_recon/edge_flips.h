// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_pds_recon/geodesic_voronoi.h>
#include <pcl_pds_recon/parallel.h>
#include <pcl_pds_recon/point_array.h>
#include <pcl_pds_recon/poisson_disk_sampling.h>
#include <pcl_pds_recon/seed_graph.h>
#include <pcl_pds_recon/triangle_complex.h>
#include <vector>

namespace pds
{

/** \brief Flips edges where the mesh then lies nearer to the points: edges come to run along creases and ridges.
 *
 * Two faces at an edge are replaced by those at the other diagonal of their quadrilateral if its points are clearly
 * nearer to these, and by so much that it is worth the smaller angles. No angle falls below a limit, no face folds onto
 * another one, and no edge is there twice: the mesh stays manifold, with the same vertices, rims and genus. O(points).
 *
 * \param seeds where they are, and their normals, which tell where a look at the points pays
 * \param points positions by rank, in units of position
 * \param triangles oriented and manifold
 */
void flip_edges(const SeedGeometry& seeds,
                const PointArray<Eigen::Vector3f>& points,
                const PoissonDiskSampling& sampling,
                const GeodesicVoronoi& voronoi,
                const Parallel& parallel,
                std::vector<Triangle>& triangles);

}  // namespace pds
