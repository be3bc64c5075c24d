// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/view.h"

#include "viewer/deviation_colors.h"

#include <utility>

#include <vtkAutoInit.h>
#include <vtkCamera.h>
#include <vtkLightKit.h>
#include <vtkProperty.h>
#include <vtkTextProperty.h>

VTK_MODULE_INIT(vtkRenderingOpenGL2)
VTK_MODULE_INIT(vtkRenderingFreeType)

namespace pds
{

namespace
{

// What software rendering draws several times a second on two cores.
constexpr std::size_t fluid_points = 500000;
constexpr std::size_t fluid_triangles = 200000;

bool is_surface(Layer layer) { return layer == Layer::mesh || layer == Layer::deviation; }

bool exclude_each_other(Layer a, Layer b)
{
  const auto is_pair = [a, b](Layer x, Layer y) { return (a == x && b == y) || (a == y && b == x); };
  return is_pair(Layer::cloud, Layer::cells) || is_pair(Layer::mesh, Layer::deviation);
}

}  // namespace

View::View(ViewData data) : data_(std::move(data)), factory_(std::make_unique<ActorFactory>(data_))
{
  renderer_->SetBackground(1, 1, 1);
  vtkNew<vtkLightKit> lights;
  lights->SetKeyLightAngle(45, -35);
  lights->SetKeyToFillRatio(1.7);
  lights->AddLightsToRenderer(renderer_);
  bar_->SetTitle("deviation");
  bar_->SetVerticalTitleSeparation(8);
  bar_->SetLabelFormat("%-#.2g");
  bar_->SetNumberOfLabels(5);
  bar_->SetPosition(0.88, 0.1);
  bar_->SetWidth(0.1);
  bar_->SetHeight(0.8);
  bar_->SetVisibility(false);
  for (vtkTextProperty* text : {bar_->GetTitleTextProperty(), bar_->GetLabelTextProperty()}) {
    text->SetColor(0.1, 0.1, 0.1);
    text->ShadowOff();
    text->ItalicOff();
  }
  renderer_->AddActor2D(bar_);
}

std::size_t View::size(Layer layer) const { return is_surface(layer) ? data_.mesh.faces.size() : data_.cloud.size(); }

bool View::is_large(Layer layer) const { return size(layer) > (is_surface(layer) ? fluid_triangles : fluid_points); }

vtkSmartPointer<vtkActor> View::make(Layer layer, bool coarse) const
{
  if (coarse && is_surface(layer)) {
    return factory_->make_coarse(layer);
  }
  return factory_->make(layer, coarse ? 1 + size(layer) / fluid_points : 1);
}

void View::put(Layer layer)
{
  if (const auto old = shown_.find(layer); old != shown_.end()) {
    renderer_->RemoveActor(old->second);
    shown_.erase(old);
  }
  const bool coarse = coarse_ && is_large(layer);
  vtkSmartPointer<vtkActor>& actor = made_[{layer, coarse}];
  if (!actor) {
    actor = make(layer, coarse);
  }
  if (actor) {
    if (is_surface(layer)) {
      actor->GetProperty()->SetInterpolation(flat_ ? VTK_FLAT : VTK_GOURAUD);
    }
    shown_[layer] = actor;
    renderer_->AddActor(actor);
    if (layer == Layer::deviation) {
      bar_->SetLookupTable(deviation_colors(deviation_reach(data_.face_deviation)));
    }
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
  std::vector<Layer> layers;
  for (const auto& [layer, actor] : shown_) {
    layers.push_back(layer);
  }
  made_.clear();
  data_ = std::move(data);
  factory_ = std::make_unique<ActorFactory>(data_);
  for (const Layer layer : layers) {
    put(layer);
  }
}

bool View::show(Layer layer, bool on)
{
  if (on) {
    for (const LayerName& other : layer_names) {
      if (exclude_each_other(layer, other.layer)) {
        show(other.layer, false);
      }
    }
    put(layer);
    return is_shown(layer);
  }
  if (const auto old = shown_.find(layer); old != shown_.end()) {
    renderer_->RemoveActor(old->second);
    shown_.erase(old);
    show_bar();
  }
  return true;
}

void View::shade_flat(bool flat)
{
  flat_ = flat;
  for (const auto& [layer, actor] : shown_) {
    if (is_surface(layer)) {
      actor->GetProperty()->SetInterpolation(flat ? VTK_FLAT : VTK_GOURAUD);
    }
  }
}

void View::coarsen(bool coarse)
{
  coarse_ = coarse;
  std::vector<Layer> layers;
  for (const auto& [layer, actor] : shown_) {
    layers.push_back(layer);
  }
  for (const Layer layer : layers) {
    if (is_large(layer)) {
      put(layer);
    }
  }
}

}  // namespace pds
