// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/load_view.h"

#include "input.h"

#include <pcl_pds_recon/certificate.h>
#include <pcl_pds_recon/deviation.h>

#include <Eigen/Geometry>
#include <utility>

namespace pds
{

namespace
{

std::vector<std::vector<std::uint32_t>> find_loops(const TriangleMesh& mesh)
{
  std::vector<Triangle> faces;
  for (const Triangle& face : mesh.faces) {
    if (face[0] != face[1] && face[1] != face[2] && face[2] != face[0]) {
      faces.push_back(face);
    }
  }
  return certify(faces, mesh.vertices.size()).boundary_loops;
}

void reconstruct_into(ViewData& data, const Options& options, const Progress& progress)
{
  Reconstruction result = reconstruct(data.cloud, options, progress);
  data.label = std::move(result.voronoi.label);
  data.witnesses = std::move(result.witness_points);
  data.seeds = std::move(result.seeds);
  data.seed_edges = std::move(result.seed_edges);
  data.radius = result.report.radius;
  data.mesh.vertices = std::move(result.moved.position);
  for (std::size_t v = data.mesh.vertices.size(); v < result.report.vertices; ++v) {  // all or none were moved
    data.mesh.vertices.push_back(data.cloud.positions[data.seeds[v]]);
  }
  if (!data.point_color.empty()) {
    for (std::size_t v = 0; v < data.mesh.vertices.size(); ++v) {
      data.vertex_color.push_back(data.point_color[data.seeds[v]]);
    }
  }
  data.mesh.faces = std::move(result.triangles);
  data.boundary_loops = std::move(result.boundary_loops);
}

/** \brief All meshes as one, their vertices one mesh after the other. */
TriangleMesh join(const std::vector<MeshFile>& files)
{
  TriangleMesh all;
  for (const MeshFile& file : files) {
    const auto first = static_cast<std::uint32_t>(all.vertices.size());
    const TriangleMesh mesh = to_mesh(file);
    all.vertices.insert(all.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    for (const auto& [a, b, c] : mesh.faces) {
      all.faces.push_back({first + a, first + b, first + c});
    }
  }
  return all;
}

/** \brief Of the vertices of all meshes; those of a mesh without any are grey, and there are none if all are. */
std::vector<ByteColor> join_colors(const std::vector<MeshFile>& files)
{
  constexpr ByteColor grey = {204, 201, 194};
  std::vector<ByteColor> all;
  bool has_any = false;
  for (const MeshFile& file : files) {
    const std::vector<ByteColor> colors = byte_colors(file.points);
    has_any = has_any || !colors.empty();
    all.insert(all.end(), colors.begin(), colors.end());
    all.resize(all.size() + file.points.size() - colors.size(), grey);
  }
  return has_any ? all : std::vector<ByteColor>();
}

/** \brief Moves all meshes but the first along x, until each lies beside the one before. */
void set_apart(TriangleMesh& mesh, const std::vector<MeshFile>& files)
{
  constexpr double gap = 0.1;  // of the width of a mesh
  std::size_t first = 0;
  double end = 0;  // of the mesh before
  for (const MeshFile& file : files) {
    const std::size_t last = first + file.points.size();
    Eigen::AlignedBox3d box;
    for (std::size_t v = first; v < last; ++v) {
      if (mesh.vertices[v].allFinite()) {
        box.extend(mesh.vertices[v]);
      }
    }
    const double width = box.sizes().x();
    const double shift = first == 0 ? 0 : end + gap * width - box.min().x();
    for (std::size_t v = first; v < last; ++v) {
      mesh.vertices[v].x() += shift;
    }
    end = box.max().x() + shift;
    first = last;
  }
}

void measure_into(ViewData& data, const ViewSource& source, const Options& options)
{
  DeviationOptions deviation;
  deviation.samples = 1;  // what is shown are vertices and faces
  deviation.threads = options.threads;
  try {
    Deviation found = measure_deviation(data.mesh, *source.reference, deviation);
    data.deviation = std::move(found.vertex_deviation);
    data.face_deviation = std::move(found.face_deviation);
  } catch (const InvalidInput& error) {
    throw InvalidInput(source.reference_name + ": " + error.what());
  }
}

}  // namespace

ViewSource load_source(const ViewerOptions& options)
{
  const Parallel parallel(options.tool.options.threads);
  ViewSource source;
  std::vector<PointTable> clouds;
  std::vector<std::string> cloud_names;
  for (const std::string& name : options.inputs) {
    MeshFile file = read_mesh_file(name, parallel);
    if (file.points.size() == 0) {
      throw InvalidInput(name + ": holds neither points nor faces; write it again");
    }
    if (file.triangles.empty() || options.points_only) {
      clouds.push_back(select_points(name, std::move(file.points), options.tool, source.warnings));
      cloud_names.push_back(name);
    } else {
      source.meshes.push_back(std::move(file));
      source.mesh_names.push_back(name);
    }
  }
  if (!clouds.empty()) {
    source.cloud = merge_clouds(cloud_names, std::move(clouds), options.tool, source.warnings);
  }
  if (!options.reference.empty()) {
    source.reference = to_mesh(read_mesh_file(options.reference, parallel));
    source.reference_name = options.reference;
  }
  return source;
}

ViewData make_cloud_data(const ViewSource& source)
{
  ViewData data;
  if (source.cloud) {
    data.cloud = source.cloud->view();
    data.point_color = byte_colors(*source.cloud);
  }
  return data;
}

ViewData make_view_data(const ViewSource& source, const Options& options, const Progress& progress)
{
  ViewData data = make_cloud_data(source);
  if (source.is_reconstructed()) {
    reconstruct_into(data, options, progress);
  } else {
    data.mesh = join(source.meshes);
    data.vertex_color = join_colors(source.meshes);
    data.boundary_loops = find_loops(data.mesh);
  }
  if (source.reference && !data.mesh.faces.empty()) {
    if (progress) {
      constexpr double measured_last = 0.97;
      progress("deviation", measured_last);
    }
    measure_into(data, source, options);
  }
  if (!source.cloud) {
    set_apart(data.mesh, source.meshes);
  }
  return data;
}

}  // namespace pds
