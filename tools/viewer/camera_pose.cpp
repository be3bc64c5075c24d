// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/camera_pose.h"

#include "io/text_scanner.h"

#include <spdlog/fmt/fmt.h>

#include <Eigen/Geometry>
#include <cmath>
#include <string_view>
#include <vector>

#include <vtkCamera.h>
#include <vtkRenderer.h>

namespace pds
{

namespace
{

std::string join(const Eigen::Vector3d& v) { return fmt::format("{},{},{},", v.x(), v.y(), v.z()); }

}  // namespace

std::string to_text(const CameraPose& pose)
{
  return join(pose.position) + join(pose.focus) + join(pose.up) + fmt::format("{}", pose.angle);
}

std::optional<CameraPose> parse_pose(const std::string& text)
{
  std::vector<std::string_view> words;
  split(text, ",", words);
  constexpr std::size_t count = 10;
  double number[count];
  if (words.size() != count) {
    return std::nullopt;
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (!parse_number(words[i], number[i]) || !std::isfinite(number[i])) {
      return std::nullopt;
    }
  }
  const CameraPose pose{{number[0], number[1], number[2]},
                        {number[3], number[4], number[5]},
                        {number[6], number[7], number[8]},
                        number[9]};
  const bool looks_somewhere = (pose.focus - pose.position).cross(pose.up).norm() > 0;
  return looks_somewhere && pose.angle > 0 && pose.angle < 180 ? std::optional<CameraPose>(pose) : std::nullopt;
}

CameraPose pose_of(vtkCamera* camera, const Eigen::Vector3d& center)
{
  return {Eigen::Vector3d(camera->GetPosition()) + center, Eigen::Vector3d(camera->GetFocalPoint()) + center,
          Eigen::Vector3d(camera->GetViewUp()), camera->GetViewAngle()};
}

void set_pose(vtkRenderer* renderer, const CameraPose& pose, const Eigen::Vector3d& center)
{
  const Eigen::Vector3d position = pose.position - center;
  const Eigen::Vector3d focus = pose.focus - center;
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetPosition(position.data());
  camera->SetFocalPoint(focus.data());
  camera->SetViewUp(pose.up.data());
  camera->SetViewAngle(pose.angle);
  renderer->ResetCameraClippingRange();
}

}  // namespace pds
