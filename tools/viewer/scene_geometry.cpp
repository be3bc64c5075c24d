// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/scene_geometry.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyDataNormals.h>
#include <vtkQuadricClustering.h>
#include <vtkUnsignedCharArray.h>

namespace pds
{

namespace
{

/** \brief Scatters consecutive numbers over all 32 bits (the finalizer of MurmurHash3). */
std::uint32_t scattered(std::uint32_t i)
{
  i = (i ^ (i >> 16)) * 0x85ebca6bU;
  i = (i ^ (i >> 13)) * 0xc2b2ae35U;
  return i ^ (i >> 16);
}

vtkSmartPointer<vtkPolyData> with_normals(vtkPolyData* mesh)
{
  vtkNew<vtkPolyDataNormals> normals;  // neither split nor turned: faces are shown as they are
  normals->SetInputData(mesh);
  normals->SplittingOff();
  normals->ConsistencyOff();
  normals->Update();
  return normals->GetOutput();
}

}  // namespace

Indices spread(std::size_t count, std::size_t limit)
{
  Indices chosen;
  if (count <= limit) {
    chosen.resize(count);
    std::iota(chosen.begin(), chosen.end(), 0U);
    return chosen;
  }
  const auto below = static_cast<std::uint32_t>(0x1p32 * static_cast<double>(limit) / static_cast<double>(count));
  for (std::uint32_t i = 0; i < count; ++i) {
    if (scattered(i) < below) {
      chosen.push_back(i);
    }
  }
  return chosen;
}

vtkSmartPointer<vtkPolyData> point_data(const PointCloudView& cloud,
                                        const Indices& chosen,
                                        const Eigen::Vector3d& center)
{
  vtkNew<vtkPoints> positions;
  vtkNew<vtkCellArray> vertices;
  vertices->Use32BitStorage();
  positions->SetNumberOfPoints(static_cast<vtkIdType>(chosen.size()));
  vertices->AllocateExact(1, static_cast<vtkIdType>(chosen.size()));
  vertices->InsertNextCell(static_cast<int>(chosen.size()));
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const Eigen::Vector3d p = cloud.positions[chosen[i]] - center;
    positions->SetPoint(static_cast<vtkIdType>(i), p.data());
    vertices->InsertCellPoint(static_cast<vtkIdType>(i));
  }
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(positions);
  result->SetVerts(vertices);
  return result;
}

vtkSmartPointer<vtkPolyData> mesh_data(const TriangleMesh& mesh,
                                       const std::vector<double>& face_deviation,
                                       const Eigen::Vector3d& center)
{
  vtkNew<vtkPoints> positions;
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    const Eigen::Vector3d p = vertex - center;
    positions->InsertNextPoint(p.data());
  }
  vtkNew<vtkCellArray> triangles;
  for (const auto& [a, b, c] : mesh.faces) {
    triangles->InsertNextCell({vtkIdType{a}, vtkIdType{b}, vtkIdType{c}});
  }
  vtkNew<vtkPolyData> bare;
  bare->SetPoints(positions);
  bare->SetPolys(triangles);
  if (!face_deviation.empty()) {
    vtkNew<vtkFloatArray> scalars;
    scalars->SetName("deviation");
    for (const double deviation : face_deviation) {
      scalars->InsertNextValue(static_cast<float>(deviation));
    }
    bare->GetCellData()->SetScalars(scalars);
  }
  return with_normals(bare);
}

void set_colors(vtkPolyData* data, const std::vector<ByteColor>& colors)
{
  vtkNew<vtkUnsignedCharArray> scalars;
  scalars->SetName("colors");
  scalars->SetNumberOfComponents(3);
  scalars->SetNumberOfTuples(static_cast<vtkIdType>(colors.size()));
  for (std::size_t i = 0; i < colors.size(); ++i) {
    scalars->SetTypedTuple(static_cast<vtkIdType>(i), colors[i].data());
  }
  data->GetPointData()->SetScalars(scalars);
}

vtkSmartPointer<vtkPolyData> coarse_mesh(vtkPolyData* mesh, double area, std::size_t faces)
{
  // A surface meets about 1.5 cubes of side s per area of s * s, and each leaves a vertex and so two triangles.
  constexpr double faces_of_square = 3;
  const double side = std::sqrt(faces_of_square * area / static_cast<double>(faces));
  vtkNew<vtkQuadricClustering> clustering;
  clustering->SetInputData(mesh);
  clustering->SetDivisionOrigin(mesh->GetCenter());
  clustering->SetDivisionSpacing(side, side, side);
  clustering->CopyCellDataOn();
  clustering->UseInputPointsOn();
  clustering->Update();
  return with_normals(clustering->GetOutput());
}

vtkSmartPointer<vtkPolyData> segment_data(vtkPolyData* points,
                                          const std::vector<std::array<std::uint32_t, 2>>& ends,
                                          const Indices& chosen)
{
  vtkNew<vtkCellArray> lines;
  for (const std::uint32_t i : chosen) {
    lines->InsertNextCell({vtkIdType{ends[i][0]}, vtkIdType{ends[i][1]}});
  }
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(points->GetPoints());
  result->SetLines(lines);
  return result;
}

vtkSmartPointer<vtkPolyData> loop_data(vtkPolyData* mesh, const std::vector<Indices>& loops)
{
  vtkNew<vtkCellArray> lines;
  for (const Indices& loop : loops) {
    lines->InsertNextCell(static_cast<int>(loop.size() + 1));
    for (const std::uint32_t vertex : loop) {
      lines->InsertCellPoint(vertex);
    }
    lines->InsertCellPoint(loop.front());
  }
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(mesh->GetPoints());
  result->SetLines(lines);
  return result;
}

vtkSmartPointer<vtkPolyData> vertex_data(vtkPolyData* mesh, const Indices& chosen)
{
  vtkNew<vtkPoints> positions;
  vtkNew<vtkFloatArray> normals;
  normals->SetNumberOfComponents(3);
  for (const std::uint32_t vertex : chosen) {
    positions->InsertNextPoint(mesh->GetPoint(vertex));
    normals->InsertNextTuple(vertex, mesh->GetPointData()->GetNormals());
  }
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(positions);
  result->GetPointData()->SetNormals(normals);
  return result;
}

}  // namespace pds
