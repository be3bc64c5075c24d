// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/colors.h"

#include <pcl_pds_recon/point_cloud_view.h>
#include <pcl_pds_recon/triangle_mesh.h>

#include <cstdint>
#include <vector>

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

// What is drawn, as VTK's data. Coordinates are relative to a centre, since graphics cards draw in single precision.

namespace pds
{

using Indices = std::vector<std::uint32_t>;

/** \brief About \a limit of the numbers 0 ... \a count - 1, or all if they are no more. Always the same ones, evenly
 * spread but in no step that could meet the rows of a scan. */
[[nodiscard]] Indices spread(std::size_t count, std::size_t limit);

/** \brief The points, drawn as one cell: a cell each would cost more memory than the points. */
[[nodiscard]] vtkSmartPointer<vtkPolyData> point_data(const PointCloudView& cloud,
                                                      const Indices& chosen,
                                                      const Eigen::Vector3d& center);

/** \brief The mesh with the normals of its vertices; \a face_deviation may be empty. */
[[nodiscard]] vtkSmartPointer<vtkPolyData> mesh_data(const TriangleMesh& mesh,
                                                     const std::vector<double>& face_deviation,
                                                     const Eigen::Vector3d& center);

/** \brief Gives each point a colour. */
void set_colors(vtkPolyData* data, const std::vector<ByteColor>& colors);

/** \brief About the same surface in about \a faces triangles, without care for its topology. */
[[nodiscard]] vtkSmartPointer<vtkPolyData> coarse_mesh(vtkPolyData* mesh, double area, std::size_t faces);

/** \brief Line segments between these points. */
[[nodiscard]] vtkSmartPointer<vtkPolyData> segment_data(vtkPolyData* points,
                                                        const std::vector<std::array<std::uint32_t, 2>>& ends,
                                                        const Indices& chosen);

/** \brief Closed lines through vertices of the mesh. */
[[nodiscard]] vtkSmartPointer<vtkPolyData> loop_data(vtkPolyData* mesh, const std::vector<Indices>& loops);

/** \brief A vertex of the mesh each, with its normal. */
[[nodiscard]] vtkSmartPointer<vtkPolyData> vertex_data(vtkPolyData* mesh, const Indices& chosen);

}  // namespace pds
