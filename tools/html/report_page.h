// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "command_line.h"
#include "html/histogram.h"
#include "io/ply_writer.h"

#include <pcl_pds_recon/reconstruction.h>

#include <string>
#include <vector>

namespace pds
{

/** \brief A picture and what is under it. */
struct PagePicture
{
  std::string png;
  std::string caption;
};

/** \brief From where the mesh is seen at first. */
struct PageCamera
{
  double azimuth = 25;    ///< degrees around the up axis
  double elevation = 15;  ///< degrees above the horizon
  char up = 'y';          ///< axis that points up: y or z
};

/** \brief What a report page shows beside the report itself. */
struct ReportPage
{
  std::string glb;  ///< the mesh around the origin
  PageCamera camera;
  std::vector<double> edge_lengths;
  std::vector<double> smallest_angles;  ///< of the faces, degrees
  std::vector<double> cloud_deviation;  ///< signed distance of each point from the mesh; empty if not measured
  std::string why_no_deviation;         ///< a sentence's end; empty if it was measured
  std::vector<PagePicture> pictures;    ///< empty if none could be drawn
  std::string why_no_pictures;          ///< a sentence's end; empty if they were drawn
};

/** \brief Measures the mesh and draws it. What this machine or build cannot do is left out, and the page says why.
 * \throws OutputError if the mesh is too large for a page
 */
[[nodiscard]] ReportPage make_report_page(const CommandLine& command_line,
                                          const PointTable& points,
                                          const PointTable& vertices,
                                          const Reconstruction& result);

/** \brief The page in one piece: it loads nothing from anywhere. */
[[nodiscard]] std::string to_html(const ReportPage& page, const CommandLine& command_line, const Report& report);

/** \brief Why the page has no mesh to turn, as a sentence's end; empty if it has. */
[[nodiscard]] std::string why_nothing_to_turn();

}  // namespace pds
