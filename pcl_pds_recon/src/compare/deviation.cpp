// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/deviation.h>

#include "compare/outside.h"
#include "compare/surface_samples.h"
#include "compare/surface_tree.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

namespace pds
{
namespace
{

constexpr std::size_t block = 2048;  // queries of some microseconds each
constexpr std::size_t most_samples = std::size_t{1} << 31U;
constexpr unsigned most_threads = 1024;
constexpr double degrees = 180 / 3.14159265358979323846;

using Hits = std::vector<SurfaceTree::Hit>;

template <typename PointAt>
Hits find_closest(const SurfaceTree& tree, std::size_t count, const PointAt& point_at, const Parallel& parallel)
{
  Hits hits(count);
  parallel.blocks(count, block, [&](std::size_t begin, std::size_t end, unsigned) {
    std::uint32_t near = SurfaceTree::none;
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector3d& p = point_at(i);  // lives as long as this name if it is computed
      if (!p.allFinite()) continue;            // leaves hits[i].face at none
      hits[i] = tree.closest(p, near);
      near = hits[i].face;
    }
  });
  return hits;
}

std::vector<double> distances(const Hits& hits)
{
  std::vector<double> result;
  result.reserve(hits.size());
  for (const SurfaceTree::Hit& hit : hits)
    if (hit.face != SurfaceTree::none) result.push_back(std::sqrt(hit.squared_distance));
  return result;
}

/** \brief Figures of at least one value; summed in their order, so that they do not depend on threads. */
Distribution describe(std::vector<double> values)
{
  Distribution result;
  const auto count = static_cast<double>(values.size());
  double squares = 0;
  for (const double value : values) {
    result.mean += value;
    squares += value * value;
  }
  result.mean /= count;
  result.rms = std::sqrt(squares / count);
  std::sort(values.begin(), values.end());
  const auto percentile = [&](double share) {
    return values[static_cast<std::size_t>(std::max(1.0, std::ceil(share * count))) - 1];
  };
  result.median = percentile(0.5);
  result.p95 = percentile(0.95);
  result.p99 = percentile(0.99);
  result.max = values.back();
  return result;
}

/** \brief The largest distance of a vertex that has a face. */
double farthest_vertex(const TriangleMesh& mesh, const Hits& hits)
{
  double farthest = 0;
  for (const Triangle& face : mesh.faces)
    for (const std::uint32_t vertex : face) farthest = std::max(farthest, hits[vertex].squared_distance);
  return std::sqrt(farthest);
}

void require_area(const TriangleMesh& mesh, const char* name)
{
  validate(mesh);
  if (mesh.faces.empty()) throw InvalidInput(std::string(name) + " has no faces; give a mesh, not a point cloud");
  double area = 0;
  for (const Triangle& face : mesh.faces) area += area_normal(mesh, face).squaredNorm();
  if (!(area > 0 && std::isfinite(area)))
    throw InvalidInput(std::string(name) + (area > 0
                                                ? " is too large to have an area in double precision; scale it down"
                                                : " has no face with an area; write it again"));
}

void check(const TriangleMesh& mesh, const TriangleMesh& reference, const DeviationOptions& options)
{
  if (options.samples < 1 || options.samples > most_samples)
    throw InvalidOption("samples must be 1 ... " + std::to_string(most_samples));
  if (options.threads > most_threads)
    throw InvalidOption("threads must be 0 ... " + std::to_string(most_threads) + "; 0 = all cores");
  require_area(mesh, "the mesh");
  if (!reference.faces.empty()) {
    require_area(reference, "the reference");
    return;
  }
  const auto is_finite = [](const Eigen::Vector3d& p) { return p.allFinite(); };
  if (std::none_of(reference.vertices.begin(), reference.vertices.end(), is_finite))
    throw InvalidInput("the reference has no points with finite coordinates; check its x, y and z");
}

/** \brief What is known about directions at the reference. */
class ReferenceNormals
{
 public:
  explicit ReferenceNormals(const TriangleMesh& reference) : reference_(reference), outside_(reference) {}

  [[nodiscard]] bool known() const { return !reference_.faces.empty() || !reference_.normals.empty(); }

  /** \brief Normal of the face or point that was hit; not of unit length, zero if not known. */
  [[nodiscard]] Eigen::Vector3d normal(const SurfaceTree::Hit& hit) const
  {
    return reference_.faces.empty() ? reference_.normals[hit.face]
                                    : area_normal(reference_, reference_.faces[hit.face]);
  }
  /** \param mesh_normal decides if the reference has no directions */
  [[nodiscard]] double signed_distance(const Eigen::Vector3d& p,
                                       const SurfaceTree::Hit& hit,
                                       const Eigen::Vector3d& mesh_normal) const
  {
    const Eigen::Vector3d out = !known()                   ? mesh_normal
                                : reference_.faces.empty() ? reference_.normals[hit.face]
                                                           : outside_.direction(hit);
    return std::copysign(std::sqrt(hit.squared_distance), out.dot(p - hit.point));
  }

 private:
  const TriangleMesh& reference_;
  Outside outside_;
};

/** \brief Angles between the lines along the normals; the side has no say. */
std::vector<double> normal_angles(const TriangleMesh& mesh,
                                  const std::vector<SurfaceSample>& samples,
                                  const Hits& hits,
                                  const ReferenceNormals& reference)
{
  std::vector<double> angles;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Eigen::Vector3d a = area_normal(mesh, mesh.faces[samples[i].face]);
    const Eigen::Vector3d b = reference.normal(hits[i]);
    if (b.squaredNorm() > 0) angles.push_back(std::atan2(a.cross(b).norm(), std::abs(a.dot(b))) * degrees);
  }
  return angles;
}

/** \brief Distances of the reference's samples, or points, from the mesh. */
Distribution measure_back(const TriangleMesh& mesh,
                          const TriangleMesh& reference,
                          const DeviationOptions& options,
                          const Parallel& parallel)
{
  const SurfaceTree tree(mesh, parallel.threads());
  const auto vertex = [&reference](std::size_t i) -> const Eigen::Vector3d& { return reference.vertices[i]; };
  const Hits vertex_hits = find_closest(tree, reference.vertices.size(), vertex, parallel);
  if (reference.faces.empty()) return describe(distances(vertex_hits));
  const auto samples = sample_surface(reference, options.samples, options.seed, parallel);
  const auto sample = [&samples](std::size_t i) -> const Eigen::Vector3d& { return samples[i].point; };
  Distribution result = describe(distances(find_closest(tree, samples.size(), sample, parallel)));
  result.max = std::max(result.max, farthest_vertex(reference, vertex_hits));
  return result;
}

}  // namespace

Deviation measure_deviation(const TriangleMesh& mesh, const TriangleMesh& reference, const DeviationOptions& options)
{
  check(mesh, reference, options);
  const Parallel parallel(options.threads);
  const SurfaceTree tree(reference, parallel.threads());
  const auto samples = sample_surface(mesh, options.samples, options.seed, parallel);
  const auto sample = [&samples](std::size_t i) -> const Eigen::Vector3d& { return samples[i].point; };
  const auto vertex = [&mesh](std::size_t i) -> const Eigen::Vector3d& { return mesh.vertices[i]; };
  const Hits sample_hits = find_closest(tree, samples.size(), sample, parallel);
  const Hits vertex_hits = find_closest(tree, mesh.vertices.size(), vertex, parallel);

  Deviation result;
  result.diagonal = tree.diagonal();
  result.mesh_to_reference = describe(distances(sample_hits));
  result.mesh_to_reference.max = std::max(result.mesh_to_reference.max, farthest_vertex(mesh, vertex_hits));
  result.reference_to_mesh = measure_back(mesh, reference, options, parallel);
  result.hausdorff = std::max(result.mesh_to_reference.max, result.reference_to_mesh.max);

  const ReferenceNormals normals(reference);
  if (normals.known()) {
    const std::vector<double> angles = normal_angles(mesh, samples, sample_hits, normals);
    if (!angles.empty()) result.normal_deviation = describe(angles);
  }
  result.sample_deviation.resize(samples.size());
  parallel.each(samples.size(), block, [&](std::size_t i) {
    const Eigen::Vector3d normal = area_normal(mesh, mesh.faces[samples[i].face]);
    result.sample_deviation[i] = normals.signed_distance(samples[i].point, sample_hits[i], normal);
  });
  const auto centroid = [&mesh](std::size_t f) -> Eigen::Vector3d {
    const Triangle& face = mesh.faces[f];
    return (mesh.vertices[face[0]] + mesh.vertices[face[1]] + mesh.vertices[face[2]]) / 3;
  };
  const Hits centroid_hits = find_closest(tree, mesh.faces.size(), centroid, parallel);
  result.face_deviation.resize(mesh.faces.size());
  parallel.each(mesh.faces.size(), block, [&](std::size_t f) {
    result.face_deviation[f] = normals.signed_distance(centroid(f), centroid_hits[f], area_normal(mesh, mesh.faces[f]));
  });
  const Outside mesh_outside(mesh);
  result.vertex_deviation.resize(mesh.vertices.size());
  parallel.each(mesh.vertices.size(), block, [&](std::size_t i) {
    result.vertex_deviation[i] = vertex_hits[i].face == SurfaceTree::none
                                     ? std::nan("")
                                     : normals.signed_distance(mesh.vertices[i], vertex_hits[i],
                                                               mesh_outside.at_vertex(static_cast<std::uint32_t>(i)));
  });
  return result;
}

std::vector<double> signed_distances(const TriangleMesh& mesh,
                                     const std::vector<Eigen::Vector3d>& points,
                                     unsigned threads)
{
  require_area(mesh, "the mesh");
  const Parallel parallel(threads);
  const SurfaceTree tree(mesh, parallel.threads());
  const Outside outside(mesh);
  const auto point = [&points](std::size_t i) -> const Eigen::Vector3d& { return points[i]; };
  const Hits hits = find_closest(tree, points.size(), point, parallel);
  std::vector<double> result(points.size(), std::nan(""));
  parallel.each(points.size(), block, [&](std::size_t i) {
    if (hits[i].face != SurfaceTree::none)
      result[i] =
          std::copysign(std::sqrt(hits[i].squared_distance), outside.direction(hits[i]).dot(points[i] - hits[i].point));
  });
  return result;
}

}  // namespace pds
