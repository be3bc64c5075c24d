// SPDX-License-Identifier: BSD-3-Clause
// Shows meshes, clouds and every step of their reconstruction, in a window or as a picture.
#include "compare/vtk_complaints.h"
#include "io/atomic_file.h"
#include "viewer/private_x_server.h"
#include "viewer/viewer_window.h"

#include <spdlog/fmt/fmt.h>

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <new>

#include <vtkCamera.h>

namespace pds
{

namespace
{

/** \brief The layers that say most about what is there. */
std::vector<Layer> first_layers(const ViewData& data)
{
  if (!data.face_deviation.empty()) {
    return {Layer::deviation, Layer::loops};
  }
  if (!data.mesh.faces.empty()) {
    return {Layer::mesh, Layer::loops};
  }
  return {Layer::cloud};
}

void show_layers(View& view, const ViewerOptions& options)
{
  for (const Layer layer : options.layers.value_or(first_layers(view.data()))) {
    if (!view.show(layer, true) && options.layers && layer != Layer::loops) {
      throw InvalidInput(options.input +
                         ": there is nothing to show in a layer of --show; cells, seeds, disks and "
                         "witnesses need a cloud, deviation a REFERENCE");
    }
  }
  view.shade_flat(options.flat);
  view.aim(options.camera);
}

/** \brief Frames per second while the view moves. */
double measure_frames(View& view, const ViewerOptions& options)
{
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetSize(options.width, options.height);
  window->SetMultiSamples(0);
  window->AddRenderer(view.renderer());
  view.coarsen(true);
  window->Render();  // the first one also loads
  const auto start = std::chrono::steady_clock::now();
  for (int frame = 0; frame < options.frames; ++frame) {
    constexpr double step = 3;  // degrees
    view.renderer()->GetActiveCamera()->Azimuth(step);
    window->Render();
  }
  return options.frames / std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void run(const ViewerOptions& options)
{
  if (!options.screenshot.empty()) {
    check_writable(options.screenshot);
  }
  const ViewSource source = load_source(options);
  ViewData data = make_view_data(source, options.reconstruction);
  const bool has_window = options.screenshot.empty() && options.frames == 0;
  const char* display = std::getenv("DISPLAY");
  if (has_window && (display == nullptr || *display == '\0')) {
    throw std::runtime_error("no X display for a window; set DISPLAY, or write a picture with --screenshot");
  }
  const PrivateXServer server;
  const VtkComplaints complaints;
  View view(std::move(data));
  show_layers(view, options);
  if (!options.screenshot.empty()) {
    draw_picture(view.renderer(), options.width, options.height, options.screenshot);
  }
  if (options.frames > 0) {
    std::cout << fmt::format("{:.1f} frames per second\n", measure_frames(view, options));
  }
  if (has_window) {
    ViewerWindow(view, source, options).run();
  }
}

constexpr int exit_bad_data = 1;
constexpr int exit_bad_usage = 2;

int fail(int status, const std::string& message)
{
  std::cerr << "pcl_pds_viewer: " << message << std::endl;
  return status;
}

int guarded_main(int argc, const char* const* argv)
{
  try {
    const ViewerOptions options = parse_viewer_options(argc, argv);
    if (options.information.empty()) {
      run(options);
    } else {
      std::cout << options.information;
    }
    return 0;
  } catch (const ViewerUsageError& error) {
    return fail(exit_bad_usage, error.what());
  } catch (const std::bad_alloc&) {
    return fail(exit_bad_data, "not enough memory for these files; use a larger machine");
  } catch (const std::exception& error) {
    return fail(exit_bad_data, error.what());
  }
}

}  // namespace

}  // namespace pds

int main(int argc, char** argv) { return pds::guarded_main(argc, argv); }
