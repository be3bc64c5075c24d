// SPDX-License-Identifier: BSD-3-Clause
#include "html/pictures.h"
#include "viewer/private_x_server.h"
#include "viewer/view.h"

#include <exception>

namespace pds
{

void pcl_pds_recon_draw_pictures(const ViewData& data,
                                 const std::vector<Shot>& shots,
                                 std::vector<std::string>& pictures,
                                 std::string& complaint)
{
  constexpr int width = 880;
  constexpr int height = 660;
  try {
    const PrivateXServer display;
    for (const Shot& shot : shots) {
      View view(data);
      for (const Layer layer : shot.layers) {
        view.show(layer, true);
      }
      view.aim(shot.camera);
      pictures.push_back(draw_png(view.renderer(), width, height));
    }
  } catch (const std::exception& error) {
    complaint = error.what();
  }
}

}  // namespace pds
