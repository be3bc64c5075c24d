// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/deviation_picture.h"

#include "viewer/private_x_server.h"
#include "viewer/view.h"

namespace pds
{

void draw_deviation(const std::string& path, const TriangleMesh& mesh, const Deviation& deviation)
{
  constexpr int width = 1600;
  constexpr int height = 1200;
  const PrivateXServer display;
  ViewData data;
  data.mesh = mesh;
  data.deviation = deviation.vertex_deviation;
  data.face_deviation = deviation.face_deviation;
  View view(std::move(data));
  view.show(Layer::deviation, true);
  view.aim({});
  draw_picture(view.renderer(), width, height, path);
}

}  // namespace pds
