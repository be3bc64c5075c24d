// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/certificate.h>
#include <pcl_pds_recon/edge_weights.h>
#include <pcl_pds_recon/geodesic_voronoi.h>
#include <pcl_pds_recon/hole_filling.h>
#include <pcl_pds_recon/neighbor_graph.h>
#include <pcl_pds_recon/ordered_points.h>
#include <pcl_pds_recon/orientation.h>
#include <pcl_pds_recon/poisson_disk_sampling.h>
#include <pcl_pds_recon/reconstruction.h>
#include <pcl_pds_recon/seed_faces.h>
#include <pcl_pds_recon/seed_graph.h>
#include <pcl_pds_recon/triangle_complex.h>
#include <pcl_pds_recon/version.h>
#include <sys/resource.h>
#include <algorithm>
#include <chrono>
#include "bucket_sort.h"
#include "parallel_parts.h"

namespace pds
{
namespace
{

constexpr double largest_radius = 1e9;  // units of position, whose box has side 1: beyond any disk, finite as a float

/** \brief Announces stages and takes their time. */
class StageClock
{
 public:
  explicit StageClock(const Progress& progress) : progress_(progress) {}

  /** \brief Ends the running stage and starts the next, whose time goes to \a seconds. */
  void start(const char* stage, double fraction, double& seconds)
  {
    stop();
    if (progress_) progress_(stage, fraction);
    seconds_ = &seconds;
    begin_ = Clock::now();
  }

  void stop()
  {
    if (seconds_ != nullptr) *seconds_ += std::chrono::duration<double>(Clock::now() - begin_).count();
    seconds_ = nullptr;
  }

 private:
  using Clock = std::chrono::steady_clock;
  const Progress& progress_;
  double* seconds_ = nullptr;
  Clock::time_point begin_;
};

/** \brief Radius in units of position, and the metric it is measured in. */
struct Metric
{
  EdgeWeights weights;
  double radius = 0;
};

Metric choose_metric(const OrderedPoints& points,
                     const NeighborGraph& graph,
                     const SurfaceEstimate& surface,
                     const Options& options,
                     const Parallel& parallel,
                     Report& report)
{
  Metric metric;
  const double interval = graph.sampling_interval;
  if (interval <= 0) return metric;
  const bool absolute = options.radius > 0;
  const WeightLimits limits{absolute ? options.radius / points.unit / interval : options.radius_factor, !absolute};
  metric.weights = curvature_weights(surface, graph, options.adaptive, limits, parallel);
  const double weighted = mean_weighted_interval(points, graph, metric.weights, parallel);
  const double radius = absolute ? options.radius / points.unit : options.radius_factor * weighted;
  metric.radius = std::min(radius, largest_radius);
  report.sampling_interval = weighted * points.unit;
  report.radius = radius * points.unit;
  return metric;
}

OrientationCues cues_for(const PointCloudView& cloud, const OrderedPoints& points, const PoissonDiskSampling& sampling)
{
  OrientationCues cues;
  if (cloud.normals)
    for (const std::uint32_t rank : sampling.seeds) cues.normal.push_back(cloud.normals[points.input_index[rank]]);
  if (cloud.sensor_origin)
    cues.sensor_origin = (*cloud.sensor_origin - points.origin) / (points.unit * sampling.radius);
  return cues;
}

/** \brief Brings faces into a canonical order: each begins with its lowest corner, and they ascend. */
std::vector<Triangle> sorted_faces(std::vector<Triangle> triangles, std::size_t vertex_count, const Parallel& parallel)
{
  constexpr std::size_t block = 4096;
  BucketSort by_first_corner(vertex_count);
  parallel.each(triangles.size(), block, [&](std::size_t f) {
    Triangle& t = triangles[f];
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    by_first_corner.count(t[0]);
  });
  const std::vector<std::size_t> begin = by_first_corner.begins();
  std::vector<Triangle> sorted(triangles.size());
  parallel.each(triangles.size(), block,
                [&](std::size_t f) { sorted[by_first_corner.place(triangles[f][0])] = triangles[f]; });
  parallel.each(vertex_count, block, [&](std::size_t v) {
    std::sort(sorted.begin() + static_cast<std::ptrdiff_t>(begin[v]),
              sorted.begin() + static_cast<std::ptrdiff_t>(begin[v + 1]));
  });
  return sorted;
}

/** \brief Numbers the seeds so that those with a face come first. */
void number_vertices(std::vector<Triangle> triangles,
                     const OrderedPoints& points,
                     const PoissonDiskSampling& sampling,
                     std::vector<std::uint32_t>& number_of_seed,
                     Reconstruction& result,
                     const Parallel& parallel)
{
  std::vector<std::uint8_t> used(sampling.seeds.size());
  for (const Triangle& t : triangles)
    for (const std::uint32_t s : t) used[s] = 1;
  number_of_seed.resize(used.size());
  result.seeds.reserve(used.size());
  for (const std::uint8_t wanted : {std::uint8_t{1}, std::uint8_t{0}})
    for (std::size_t s = 0; s < used.size(); ++s)
      if (used[s] == wanted) {
        number_of_seed[s] = static_cast<std::uint32_t>(result.seeds.size());
        result.seeds.push_back(points.input_index[sampling.seeds[s]]);
      }
  for (Triangle& t : triangles)
    for (std::uint32_t& v : t) v = number_of_seed[v];
  result.triangles = sorted_faces(std::move(triangles), used.size(), parallel);
}

void describe_points(const OrderedPoints& points,
                     const PoissonDiskSampling& sampling,
                     const GeodesicVoronoi& voronoi,
                     const std::vector<std::uint32_t>& number_of_seed,
                     Reconstruction& result,
                     const Parallel& parallel)
{
  using Indices = std::vector<std::uint32_t>;
  constexpr std::size_t block = 32768;
  const std::size_t n = points.rank_of_input.size();
  result.voronoi.label.resize(n);
  result.voronoi.distance.resize(n);
  for (const Indices& part :
       parallel_parts<Indices>(n, block, parallel, [&](std::size_t begin, std::size_t end, Indices&witnesses) {
         for (std::size_t i = begin; i < end; ++i) {
           const std::uint32_t rank = points.rank_of_input[i];
           const bool has_seed = rank != no_rank && !sampling.nearest.empty();
           const NearestSeeds nearest = has_seed ? sampling.nearest[rank] : NearestSeeds{};
           result.voronoi.label[i] = has_seed ? number_of_seed[nearest.seed[0]] : no_label;
           result.voronoi.distance[i] = has_seed
                                            ? static_cast<float>(static_cast<double>(nearest.distance[0]) * points.unit)
                                            : std::numeric_limits<float>::quiet_NaN();
           if (has_seed && voronoi.witness[rank] != 0) witnesses.push_back(static_cast<std::uint32_t>(i));
         }
       }))
    append(result.witness_points, part);
}

void report_sampling(const PoissonDiskSampling& sampling, Report& report, const Parallel& parallel)
{
  report.seeds = sampling.seeds.size();
  if (sampling.seeds.empty()) return;
  double nearest_pair = std::numeric_limits<double>::infinity();
  for (const std::uint32_t s : sampling.seeds)
    nearest_pair = std::min(nearest_pair, static_cast<double>(sampling.nearest[s].distance[1]));
  // Disks are grown to disk_reach; seeds that are nowhere nearer than that to another are reported at it.
  report.min_seed_distance = std::min(nearest_pair / sampling.radius, disk_reach);
  constexpr std::size_t block = 65536;
  const std::vector<float> farthest_of_block = parallel_parts<float>(
      sampling.nearest.size(), block, parallel, [&](std::size_t begin, std::size_t end, float& farthest) {
        for (std::size_t i = begin; i < end; ++i) farthest = std::max(farthest, sampling.nearest[i].distance[0]);
      });
  const float farthest = *std::max_element(farthest_of_block.begin(), farthest_of_block.end());
  report.coverage_radius = static_cast<double>(farthest) / sampling.radius;
}

void report_certificate(Certificate certificate, Reconstruction& result)
{
  Report& report = result.report;
  report.vertices = certificate.vertices;
  report.faces = certificate.faces;
  report.edges = certificate.edges;
  report.components = certificate.components;
  report.boundary_loops = certificate.boundary_loops.size();
  report.nonmanifold_edges = certificate.nonmanifold_edges;
  report.nonmanifold_vertices = certificate.nonmanifold_vertices;
  report.inconsistent_edges = certificate.inconsistent_edges;
  report.euler = certificate.euler;
  report.closed = certificate.faces > 0 && certificate.boundary_loops.empty();
  result.boundary_loops = std::move(certificate.boundary_loops);
}

std::size_t peak_resident_bytes()
{
  rusage usage{};
  constexpr std::size_t bytes_per_kib = 1024;
  return getrusage(RUSAGE_SELF, &usage) == 0 ? static_cast<std::size_t>(usage.ru_maxrss) * bytes_per_kib : 0;
}

}  // namespace

Reconstruction reconstruct(const PointCloudView& cloud, const Options& options, const Progress& progress)
{
  validate(options);
  const auto begin = std::chrono::steady_clock::now();
  const Parallel parallel(options.threads);
  Reconstruction result;
  Report& report = result.report;
  StageClock clock(progress);

  // Step 1: neighbours, sampling interval, radius.
  clock.start("neighbors", 0.0, report.seconds.neighbors);
  const OrderedPoints points = order_points(cloud, parallel);
  const NeighborGraph graph = build_neighbor_graph(points, cloud, options.k_neighbors, parallel);
  clock.start("weights", 0.4, report.seconds.weights);
  const SurfaceEstimate surface = estimate_surface(points, graph, parallel);
  const Metric metric = choose_metric(points, graph, surface, options, parallel, report);

  // Steps 2 to 5: seeds and their disks.
  clock.start("sampling", 0.5, report.seconds.sampling);
  PoissonDiskSampling sampling;
  if (metric.radius > 0)
    sampling = sample_poisson_disks(points, graph, surface, metric.weights, feature_ranks(surface, graph, parallel),
                                    metric.radius, options.geodesic_solver, options.seed, parallel);

  // Steps 6 and 7: Voronoi diagram and adjacent seeds.
  clock.start("voronoi", 0.7, report.seconds.voronoi);
  const GeodesicVoronoi voronoi =
      build_geodesic_voronoi(points, graph, metric.weights, sampling, options.voronoi_threshold, parallel);
  clock.start("seed_graph", 0.8, report.seconds.seed_graph);
  const SeedGeometry seeds = describe_seeds(cloud, points, surface, sampling, voronoi, parallel);
  const SeedGraph seed_graph = build_seed_graph(seeds, voronoi.pairs, parallel);

  // Step 8: triangles, holes.
  clock.start("faces", 0.85, report.seconds.faces);
  const SeedFaces faces = trace_faces(seed_graph, seeds, parallel);
  TriangleComplex complex(seeds.position, parallel);
  const std::vector<Triangle> one_sided = add_dual_triangles(complex, faces.triangles, voronoi.triples);
  clock.start("holes", 0.9, report.seconds.holes);
  FillLimits limits;
  limits.perimeter = options.hole_size;
  report.filled_holes = fill_holes(complex, seeds, BorderingCells(voronoi.pairs), faces.polygons, limits);

  clock.start("orientation", 0.95, report.seconds.orientation);
  std::vector<std::uint32_t> number_of_seed;
  number_vertices(orient_faces(complex, cues_for(cloud, points, sampling)), points, sampling, number_of_seed, result,
                  parallel);
  describe_points(points, sampling, voronoi, number_of_seed, result, parallel);
  report.orientable = one_sided.empty();
  report_certificate(certify(result.triangles, result.seeds.size(), parallel), result);
  report_sampling(sampling, report, parallel);
  clock.stop();

  report.input_points = cloud.size;
  report.valid_points = points.valid_points;
  report.merged_points = points.merged_points;
  report.k = options.k_neighbors;
  report.threads = parallel.threads();
  report.peak_rss_bytes = peak_resident_bytes();
  report.version = PCL_PDS_RECON_VERSION;
  report.seconds.total = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

}  // namespace pds
