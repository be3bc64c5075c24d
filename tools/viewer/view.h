// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/picture.h"
#include "viewer/actors.h"

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>

namespace pds
{

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

  void aim(const CameraPlace& place) { aim_camera(renderer_, place); }

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

}  // namespace pds
