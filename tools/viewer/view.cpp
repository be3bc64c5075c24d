// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/view.h"

#include "viewer/deviation_colors.h"

#include <algorithm>
#include <limits>
#include <utility>

#include <vtkAutoInit.h>
#include <vtkCamera.h>
#include <vtkLight.h>
#include <vtkPointSource.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkTextProperty.h>

VTK_MODULE_INIT(vtkRenderingOpenGL2)
VTK_MODULE_INIT(vtkRenderingFreeType)

namespace pds
{

namespace
{

// What two cores draw at least 15 times a second without a graphics card: docs/viewer.md has the figures.
constexpr std::size_t fluid_points = 80000;
constexpr std::size_t fluid_faces = 40000;
constexpr std::size_t fluid_lines = 40000;
constexpr std::size_t unlimited = std::numeric_limits<std::size_t>::max();

bool is_surface(Layer layer) { return layer == Layer::mesh || layer == Layer::deviation; }

std::size_t fluid_size(Layer layer)
{
  switch (layer) {
    case Layer::mesh:
    case Layer::deviation:
      return fluid_faces;
    case Layer::edges:
    case Layer::graph:
    case Layer::disks:
    case Layer::normals:
      return fluid_lines;
    case Layer::loops:
      return unlimited;
    default:
      return fluid_points;
  }
}

bool exclude_each_other(Layer a, Layer b)
{
  const auto is_pair = [a, b](Layer x, Layer y) { return (a == x && b == y) || (a == y && b == x); };
  return is_pair(Layer::cloud, Layer::cells) || is_pair(Layer::mesh, Layer::deviation);
}

/** \brief A light that goes with the camera. Two of them: without a graphics card each costs a tenth of a frame. */
void add_light(vtkRenderer* renderer, double elevation, double azimuth, double intensity)
{
  vtkNew<vtkLight> light;
  light->SetLightTypeToCameraLight();
  light->SetDirectionAngle(elevation, azimuth);
  light->SetIntensity(intensity);
  renderer->AddLight(light);
}

void set_up_bar(vtkScalarBarActor* bar)
{
  bar->SetTitle("deviation");
  bar->SetVerticalTitleSeparation(8);
  bar->SetLabelFormat("%-#.2g");
  bar->SetNumberOfLabels(5);
  bar->SetPosition(0.88, 0.1);
  bar->SetWidth(0.1);
  bar->SetHeight(0.8);
  bar->SetVisibility(false);
  for (vtkTextProperty* text : {bar->GetTitleTextProperty(), bar->GetLabelTextProperty()}) {
    text->SetColor(0.1, 0.1, 0.1);
    text->ShadowOff();
    text->ItalicOff();
  }
}

void set_up_mark(vtkActor* mark)
{
  vtkNew<vtkPointSource> point;
  point->SetNumberOfPoints(1);
  point->SetRadius(0);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(point->GetOutputPort());
  mark->SetMapper(mapper);
  mark->GetProperty()->SetPointSize(10);
  mark->GetProperty()->SetColor(0.9, 0, 0.8);
  mark->GetProperty()->LightingOff();
  mark->SetVisibility(false);
}

}  // namespace

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

View::View(ViewData data) : data_(std::move(data)), factory_(std::make_unique<ActorFactory>(data_))
{
  renderer_->SetBackground(1, 1, 1);
  add_light(renderer_, 45, -35, 0.5);
  add_light(renderer_, 0, 0, 0.6);
  set_up_bar(bar_);
  set_up_mark(mark_);
  renderer_->AddActor2D(bar_);
  renderer_->AddActor(mark_);
}

bool View::is_heavy() const
{
  return std::any_of(shown_.begin(), shown_.end(),
                     [this](const auto& shown) { return factory_->size(shown.first) > fluid_size(shown.first); });
}

/** Heavy layers share what can move fluently. */
std::size_t View::limit(Layer layer) const
{
  if (!coarse_ || factory_->size(layer) <= fluid_size(layer)) {
    return unlimited;
  }
  const auto sharing = std::count_if(wanted_.begin(), wanted_.end(),
                                     [this](Layer other) { return factory_->size(other) > fluid_size(other); });
  return fluid_size(layer) / static_cast<std::size_t>(std::max<std::ptrdiff_t>(sharing, 1));
}

void View::put(Layer layer)
{
  take_away(layer);
  vtkSmartPointer<vtkActor>& actor = made_[{layer, limit(layer)}];
  if (!actor) {
    actor = factory_->make(layer, limit(layer));
  }
  if (!actor) {
    return;
  }
  shown_[layer] = actor;
  renderer_->AddActor(actor);
  if (is_surface(layer)) {
    actor->GetProperty()->SetInterpolation(shading_ == Shading::flat ? VTK_FLAT : VTK_GOURAUD);
    actor->GetProperty()->SetRepresentation(shading_ == Shading::wireframe ? VTK_WIREFRAME : VTK_SURFACE);
  }
  if (layer == Layer::cloud || layer == Layer::mesh) {
    actor->GetMapper()->SetScalarVisibility(scan_colors_);
  }
  if (layer == Layer::deviation) {
    bar_->SetLookupTable(deviation_colors(deviation_reach(data_.face_deviation)));
  }
}

void View::take_away(Layer layer)
{
  if (const auto old = shown_.find(layer); old != shown_.end()) {
    renderer_->RemoveActor(old->second);
    shown_.erase(old);
  }
}

void View::put_all()
{
  for (const Layer layer : wanted_) {
    put(layer);
  }
  show_bar();
}

void View::show_bar()
{
  constexpr double aside = 0.12;  // of half the width: the place of the bar
  bar_->SetVisibility(is_shown(Layer::deviation));
  renderer_->GetActiveCamera()->SetWindowCenter(is_shown(Layer::deviation) ? aside : 0, 0);
}

void View::replace(ViewData data)
{
  mark(std::nullopt);
  for (auto made = made_.begin(); made != made_.end();) {
    made = made->first.first == Layer::cloud && made->second ? std::next(made) : made_.erase(made);
  }
  data_ = std::move(data);
  factory_ = std::make_unique<ActorFactory>(data_);
  put_all();
}

bool View::show(Layer layer, bool on)
{
  if (on) {
    for (const LayerName& other : layer_names) {
      if (exclude_each_other(layer, other.layer)) {
        show(other.layer, false);
      }
    }
    wanted_.insert(layer);
    put(layer);
  } else {
    wanted_.erase(layer);
    take_away(layer);
  }
  show_bar();
  return is_shown(layer) == on;
}

void View::shade(Shading shading)
{
  shading_ = shading;
  put_all();
}

void View::show_scan_colors(bool on)
{
  scan_colors_ = on;
  put_all();
}

void View::coarsen(bool coarse)
{
  coarse_ = coarse;
  put_all();
}

void View::mark(const std::optional<Eigen::Vector3d>& place)
{
  mark_->SetVisibility(place ? 1 : 0);
  if (place) {
    const Eigen::Vector3d p = *place - center();
    mark_->SetPosition(p.x(), p.y(), p.z());
  }
}

}  // namespace pds
