// SPDX-License-Identifier: BSD-3-Clause
#include "html/pictures.h"

#include "io/plugin.h"

#ifdef PCL_PDS_RECON_WITH_PICTURES

#include "child_process.h"

#include <cstdlib>
#include <optional>

namespace pds
{

namespace
{

/** In the child: sends the complaint, which is empty if all is well, and then the pictures. */
void draw_and_send(const ChildOutput& output, const ViewData& data, const std::vector<Shot>& shots)
{
  setenv("VTK_SMP_BACKEND_IN_USE", "Sequential", 1);  // the threads of TBB, which Embree may have started, are not here
  std::vector<std::string> pictures;
  std::string complaint;
  try {
    void* function = load_plugin_function("pcl_pds_recon_pictures", "pcl_pds_recon_draw_pictures");
    reinterpret_cast<decltype(&pcl_pds_recon_draw_pictures)>(function)(data, shots, pictures, complaint);
  } catch (const PluginError& error) {
    complaint = error.what();
  }
  output.send_text(complaint);
  for (const std::string& picture : pictures) {
    output.send_text(picture);
  }
}

}  // namespace

std::vector<std::string> draw_pictures(const ViewData& data, const std::vector<Shot>& shots)
{
  const ChildProcess child([&](const ChildOutput& output) { draw_and_send(output, data, shots); });
  const std::optional<std::string> complaint = child.receive_text();
  if (complaint && !complaint->empty()) {
    throw PluginError(*complaint);
  }
  std::vector<std::string> pictures;
  while (pictures.size() < shots.size()) {
    std::optional<std::string> picture = child.receive_text();
    if (!picture) {
      throw PluginError("VTK cannot draw on this display; unset DISPLAY and install xvfb");
    }
    pictures.push_back(std::move(*picture));
  }
  return pictures;
}

}  // namespace pds

#else

namespace pds
{

std::vector<std::string> draw_pictures(const ViewData& /*data*/, const std::vector<Shot>& /*shots*/)
{
  throw PluginError("this build is without VTK, which draws them");
}

}  // namespace pds

#endif
