// SPDX-License-Identifier: BSD-3-Clause
#include "curve_reconstruction.h"

#include <pcl_pds_recon/curve_extraction.h>
#include <pcl_pds_recon/curve_shape.h>
#include <pcl_pds_recon/geodesic_voronoi.h>
#include <pcl_pds_recon/outliers.h>
#include <pcl_pds_recon/poisson_disk_sampling.h>
#include <pcl_pds_recon/scan_noise.h>
#include <pcl_pds_recon/version.h>
#include <algorithm>
#include <chrono>
#include <utility>
#include "output.h"
#include "preparation.h"
#include "run_report.h"
#include "stage_clock.h"

namespace pds
{
namespace
{

constexpr int most_sortings = 2;  // of strays, as for surfaces
constexpr int center_passes = 2;  // the second one sees the directions of a band that is hardly one any more

/** \brief One call of reconstruct_curves(): its input, and what its stages have in common. */
class CurveRun
{
 public:
  CurveRun(const PointCloudView& cloud, const Options& options, const Progress& progress)
      : cloud_(cloud), options_(options), parallel_(options.threads), clock_(progress, report_.stage_peaks)
  {
  }

  /** \brief Step 1: neighbours. Strays go, and what looks like a line at no scale. */
  void find_neighbors()
  {
    clock_.start("neighbors", 0.0, report_.seconds.neighbors);
    points_ = order_points(cloud_, parallel_);
    join(options_.k_neighbors);
    for (int round = 0; round < most_sortings; ++round)
      if (!leave_out(find_outliers(points_, graph_, parallel_))) break;
    find_scales();
    std::vector<std::uint8_t> shapeless(points_.size());
    for (std::size_t i = 0; i < shapeless.size(); ++i)
      shapeless[i] = scales_[components_.component[i]].radius > 0 ? 0 : 1;
    if (leave_out(shapeless)) find_scales();
  }

  /** \brief Moves the points of noisy curves into the middle of the noise, whose width the disks must exceed. */
  void find_middle()
  {
    clock_.start("weights", 0.3, report_.seconds.weights);
    for (const LineScale& scale : scales_) {
      report_.sampling_interval = std::max(report_.sampling_interval, scale.interval);
      points_.smoothed = points_.smoothed || scale.noisy;
    }
    radius_ = report_.sampling_interval > 0 && options_.radius > 0 ? options_.radius / points_.unit
                                                                   : options_.radius_factor * report_.sampling_interval;
    if (points_.smoothed)
      for (int pass = 0; pass < center_passes; ++pass)
        points_.position = center_on_curves(points_, components_, scales_, parallel_);
    join(2 * options_.k_neighbors);
    ranks_ = points_.smoothed ? middle_ranks(cloud_, points_, parallel_) : std::vector<std::uint8_t>(points_.size());
  }

  /** \brief Steps 2 to 5: seeds and their disks. */
  void sample()
  {
    clock_.start("sampling", 0.5, report_.seconds.sampling);
    if (radius_ <= 0) return;
    SurfaceEstimate no_surface;
    no_surface.normal.assign(points_.size(), Eigen::Vector3f::Zero());
    no_surface.curvature.assign(points_.size(), 0.0F);
    no_surface.inside.assign(points_.size(), 0);
    // Curves keep their length if their ends are seeds.
    const GivenSeeds ends{find_ends(points_, graph_, ranks_, radius_, parallel_)};
    // On a line shortest paths along edges are exact.
    sampling_ =
        sample_poisson_disks(points_, graph_, no_surface, EdgeWeights(), ranks_, std::min(radius_, largest_radius),
                             GeodesicSolver::dijkstra, options_.seed, parallel_, ends);
  }

  /** \brief Steps 6 to 8: Voronoi diagram, adjacent seeds, curves. */
  void build_dual()
  {
    clock_.start("voronoi", 0.7, report_.seconds.voronoi);
    voronoi_ = build_geodesic_voronoi(points_, graph_, EdgeWeights(), sampling_, options_.voronoi_threshold, parallel_);
    clock_.start("seed_graph", 0.9, report_.seconds.seed_graph);
    curves_ = extract_curves(voronoi_.pairs, sampling_.seeds.size());
  }

  Reconstruction describe()
  {
    clock_.start("output", 0.95, report_.seconds.orientation);
    Reconstruction result;
    const std::vector<std::uint32_t> number_of_seed = number_along_curves(curves_, points_, sampling_, result);
    describe_points(cloud_, points_, sampling_, voronoi_, number_of_seed, result, parallel_);
    report_.sampling_interval *= points_.unit;
    report_.vertices = 0;
    for (const Curve& curve : curves_) {
      report_.vertices += curve.seeds.size();
      report_.closed_curves += curve.closed ? 1 : 0;
    }
    report_.curves = report_.components = curves_.size();
    report_.segments = report_.edges = result.segments.size();
    report_.euler = static_cast<long long>(report_.vertices) - static_cast<long long>(report_.edges);
    report_sampling(sampling_, points_, report_, parallel_);
    report_.curve_radius = report_.radius;
    report_.input_points = cloud_.size;
    report_.smoothed = points_.smoothed;
    report_.k = options_.k_neighbors;
    report_.threads = parallel_.threads();
    report_.peak_rss_bytes = peak_resident_bytes();
    report_.version = PCL_PDS_RECON_VERSION;
    clock_.stop();
    report_.seconds.total = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    result.report = report_;
    return result;
  }

 private:
  /** \return whether there are any */
  bool leave_out(const std::vector<std::uint8_t>& outlier)
  {
    if (std::find(outlier.begin(), outlier.end(), 1) == outlier.end()) return false;
    points_ = without_outliers(std::move(points_), outlier, parallel_);
    join(options_.k_neighbors);
    return true;
  }

  void find_scales()
  {
    components_ = find_components(graph_);
    scales_ = find_line_scales(points_, graph_, components_, LineLimits(), parallel_);
  }

  void join(int neighbors)
  {
    graph_ = {};
    // A search that the caller brings knows nothing of positions in the middle of the noise.
    PointCloudView searched = cloud_;
    if (points_.smoothed) searched.neighbor_search = nullptr;
    graph_ = build_neighbor_graph(points_, searched, neighbors, parallel_);
  }

  const PointCloudView& cloud_;
  const Options& options_;
  Parallel parallel_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  Report report_;
  StageClock clock_;
  OrderedPoints points_;
  NeighborGraph graph_;
  PointComponents components_;
  std::vector<LineScale> scales_;
  double radius_ = 0;  ///< in units of position
  std::vector<std::uint8_t> ranks_;
  PoissonDiskSampling sampling_;
  GeodesicVoronoi voronoi_;
  std::vector<Curve> curves_;
};

}  // namespace

Reconstruction reconstruct_curves(const PointCloudView& cloud, const Options& options, const Progress& progress)
{
  CurveRun run(cloud, options, progress);
  run.find_neighbors();
  run.find_middle();
  run.sample();
  run.build_dual();
  return run.describe();
}

}  // namespace pds
