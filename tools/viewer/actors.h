// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "viewer/scene_geometry.h"
#include "viewer/view_data.h"

#include <limits>
#include <map>

#include <vtkActor.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

namespace pds
{

/** \brief Turns view data into VTK's actors. */
class ActorFactory
{
 public:
  /** \param data must outlive this object */
  explicit ActorFactory(const ViewData& data);

  /** \brief Number of points, lines or triangles in a layer; 0: there is nothing to show. */
  [[nodiscard]] std::size_t size(Layer layer) const;

  /** \brief The actor of a layer; nullptr if there is nothing to show.
   * \param limit about as many points, lines or triangles are drawn instead of all, if they are fewer
   */
  [[nodiscard]] vtkSmartPointer<vtkActor> make(Layer layer,
                                               std::size_t limit = std::numeric_limits<std::size_t>::max());

  [[nodiscard]] const Eigen::Vector3d& center() const { return center_; }

 private:
  [[nodiscard]] vtkPolyData* mesh(std::size_t limit);
  [[nodiscard]] Indices choose_points(Layer layer, std::size_t limit) const;
  [[nodiscard]] std::vector<ByteColor> point_colors(Layer layer, const Indices& chosen) const;
  [[nodiscard]] vtkSmartPointer<vtkActor> make_points(Layer layer, std::size_t limit) const;
  [[nodiscard]] vtkSmartPointer<vtkActor> make_glyphs(Layer layer, std::size_t limit);
  [[nodiscard]] vtkSmartPointer<vtkActor> make_surface(Layer layer, std::size_t limit);
  [[nodiscard]] vtkSmartPointer<vtkActor> make_lines(Layer layer, std::size_t limit);

  const ViewData& data_;
  Eigen::Vector3d center_{0, 0, 0};
  double area_ = 0;                                           ///< of the mesh
  std::map<std::size_t, vtkSmartPointer<vtkPolyData>> mesh_;  ///< by the number of its triangles
};

}  // namespace pds
