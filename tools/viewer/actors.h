// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "viewer/view_data.h"

#include <vtkActor.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

namespace pds
{

/** \brief Turns view data into VTK's actors. Coordinates are relative to the centre of the data, since VTK's cards
 * draw in single precision. */
class ActorFactory
{
 public:
  /** \param data must outlive this object */
  explicit ActorFactory(const ViewData& data);

  /** \brief The actor of a layer; nullptr if the data has nothing to show in it.
   * \param every of the points of clouds: 1 = all, 10 = every tenth
   */
  [[nodiscard]] vtkSmartPointer<vtkActor> make(Layer layer, std::size_t every = 1) const;

  /** \brief The mesh in fewer triangles, to be shown while the view moves; in the colours of \a layer. */
  [[nodiscard]] vtkSmartPointer<vtkActor> make_coarse(Layer layer) const;

  [[nodiscard]] const Eigen::Vector3d& center() const { return center_; }

 private:
  using Chosen = std::vector<std::uint32_t>;

  [[nodiscard]] vtkSmartPointer<vtkPolyData> points(const Chosen& chosen) const;
  [[nodiscard]] vtkSmartPointer<vtkPolyData> mesh() const;
  [[nodiscard]] vtkSmartPointer<vtkPolyData> loops() const;
  [[nodiscard]] vtkSmartPointer<vtkActor> make_points(Layer layer, std::size_t every) const;
  [[nodiscard]] vtkSmartPointer<vtkActor> make_glyphs(Layer layer) const;
  [[nodiscard]] vtkSmartPointer<vtkActor> make_surface(Layer layer, vtkPolyData* mesh) const;

  const ViewData& data_;
  Eigen::Vector3d center_{0, 0, 0};
  vtkSmartPointer<vtkPolyData> mesh_;
};

}  // namespace pds
