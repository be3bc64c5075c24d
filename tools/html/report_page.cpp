// SPDX-License-Identifier: BSD-3-Clause
#include "html/report_page.h"

#include "html/deviation.h"
#include "html/mesh_measures.h"
#include "html/pictures.h"
#include "io/glb_writer.h"
#include "io/plugin.h"
#include "io/vertex_normals.h"

#include <Eigen/Geometry>
#include <cstring>
#include <utility>

namespace pds
{

namespace
{

std::vector<Eigen::Vector3d> positions(const PointTable& points)
{
  const Vector3View view = points.view().positions;
  std::vector<Eigen::Vector3d> all(points.size());
  for (std::size_t row = 0; row < points.size(); ++row) {
    all[row] = view[row];
  }
  return all;
}

Eigen::AlignedBox3d bounding_box(const TriangleMesh& mesh)
{
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    box.extend(vertex);
  }
  return box;
}

/** From where a mesh is seen at first. If the format does not say that z is up, it is for what stands upright or lies
 * flat in x and y, as statues, towers and terrains do; otherwise y is, as in glTF. */
PageCamera find_camera(const Eigen::AlignedBox3d& box, bool z_is_up)
{
  constexpr double flat = 0.25;
  constexpr double from_the_side = 15;  // degrees
  constexpr double from_above = 40;
  const Eigen::Vector3d size = box.sizes();
  const bool is_flat = size.z() < flat * std::min(size.x(), size.y());
  const bool is_upright = size.z() > std::max(size.x(), size.y());
  PageCamera camera;
  camera.up = z_is_up || is_flat || is_upright ? 'z' : 'y';
  camera.elevation = is_flat ? from_above : from_the_side;
  return camera;
}

/** A browser turns it in single precision, so it is moved to the origin for good. */
std::string make_page_glb(const PointTable& vertices, const TriangleMesh& mesh, const Eigen::Vector3d& center)
{
  const PointTable with_normals =
      vertices.has_normals() ? vertices.with_fields({}, Parallel(1)) : with_vertex_normals(vertices, mesh.faces);
  PointTable moved = with_normals.with_fields(
      {{"x", ScalarType::float32}, {"y", ScalarType::float32}, {"z", ScalarType::float32}}, Parallel(1));
  for (std::size_t row = 0; row < moved.size(); ++row) {
    const Eigen::Vector3f position = (mesh.vertices[row] - center).cast<float>();
    std::memcpy(moved.record(row), position.data(), 3 * sizeof(float));
  }
  moved.z_is_up = false;  // the page itself turns it
  return make_glb(moved, mesh.faces);
}

/** For each face the mean of its corners' Voronoi cells, of which each has the mean of its points. */
std::vector<double> deviation_by_face(const std::vector<double>& cloud_deviation, const Reconstruction& result)
{
  std::vector<double> sum(result.seeds.size(), 0);
  std::vector<double> count(result.seeds.size(), 0);
  for (std::size_t i = 0; i < cloud_deviation.size(); ++i) {
    if (const std::uint32_t cell = result.voronoi.label[i]; cell != no_label) {
      sum[cell] += cloud_deviation[i];
      count[cell] += 1;
    }
  }
  std::vector<double> by_face;
  by_face.reserve(result.triangles.size());
  for (const auto& [a, b, c] : result.triangles) {
    by_face.push_back((sum[a] / count[a] + sum[b] / count[b] + sum[c] / count[c]) / 3);
  }
  return by_face;
}

void draw_into(ReportPage& page, const ViewData& view)
{
  CameraPlace front;
  front.azimuth = page.camera.azimuth;
  front.elevation = page.camera.elevation;
  front.up = page.camera.up;
  front.zoom = 1.2;  // room at the rim from all sides
  CameraPlace back = front;
  back.azimuth += 180;
  std::vector<Shot> shots = {{{Layer::mesh, Layer::edges, Layer::loops}, front}, {{Layer::mesh, Layer::loops}, back}};
  std::vector<std::string> captions = {"The triangles; boundary loops, if any, in orange", "From the other side"};
  if (!view.face_deviation.empty()) {
    shots.push_back({{Layer::deviation}, front});
    captions.emplace_back("Deviation of the points from the mesh, mean of each Voronoi cell; outside is positive");
  }
  try {
    std::vector<std::string> pictures = draw_pictures(view, shots);
    for (std::size_t i = 0; i < pictures.size(); ++i) {
      page.pictures.push_back({std::move(pictures[i]), captions[i]});
    }
  } catch (const PluginError& error) {
    page.why_no_pictures = error.what();
  }
}

}  // namespace

ReportPage make_report_page(const CommandLine& command_line,
                            const PointTable& points,
                            const PointTable& vertices,
                            const Reconstruction& result)
{
  ReportPage page;
  ViewData view;
  view.mesh.vertices = positions(vertices);
  view.mesh.faces = result.triangles;
  view.vertex_color = byte_colors(vertices);
  view.boundary_loops = result.boundary_loops;
  const Eigen::AlignedBox3d box = bounding_box(view.mesh);
  page.camera = find_camera(box, vertices.z_is_up);
  page.glb = make_page_glb(vertices, view.mesh, box.center());
  page.edge_lengths = edge_lengths(view.mesh);
  page.smallest_angles = smallest_angles(view.mesh);
  try {
    page.cloud_deviation = measure_cloud_deviation(view.mesh, positions(points), command_line.options.threads);
    view.face_deviation = deviation_by_face(page.cloud_deviation, result);
  } catch (const PluginError& error) {
    page.why_no_deviation = error.what();
  }
  draw_into(page, view);
  return page;
}

}  // namespace pds
