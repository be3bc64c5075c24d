// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <pcl_pds_recon/options.h>
#include <pcl_pds_recon/triangle_mesh.h>

// Target pcl_pds_recon::compare, which is there if Embree was found.

namespace pds
{

/** \brief How the deviation of a mesh is measured. */
struct DeviationOptions
{
  std::size_t samples = 400000;  ///< on each surface, evenly by area; 1 ... 2^31
  unsigned threads = 0;          ///< worker threads; 0 = all cores. The result does not depend on it
  std::uint64_t seed = 0;        ///< picks the samples
};

/** \brief Figures of a set of distances (in input units) or angles (in degrees). */
struct Distribution
{
  double mean = 0;    ///< arithmetic mean
  double rms = 0;     ///< square root of the mean square
  double median = 0;  ///< as all percentiles: the least value that so many do not exceed
  double p95 = 0;     ///< 95th percentile
  double p99 = 0;     ///< 99th percentile
  double max = 0;     ///< the greatest
};

/** \brief Deviation of a mesh from a reference: the paper's "3D compare". */
struct Deviation
{
  Distribution mesh_to_reference;  ///< samples of the mesh, its vertices also for the maximum
  Distribution reference_to_mesh;  ///< likewise of the reference; of a cloud its points
  double hausdorff = 0;            ///< the larger of the two maxima
  double diagonal = 0;             ///< of the reference's bounding box
  /** Angle between the faces at a sample of the mesh and at the place of the reference nearest to it, 0 ... 90 degrees:
   * the side that is outside has no say. Not of a cloud without normals. */
  std::optional<Distribution> normal_deviation;
  /** Signed distance of each sample from the reference: positive on the side that the reference's normals point to. If
   * it is a cloud without normals, where the mesh's normal points away from its nearest point. */
  std::vector<double> sample_deviation;
  std::vector<double> vertex_deviation;  ///< signed distance of each vertex of the mesh, likewise
  /** Signed distance of the centroid of each face, likewise: where the vertices are points of the reference, only the
   * faces show a deviation. */
  std::vector<double> face_deviation;
};

/** \brief Measures how far a mesh is from a reference and back, by exact distances to the nearest triangle.
 *
 * From mesh to a cloud the distance is that to the nearest point, so the cloud's spacing shows in it.
 * The result is the same for any number of threads. O((samples + vertices) log faces).
 * \param mesh must have a face with an area
 * \param reference a mesh likewise, or a cloud; points that are not finite are passed over
 * \throws InvalidInput if \a mesh or \a reference is not as said
 * \throws InvalidOption if an option is out of range
 */
[[nodiscard]] Deviation measure_deviation(const TriangleMesh& mesh,
                                          const TriangleMesh& reference,
                                          const DeviationOptions& options = {});

/** \brief Signed distance of each point from the mesh: positive outside, NaN if the point is not finite.
 *
 * At the rim of an open mesh the side has little meaning. The result is the same for any number of threads.
 * O((points + faces) log faces).
 * \param mesh must have a face with an area
 * \param threads 0 = all cores
 * \throws InvalidInput if \a mesh is not as said
 */
[[nodiscard]] std::vector<double> signed_distances(const TriangleMesh& mesh,
                                                   const std::vector<Eigen::Vector3d>& points,
                                                   unsigned threads = 0);

/** \brief Number of pairs of faces that meet in more than a vertex or an edge that they share. Exact.
 *
 * Corners are the same if their coordinates are; faces without area are passed over.
 * \param threads 0 = all cores; the result does not depend on it
 * \throws InvalidInput if a face names a vertex that is not there or is not finite
 */
[[nodiscard]] std::size_t count_self_intersections(const TriangleMesh& mesh, unsigned threads = 0);

}  // namespace pds
