// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_pds_recon/report.h>

#include <utility>
#include <vector>

namespace pds
{

/** \brief The stages of a run in their order, by the names that JSON report, log and page give them; without the total.
 */
[[nodiscard]] inline std::vector<std::pair<const char*, double>> stage_times(const StageSeconds& seconds)
{
  return {{"load", seconds.load},
          {"neighbors", seconds.neighbors},
          {"weights", seconds.weights},
          {"sampling", seconds.sampling},
          {"voronoi", seconds.voronoi},
          {"seed_graph", seconds.seed_graph},
          {"faces", seconds.faces},
          {"holes", seconds.holes},
          {"orientation", seconds.orientation},
          {"placement", seconds.placement},
          {"save", seconds.save}};
}

}  // namespace pds
