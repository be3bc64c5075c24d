// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/picture.h"
#include "viewer/view_data.h"

#include <string>
#include <vector>

namespace pds
{

/** \brief A picture that is to be drawn. */
struct Shot
{
  std::vector<Layer> layers;
  CameraPlace camera;
};

/** \brief Draws PNG files in memory, in a process of its own: VTK ends the process if it does not like the display.
 * \throws PluginError if they cannot be drawn; what() says why */
[[nodiscard]] std::vector<std::string> draw_pictures(const ViewData& data, const std::vector<Shot>& shots);

/** \brief The plugin's function. What goes wrong is left in \a complaint, since no exception may leave a plugin. */
extern "C" void pcl_pds_recon_draw_pictures(const ViewData& data,
                                            const std::vector<Shot>& shots,
                                            std::vector<std::string>& pictures,
                                            std::string& complaint);

}  // namespace pds
