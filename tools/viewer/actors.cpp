// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/actors.h"

#include "viewer/deviation_colors.h"

#include <pcl_pds_recon/reconstruction.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include <vtkGlyph3D.h>
#include <vtkLineSource.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRegularPolygonSource.h>

namespace pds
{

namespace
{

constexpr std::size_t disk_sides = 24;

struct Color
{
  double red, green, blue;
};

/** \brief A lively colour of its own for every Voronoi cell: hues a golden angle apart. */
ByteColor cell_color(std::uint32_t label)
{
  if (label == no_label) {
    return {153, 153, 153};
  }
  const double turns = label * 0.61803398874989484820;
  const double hue = 6 * (turns - std::floor(turns));
  const auto channel = [hue](double at) {
    const double away = std::abs(std::fmod(hue - at + 9, 6) - 3);
    return static_cast<std::uint8_t>(255 * (0.35 + 0.6 * std::clamp(2 - away, 0.0, 1.0)));
  };
  return {channel(0), channel(2), channel(4)};
}

vtkSmartPointer<vtkActor> make_actor(vtkPolyData* data, const Color& color, float point_size = 1)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  mapper->ScalarVisibilityOff();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(color.red, color.green, color.blue);
  actor->GetProperty()->SetPointSize(point_size);
  actor->GetProperty()->LightingOff();
  return actor;
}

/** \brief Middle of the box around the cloud, or the mesh if there is none: it stays when the mesh is made anew. */
Eigen::Vector3d find_center(const ViewData& data)
{
  Eigen::AlignedBox3d box;
  const auto take = [&box](const Eigen::Vector3d& p) {
    if (p.allFinite()) {
      box.extend(p);
    }
  };
  for (std::size_t i = 0; i < data.cloud.size; ++i) {
    take(data.cloud.positions[i]);
  }
  if (data.cloud.size == 0) {
    std::for_each(data.mesh.vertices.begin(), data.mesh.vertices.end(), take);
  }
  return box.isEmpty() ? Eigen::Vector3d(0, 0, 0) : Eigen::Vector3d(box.center());
}

}  // namespace

ActorFactory::ActorFactory(const ViewData& data) : data_(data), center_(find_center(data))
{
  for (const Triangle& face : data.mesh.faces) {
    area_ += 0.5 * area_normal(data.mesh, face).norm();
  }
}

std::size_t ActorFactory::size(Layer layer) const
{
  const std::size_t vertices = data_.mesh.faces.empty() ? 0 : data_.mesh.vertices.size();
  switch (layer) {
    case Layer::cloud:
      return data_.cloud.size;
    case Layer::cells:
      return data_.label.size();
    case Layer::seeds:
      return data_.seeds.size();
    case Layer::witnesses:
      return data_.witnesses.size();
    case Layer::graph:
      return data_.seed_edges.size();
    case Layer::deviation:
      return data_.face_deviation.size();
    case Layer::disks:
      return vertices * disk_sides;
    case Layer::normals:
      return vertices;
    case Layer::loops:
      return data_.boundary_loops.size();
    default:
      return data_.mesh.faces.size();
  }
}

vtkPolyData* ActorFactory::mesh(std::size_t limit)
{
  const std::size_t faces = std::min(limit, data_.mesh.faces.size());
  vtkSmartPointer<vtkPolyData>& found = mesh_[faces];
  if (!found) {
    found = faces == data_.mesh.faces.size() ? mesh_data(data_.mesh, data_.face_deviation, center_)
                                             : coarse_mesh(mesh(data_.mesh.faces.size()), area_, faces);
    if (faces == data_.mesh.faces.size() && !data_.vertex_color.empty()) {
      set_colors(found, data_.vertex_color);
    }
  }
  return found;
}

Indices ActorFactory::choose_points(Layer layer, std::size_t limit) const
{
  Indices chosen = spread(size(layer), limit);
  if (layer == Layer::seeds || layer == Layer::witnesses) {
    const Indices& of = layer == Layer::seeds ? data_.seeds : data_.witnesses;
    for (std::uint32_t& i : chosen) {
      i = of[i];
    }
  }
  const auto is_bad = [this](std::uint32_t i) { return !data_.cloud.positions[i].allFinite(); };
  chosen.erase(std::remove_if(chosen.begin(), chosen.end(), is_bad), chosen.end());
  return chosen;
}

/** Of the points of a layer that is not of one colour. */
std::vector<ByteColor> ActorFactory::point_colors(Layer layer, const Indices& chosen) const
{
  std::vector<ByteColor> colors;
  for (const std::uint32_t i : chosen) {
    colors.push_back(layer == Layer::cells ? cell_color(data_.label[i]) : data_.point_color[i]);
  }
  return colors;
}

vtkSmartPointer<vtkActor> ActorFactory::make_points(Layer layer, std::size_t limit) const
{
  const Indices chosen = choose_points(layer, limit);
  if (chosen.empty()) {
    return nullptr;
  }
  const vtkSmartPointer<vtkPolyData> data = point_data(data_.cloud, chosen, center_);
  if (layer == Layer::cells || (layer == Layer::cloud && !data_.point_color.empty())) {
    set_colors(data, point_colors(layer, chosen));
  }
  constexpr std::size_t few = 50000;  // whose dots of a pixel each would be lost in a picture
  const float larger = limit < size(layer) || chosen.size() < few ? 1 : 0;
  switch (layer) {
    case Layer::seeds:
      return make_actor(data, {0.85, 0.1, 0.1}, 4);
    case Layer::witnesses:
      return make_actor(data, {0.1, 0.3, 0.8}, 2 + larger);
    case Layer::cells: {
      vtkSmartPointer<vtkActor> actor = make_actor(data, {1, 1, 1}, 2 + larger);
      actor->GetMapper()->ScalarVisibilityOn();
      return actor;
    }
    default:
      return make_actor(data, {0.45, 0.5, 0.55}, 1 + larger);
  }
}

vtkSmartPointer<vtkActor> ActorFactory::make_glyphs(Layer layer, std::size_t limit)
{
  const bool are_disks = layer == Layer::disks;
  const std::size_t vertices = data_.mesh.vertices.size();
  double length = data_.radius;
  if (!(length > 0)) {  // a mesh that was read: about the length of an edge
    length = std::sqrt(2 * area_ / static_cast<double>(data_.mesh.faces.size()));
  }
  vtkNew<vtkGlyph3D> glyphs;
  glyphs->SetInputData(
      vertex_data(mesh(data_.mesh.faces.size()), spread(vertices, are_disks ? limit / disk_sides : limit)));
  glyphs->SetVectorModeToUseNormal();
  glyphs->SetScaleModeToDataScalingOff();
  glyphs->SetScaleFactor(length);
  if (are_disks) {
    vtkNew<vtkRegularPolygonSource> circle;
    circle->SetNumberOfSides(disk_sides);
    circle->SetRadius(0.5);  // so that they touch but do not overlap
    circle->SetNormal(1, 0, 0);
    circle->GeneratePolygonOff();
    glyphs->SetSourceConnection(circle->GetOutputPort());
  } else {
    vtkNew<vtkLineSource> line;
    line->SetPoint1(0, 0, 0);
    line->SetPoint2(1, 0, 0);
    glyphs->SetSourceConnection(line->GetOutputPort());
  }
  glyphs->Update();
  return make_actor(glyphs->GetOutput(), are_disks ? Color{0.1, 0.45, 0.2} : Color{0.2, 0.3, 0.75});
}

vtkSmartPointer<vtkActor> ActorFactory::make_surface(Layer layer, std::size_t limit)
{
  vtkSmartPointer<vtkActor> actor = make_actor(mesh(limit), {0.80, 0.79, 0.76});
  vtkMapper* mapper = actor->GetMapper();
  vtkMapper::SetResolveCoincidentTopologyToPolygonOffset();  // points and lines in front of the faces they lie on
  actor->GetProperty()->LightingOn();
  if (layer == Layer::deviation) {
    mapper->ScalarVisibilityOn();
    mapper->SetScalarModeToUseCellData();
    mapper->SetLookupTable(deviation_colors(deviation_reach(data_.face_deviation)));
    mapper->UseLookupTableScalarRangeOn();
    return actor;
  }
  mapper->SetScalarModeToUsePointData();
  vtkNew<vtkProperty> back;
  back->SetColor(0.75, 0.25, 0.20);
  actor->SetBackfaceProperty(back);
  return actor;
}

vtkSmartPointer<vtkActor> ActorFactory::make_lines(Layer layer, std::size_t limit)
{
  if (layer == Layer::edges) {
    vtkSmartPointer<vtkActor> actor = make_actor(mesh(limit), {0.2, 0.22, 0.25});
    actor->GetProperty()->SetRepresentationToWireframe();
    return actor;
  }
  if (layer == Layer::loops) {
    vtkSmartPointer<vtkActor> actor =
        make_actor(loop_data(mesh(data_.mesh.faces.size()), data_.boundary_loops), {0.95, 0.5, 0.05});
    actor->GetProperty()->SetLineWidth(4);
    return actor;
  }
  const vtkSmartPointer<vtkPolyData> seeds = point_data(data_.cloud, data_.seeds, center_);
  vtkSmartPointer<vtkActor> actor =
      make_actor(segment_data(seeds, data_.seed_edges, spread(size(layer), limit)), {0.55, 0.15, 0.55});
  actor->GetProperty()->SetLineWidth(2);
  return actor;
}

vtkSmartPointer<vtkActor> ActorFactory::make(Layer layer, std::size_t limit)
{
  if (size(layer) == 0) {
    return nullptr;
  }
  switch (layer) {
    case Layer::mesh:
    case Layer::deviation:
      return make_surface(layer, limit);
    case Layer::edges:
    case Layer::loops:
    case Layer::graph:
      return make_lines(layer, limit);
    case Layer::disks:
    case Layer::normals:
      return make_glyphs(layer, limit);
    default:
      return make_points(layer, limit);
  }
}

}  // namespace pds
