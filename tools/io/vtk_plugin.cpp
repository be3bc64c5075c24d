// SPDX-License-Identifier: BSD-3-Clause
#include "io/vtk_writer.h"

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataWriter.h>
#include <vtkSmartPointer.h>
#include <vtkXMLPolyDataWriter.h>
#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <functional>
#include <string>
#include <string_view>

namespace pds
{

namespace
{

int vtk_type(ScalarType type)
{
  switch (type) {
    case ScalarType::int8:
      return VTK_SIGNED_CHAR;
    case ScalarType::uint8:
      return VTK_UNSIGNED_CHAR;
    case ScalarType::int16:
      return VTK_SHORT;
    case ScalarType::uint16:
      return VTK_UNSIGNED_SHORT;
    case ScalarType::int32:
      return VTK_INT;
    case ScalarType::uint32:
      return VTK_UNSIGNED_INT;
    case ScalarType::int64:
      return VTK_LONG_LONG;
    case ScalarType::uint64:
      return VTK_UNSIGNED_LONG_LONG;
    case ScalarType::float32:
      return VTK_FLOAT;
    case ScalarType::float64:
      break;
  }
  return VTK_DOUBLE;
}

/** One array of as many components as names; all these fields have the type of the first. */
template <std::size_t Size>
vtkSmartPointer<vtkDataArray> make_array(const PointTable& points, const std::array<const char*, Size>& names)
{
  const ScalarType type = points.find(names.front())->type;
  auto array = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(vtk_type(type)));
  array->SetNumberOfComponents(static_cast<int>(names.size()));
  array->SetNumberOfTuples(static_cast<vtkIdType>(points.size()));
  auto* target = static_cast<std::byte*>(array->GetVoidPointer(0));
  for (std::size_t row = 0; row < points.size(); ++row) {
    for (const char* name : names) {
      std::memcpy(target, points.record(row) + points.find(name)->offset, size_of(type));
      target += size_of(type);
    }
  }
  return array;
}

/** VTK writes names into XML as they are, which may be no UTF-8. */
std::string xml_name(std::string name)
{
  constexpr std::string_view markup = "<>&\"'";
  const auto is_safe = [&](char c) {
    return static_cast<unsigned char>(c) < 128 && markup.find(c) == std::string_view::npos;
  };
  std::replace_if(name.begin(), name.end(), std::not_fn(is_safe), '_');
  return name;
}

void add_fields(const PointTable& points, vtkPointData& data)
{
  const bool has_colors = points.color_type().has_value();
  if (points.has_normals()) {
    const auto normals = make_array(points, normal_fields);
    normals->SetName("Normals");
    data.SetNormals(normals);
  }
  if (has_colors) {
    const auto colors = make_array(points, color_fields);
    colors->SetName("RGB");
    data.SetScalars(colors);
  }
  for (const Field& field : points.fields()) {
    const bool is_done = is_one_of(field.name, position_fields) ||
                         (points.has_normals() && is_one_of(field.name, normal_fields)) ||
                         (has_colors && is_one_of(field.name, color_fields));
    if (!is_done) {
      const auto array = make_array(points, std::array{field.name.c_str()});
      array->SetName(xml_name(field.name).c_str());
      data.AddArray(array);
    }
  }
}

template <typename Cells>
vtkSmartPointer<vtkCellArray> make_cells(const Cells& cells)
{
  auto array = vtkSmartPointer<vtkCellArray>::New();
  for (const auto& cell : cells) {
    array->InsertNextCell(static_cast<int>(cell.size()));
    for (const std::uint32_t vertex : cell) {
      array->InsertCellPoint(vertex);
    }
  }
  return array;
}

vtkSmartPointer<vtkPolyData> make_poly_data(const PointTable& points,
                                            const Triangles& triangles,
                                            const Segments& segments)
{
  vtkNew<vtkPoints> positions;
  positions->SetData(make_array(points, position_fields));
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(positions);
  mesh->SetPolys(make_cells(triangles));
  mesh->SetLines(make_cells(segments));
  add_fields(points, *mesh->GetPointData());
  return mesh;
}

/** Laid out in memory, because VTK's writers do not notice in every case that the disk is full. */
template <typename Writer>
bool render(Writer& writer, vtkPolyData* mesh)
{
  writer.SetInputData(mesh);
  writer.WriteToOutputStringOn();
  return writer.Write() != 0;
}

bool render_vtp(vtkPolyData* mesh, bool ascii, std::string& bytes)
{
  vtkNew<vtkXMLPolyDataWriter> writer;
  if (ascii) {
    writer->SetDataModeToAscii();
  }
  const bool is_rendered = render(*writer, mesh);
  bytes = writer->GetOutputString();
  return is_rendered;
}

bool render_legacy_vtk(vtkPolyData* mesh, bool ascii, std::string& bytes)
{
  vtkNew<vtkPolyDataWriter> writer;
  writer->SetFileType(ascii ? VTK_ASCII : VTK_BINARY);
  const bool is_rendered = render(*writer, mesh);
  bytes = std::string(writer->GetOutputString(), static_cast<std::size_t>(writer->GetOutputStringLength()));
  return is_rendered;
}

}  // namespace

void pcl_pds_recon_render_with_vtk(const std::string& extension,
                                   const PointTable& points,
                                   const Triangles& triangles,
                                   const Segments& segments,
                                   bool ascii,
                                   std::string& bytes,
                                   std::string& complaint)
{
  try {
    vtkObject::GlobalWarningDisplayOff();  // what goes wrong is reported by the caller, in one line
    const auto mesh = make_poly_data(points, triangles, segments);
    if (!(extension == ".vtp" ? render_vtp : render_legacy_vtk)(mesh, ascii, bytes)) {
      complaint = "the mesh cannot be laid out in memory for VTK's format; write .ply, which does without";
    }
  } catch (const std::exception& error) {
    complaint = error.what();
  }
}

}  // namespace pds
