// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/certificate.h>
#include <pcl_pds_recon/edge_flips.h>
#include <pcl_pds_recon/fold_removal.h>
#include <pcl_pds_recon/geodesic_voronoi.h>
#include <pcl_pds_recon/handle_removal.h>
#include <pcl_pds_recon/hole_filling.h>
#include <pcl_pds_recon/mesh_cleaning.h>
#include <pcl_pds_recon/orientation.h>
#include <pcl_pds_recon/outward_normals.h>
#include <pcl_pds_recon/placement.h>
#include <pcl_pds_recon/poisson_disk_sampling.h>
#include <pcl_pds_recon/reconstruction.h>
#include <pcl_pds_recon/scan_noise.h>
#include <pcl_pds_recon/seed_faces.h>
#include <pcl_pds_recon/seed_graph.h>
#include <pcl_pds_recon/side_mending.h>
#include <pcl_pds_recon/side_parting.h>
#include <pcl_pds_recon/triangle_complex.h>
#include <pcl_pds_recon/version.h>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>
#include "cloud_distance.h"
#include "dimension.h"
#include "output.h"
#include "page_pool.h"
#include "preparation.h"
#include "radius_search.h"
#include "relaxation.h"
#include "run_report.h"
#include "stage_clock.h"

namespace pds
{
namespace
{

/** \brief Leaves out what names a seed that may not be a vertex.
 * \param allowed ranks, ascending */
void keep_evidence(const PoissonDiskSampling& sampling,
                   const std::vector<std::uint32_t>& allowed,
                   GeodesicVoronoi& voronoi)
{
  const auto barred = [&](std::uint32_t seed) {
    return !std::binary_search(allowed.begin(), allowed.end(), sampling.seeds[seed]);
  };
  std::vector<SeedPair>& pairs = voronoi.pairs;
  std::vector<SeedTriple>& triples = voronoi.triples;
  pairs.erase(std::remove_if(pairs.begin(), pairs.end(), [&](const SeedPair& p) { return barred(p.a) || barred(p.b); }),
              pairs.end());
  triples.erase(std::remove_if(triples.begin(), triples.end(),
                               [&](const SeedTriple& t) { return barred(t.a) || barred(t.b) || barred(t.c); }),
                triples.end());
}

/** \brief Steps 6 to 8 of the flowchart, for one set of seeds. */
struct Dual
{
  GeodesicVoronoi voronoi;
  SeedGeometry seeds;
  SeedGraph graph;
  std::vector<Triangle> triangles;      ///< of seeds, turned to their outside
  std::vector<Eigen::Vector3d> placed;  ///< of every seed, in radii; empty: the seeds' own places
  bool orientable = true;
  std::size_t filled_holes = 0;
};

/** \brief One call of reconstruct(): its input, and what its stages have in common. */
class Run
{
 public:
  Run(const PointCloudView& cloud, const Options& options, const Progress& progress)
      : cloud_(cloud), options_(options), parallel_(options.threads), clock_(progress, report_.stage_peaks)
  {
  }

  /** \brief Step 1: neighbours, sampling interval, radius. */
  void find_radius()
  {
    clock_.start("neighbors", 0.0, report_.seconds.neighbors);
    found_ = find_neighborhoods(cloud_, options_, parallel_);
    clock_.start("weights", 0.4, report_.seconds.weights);
    metric_ = choose_metric(found_, options_, parallel_, report_);
    features_ = found_.points.smoothed ? middle_ranks(cloud_, found_.points, parallel_)
                                       : feature_ranks(found_.points, found_.surface, found_.graph, parallel_);
  }

  /** \brief Steps 2 to 5: seeds and their disks, finest level first. The seeds of a level are among those of the finer
   * one, whose sampling begins with them. */
  std::vector<PoissonDiskSampling> sample(double radius, std::size_t levels, const SteadyCount& steady)
  {
    clock_.start("sampling", 0.5, report_.seconds.sampling);
    std::vector<PoissonDiskSampling> nested(levels);
    if (radius <= 0) return nested;
    std::vector<std::uint32_t> coarser;
    for (std::size_t level = levels; level-- > 0;) {
      const auto at_level = [level](double finest) {
        return std::min(std::ldexp(finest, static_cast<int>(level)), largest_radius);
      };
      nested[level] = sample(at_level(radius), {coarser}, {steady.spread, at_level(steady.radius_of_cells)});
      coarser = nested[level].seeds;
    }
    return nested;
  }

  /** \brief Steps 6 to 8: Voronoi diagram, adjacent seeds, triangles, holes.
   * \param allowed ranks of the points that may be vertices, ascending; empty: all */
  Dual build_dual(const PoissonDiskSampling& sampling, const std::vector<std::uint32_t>& allowed)
  {
    Dual dual;
    clock_.start("voronoi", 0.7, report_.seconds.voronoi);
    dual.voronoi = build_geodesic_voronoi(found_.points, found_.graph, metric_.weights, sampling,
                                          options_.voronoi_threshold, parallel_);
    if (!allowed.empty()) keep_evidence(sampling, allowed, dual.voronoi);
    if (!repeats_) {
      pages_.reset();                  // what follows works on seeds, in small arrays
      found_.graph = NeighborGraph();  // half of the memory, and of no more use
    }
    clock_.start("seed_graph", 0.8, report_.seconds.seed_graph);
    dual.seeds = describe_seeds(cloud_, found_.points, found_.surface, sampling, dual.voronoi, parallel_);
    dual.graph = build_seed_graph(dual.seeds, dual.voronoi.pairs, parallel_);

    clock_.start("faces", 0.85, report_.seconds.faces);
    const SeedFaces faces = trace_faces(dual.graph, dual.seeds, parallel_);
    const std::vector<Eigen::Vector3d> outward =
        outward_normals(cloud_, found_.points, dual.seeds, dual.voronoi, parallel_);
    TriangleComplex complex(dual.seeds.position, parallel_, outward);
    dual.orientable = add_dual_triangles(complex, faces.triangles, dual.voronoi.triples).empty();
    clock_.start("holes", 0.9, report_.seconds.holes);
    FillLimits limits;
    limits.perimeter = options_.hole_size;
    limits.join_rims = found_.points.smoothed;
    limits.sparsity = &dual.voronoi.sparsity;
    const BorderingCells bordering(dual.voronoi.pairs);
    dual.filled_holes = fill_holes(complex, dual.seeds, bordering, faces.polygons, limits);
    if (found_.points.smoothed && limits.perimeter > 0) {
      dual.filled_holes += fill_gaps(complex, dual.seeds, bordering, limits);
      if (outward.empty()) mend_sides(complex, dual.seeds, bordering, limits);
      remove_small_handles(complex, bordering, limits);
      remove_folds(complex, bordering, limits);
      clean_mesh(complex, dual.seeds);
    }
    part_sides(complex, outward);

    clock_.start("orientation", 0.95, report_.seconds.orientation);
    dual.triangles = orient_faces(complex, orientation_cues(cloud_, found_.points, sampling, outward));
    return dual;
  }

  /** \brief Moves the seeds to the middle of their cells, step by step, and meshes them anew. */
  void relax(PoissonDiskSampling& sampling, Dual& dual)
  {
    Relaxation relaxation;
    for (unsigned step = 0; step < options_.relax; ++step) {
      clock_.start("relaxation", 0.5, report_.seconds.sampling);
      // Where seeds have moved apart no dart is thrown between them, or there would soon be more and more.
      const bool is_last = step + 1 == options_.relax;
      const GivenSeeds moved{
          relaxation.step(dual.seeds, dual.triangles, found_.points, sampling, dual.voronoi, is_last, parallel_),
          disk_reach};
      sampling = sample(sampling.radius, moved);
      dual = build_dual(sampling, {});
    }
  }

  /** \brief Brings edges, and vertices if they may move, to where the mesh fits the points best. */
  void fit(const PoissonDiskSampling& sampling, Dual& dual)
  {
    clock_.start("placement", 0.96, report_.seconds.placement);
    if (options_.relax == 0)  // which is asked for even triangles
      flip_edges(dual.seeds, found_.points.position, sampling, dual.voronoi, parallel_, dual.triangles);
    if (options_.placement == Placement::quadric)
      dual.placed = place_vertices(dual.seeds, dual.triangles, found_.points.position, sampling, dual.voronoi,
                                   found_.points.smoothed, parallel_);
  }

  /** \brief Distance that 99 % of the points keep to the mesh. */
  double measure_error(const PoissonDiskSampling& sampling, const Dual& dual)
  {
    constexpr double share = 0.99;
    clock_.start("distance", 0.97, report_.seconds.placement);
    report_.p99_distance =
        distance_of_share(cloud_, found_.points, sampling, dual.placed.empty() ? dual.seeds.position : dual.placed,
                          dual.triangles, share, parallel_);
    return report_.p99_distance;
  }

  Reconstruction describe(const PoissonDiskSampling& sampling, Dual dual)
  {
    clock_.start("output", 0.98, report_.seconds.orientation);
    Reconstruction result;
    result.report = report_;
    Report& report = result.report;
    const std::vector<std::uint32_t> number_of_seed =
        number_vertices(std::move(dual.triangles), found_.points, sampling, result, parallel_);
    describe_points(cloud_, found_.points, sampling, dual.voronoi, number_of_seed, result, parallel_);
    describe_seed_graph(dual.graph, number_of_seed, result, parallel_);
    report_certificate(certify(result.triangles, result.seeds.size(), parallel_), result);
    if (!dual.placed.empty())
      describe_moved_vertices(dual.placed, found_.points, sampling, dual.voronoi, number_of_seed, result);
    report_sampling(sampling, found_.points, report, parallel_);
    clock_.stop();
    report.seconds = report_.seconds;
    report.stage_peaks = report_.stage_peaks;
    report.orientable = dual.orientable;
    report.filled_holes = dual.filled_holes;
    report.input_points = cloud_.size;
    report.smoothed = found_.points.smoothed;
    report.k = options_.k_neighbors;
    report.threads = parallel_.threads();
    report.peak_rss_bytes = peak_resident_bytes();
    report.version = PCL_PDS_RECON_VERSION;
    report.seconds.total = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    return result;
  }

  [[nodiscard]] double radius() const { return metric_.radius; }
  [[nodiscard]] double least_radius() const
  {
    return found_.radius > 0 ? metric_.radius * least_radius_factor * found_.interval / found_.radius : 0;
  }
  /** \brief Keeps what stages need that may run again. */
  void repeat_stages() { repeats_ = true; }

 private:
  PoissonDiskSampling sample(double radius, const GivenSeeds& given, const SteadyCount& steady = {}) const
  {
    return sample_poisson_disks(found_.points, found_.graph, found_.surface, metric_.weights, features_, radius,
                                options_.geodesic_solver, options_.seed, parallel_, given, steady);
  }

  std::optional<PageReuse> pages_{std::in_place};
  const PointCloudView& cloud_;
  const Options& options_;
  Parallel parallel_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  Report report_;
  StageClock clock_;
  Neighborhoods found_;
  Metric metric_;
  std::vector<std::uint8_t> features_;
  bool repeats_ = false;
};

/** \brief Ranks of the seeds that have a face. */
std::vector<std::uint32_t> vertices_of(const PoissonDiskSampling& sampling, const Dual& dual)
{
  std::vector<std::uint8_t> used(sampling.seeds.size());
  for (const Triangle& t : dual.triangles)
    for (const std::uint32_t s : t) used[s] = 1;
  std::vector<std::uint32_t> ranks;
  for (std::size_t s = 0; s < used.size(); ++s)
    if (used[s] != 0) ranks.push_back(sampling.seeds[s]);
  return ranks;
}

}  // namespace

Reconstruction reconstruct(const PointCloudView& cloud, const Options& options, const Progress& progress)
{
  return std::move(reconstruct_levels(cloud, options, 1, progress).front());
}

std::vector<Reconstruction> reconstruct_levels(const PointCloudView& cloud,
                                               const Options& options,
                                               unsigned levels,
                                               const Progress& progress)
{
  validate(options);
  if (levels < 1 || levels > most_levels) throw InvalidOption("levels must be 1 to 16");
  if (levels > 1 && options.relax > 0) throw InvalidOption("levels cannot be nested if relax moves their seeds");
  if (options.dimension != Dimension::surface) {
    if (levels > 1) throw InvalidOption("levels are for surfaces only; take one, or dimension 2");
    return {reconstruct_curves_too(cloud, options, progress)};
  }
  Run run(cloud, options, progress);
  run.find_radius();
  RadiusSearch search(options, run.radius(), run.least_radius());
  if (levels > 1 || options.relax > 0 || search.active()) run.repeat_stages();

  std::vector<PoissonDiskSampling> samplings;
  Dual dual;
  for (bool found = false; !found;) {
    do samplings = run.sample(search.radius(), levels, search.steady());
    while (!search.sampled(samplings[0]));
    dual = run.build_dual(samplings[0], {});
    run.relax(samplings[0], dual);
    run.fit(samplings[0], dual);
    found = search.meshed([&] { return vertices_of(samplings[0], dual).size(); },
                          [&] { return run.measure_error(samplings[0], dual); });
  }
  std::vector<Reconstruction> results;
  std::vector<std::uint32_t> vertices = vertices_of(samplings[0], dual);
  results.push_back(run.describe(samplings[0], std::move(dual)));
  for (std::size_t level = 1; level < levels; ++level) {
    Dual coarser = run.build_dual(samplings[level], vertices);
    run.fit(samplings[level], coarser);
    vertices = vertices_of(samplings[level], coarser);
    results.push_back(run.describe(samplings[level], std::move(coarser)));
  }
  return results;
}

}  // namespace pds
