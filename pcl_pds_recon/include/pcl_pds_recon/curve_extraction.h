// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <pcl_pds_recon/geodesic_voronoi.h>

namespace pds
{

/** \brief A polyline without branches. */
struct Curve
{
  std::vector<std::uint32_t> seeds;  ///< in their order along it, none twice
  bool closed = false;               ///< the last is joined to the first
};

/** \brief Finds the curves that the Voronoi dual consists of (paper, section "1D manifold case").
 *
 * Two seeds are adjacent where their cells border. A pair is passed over if the way between its seeds leads by a third
 * one; of the others those with the shortest ways count, two at each seed. So whatever the pairs are, nothing branches.
 * A closed curve has three seeds or more. O(pairs). \return open curves, then closed ones, each from its lower end or
 * its lowest seed on
 */
[[nodiscard]] std::vector<Curve> extract_curves(const std::vector<SeedPair>& pairs, std::size_t seeds);

}  // namespace pds
