// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace pds
{

/** \brief Wall-clock seconds of each stage. The library fills all but load and save, which belong to the caller. */
struct StageSeconds
{
  double load = 0;         ///< reading the input file (command tool)
  double neighbors = 0;    ///< ordering, merging, thinning, k nearest neighbours, planes, sheets, noise
  double weights = 0;      ///< edge weights and feature ranks
  double sampling = 0;     ///< dart throwing with geodesic disks
  double voronoi = 0;      ///< Voronoi cells, witness points, seed triples
  double seed_graph = 0;   ///< adjacency of seeds and its planar subset
  double faces = 0;        ///< faces of the planar graph and their triangles
  double holes = 0;        ///< hole filling
  double orientation = 0;  ///< orientation, output order, certificate
  double placement = 0;    ///< moving the vertices off the points and measuring their distance, if asked for
  double save = 0;         ///< writing the output file (command tool)
  double total = 0;        ///< the whole run
};

/** \brief How much memory the process had taken at most when a stage ended: what the stage that raised it needs. */
struct StagePeak
{
  std::string stage;        ///< as progress names it; load and save belong to the caller
  std::size_t rss_bytes{};  ///< resident memory, 0 if unknown
};

/** \brief What the reconstruction did, and the certificate of what it made. */
struct Report
{
  std::size_t input_points = 0;    ///< points given
  std::size_t valid_points = 0;    ///< of these, with finite coordinates
  std::size_t merged_points = 0;   ///< of the valid ones, dropped because a coincident point represents them
  std::size_t outliers = 0;        ///< of the rest, left out because they belong to no surface
  std::size_t thinned_points = 0;  ///< of the rest, left out because the radius does not need them, or too close
  bool smoothed = false;           ///< the cloud is noisy: the middle of the noise was taken for the surface
  int k = 0;                       ///< neighbours per point
  /** Mean distance to the k neighbours, in input units (weighted if adaptive); with an absolute radius, of the points
   * that thinning left. */
  double sampling_interval = 0;
  double radius = 0;                     ///< Poisson-disk radius in input units (where the weight is 1)
  std::size_t seeds = 0;                 ///< Poisson-disk samples, with or without a face
  std::size_t vertices = 0;              ///< of the mesh; all have a face or, on a curve, a segment
  std::size_t faces = 0;                 ///< triangles
  std::size_t edges = 0;                 ///< distinct edges, of faces and of curves
  std::size_t components = 0;            ///< connected by edges
  std::size_t segments = 0;              ///< of the edges, those of curves
  std::size_t curves = 0;                ///< of the components, polylines
  std::size_t closed_curves = 0;         ///< of these, without ends
  double curve_radius = 0;               ///< Poisson-disk radius of the curves in input units; 0: none were looked for
  std::size_t boundary_loops = 0;        ///< closed chains of edges with one face
  std::size_t nonmanifold_edges = 0;     ///< edges of more than two faces (always 0)
  std::size_t nonmanifold_vertices = 0;  ///< vertices of more than one fan (always 0)
  std::size_t inconsistent_edges = 0;    ///< edges run through twice in the same direction (always 0)
  long long euler = 0;                   ///< vertices - edges + faces
  bool closed = false;                   ///< there are faces and no boundary
  bool orientable = true;                ///< false: the surface is one-sided and was cut open
  double p99_distance = 0;       ///< 99 % of the points are that near to the mesh, in input units; 0: not measured
  std::size_t filled_holes = 0;  ///< polygons of more than three sides that were triangulated, and joints between rims
  /** Least distance of two seeds, in radii, in the run's metric; disks are grown to 1.25 radii, so that is the largest
   * value. */
  double min_seed_distance = 0;
  double coverage_radius = 0;      ///< greatest distance of a point from its nearest seed, thinned ones aside, likewise
  unsigned threads = 0;            ///< worker threads used
  StageSeconds seconds;            ///< where the time went
  std::size_t peak_rss_bytes = 0;  ///< peak resident memory of the process, 0 if unknown
  std::vector<StagePeak> stage_peaks;  ///< in the order in which the stages first ended
  std::string version;                 ///< version of the library
};

}  // namespace pds
