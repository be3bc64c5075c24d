// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

class vtkCamera;
class vtkRenderer;

namespace pds
{

/** \brief Where a camera stands and looks, in the coordinates of the data: enough to return to it another day. */
struct CameraPose
{
  Eigen::Vector3d position{0, 0, 1};
  Eigen::Vector3d focus{0, 0, 0};
  Eigen::Vector3d up{0, 1, 0};
  double angle = 30;  ///< of view, degrees
};

/** \brief Ten numbers parted by commas: position, focus, up and angle, each to the last bit. */
[[nodiscard]] std::string to_text(const CameraPose& pose);

/** \brief Understands to_text(); nothing if it is not ten numbers that make a pose. */
[[nodiscard]] std::optional<CameraPose> parse_pose(const std::string& text);

/** \param center of the data: where the scene has its origin */
[[nodiscard]] CameraPose pose_of(vtkCamera* camera, const Eigen::Vector3d& center);
void set_pose(vtkRenderer* renderer, const CameraPose& pose, const Eigen::Vector3d& center);

}  // namespace pds
