// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/viewer_window.h"

#include "viewer/keys.h"
#include "viewer/pick.h"
#include "viewer/window_style.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <iostream>

#include <vtkTextProperty.h>

namespace pds
{

namespace
{

constexpr double radius_step = 1.25;    // of a press of + or -
constexpr double adaptive_step = 0.1;   // of a press of a
constexpr double most_adaptive = 0.31;  // then it starts again; the paper goes up to 0.3
constexpr unsigned long poll_milliseconds = 100;
// All details are drawn when nothing has changed for so long, since that may take seconds.
constexpr std::chrono::milliseconds rest_time(300);

void set_up_text(vtkTextActor* text, double x, double y, int size)
{
  text->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  text->SetPosition(x, y);
  text->GetTextProperty()->SetColor(0.1, 0.1, 0.1);
  text->GetTextProperty()->SetFontSize(size);
}

}  // namespace

ViewerWindow::ViewerWindow(View& view, const ViewSource& source, const ViewerOptions& options)
    : view_(view),
      source_(source),
      options_(options.tool.options),
      chooses_layers_(options.layers.has_value()),
      rerun_(source)
{
  window_->SetSize(options.width, options.height);
  window_->SetWindowName("pcl_pds_viewer");
  window_->SetMultiSamples(0);  // without a graphics card they cost most of a frame
  window_->AddRenderer(view.renderer());
  vtkNew<WindowStyle> style;
  style->window = this;
  style->SetCurrentRenderer(view.renderer());
  interactor_->SetRenderWindow(window_);
  interactor_->SetInteractorStyle(style);
  set_up_text(status_, 0.01, 0.01, 14);
  set_up_text(help_, 0.01, 0.3, 15);
  help_->GetTextProperty()->SetFontFamilyToCourier();
  help_->SetInput(key_help().c_str());
  help_->SetVisibility(false);
  view.renderer()->AddActor2D(status_);
  view.renderer()->AddActor2D(help_);
  saved_camera_->DeepCopy(view.renderer()->GetActiveCamera());
  status_->SetInput((summary() + "; h: keys").c_str());
}

void ViewerWindow::open()
{
  draw();
  interactor_->Initialize();
}

void ViewerWindow::run()
{
  open();
  if (source_.is_reconstructed()) {
    rerun_.request(options_);
  }
  interactor_->CreateRepeatingTimer(poll_milliseconds);
  interactor_->Start();
}

/** What cannot be drawn fluently is drawn in few details first, so that nothing keeps the user waiting. */
void ViewerWindow::draw()
{
  if (view_.is_heavy()) {
    view_.coarsen(true);
    last_change_ = Clock::now();
  }
  window_->Render();
}

void ViewerWindow::start_motion()
{
  is_moving_ = true;
  view_.coarsen(true);
}

void ViewerWindow::stop_motion()
{
  is_moving_ = false;
  last_change_ = Clock::now();
}

void ViewerWindow::refine()
{
  if (view_.is_coarse() && !is_moving_ && !is_busy() && Clock::now() - last_change_ > rest_time) {
    view_.coarsen(false);
    window_->Render();
  }
}

std::string ViewerWindow::summary() const
{
  const ViewData& data = view_.data();
  std::string text;
  if (!data.mesh.faces.empty()) {
    text = fmt::format("{} vertices, {} faces, {} boundary loops", data.mesh.vertices.size(), data.mesh.faces.size(),
                       data.boundary_loops.size());
  }
  if (source_.cloud) {
    text += fmt::format("{}{} points", text.empty() ? "" : "; ", data.cloud.size);
  }
  if (source_.is_reconstructed() && data.radius > 0) {
    text += fmt::format(", radius {:.4g}, adaptive {:.2g}", data.radius, options_.adaptive);
  }
  return text;
}

void ViewerWindow::say(const std::string& text)
{
  status_->SetInput(text.c_str());
  draw();
}

void ViewerWindow::toggle(const LayerName& layer)
{
  chooses_layers_ = true;
  const bool done = view_.show(layer.layer, !view_.is_shown(layer.layer));
  say(done ? summary() : std::string("there is nothing to show as ") + layer.name);
}

void ViewerWindow::change_options(char key)
{
  if (!source_.is_reconstructed()) {
    say("this is a mesh already; give a cloud alone, or --points");
    return;
  }
  if (key == 'a') {
    options_.adaptive += adaptive_step;
    if (options_.adaptive > most_adaptive) {
      options_.adaptive = 0;
    }
  } else {
    double& size = options_.radius > 0 ? options_.radius : options_.radius_factor;
    const double before = size;
    size *= key == '+' ? radius_step : 1 / radius_step;
    try {
      validate(options_);
    } catch (const InvalidOption& error) {
      size = before;
      say(error.what());
      return;
    }
  }
  rerun_.request(options_);
  say("reconstructing");
}

void ViewerWindow::take_result(Rerun::Result result)
{
  if (!result.error.empty() || result.data.mesh.faces.empty()) {
    say(result.error.empty() ? "no faces came out; try another radius" : result.error);
    return;
  }
  const bool is_first = view_.data().mesh.faces.empty();
  view_.replace(std::move(result.data));
  if (is_first && !chooses_layers_) {
    view_.show(Layer::cloud, false);
    for (const Layer layer : first_layers(view_.data())) {
      view_.show(layer, true);
    }
  }
  say(summary());
}

void ViewerWindow::poll()
{
  if (std::optional<Rerun::Result> result = rerun_.take()) {
    take_result(std::move(*result));
  } else if (rerun_.is_busy() && rerun_.progress() != status()) {
    say(rerun_.progress());
  }
  refine();
}

void ViewerWindow::pick(int x, int y)
{
  vtkRenderer* renderer = view_.renderer();
  const double depth = renderer->GetZ(x, y);
  view_.mark(std::nullopt);
  if (depth >= 1) {
    say("nothing there");
    return;
  }
  renderer->SetDisplayPoint(x, y, depth);
  renderer->DisplayToWorld();
  double world[4];
  renderer->GetWorldPoint(world);
  const Eigen::Vector3d place = Eigen::Vector3d(world[0], world[1], world[2]) / world[3] + view_.center();
  const bool shows_points = view_.is_shown(Layer::cloud) || view_.is_shown(Layer::cells);
  const bool shows_mesh =
      view_.is_shown(Layer::mesh) || view_.is_shown(Layer::deviation) || view_.is_shown(Layer::edges);
  const ViewData& data = view_.data();
  const bool takes_point = data.mesh.vertices.empty() || (shows_points && !shows_mesh);
  const Pick found = takes_point ? pick_point(source_, data, place) : pick_vertex(source_, data, place);
  view_.mark(found.place);
  say(found.text);
}

void ViewerWindow::save_camera()
{
  saved_camera_->DeepCopy(view_.renderer()->GetActiveCamera());
  std::cout << "--camera " << to_text(view_.pose()) << std::endl;
  say("camera saved; k returns to it");
}

bool ViewerWindow::change_look(char key)
{
  vtkCamera* camera = view_.renderer()->GetActiveCamera();
  switch (key) {
    case 'f':
      view_.shade(view_.shading() == Shading::smooth ? Shading::flat
                  : view_.shading() == Shading::flat ? Shading::wireframe
                                                     : Shading::smooth);
      return true;
    case 'o':
      if (!view_.has_scan_colors()) {
        say("the scan has no colours");
        return false;
      }
      view_.show_scan_colors(!view_.shows_scan_colors());
      return true;
    case 'k':
      camera->DeepCopy(saved_camera_);
      camera->Modified();  // VTK's copy does not say so, and the old matrices would go on
      return true;
    case 'r':
      view_.renderer()->ResetCamera();
      return true;
    case 'h':
      help_->SetVisibility(help_->GetVisibility() == 0 ? 1 : 0);
      return true;
    default:
      return false;
  }
}

void ViewerWindow::press(char key, int x, int y)
{
  const auto* layer =
      std::find_if(layer_names.begin(), layer_names.end(), [key](const LayerName& name) { return name.key == key; });
  if (layer != layer_names.end()) {
    toggle(*layer);
    return;
  }
  switch (key) {
    case '+':
    case '-':
    case 'a':
      change_options(key);
      return;
    case 'p':
      pick(x, y);
      return;
    case 'K':
      save_camera();
      return;
    case 'q':
      interactor_->ExitCallback();
      return;
    default:
      if (change_look(key)) {
        draw();
      }
  }
}

}  // namespace pds
