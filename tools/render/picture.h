// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

class vtkRenderer;
class vtkRenderWindow;

namespace pds
{

/** \brief Where the camera stands. */
struct CameraPlace
{
  double azimuth = 0;    ///< degrees around the up axis
  double elevation = 0;  ///< degrees above the horizon
  double zoom = 1.4;     ///< 1: the sphere around everything fits the picture
  char up = 'y';         ///< axis that points up: y or z
};

void aim_camera(vtkRenderer* renderer, const CameraPlace& place);

/** \brief Writes what the window shows as PNG, under its name only when it is complete.
 * \throws std::runtime_error if it cannot be written */
void save_picture(vtkRenderWindow* window, const std::string& path);

/** \brief Draws the scene into a PNG of this size without showing a window; there must be an X display.
 * \return the bytes of the file */
[[nodiscard]] std::string draw_png(vtkRenderer* renderer, int width, int height);

/** \brief Likewise into a file. \throws std::runtime_error if it cannot be written */
void draw_picture(vtkRenderer* renderer, int width, int height, const std::string& path);

}  // namespace pds
