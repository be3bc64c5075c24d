// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/las_header.h"
#include "io/point_table.h"

#include <pcl_pds_recon/parallel.h>

namespace pds
{

/** \brief Compares the points of a LAS or LAZ file with the bounds in its header: a scale or offset that is wrong moves
 * points out of them.
 *
 * Points may lie outside by two steps of the scale, since writers round, by the rounding of single precision, in which
 * some compute the bounds, and by 1e-4 of the bounds' width, for those that print them with few digits. Bounds that are
 * wider than the points are believed, since whoever takes points out of a file may leave its header as it is. Only if
 * the points span a thousand steps or more in each axis, and scales that are larger by powers of ten, with the same
 * offsets, would let them reach all six bounds to the last step, are the scales taken to be wrong. An axis
 * whose bounds are both 0, not finite or turned around has not been filled in, and cannot be checked. \param points all
 * that the file holds \throws InvalidInput if the header's scale, offset or bounds are wrong
 */
void check_las_bounds(const LasHeader& header, const PointTable& points, const Parallel& parallel);

}  // namespace pds
