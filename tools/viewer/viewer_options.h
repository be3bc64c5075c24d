// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "command_line.h"
#include "viewer/view.h"

#include <optional>
#include <string>
#include <vector>

namespace pds
{

/** \brief What pcl_pds_viewer was asked to show. */
struct ViewerOptions
{
  std::vector<std::string> inputs;
  std::string reference;     ///< the deviation from it is shown; empty: none
  bool points_only = false;  ///< the vertices of meshes are taken as clouds
  CommandLine tool;          ///< of the command tool's options those about the cloud and its reconstruction
  std::optional<std::vector<Layer>> layers;
  Shading shading = Shading::smooth;
  bool scan_colors = true;  ///< of cloud and mesh, where there are any
  int width = 1200;         ///< of the window or picture, pixels
  int height = 900;         ///< likewise
  CameraPlace camera;
  std::optional<CameraPose> pose;  ///< wins over camera
  std::string screenshot;          ///< PNG; empty: a window
  int frames = 0;           ///< frames to be drawn and timed while the camera turns, instead of a window; 0: none
  std::string information;  ///< text to print instead: help or version

  [[nodiscard]] bool wants_window() const { return screenshot.empty() && frames == 0; }
};

/** \throws UsageError */
[[nodiscard]] ViewerOptions parse_viewer_options(int argc, const char* const* argv);

}  // namespace pds
