// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/load_view.h"

#include <pcl_pds_recon/certificate.h>
#include <pcl_pds_recon/deviation.h>

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

void reconstruct_into(ViewData& data, const ViewSource& source, const Options& options, const Progress& progress)
{
  Reconstruction result = reconstruct(source.input.points.view(), options, progress);
  data.label = std::move(result.voronoi.label);
  data.witnesses = std::move(result.witness_points);
  data.seeds = std::move(result.seeds);
  data.radius = result.report.radius;
  for (std::size_t v = 0; v < result.report.vertices; ++v) {
    data.mesh.vertices.push_back(data.cloud[data.seeds[v]]);
  }
  data.mesh.faces = std::move(result.triangles);
  data.boundary_loops = std::move(result.boundary_loops);
}

}  // namespace

ViewSource load_source(const ViewerOptions& options)
{
  const Parallel parallel(options.reconstruction.threads);
  ViewSource source{read_mesh_file(options.input, parallel), false, {}};
  if (options.points_only) {
    source.input.triangles.clear();
  }
  source.is_cloud = source.input.triangles.empty();
  if (!options.reference.empty()) {
    source.reference = to_mesh(read_mesh_file(options.reference, parallel));
  }
  return source;
}

ViewData make_view_data(const ViewSource& source, const Options& options, const Progress& progress)
{
  ViewData data;
  TriangleMesh input = to_mesh(source.input);
  if (source.is_cloud) {
    data.cloud = std::move(input.vertices);
    reconstruct_into(data, source, options, progress);
  } else {
    data.mesh = std::move(input);
    data.boundary_loops = find_loops(data.mesh);
  }
  if (source.reference && !data.mesh.faces.empty()) {
    DeviationOptions deviation;
    deviation.samples = 1;  // what is shown are vertices and faces
    deviation.threads = options.threads;
    Deviation found = measure_deviation(data.mesh, *source.reference, deviation);
    data.deviation = std::move(found.vertex_deviation);
    data.face_deviation = std::move(found.face_deviation);
  }
  return data;
}

}  // namespace pds
