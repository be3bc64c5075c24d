// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/certificate.h>
#include <pcl_pds_recon/edge_weights.h>
#include <pcl_pds_recon/geodesic_voronoi.h>
#include <pcl_pds_recon/hole_filling.h>
#include <pcl_pds_recon/neighbor_graph.h>
#include <pcl_pds_recon/ordered_points.h>
#include <pcl_pds_recon/orientation.h>
#include <pcl_pds_recon/outliers.h>
#include <pcl_pds_recon/outward_normals.h>
#include <pcl_pds_recon/placement.h>
#include <pcl_pds_recon/poisson_disk_sampling.h>
#include <pcl_pds_recon/reconstruction.h>
#include <pcl_pds_recon/scan_noise.h>
#include <pcl_pds_recon/seed_faces.h>
#include <pcl_pds_recon/seed_graph.h>
#include <pcl_pds_recon/thinning.h>
#include <pcl_pds_recon/triangle_complex.h>
#include <pcl_pds_recon/version.h>
#include <sys/resource.h>
#include <algorithm>
#include <chrono>
#include "output.h"
#include "parallel_parts.h"

namespace pds
{
namespace
{

constexpr int most_sortings = 2;        // of outliers; more find little
constexpr int most_smoothings = 4;      // noise of one interval takes three; what is left then is no surface
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

/** \brief The points that the radius needs, and who is whose neighbour. */
struct Neighborhoods
{
  OrderedPoints points;
  NeighborGraph graph;
  double interval = 0;  ///< sampling interval that the radius refers to: of the cloud before thinning, if that is known
};

/** \brief Orders, thins, sorts out, smooths if they are noisy, and joins the points. A radius in sampling intervals is
 * known only once all are joined. */
Neighborhoods find_neighborhoods(const PointCloudView& cloud, const Options& options, const Parallel& parallel)
{
  Neighborhoods found;
  const double fineness = options.adaptive == 0 ? voxels_per_radius : voxels_per_adaptive_radius;
  const auto thin = [&](double radius) {
    found.points = thin_points(std::move(found.points), radius / fineness, parallel);
  };
  const auto join = [&] {
    found.graph = {};  // before the next one is made: two of them would be the peak of the run's memory
    // A search that the caller brings knows nothing of smoothed positions.
    PointCloudView searched = cloud;
    if (found.points.smoothed) searched.neighbor_search = nullptr;
    found.graph = build_neighbor_graph(found.points, searched, options.k_neighbors, parallel);
  };
  found.points = order_points(cloud, parallel);
  if (options.radius > 0) thin(options.radius / found.points.unit);
  join();
  // Without their company, more outliers stand alone.
  for (int round = 0; round < most_sortings; ++round) {
    const std::vector<std::uint8_t> outlier = find_outliers(found.points, found.graph, parallel);
    if (outlier.empty()) break;
    found.points = without_outliers(std::move(found.points), outlier, parallel);
    join();
  }
  for (int pass = 0; pass < most_smoothings && is_noisy(found.points, found.graph, parallel); ++pass) {
    found.points.position = smooth_positions(found.points, found.graph, parallel);
    found.points.smoothed = true;
    join();
  }
  found.interval = found.graph.sampling_interval;
  if (options.radius > 0 || found.interval <= 0) return found;
  const std::size_t points = found.points.size();
  thin(options.radius_factor * found.interval);
  if (found.points.size() < points) join();
  return found;
}

/** \brief Radius in units of position, and the metric it is measured in. */
struct Metric
{
  EdgeWeights weights;
  double radius = 0;
};

Metric choose_metric(const Neighborhoods& found,
                     const SurfaceEstimate& surface,
                     const Options& options,
                     const Parallel& parallel,
                     Report& report)
{
  const auto& [points, graph, interval_of_cloud] = found;
  Metric metric;
  const double interval = graph.sampling_interval;
  if (interval <= 0) return metric;
  const bool absolute = options.radius > 0;
  const double radius = absolute ? options.radius / points.unit : options.radius_factor * interval_of_cloud;
  metric.weights = curvature_weights(surface, graph, options.adaptive, {radius / interval, !absolute}, parallel);
  // Thinning changes the interval, but hardly what the weights do to it.
  const double stretch = mean_weighted_interval(points, graph, metric.weights, parallel) / interval;
  metric.radius = std::min(absolute ? radius : radius * stretch, largest_radius);
  report.sampling_interval = interval_of_cloud * stretch * points.unit;
  report.radius = metric.radius * points.unit;
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
  Neighborhoods found = find_neighborhoods(cloud, options, parallel);
  const OrderedPoints& points = found.points;
  NeighborGraph& graph = found.graph;
  clock.start("weights", 0.4, report.seconds.weights);
  const SurfaceEstimate surface = estimate_surface(points, graph, parallel);
  const Metric metric = choose_metric(found, surface, options, parallel, report);

  // Steps 2 to 5: seeds and their disks.
  clock.start("sampling", 0.5, report.seconds.sampling);
  const std::vector<std::uint8_t> features =
      points.smoothed ? middle_ranks(cloud, points, parallel) : feature_ranks(surface, graph, parallel);
  PoissonDiskSampling sampling;
  if (metric.radius > 0)
    sampling = sample_poisson_disks(points, graph, surface, metric.weights, features, metric.radius,
                                    options.geodesic_solver, options.seed, parallel);

  // Steps 6 and 7: Voronoi diagram and adjacent seeds.
  clock.start("voronoi", 0.7, report.seconds.voronoi);
  const GeodesicVoronoi voronoi =
      build_geodesic_voronoi(points, graph, metric.weights, sampling, options.voronoi_threshold, parallel);
  graph = NeighborGraph();  // half of the memory, and of no more use
  clock.start("seed_graph", 0.8, report.seconds.seed_graph);
  const SeedGeometry seeds = describe_seeds(cloud, points, surface, sampling, voronoi, parallel);
  const SeedGraph seed_graph = build_seed_graph(seeds, voronoi.pairs, parallel);

  // Step 8: triangles, holes.
  clock.start("faces", 0.85, report.seconds.faces);
  const SeedFaces faces = trace_faces(seed_graph, seeds, parallel);
  TriangleComplex complex(seeds.position, parallel, outward_normals(cloud, points, seeds, voronoi, parallel));
  const std::vector<Triangle> one_sided = add_dual_triangles(complex, faces.triangles, voronoi.triples);
  clock.start("holes", 0.9, report.seconds.holes);
  FillLimits limits;
  limits.perimeter = options.hole_size;
  report.filled_holes = fill_holes(complex, seeds, BorderingCells(voronoi.pairs), faces.polygons, limits);

  clock.start("orientation", 0.95, report.seconds.orientation);
  std::vector<Triangle> triangles = orient_faces(complex, cues_for(cloud, points, sampling));
  std::vector<Eigen::Vector3d> placed;
  if (options.placement == Placement::quadric) {
    clock.start("placement", 0.96, report.seconds.placement);
    placed = place_vertices(seeds, triangles, points, sampling, voronoi, parallel);
    clock.start("output", 0.98, report.seconds.orientation);
  }
  const std::vector<std::uint32_t> number_of_seed =
      number_vertices(std::move(triangles), points, sampling, result, parallel);
  describe_points(cloud, points, sampling, voronoi, number_of_seed, result, parallel);
  describe_seed_graph(seed_graph, number_of_seed, result, parallel);
  report.orientable = one_sided.empty();
  report_certificate(certify(result.triangles, result.seeds.size(), parallel), result);
  if (!placed.empty()) describe_moved_vertices(placed, points, sampling, voronoi, number_of_seed, result);
  report_sampling(sampling, report, parallel);
  clock.stop();

  report.input_points = cloud.size;
  report.valid_points = points.valid_points;
  report.merged_points = points.merged_points;
  report.outliers = points.outliers;
  report.thinned_points = points.thinned_points;
  report.smoothed = points.smoothed;
  report.k = options.k_neighbors;
  report.threads = parallel.threads();
  report.peak_rss_bytes = peak_resident_bytes();
  report.version = PCL_PDS_RECON_VERSION;
  report.seconds.total = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

}  // namespace pds
