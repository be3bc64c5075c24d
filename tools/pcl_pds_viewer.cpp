// SPDX-License-Identifier: BSD-3-Clause
// Shows meshes, clouds and every step of their reconstruction, in a window or as a picture.
#include "compare/vtk_complaints.h"
#include "io/atomic_file.h"
#include "printable.h"
#include "program.h"
#include "viewer/private_x_server.h"
#include "viewer/viewer_window.h"

#include <spdlog/fmt/fmt.h>

#include <chrono>
#include <cstdlib>
#include <ctime>
#include <iostream>

#include <vtkCamera.h>

namespace pds
{

namespace
{

/** \brief A window waits for layers that a reconstruction is to bring; a picture cannot. */
void show_layers(View& view, const ViewerOptions& options)
{
  for (const Layer layer : options.layers.value_or(first_layers(view.data()))) {
    const bool is_there = view.show(layer, true);
    if (!is_there && options.layers && layer != Layer::loops && !options.wants_window()) {
      throw InvalidInput(options.inputs.front() +
                         ": there is nothing to show in a layer of --show; cells, seeds, disks, witnesses and graph "
                         "need a cloud alone, deviation a --reference");
    }
  }
  view.shade(options.shading);
  view.show_scan_colors(options.scan_colors);
  view.aim(options.camera);
  if (options.pose) {
    view.set_pose(*options.pose);
  }
}

/** \brief Frames per second while the view moves, and what they cost all processors, which other programs change less.
 */
std::string measure_frames(View& view, const ViewerOptions& options)
{
  vtkNew<vtkRenderWindow> window;
  window->SetSize(options.width, options.height);
  window->SetMultiSamples(0);
  window->AddRenderer(view.renderer());
  view.coarsen(true);
  window->Render();  // the first one also loads
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t processors = std::clock();
  for (int frame = 0; frame < options.frames; ++frame) {
    constexpr double step = 3;  // degrees
    view.renderer()->GetActiveCamera()->Azimuth(step);
    window->Render();
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  const double processor_seconds = static_cast<double>(std::clock() - processors) / CLOCKS_PER_SEC;
  return fmt::format("{:.1f} frames per second, {:.0f} ms of processor time each\n", options.frames / seconds.count(),
                     1000 * processor_seconds / options.frames);
}

void run(const ViewerOptions& options)
{
  if (!options.screenshot.empty()) {
    check_writable(options.screenshot);
  }
  const char* display = std::getenv("DISPLAY");
  if (options.wants_window() && (display == nullptr || *display == '\0')) {
    throw std::runtime_error("no X display for a window; set DISPLAY, or write a picture with --screenshot");
  }
  const ViewSource source = load_source(options);
  for (const std::string& warning : source.warnings) {
    std::cerr << printable("pcl_pds_viewer: " + warning) << std::endl;
  }
  const bool is_cloud_enough = options.layers && *options.layers == std::vector<Layer>{Layer::cloud};
  const bool waits = source.is_reconstructed() && (options.wants_window() || is_cloud_enough);
  ViewData data = waits ? make_cloud_data(source) : make_view_data(source, options.tool.options);
  const PrivateXServer server;
  const VtkComplaints complaints;
  View view(std::move(data));
  show_layers(view, options);
  if (!options.screenshot.empty()) {
    draw_picture(view.renderer(), options.width, options.height, options.screenshot);
  }
  if (options.frames > 0) {
    std::cout << measure_frames(view, options);
  }
  if (options.wants_window()) {
    ViewerWindow(view, source, options).run();
  }
}

}  // namespace

}  // namespace pds

int main(int argc, char** argv)
{
  return pds::run_program("pcl_pds_viewer", [argc, argv] {
    const pds::ViewerOptions options = pds::parse_viewer_options(argc, argv);
    if (options.information.empty()) {
      pds::run(options);
    } else {
      std::cout << options.information;
    }
    return 0;
  });
}
