// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/viewer_window.h"

#include "viewer/keys.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <vtkAutoInit.h>
#include <vtkCamera.h>
#include <vtkCommand.h>
#include <vtkInteractorStyleTrackballCamera.h>
#include <vtkObjectFactory.h>
#include <vtkTextProperty.h>

VTK_MODULE_INIT(vtkInteractionStyle)

namespace pds
{

namespace
{

constexpr double radius_step = 1.25;    // of a press of + or -
constexpr double adaptive_step = 0.1;   // of a press of a
constexpr double most_adaptive = 0.31;  // then it starts again; the paper goes up to 0.3
constexpr unsigned long poll_milliseconds = 100;

/** \brief Mouse as usual in VTK; keys as in key_help(). */
class Style : public vtkInteractorStyleTrackballCamera
{
 public:
  static Style* New();

  void OnChar() override
  {
    int x = 0;
    int y = 0;
    Interactor->GetEventPosition(x, y);
    window->press(Interactor->GetKeyCode(), x, y);
  }
  void OnTimer() override
  {
    vtkInteractorStyleTrackballCamera::OnTimer();
    window->poll();
  }
  void StartState(int state) override
  {
    view->coarsen(true);
    vtkInteractorStyleTrackballCamera::StartState(state);
  }
  void StopState() override
  {
    vtkInteractorStyleTrackballCamera::StopState();
    view->coarsen(false);
    Interactor->Render();
  }

  ViewerWindow* window = nullptr;
  View* view = nullptr;
};
vtkStandardNewMacro(Style);

std::uint32_t nearest(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& p)
{
  std::uint32_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const double distance = (points[i] - p).squaredNorm();
    if (distance < least) {
      least = distance;
      best = i;
    }
  }
  return best;
}

void set_up_text(vtkTextActor* text, double x, double y, int size)
{
  text->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  text->SetPosition(x, y);
  text->GetTextProperty()->SetColor(0.1, 0.1, 0.1);
  text->GetTextProperty()->SetFontSize(size);
}

}  // namespace

ViewerWindow::ViewerWindow(View& view, const ViewSource& source, const ViewerOptions& options)
    : view_(view), source_(source), options_(options.reconstruction), rerun_(source)
{
  window_->SetSize(options.width, options.height);
  window_->SetWindowName("pcl_pds_viewer");
  window_->SetMultiSamples(0);  // without a graphics card they cost most of a frame
  window_->AddRenderer(view.renderer());
  vtkNew<Style> style;
  style->window = this;
  style->view = &view;
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
  window_->Render();
  interactor_->Initialize();
}

void ViewerWindow::run()
{
  open();
  interactor_->CreateRepeatingTimer(poll_milliseconds);
  interactor_->Start();
}

std::string ViewerWindow::summary() const
{
  const ViewData& data = view_.data();
  std::string text = fmt::format("{} vertices, {} faces, {} boundary loops", data.mesh.vertices.size(),
                                 data.mesh.faces.size(), data.boundary_loops.size());
  if (source_.is_cloud) {
    text +=
        fmt::format("; {} points, radius {:.4g}, adaptive {:.2g}", data.cloud.size(), data.radius, options_.adaptive);
  }
  return text;
}

void ViewerWindow::say(const std::string& text)
{
  status_->SetInput(text.c_str());
  window_->Render();
}

void ViewerWindow::toggle(const LayerName& layer)
{
  const bool done = view_.show(layer.layer, !view_.is_shown(layer.layer));
  say(done ? summary() : std::string("there is nothing to show as ") + layer.name);
}

void ViewerWindow::change_options(char key)
{
  if (!source_.is_cloud) {
    say("this is a mesh already; give a cloud, or --points");
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

void ViewerWindow::poll()
{
  if (!rerun_.is_busy()) {
    return;
  }
  if (std::optional<Rerun::Result> result = rerun_.take()) {
    if (!result->error.empty() || result->data.mesh.faces.empty()) {
      say(result->error.empty() ? "no faces came out; try another radius" : result->error);
      return;
    }
    view_.replace(std::move(result->data));
    say(summary());
  } else if (const std::string now = rerun_.progress(); now != status()) {
    say(now);
  }
}

std::string ViewerWindow::describe_place(int x, int y) const
{
  const double depth = view_.renderer()->GetZ(x, y);
  if (depth >= 1) {
    return "nothing there";
  }
  view_.renderer()->SetDisplayPoint(x, y, depth);
  view_.renderer()->DisplayToWorld();
  double world[4];
  view_.renderer()->GetWorldPoint(world);
  const Eigen::Vector3d place = Eigen::Vector3d(world[0], world[1], world[2]) / world[3] + view_.center();
  const ViewData& data = view_.data();
  if (data.mesh.vertices.empty()) {
    return fmt::format("point {}", nearest(data.cloud, place));
  }
  const std::uint32_t vertex = nearest(data.mesh.vertices, place);
  std::string text = fmt::format("vertex {}", vertex);
  std::uint32_t row = vertex;
  if (source_.is_cloud) {
    row = data.seeds[vertex];
    text += fmt::format(", input point {}, cell of {} points", row,
                        std::count(data.label.begin(), data.label.end(), vertex));
  }
  if (!data.deviation.empty()) {
    text += fmt::format(", deviation {:.5g}", data.deviation[vertex]);
  }
  const PointTable& table = source_.input.points;
  for (const Field& field : table.fields()) {
    text += fmt::format(", {} {:.8g}", field.name, table.value(row, field));
  }
  return text;
}

void ViewerWindow::press(char key, int x, int y)
{
  const auto* layer =
      std::find_if(layer_names.begin(), layer_names.end(), [key](const LayerName& name) { return name.key == key; });
  if (layer != layer_names.end()) {
    toggle(*layer);
    return;
  }
  vtkCamera* camera = view_.renderer()->GetActiveCamera();
  switch (key) {
    case 'f':
      view_.shade_flat(!view_.is_flat());
      break;
    case '+':
    case '-':
    case 'a':
      change_options(key);
      return;
    case 'p':
      say(describe_place(x, y));
      return;
    case 'K':
      saved_camera_->DeepCopy(camera);
      say("camera saved; k returns to it");
      return;
    case 'k':
      camera->DeepCopy(saved_camera_);
      camera->Modified();  // VTK's copy does not say so, and the old matrices would go on
      break;
    case 'r':
      view_.renderer()->ResetCamera();
      break;
    case 'h':
      help_->SetVisibility(help_->GetVisibility() == 0 ? 1 : 0);
      break;
    case 'q':
      interactor_->ExitCallback();
      return;
    default:
      return;
  }
  window_->Render();
}

}  // namespace pds
