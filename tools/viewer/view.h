// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "viewer/actors.h"

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>

namespace pds
{

/** \brief Where the camera stands. */
struct CameraPlace
{
  double azimuth = 0;    ///< degrees around the up axis
  double elevation = 0;  ///< degrees above the horizon
  double zoom = 1.4;     ///< 1: the sphere around everything fits the picture
  char up = 'y';         ///< axis that points up: y or z
};

/** \brief A scene of layers that are switched on and off. */
class View
{
 public:
  explicit View(ViewData data);

  /** \brief Shows other data in the same layers from the same place. */
  void replace(ViewData data);

  /** \brief Switches a layer. Some take turns: the cloud with the cells, the mesh with the deviation.
   * \return false if there is nothing to show in it */
  bool show(Layer layer, bool on);
  [[nodiscard]] bool is_shown(Layer layer) const { return shown_.count(layer) != 0; }

  /** \brief Flat faces (true) or smooth ones. */
  void shade_flat(bool flat);
  [[nodiscard]] bool is_flat() const { return flat_; }

  /** \brief Fewer points and triangles while the view moves. */
  void coarsen(bool coarse);

  void aim(const CameraPlace& place);

  [[nodiscard]] vtkRenderer* renderer() { return renderer_; }
  [[nodiscard]] const ViewData& data() const { return data_; }
  [[nodiscard]] const Eigen::Vector3d& center() const { return factory_->center(); }

 private:
  [[nodiscard]] vtkSmartPointer<vtkActor> make(Layer layer, bool coarse) const;
  [[nodiscard]] bool is_large(Layer layer) const;
  [[nodiscard]] std::size_t size(Layer layer) const;
  void put(Layer layer);
  void show_bar();

  ViewData data_;
  std::unique_ptr<ActorFactory> factory_;
  std::map<Layer, vtkSmartPointer<vtkActor>> shown_;
  std::map<std::pair<Layer, bool>, vtkSmartPointer<vtkActor>> made_;  ///< by layer, and whether it is coarse
  bool flat_ = false;
  bool coarse_ = false;
  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkScalarBarActor> bar_;
};

/** \brief Writes what the window shows as PNG, under its name only when it is complete.
 * \throws std::runtime_error if it cannot be written */
void save_picture(vtkRenderWindow* window, const std::string& path);

/** \brief Draws the view into a PNG of this size without showing a window; there must be an X display. */
void draw_picture(View& view, int width, int height, const std::string& path);

}  // namespace pds
