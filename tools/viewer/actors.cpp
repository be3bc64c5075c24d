// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/actors.h"

#include "viewer/deviation_colors.h"

#include <pcl_pds_recon/reconstruction.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include <vtkArrowSource.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkGlyph3D.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkQuadricClustering.h>
#include <vtkRegularPolygonSource.h>
#include <vtkTransform.h>
#include <vtkUnsignedCharArray.h>

namespace pds
{

namespace
{

struct Color
{
  double red, green, blue;
};

/** \brief A lively colour of its own for every Voronoi cell: hues a golden angle apart. */
Color cell_color(std::uint32_t label)
{
  if (label == no_label) {
    return {0.6, 0.6, 0.6};
  }
  const double turns = label * 0.61803398874989484820;
  const double hue = 6 * (turns - std::floor(turns));
  const auto channel = [hue](double at) {
    const double away = std::abs(std::fmod(hue - at + 9, 6) - 3);
    return 0.35 + 0.6 * std::clamp(2 - away, 0.0, 1.0);
  };
  return {channel(0), channel(2), channel(4)};
}

vtkSmartPointer<vtkActor> make_actor(vtkPolyData* data, const Color& color, float point_size = 1)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(color.red, color.green, color.blue);
  actor->GetProperty()->SetPointSize(point_size);
  actor->GetProperty()->LightingOff();
  return actor;
}

void color_cells(vtkPolyData* points, const std::vector<std::uint32_t>& chosen, const std::vector<std::uint32_t>& label)
{
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  colors->SetNumberOfTuples(static_cast<vtkIdType>(chosen.size()));
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const Color color = cell_color(label[chosen[i]]);
    colors->SetTuple3(static_cast<vtkIdType>(i), 255 * color.red, 255 * color.green, 255 * color.blue);
  }
  points->GetPointData()->SetScalars(colors);
}

}  // namespace

ActorFactory::ActorFactory(const ViewData& data) : data_(data)
{
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : data.mesh.vertices.empty() ? data.cloud : data.mesh.vertices) {
    if (p.allFinite()) {
      box.extend(p);
    }
  }
  center_ = box.isEmpty() ? Eigen::Vector3d(0, 0, 0) : Eigen::Vector3d(box.center());
  mesh_ = mesh();
}

vtkSmartPointer<vtkPolyData> ActorFactory::points(const Chosen& chosen) const
{
  vtkNew<vtkPoints> positions;
  vtkNew<vtkCellArray> vertices;
  positions->SetNumberOfPoints(static_cast<vtkIdType>(chosen.size()));
  vertices->AllocateExact(1, static_cast<vtkIdType>(chosen.size()));
  vertices->InsertNextCell(static_cast<int>(chosen.size()));
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const Eigen::Vector3d p = data_.cloud[chosen[i]] - center_;
    positions->SetPoint(static_cast<vtkIdType>(i), p.data());
    vertices->InsertCellPoint(static_cast<vtkIdType>(i));
  }
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(positions);
  result->SetVerts(vertices);
  return result;
}

vtkSmartPointer<vtkPolyData> ActorFactory::mesh() const
{
  vtkNew<vtkPoints> positions;
  for (const Eigen::Vector3d& vertex : data_.mesh.vertices) {
    const Eigen::Vector3d p = vertex - center_;
    positions->InsertNextPoint(p.data());
  }
  vtkNew<vtkCellArray> triangles;
  for (const auto& [a, b, c] : data_.mesh.faces) {
    triangles->InsertNextCell({vtkIdType{a}, vtkIdType{b}, vtkIdType{c}});
  }
  vtkNew<vtkPolyData> bare;
  bare->SetPoints(positions);
  bare->SetPolys(triangles);
  if (!data_.face_deviation.empty()) {
    vtkNew<vtkFloatArray> scalars;
    scalars->SetName("deviation");
    for (const double deviation : data_.face_deviation) {
      scalars->InsertNextValue(static_cast<float>(deviation));
    }
    bare->GetCellData()->SetScalars(scalars);
  }
  vtkNew<vtkPolyDataNormals> normals;  // neither split nor turned: faces are shown as they are
  normals->SetInputData(bare);
  normals->SplittingOff();
  normals->ConsistencyOff();
  normals->Update();
  return normals->GetOutput();
}

vtkSmartPointer<vtkPolyData> ActorFactory::loops() const
{
  vtkNew<vtkCellArray> lines;
  for (const auto& loop : data_.boundary_loops) {
    lines->InsertNextCell(static_cast<int>(loop.size() + 1));
    for (const std::uint32_t vertex : loop) {
      lines->InsertCellPoint(vertex);
    }
    lines->InsertCellPoint(loop.front());
  }
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(mesh_->GetPoints());
  result->SetLines(lines);
  return result;
}

vtkSmartPointer<vtkActor> ActorFactory::make_points(Layer layer, std::size_t every) const
{
  Chosen chosen;
  const auto take = [&](std::uint32_t i) {
    if (i % every == 0 && data_.cloud[i].allFinite()) {
      chosen.push_back(i);
    }
  };
  if (layer == Layer::seeds) {
    every = 1;
    std::for_each(data_.seeds.begin(), data_.seeds.end(), take);
  } else if (layer == Layer::witnesses) {
    std::for_each(data_.witnesses.begin(), data_.witnesses.end(), take);
  } else if (layer == Layer::cloud || !data_.label.empty()) {
    for (std::uint32_t i = 0; i < data_.cloud.size(); ++i) {
      take(i);
    }
  }
  if (chosen.empty()) {
    return nullptr;
  }
  const vtkSmartPointer<vtkPolyData> data = points(chosen);
  switch (layer) {
    case Layer::seeds:
      return make_actor(data, {0.85, 0.1, 0.1}, 4);
    case Layer::witnesses:
      return make_actor(data, {0.1, 0.3, 0.8}, 2);
    case Layer::cells:
      color_cells(data, chosen, data_.label);
      return make_actor(data, {1, 1, 1}, 2);
    default:
      return make_actor(data, {0.45, 0.5, 0.55}, 1);
  }
}

vtkSmartPointer<vtkActor> ActorFactory::make_glyphs(Layer layer) const
{
  if (data_.mesh.faces.empty()) {
    return nullptr;
  }
  double length = data_.radius;
  if (!(length > 0)) {  // a mesh that was read: the length of an average edge
    const double area = [this] {
      double sum = 0;
      for (const Triangle& face : data_.mesh.faces) {
        sum += area_normal(data_.mesh, face).norm();
      }
      return sum;
    }();
    length = std::sqrt(area / static_cast<double>(data_.mesh.faces.size()));
  }
  vtkNew<vtkGlyph3D> glyphs;
  glyphs->SetInputData(mesh_);
  glyphs->SetVectorModeToUseNormal();
  glyphs->SetScaleModeToDataScalingOff();
  glyphs->SetScaleFactor(length);
  glyphs->SetColorModeToColorByVector();
  if (layer == Layer::disks) {
    constexpr int sides = 24;
    vtkNew<vtkRegularPolygonSource> circle;
    circle->SetNumberOfSides(sides);
    circle->SetRadius(0.5);  // so that they touch but do not overlap
    circle->SetNormal(1, 0, 0);
    circle->GeneratePolygonOff();
    glyphs->SetSourceConnection(circle->GetOutputPort());
  } else {
    vtkNew<vtkArrowSource> arrow;
    glyphs->SetSourceConnection(arrow->GetOutputPort());
  }
  glyphs->Update();
  vtkSmartPointer<vtkActor> actor =
      make_actor(glyphs->GetOutput(), layer == Layer::disks ? Color{0.1, 0.45, 0.2} : Color{0.2, 0.3, 0.75});
  actor->GetMapper()->ScalarVisibilityOff();
  return actor;
}

vtkSmartPointer<vtkActor> ActorFactory::make_surface(Layer layer, vtkPolyData* mesh) const
{
  vtkSmartPointer<vtkActor> actor = make_actor(mesh, {0.80, 0.79, 0.76});
  vtkMapper* mapper = actor->GetMapper();
  vtkMapper::SetResolveCoincidentTopologyToPolygonOffset();  // points and lines in front of the faces they lie on
  mapper->SetScalarVisibility(layer == Layer::deviation ? 1 : 0);
  actor->GetProperty()->LightingOn();
  if (layer == Layer::deviation) {
    const double reach = deviation_reach(data_.face_deviation);
    mapper->SetScalarModeToUseCellData();
    mapper->SetLookupTable(deviation_colors(reach));
    mapper->UseLookupTableScalarRangeOn();
    return actor;
  }
  vtkNew<vtkProperty> back;
  back->SetColor(0.75, 0.25, 0.20);
  actor->SetBackfaceProperty(back);
  return actor;
}

vtkSmartPointer<vtkActor> ActorFactory::make(Layer layer, std::size_t every) const
{
  const bool has_mesh = !data_.mesh.faces.empty();
  switch (layer) {
    case Layer::mesh:
      return has_mesh ? make_surface(layer, mesh_) : nullptr;
    case Layer::deviation:
      return has_mesh && !data_.face_deviation.empty() ? make_surface(layer, mesh_) : nullptr;
    case Layer::edges: {
      if (!has_mesh) {
        return nullptr;
      }
      vtkSmartPointer<vtkActor> actor = make_actor(mesh_, {0.2, 0.22, 0.25});
      actor->GetMapper()->ScalarVisibilityOff();
      actor->GetProperty()->SetRepresentationToWireframe();
      return actor;
    }
    case Layer::loops: {
      vtkSmartPointer<vtkActor> actor = make_actor(loops(), {0.95, 0.5, 0.05});
      actor->GetProperty()->SetLineWidth(4);
      return data_.boundary_loops.empty() ? nullptr : actor;
    }
    case Layer::disks:
    case Layer::normals:
      return make_glyphs(layer);
    default:
      return make_points(layer, every);
  }
}

vtkSmartPointer<vtkActor> ActorFactory::make_coarse(Layer layer) const
{
  constexpr int divisions = 160;  // of the longest side: some 50,000 triangles
  vtkNew<vtkQuadricClustering> clustering;
  clustering->SetInputData(mesh_);
  clustering->SetNumberOfDivisions(divisions, divisions, divisions);
  clustering->AutoAdjustNumberOfDivisionsOff();
  clustering->CopyCellDataOn();
  clustering->UseInputPointsOn();
  clustering->Update();
  return make_surface(layer, clustering->GetOutput());
}

}  // namespace pds
