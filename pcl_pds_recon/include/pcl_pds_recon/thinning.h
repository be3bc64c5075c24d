// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include <pcl_pds_recon/ordered_points.h>
#include <pcl_pds_recon/parallel.h>

namespace pds
{

/** \brief How fine the points are that a disk needs: voxels per radius. A voxel keeps one point, which leaves about 30
 * for a Voronoi cell, as many as the default radius factor finds in a cloud that is not thinned. */
constexpr double voxels_per_radius = 3.75;
/** \brief The same in the adaptive metric, where the smallest disks are much smaller than the mean one. */
constexpr double voxels_per_adaptive_radius = 5.6;

/** \brief The same on plane parts, where half as many points tell as much: squares per radius. */
constexpr double squares_per_radius_of_plane = 3.0;

/** \brief Fewer points say nothing about a surface, however large the radius. */
constexpr std::size_t fewest_points_left = 1000;
constexpr std::size_t fewest_points_to_thin = 2 * fewest_points_left;

/** \brief Smaller clouds take a few hundredths of a second as they are. */
constexpr std::size_t fewest_points_to_thin_planes = 50000;

/** \brief True if it is worth while to keep so many of the points: half of them at most. */
constexpr bool thinning_pays(std::size_t points, std::size_t kept) { return points >= 2 * kept; }

/** \brief Leaves out points that disks of this size do not need.
 *
 * Space is cut into voxels; of the points in one, the nearest to their mean stays, which is in the middle of the noise,
 * and represents the others, as one of several coincident points does. A point and its representative are at most
 * sqrt(3) voxels apart, 0.46 radii in the uniform metric and seldom more than 0.15; that bounds what thinning changes
 * about the distance of a point. Nothing is left out unless that leaves
 * half of the points at most, and a thousand of them are left at least, in smaller voxels if need be. O(n).
 * \param voxel_side in units of position
 * \return the points that are left, in their order
 */
[[nodiscard]] OrderedPoints thin_points(OrderedPoints points, double voxel_side, const Parallel& parallel);

/** \brief Leaves out points in the midst of plane parts of the surface, where half of them tell as much.
 *
 * Where a single, nearly plane sheet goes on for about \a radius all around, squares are put over it, and each keeps
 * the point nearest to the mean of its points. Sharp bends, rims, noise, thin parts, and what is near them keep all of
 * their points. A point and its representative are at most 0.47 radii apart where density is even. Nothing is left out
 * unless it is a fifth of all points at least. For uniform metrics. O(n). \param radius of the disks, in units of
 * position \param thickest standard deviation of points from a plane that they count as on: less than what is noise
 * \return the points that are left, in their order
 */
[[nodiscard]] OrderedPoints thin_plane_parts(OrderedPoints points,
                                             double radius,
                                             double thickest,
                                             const Parallel& parallel);

/** \brief order_points() and thin_points() at once, for less than the former takes: points within a voxel need no
 * order. The voxels are others, for they begin at a corner of the cloud's box. \param voxel_side in units of the input
 * \throws InvalidInput as order_points()
 */
[[nodiscard]] OrderedPoints order_and_thin_points(const PointCloudView& cloud,
                                                  double voxel_side,
                                                  const Parallel& parallel);

}  // namespace pds
