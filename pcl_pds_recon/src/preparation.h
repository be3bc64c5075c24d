// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_pds_recon/edge_weights.h>
#include <pcl_pds_recon/neighbor_graph.h>
#include <pcl_pds_recon/options.h>
#include <pcl_pds_recon/ordered_points.h>
#include <pcl_pds_recon/point_cloud_view.h>
#include <pcl_pds_recon/report.h>

namespace pds
{

constexpr double least_radius_factor = 1.5;  ///< the least that Options::radius_factor may be
constexpr double largest_radius = 1e9;  ///< units of position, whose box has side 1: beyond any disk, finite as a float

/** \brief The points that the radius needs, and who is whose neighbour. */
struct Neighborhoods
{
  OrderedPoints points;
  NeighborGraph graph;
  SurfaceEstimate surface;  ///< of the points and their rows
  double radius = 0;        ///< wanted, or a first guess, where the weight is its mean; units of position
  double interval = 0;  ///< sampling interval that the radius refers to: of the cloud before thinning, if that is known
};

/** \brief Orders, thins, sorts out, smooths if they are noisy, and joins the points, sheets apart. A radius in sampling
 * intervals is known only once all are joined. */
[[nodiscard]] Neighborhoods find_neighborhoods(const PointCloudView& cloud,
                                               const Options& options,
                                               const Parallel& parallel);

/** \brief Radius in units of position, and the metric it is measured in. */
struct Metric
{
  EdgeWeights weights;
  double radius = 0;
};

[[nodiscard]] Metric choose_metric(const Neighborhoods& found,
                                   const Options& options,
                                   const Parallel& parallel,
                                   Report& report);

}  // namespace pds
