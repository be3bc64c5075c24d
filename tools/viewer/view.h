// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/picture.h"
#include "viewer/actors.h"
#include "viewer/camera_pose.h"

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>

namespace pds
{

/** \brief How faces are drawn. */
enum class Shading
{
  smooth,
  flat,
  wireframe
};

/** \brief A scene of layers that are switched on and off. */
class View
{
 public:
  explicit View(ViewData data);

  /** \brief Shows other data of the same cloud in the same layers from the same place. */
  void replace(ViewData data);

  /** \brief Switches a layer. Some take turns: the cloud with the cells, the mesh with the deviation. A layer without
   * anything to show is shown as soon as replace() brings something.
   * \return false if there is nothing to show in it */
  bool show(Layer layer, bool on);
  [[nodiscard]] bool is_shown(Layer layer) const { return shown_.count(layer) != 0; }

  void shade(Shading shading);
  [[nodiscard]] Shading shading() const { return shading_; }

  /** \brief Shows cloud and mesh in the colours of the scan, as at first, or each in one of our own. */
  void show_scan_colors(bool on);
  [[nodiscard]] bool shows_scan_colors() const { return scan_colors_; }
  [[nodiscard]] bool has_scan_colors() const { return !data_.point_color.empty() || !data_.vertex_color.empty(); }

  /** \brief Fewer points, lines and triangles, so that the view can move fluently; or all of them again. */
  void coarsen(bool coarse);
  [[nodiscard]] bool is_coarse() const { return coarse_; }
  [[nodiscard]] bool is_heavy() const;  ///< more is shown than can move fluently

  /** \brief Puts a mark at a place, in the coordinates of the data; or takes it away. */
  void mark(const std::optional<Eigen::Vector3d>& place);

  void aim(const CameraPlace& place) { aim_camera(renderer_, place); }
  void set_pose(const CameraPose& pose) { pds::set_pose(renderer_, pose, center()); }
  [[nodiscard]] CameraPose pose() const { return pose_of(renderer_->GetActiveCamera(), center()); }

  [[nodiscard]] vtkRenderer* renderer() { return renderer_; }
  [[nodiscard]] const ViewData& data() const { return data_; }
  [[nodiscard]] const Eigen::Vector3d& center() const { return factory_->center(); }

 private:
  [[nodiscard]] std::size_t limit(Layer layer) const;
  void put(Layer layer);
  void take_away(Layer layer);
  void put_all();
  void show_bar();

  ViewData data_;
  std::unique_ptr<ActorFactory> factory_;
  std::set<Layer> wanted_;
  std::map<Layer, vtkSmartPointer<vtkActor>> shown_;
  std::map<std::pair<Layer, std::size_t>, vtkSmartPointer<vtkActor>> made_;  ///< by layer and its limit
  Shading shading_ = Shading::smooth;
  bool scan_colors_ = true;
  bool coarse_ = false;
  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkScalarBarActor> bar_;
  vtkNew<vtkActor> mark_;
};

}  // namespace pds
