// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/point_table.h"

#include <pcl_pds_recon/parallel.h>

#include <vector>

namespace pds
{

/** \brief Name of the field that numbers the clouds that were merged, from 1. */
constexpr const char* scan_field = "scan";

/** \brief All points of several clouds, one cloud after the other, with the number of each point's cloud in the field
 * "scan", in place of any of the same name.
 *
 * The table has the fields of all clouds, each of a type that holds the values of all; where a cloud lacks a field its
 * points have NaN or, if the field is an integer, 0. Colours of 8 bits are spread to 16 if others have those, and
 * either become 0 ... 1 if others have floats. Sensor origins that differ become the fields vp_x vp_y vp_z of the
 * points; one that all clouds have stays. z is up if it is in any cloud, since all are in one frame. Each cloud is
 * freed when it has been copied.
 */
[[nodiscard]] PointTable merge_points(std::vector<PointTable> clouds, const Parallel& parallel);

}  // namespace pds
