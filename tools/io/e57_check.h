// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/e57_file.h"

namespace pds
{

/** \brief Checks what an E57 file says about its points, since PDAL takes fewer of them if it announces fewer, and
 * turns them by whatever it finds.
 *
 * All scalars of a field lie in a stream of their own, one after the other, with as many bits each as the description
 * says. So the stream's length shows how many there are: exactly those of floating-point fields, and within the bits
 * that fill up a packet's last word those of integers. Nothing shows it if all fields are text or constant.
 * \throws InvalidInput if a scan announces another number of points than it holds or has an impossible pose
 */
void check_e57_points(const E57File& file);

}  // namespace pds
