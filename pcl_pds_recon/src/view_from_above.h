// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include <pcl_pds_recon/seed_graph.h>

namespace pds
{

/** \brief What leads outside of the seeds of a cloud that was seen from above, as land is from an aircraft: up, where
 * nothing hides a surface that does not stand up, and 0 elsewhere. Above is where z grows, or else y, or else x.
 * O(seeds).
 * \return empty if the cloud does not look as if seen from there: a body has undersides */
[[nodiscard]] std::vector<Eigen::Vector3d> outward_from_above(const SeedGeometry& seeds, const Parallel& parallel);

}  // namespace pds
