// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include <pcl_pds_recon/options.h>
#include <pcl_pds_recon/point_cloud_view.h>
#include <pcl_pds_recon/report.h>

namespace pds
{

/** \brief Marks a point without a Voronoi cell: it is not finite, or the cloud gave no seeds. */
constexpr std::uint32_t no_label = std::numeric_limits<std::uint32_t>::max();

/** \brief Geodesic Voronoi diagram of the seeds, one entry per input point (paper, section "2D manifold case"). */
struct VoronoiDiagram
{
  std::vector<std::uint32_t> label;  ///< nearest seed, an index into Reconstruction::seeds, or no_label
  std::vector<float> distance;       ///< distance to it in input units, in the run's metric; NaN without a label
};

/** \brief Vertices that are not on input points (Placement::quadric). */
struct MovedVertices
{
  std::vector<Eigen::Vector3d> position;  ///< of each vertex, in the input's coordinates; empty if none has moved
  /** \brief Input indices of the points in the vertices' cells, in an order that does not depend on the input's, for
   * means of their attributes. Of coincident points there is one, and none that was thinned out. */
  std::vector<std::uint32_t> cell_point;
  std::vector<std::size_t> cell_begin;  ///< by vertex: its first place in cell_point; size vertices + 1
};

/** \brief An oriented, manifold triangle mesh, or polylines without branches, on a subset of the input points, and how
 * it came about. */
struct Reconstruction
{
  /** \brief Input index of each seed. The first report.vertices seeds are the mesh's vertices in its order, those of
   * curves last and one after the other; seeds that ended without a face or a segment follow. Their order does not
   * depend on the order of the input. */
  std::vector<std::uint32_t> seeds;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< vertices of each face, counter-clockwise from outside
  /** \brief Edges of curves: pairs of vertices, one curve after the other, each in its direction. */
  std::vector<std::array<std::uint32_t, 2>> segments;
  MovedVertices moved;                        ///< empty unless vertices are placed off the points
  VoronoiDiagram voronoi;                     ///< cell and distance of every input point
  std::vector<std::uint32_t> witness_points;  ///< input indices of points near Voronoi edges, ascending
  /** \brief Seed graph: pairs of seeds whose Voronoi cells border each other, as far as they do not cross; numbers into
   * seeds, the lower one first, ascending. */
  std::vector<std::array<std::uint32_t, 2>> seed_edges;
  std::vector<std::vector<std::uint32_t>> boundary_loops;  ///< vertices of each rim, in the direction of its faces
  Report report;                                           ///< counts, certificate, seconds
};

/** \brief Called at the start of every stage with its name and the share of the work done so far (0 ... 1). */
using Progress = std::function<void(const char* stage, double fraction)>;

/** \brief Reconstructs surfaces, or curves, from a dense point cloud by Poisson-disk sampling (Hou et al. 2015).
 *
 * Time O(n log n), about 200 bytes per point at 15 neighbours and 260 at 30. The mesh is the same for any number of
 * threads and any input order.
 *
 * \param cloud the points; too few or collinear points give an empty mesh, not an error
 * \param options see Options
 * \param progress optional; called from the calling thread. What it throws ends the run and reaches the caller
 * \throws InvalidOption if an option is out of range
 * \throws InvalidInput if the cloud is too large or its extent is not finite
 */
[[nodiscard]] Reconstruction reconstruct(const PointCloudView& cloud,
                                         const Options& options,
                                         const Progress& progress = {});

constexpr unsigned most_levels = 16;  ///< of detail: the coarsest radius is 2^15 times as large as the finest

/** \brief Reconstructs nested levels of detail in one run.
 *
 * The first level is the mesh of the options, and each further one has twice the radius, so about a quarter of the
 * vertices, which are all among those of the level before.
 *
 * \param levels 1 ... 16
 * \throws InvalidOption besides, if \a levels is out of range, or above 1 and options.relax is not 0 or
 * options.dimension not surface
 */
[[nodiscard]] std::vector<Reconstruction> reconstruct_levels(const PointCloudView& cloud,
                                                             const Options& options,
                                                             unsigned levels,
                                                             const Progress& progress = {});

}  // namespace pds
