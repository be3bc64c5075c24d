// SPDX-License-Identifier: BSD-3-Clause
#include "compare/vtk_reader.h"

#include "compare/face_readers.h"
#include "compare/vtk_complaints.h"
#include "io/file_extension.h"

#include <pcl_pds_recon/options.h>

#include <exception>

#include <vtkCellArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataReader.h>
#include <vtkXMLPolyDataReader.h>

namespace pds
{

namespace
{

template <typename Reader>
vtkSmartPointer<vtkPolyData> read_poly_data(const std::string& path)
{
  const VtkComplaints complaints;
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  try {
    reader->Update();
  } catch (const std::exception& error) {
    throw InvalidInput(std::string("cannot be read, is it complete? ") + error.what());
  }
  if (!complaints.first().empty()) {
    throw InvalidInput("cannot be read, is it complete? " + complaints.first());
  }
  return reader->GetOutput();
}

std::uint32_t to_index(vtkIdType id, vtkIdType point_count)
{
  if (id < 0 || id >= point_count) {
    throw InvalidInput("a face names a vertex that is not there; write the mesh again");
  }
  return static_cast<std::uint32_t>(id);
}

void add_polygons(vtkPolyData& data, Triangles& triangles)
{
  vtkNew<vtkIdList> ids;
  std::vector<std::uint32_t> corners;
  vtkCellArray* polygons = data.GetPolys();
  for (polygons->InitTraversal(); polygons->GetNextCell(ids) != 0;) {
    corners.clear();
    for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i) {
      corners.push_back(to_index(ids->GetId(i), data.GetNumberOfPoints()));
    }
    add_polygon(corners, triangles);
  }
}

void add_strips(vtkPolyData& data, Triangles& triangles)
{
  vtkNew<vtkIdList> ids;
  vtkCellArray* strips = data.GetStrips();
  for (strips->InitTraversal(); strips->GetNextCell(ids) != 0;) {
    for (vtkIdType i = 2; i < ids->GetNumberOfIds(); ++i) {
      const vtkIdType odd = i % 2;  // every other triangle of a strip runs the other way
      triangles.push_back({to_index(ids->GetId(i - 2 + odd), data.GetNumberOfPoints()),
                           to_index(ids->GetId(i - 1 - odd), data.GetNumberOfPoints()),
                           to_index(ids->GetId(i), data.GetNumberOfPoints())});
    }
  }
}

}  // namespace

MeshFile read_with_vtk(const std::string& path)
{
  const vtkSmartPointer<vtkPolyData> data = file_extension(path) == ".vtp" ? read_poly_data<vtkXMLPolyDataReader>(path)
                                                                           : read_poly_data<vtkPolyDataReader>(path);
  if (data->GetNumberOfPoints() == 0) {
    throw InvalidInput("holds no points; write the mesh again");
  }
  MeshFile mesh{PointTable({{"x", ScalarType::float64}, {"y", ScalarType::float64}, {"z", ScalarType::float64}}), {}};
  mesh.points.resize(static_cast<std::size_t>(data->GetNumberOfPoints()));
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    double p[3];
    data->GetPoint(static_cast<vtkIdType>(i), p);
    for (std::size_t k = 0; k < 3; ++k) {
      mesh.points.set_value(i, mesh.points.fields()[k], p[k]);
    }
  }
  add_polygons(*data, mesh.triangles);
  add_strips(*data, mesh.triangles);
  return mesh;
}

}  // namespace pds
