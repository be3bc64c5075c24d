// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <pcl_pds_recon/neighbor_graph.h>
#include <pcl_pds_recon/point_components.h>

namespace pds
{

/** \brief What a component looks like in neighbourhoods just so wide that it looks like a line. */
struct LineScale
{
  double radius = 0;      ///< of these neighbourhoods, in units of position; 0: it never looks like a line
  double interval = 0;    ///< sampling interval: mean distance to the neighbours or, with noise, half of the radius
  bool noisy = false;     ///< the line has a width
  std::size_t crowd = 0;  ///< points in a neighbourhood, on average
};

/** \brief How wide one may look for a line. */
struct LineLimits
{
  double most_intervals = std::numeric_limits<double>::infinity();  ///< radius over the mean distance of neighbours
  double least_length = 0;                                          ///< extent of the component over the radius
};

/** \brief Finds for each component the scale at which it looks like a line: noise makes a curve a band, which has one
 * dimension only to who looks wider than its width. Looks at some hundred points of each. */
[[nodiscard]] std::vector<LineScale> find_line_scales(const OrderedPoints& points,
                                                      const NeighborGraph& graph,
                                                      const PointComponents& components,
                                                      const LineLimits& limits,
                                                      const Parallel& parallel);

/** \brief Positions in the middle of the noise: of each point of a noisy component, on the parabola that fits its
 * neighbourhood best. */
[[nodiscard]] PointArray<Eigen::Vector3f> center_on_curves(const OrderedPoints& points,
                                                           const PointComponents& components,
                                                           const std::vector<LineScale>& scales,
                                                           const Parallel& parallel);

/** \brief Finds the ends of open curves: points with all of their neighbours on one side.
 * \param rank how much each point deserves to be a seed: the best one beside an end takes its place
 * \param radius no two ends are nearer to each other, in units of position
 * \return ranks, ascending */
[[nodiscard]] std::vector<std::uint32_t> find_ends(const OrderedPoints& points,
                                                   const NeighborGraph& graph,
                                                   const std::vector<std::uint8_t>& rank,
                                                   double radius,
                                                   const Parallel& parallel);

}  // namespace pds
