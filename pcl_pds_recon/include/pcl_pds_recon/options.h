// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace pds
{

/** \brief How distances along the surface are computed on the neighbourhood graph. */
enum class GeodesicSolver
{
  fast_marching,  ///< two-point (eikonal) updates; the paper's choice, mean error below 1 %
  dijkstra        ///< shortest paths along graph edges; overestimates, kept for comparison
};

/** \brief Where the vertices of the mesh are. */
enum class Placement
{
  point,   ///< on input points: the seeds
  quadric  ///< where the mesh fits the points of its vertices' Voronoi cells best, off the points; see placement.h
};

/** \brief What the points are taken for. */
enum class Dimension
{
  curve,     ///< points of curves, open or closed: polylines
  surface,   ///< points of surfaces: triangle meshes
  automatic  ///< each connected part of the cloud is what it looks like
};

/** \brief Everything a reconstruction can be told. The defaults suit a clean, dense scan.
 *
 * Distances are in the unit of the input unless a field says otherwise.
 */
struct Options
{
  int k_neighbors = 15;        ///< neighbours per point, the point itself not counted (4 ... 200)
  double radius_factor = 3.0;  ///< Poisson-disk radius in sampling intervals (1.5 ... 1000)
  double radius = 0.0;         ///< absolute Poisson-disk radius; 0 = radius_factor sampling intervals
  /** Vertices of the mesh, 4 to 2^31, within 0.5 % or 2; the radius follows from it. 0 = by the radius. */
  std::uint64_t vertices = 0;
  /** Fewest vertices for which 99 % of the points are within this distance of the mesh; the radius follows from it.
   * 0 = by the radius. */
  double max_error = 0.0;
  double adaptive = 0.0;           ///< curvature coefficient c of the weight exp(c x); 0 = uniform (0 ... 2)
  double voronoi_threshold = 0.1;  ///< a witness's two distances differ by less than this many radii (0 ... 1)
  /** Perimeter limit of filled holes in radii (15 by default): larger ones stay open, but for those across which
   * Voronoi cells border everywhere, which shows that there is surface. 0 = fill nothing, three-sided faces of the
   * Voronoi dual only. */
  double hole_size = 15.0;
  /** Steps of Lloyd's relaxation, each of which moves every seed to the middle of its Voronoi cell (0 ... 100):
   * triangles come nearer to equilateral, and seeds nearer to each other than the radius. */
  unsigned relax = 0;
  GeodesicSolver geodesic_solver = GeodesicSolver::fast_marching;  ///< how disks are grown
  Placement placement = Placement::point;                          ///< where the vertices are
  /** What the points are taken for. Of all options, those that tell the radius by itself, k_neighbors,
   * voronoi_threshold, threads and seed are for curves as well; others that are not at their defaults are refused
   * unless this is surface, but for hole_size and geodesic_solver, which curves make no use of. */
  Dimension dimension = Dimension::surface;
  unsigned threads = 0;    ///< worker threads (0 ... 1024); 0 = all cores. The result does not depend on it
  std::uint64_t seed = 0;  ///< picks one of the equally valid dart-throwing orders
};

/** \brief Thrown when an option is out of range; what() is one line that names the option and its range. */
struct InvalidOption : std::invalid_argument
{
  using std::invalid_argument::invalid_argument;
};

/** \brief Thrown when the input cannot be processed; what() is one line that says why and what to do. */
struct InvalidInput : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/** \brief Checks every field of \a options against its documented range.
 * \throws InvalidOption naming the first field out of range
 */
void validate(const Options& options);

}  // namespace pds
