// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_pds_recon/deviation.h>

#include <string>

namespace pds
{

/** \brief Draws a mesh coloured by its signed deviation, with the bar of colours, into a PNG file.
 * \throws std::runtime_error if there is no way to draw or the file cannot be written
 */
void draw_deviation(const std::string& path, const TriangleMesh& mesh, const Deviation& deviation);

}  // namespace pds
