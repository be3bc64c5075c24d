// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_pds_recon/curve_extraction.h>
#include <pcl_pds_recon/geodesic_voronoi.h>
#include <pcl_pds_recon/ordered_points.h>
#include <pcl_pds_recon/parallel.h>
#include <pcl_pds_recon/poisson_disk_sampling.h>
#include <pcl_pds_recon/reconstruction.h>
#include <pcl_pds_recon/seed_graph.h>
#include <pcl_pds_recon/triangle_complex.h>
#include <cstdint>
#include <vector>

namespace pds
{

/** \brief Fills in the seeds, those with a face first, and the triangles, in an order that depends only on them.
 * \return the number of each seed in the result */
[[nodiscard]] std::vector<std::uint32_t> number_vertices(std::vector<Triangle> triangles,
                                                         const OrderedPoints& points,
                                                         const PoissonDiskSampling& sampling,
                                                         Reconstruction& result,
                                                         const Parallel& parallel);

/** \brief Fills in the seeds, those of curves first and in their order, and the segments.
 * \return likewise */
[[nodiscard]] std::vector<std::uint32_t> number_along_curves(const std::vector<Curve>& curves,
                                                             const OrderedPoints& points,
                                                             const PoissonDiskSampling& sampling,
                                                             Reconstruction& result);

/** \brief Fills in the label and distance of every input point, and which of them are witnesses. */
void describe_points(const PointCloudView& cloud,
                     const OrderedPoints& points,
                     const PoissonDiskSampling& sampling,
                     const GeodesicVoronoi& voronoi,
                     const std::vector<std::uint32_t>& number_of_seed,
                     Reconstruction& result,
                     const Parallel& parallel);

/** \brief Fills in the edges of the seed graph. */
void describe_seed_graph(const SeedGraph& graph,
                         const std::vector<std::uint32_t>& number_of_seed,
                         Reconstruction& result,
                         const Parallel& parallel);

/** \brief Fills in the vertices' positions and their cells, once their count is in the report.
 * \param position of every seed, in radii */
void describe_moved_vertices(const std::vector<Eigen::Vector3d>& position,
                             const OrderedPoints& points,
                             const PoissonDiskSampling& sampling,
                             const GeodesicVoronoi& voronoi,
                             const std::vector<std::uint32_t>& number_of_seed,
                             Reconstruction& result);

}  // namespace pds
