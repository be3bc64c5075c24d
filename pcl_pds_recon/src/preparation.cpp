// SPDX-License-Identifier: BSD-3-Clause
#include "preparation.h"

#include <pcl_pds_recon/nearest_neighbors.h>
#include <pcl_pds_recon/outliers.h>
#include <pcl_pds_recon/scan_noise.h>
#include <pcl_pds_recon/sheet_separation.h>
#include <pcl_pds_recon/thinning.h>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>
#include "surface_sampling.h"

namespace pds
{
namespace
{

constexpr int most_sortings = 2;            // of outliers; more find little
constexpr std::size_t layered_share = 100;  // misfitting scans are in layers: so many points have one beside theirs
constexpr int most_smoothings = 4;          // noise of one interval takes three; what is left then is no surface

// Voxels that make one of points too close to each other; shares of the box.
constexpr double finest_voxel = 1.0 / (1 << 20);  // there are no more numbers for finer ones
constexpr double coarsest_voxel = 0.1;            // what is no surface then will be none
constexpr double coarsening = 1.25;               // from voxel to voxel, if nothing else tells how large they must be
constexpr double least_merging = 0.6;             // sampling intervals; on a line these are four points long

// Sampling intervals of deviation from a plane part that is thinned before noise is looked for: as much as would be
// noise.
constexpr double thickest_plane = 0.1;
// Sampling intervals: plane parts are not thinned for larger disks than this, whatever the radius. A fifth of their
// points is left then, which reach 2.2 times as far as those at rims: lone_reach is no nearer than where density
// changes.
constexpr double largest_plane_radius = 4.5;

bool radius_is_absolute(const Options& options)
{
  return options.radius > 0 && options.vertices == 0 && options.max_error == 0;
}

/** \brief Radius in units of position that gives about so many vertices.
 *
 * k neighbours lie on a disk of k / n of the area, at 2/3 of its radius in the mean; Poisson-disk samples are so dense
 * that their number times the squared radius is 0.65 of the area. */
double radius_for(std::uint64_t vertices, std::size_t points, double interval, int k)
{
  constexpr double density = 0.65;
  constexpr double pi = 3.14159265358979323846;
  const double area_of_point = pi * 9 / 4 * interval * interval / k;
  return std::sqrt(density * static_cast<double>(points) * area_of_point / static_cast<double>(vertices));
}

/** \brief Throws if so many vertices would be closer to each other than the least radius factor allows. */
void require_enough_points(const Neighborhoods& found, std::size_t points, const Options& options)
{
  const double factor = found.radius / found.interval;
  if (factor >= least_radius_factor) return;
  const auto most = static_cast<std::uint64_t>(static_cast<double>(options.vertices) * factor * factor /
                                               (least_radius_factor * least_radius_factor));
  throw InvalidInput("vertices: " + std::to_string(options.vertices) + " are too many for " + std::to_string(points) +
                     " points; ask for " + std::to_string(most) + " at most");
}

/** \brief The sampling interval of a cloud that may be thinned before its points are joined, from some of its points.
 */
class SampledInterval
{
 public:
  SampledInterval(const OrderedPoints& points, int k, const Parallel& parallel)
      : distances_(sample_neighbor_distances(points.position, static_cast<std::size_t>(k), parallel))
  {
    for (NeighborDistance& distance : distances_) distance.point = points.input_index[distance.point];
  }

  /** \brief Of those points that are neither outliers nor strays. */
  [[nodiscard]] double mean(const OrderedPoints& points) const
  {
    const float stray = stray_reach * median();
    double sum = 0;
    std::size_t count = 0;
    for (const NeighborDistance& distance : distances_) {
      if (points.rank_of_input[distance.point] == no_rank || distance.mean > stray) continue;
      sum += static_cast<double>(distance.mean);
      ++count;
    }
    return count > 0 ? sum / static_cast<double>(count) : 0.0;
  }

  /** \brief The mean, or the median if that is less: outliers that nobody has found yet do not widen it. */
  [[nodiscard]] double cautious_mean(const OrderedPoints& points) const
  {
    return std::min(mean(points), static_cast<double>(median()));
  }

 private:
  [[nodiscard]] float median() const
  {
    std::vector<float> means;
    for (const NeighborDistance& distance : distances_) means.push_back(distance.mean);
    const auto middle = means.begin() + static_cast<std::ptrdiff_t>(means.size() / 2);
    std::nth_element(means.begin(), middle, means.end());
    return *middle;
  }

  PointArray<NeighborDistance> distances_;  ///< by input index instead of rank
};

/** \brief The steps of find_neighborhoods(), and what they know about the cloud. */
class Preparation
{
 public:
  Preparation(const PointCloudView& cloud, const Options& options, const Parallel& parallel)
      : cloud_(cloud),
        options_(options),
        parallel_(parallel),
        fineness_(options.adaptive == 0 ? voxels_per_radius : voxels_per_adaptive_radius)
  {
  }

  Neighborhoods run()
  {
    order();
    join();
    merge_close_points();
    leave_out_outliers();
    smooth();
    found_.interval = found_.graph.sampling_interval;
    found_.radius = radius_of(found_.interval);
    if (options_.vertices > 0 && found_.interval > 0) require_enough_points(found_, points_of_surface(), options_);
    if (radius_follows_interval() && found_.interval > 0) thin_for_radius();
    PointArray<Reach>().swap(found_.graph.reach);  // of no more use
    return std::move(found_);
  }

 private:
  [[nodiscard]] bool radius_follows_interval() const
  {
    return !radius_is_absolute(options_) && options_.max_error == 0;
  }

  /** \brief The distinct points that are no outliers, thinned ones among them but for those that were too close. */
  [[nodiscard]] std::size_t points_of_surface() const
  {
    return found_.points.size() + found_.points.thinned_points - close_points_;
  }

  [[nodiscard]] double radius_of(double interval) const
  {
    if (radius_is_absolute(options_)) return options_.radius / found_.points.unit;
    if (options_.vertices == 0) return options_.radius_factor * interval;
    return radius_for(options_.vertices, points_of_surface(), interval, options_.k_neighbors);
  }

  void order()
  {
    found_.points = radius_is_absolute(options_) ? order_and_thin_points(cloud_, options_.radius / fineness_, parallel_)
                                                 : order_points(cloud_, parallel_);
    if (options_.max_error == 0 && options_.adaptive == 0 && found_.points.thinned_points == 0) thin_planes();
  }

  void thin_planes()
  {
    if (found_.points.size() < fewest_points_to_thin_planes) return;
    const SampledInterval sample(found_.points, options_.k_neighbors, parallel_);
    const double interval = sample.cautious_mean(found_.points);
    found_.points =
        thin_plane_parts(std::move(found_.points), std::min(radius_of(interval), largest_plane_radius * interval),
                         thickest_plane * interval, parallel_);
    if (found_.points.thinned_points > 0) sample_ = sample;
  }

  void join()
  {
    found_.graph = {};  // before the next one is made: two of them would be the peak of the run's memory
    found_.surface = {};
    // A search that the caller brings knows nothing of smoothed positions.
    PointCloudView searched = cloud_;
    if (found_.points.smoothed) searched.neighbor_search = nullptr;
    found_.graph = list_neighbors(found_.points, searched, options_.k_neighbors, parallel_);
    found_.surface = estimate_surface(found_.points, found_.graph, parallel_);
    part_sheets();
    join_neighbors(found_.points, searched, found_.graph, parallel_);
    if (sample_) restore_interval(found_.graph.sampling_interval);
  }

  /** \brief Parts sheets; in a smoothed cloud that was in layers only where it had them before, for smoothing brings
   * layers out. */
  void part_sheets()
  {
    std::vector<std::uint8_t> candidate;
    if (found_.points.smoothed && in_layers_) {
      if (parted_.empty()) return;
      candidate = parted_before();
    }
    parted_.clear();
    const SheetCounts sheets =
        separate_sheets(cloud_, found_.points, found_.graph, found_.surface, parallel_, candidate);
    if (!found_.points.smoothed) in_layers_ = sheets.too_near * layered_share > found_.points.size();
    if (sheets.parted == 0) return;
    parted_.resize(cloud_.size);
    for (std::size_t i = 0; i < found_.points.size(); ++i)
      if (found_.graph.reach[i].rank == Reach::parted) parted_[found_.points.input_index[i]] = 1;
  }

  /** \brief By point, whether its row was parted the last time. */
  [[nodiscard]] std::vector<std::uint8_t> parted_before() const
  {
    std::vector<std::uint8_t> parted(found_.points.size());
    for (std::size_t i = 0; i < parted.size(); ++i) parted[i] = parted_[found_.points.input_index[i]];
    return parted;
  }

  /** \brief From that of all points that are left to that where none were left out. Smoothing does the same to both. */
  void restore_interval(double& interval)
  {
    if (!found_.points.smoothed) unthinned_over_thinned_ = interval > 0 ? sample_->mean(found_.points) / interval : 1.0;
    interval *= unthinned_over_thinned_;
  }

  /** \brief Points that are rows or clumps at the reach of their neighbours may be a surface at a larger one: of those
   * in a voxel as wide as the sampling interval one stays, until they are. Points that never are stay as they were. */
  void merge_close_points()
  {
    if (is_sampled_as_surface(found_.graph, parallel_)) return;
    sample_.reset();
    for (double voxel = finest_voxel; voxel < coarsest_voxel; voxel *= coarsening) {
      voxel = std::max(voxel, least_merging * found_.graph.sampling_interval);
      const std::size_t points = found_.points.size();
      found_.points = thin_points(std::move(found_.points), voxel, parallel_);
      if (found_.points.size() == points) continue;
      join();
      close_points_ = found_.points.thinned_points;
      if (is_sampled_as_surface(found_.graph, parallel_)) return;
    }
    close_points_ = 0;
    order();
    join();
  }

  void leave_out_outliers()
  {
    // Without their company, more outliers stand alone.
    for (int round = 0; round < most_sortings; ++round) {
      const std::vector<std::uint8_t> outlier = find_outliers(found_.points, found_.graph, parallel_);
      if (outlier.empty()) break;
      found_.points = without_outliers(std::move(found_.points), outlier, parallel_);
      join();
    }
  }

  [[nodiscard]] bool is_cloud_noisy() const
  {
    const std::size_t of_planes = sample_ ? found_.points.thinned_points : 0;  // none of them noisy
    return is_noisy(found_.points, found_.graph, parallel_, of_planes);
  }

  void smooth()
  {
    for (int pass = 0; pass < most_smoothings && is_cloud_noisy(); ++pass) {
      found_.points.position = smooth_positions(found_.points, found_.graph, parallel_);
      found_.points.smoothed = true;
      join();
    }
  }

  void thin_for_radius()
  {
    const std::size_t points = found_.points.size();
    sample_.reset();
    found_.points = thin_points(std::move(found_.points), found_.radius / fineness_, parallel_);
    if (found_.points.size() < points) join();
  }

  const PointCloudView& cloud_;
  const Options& options_;
  const Parallel& parallel_;
  double fineness_;  ///< voxels per radius, if all points are thinned
  Neighborhoods found_;
  std::size_t close_points_ = 0;      ///< thinned ones that do not count, for the interval is that of the others
  bool in_layers_ = false;            ///< as scans are that misfit; noise by itself makes none
  std::vector<std::uint8_t> parted_;  ///< by input index, whether its row lost points of another sheet; empty: none
  std::optional<SampledInterval> sample_;  ///< if only plane parts have been thinned
  double unthinned_over_thinned_ = 1;      ///< sampling interval
};

}  // namespace

Neighborhoods find_neighborhoods(const PointCloudView& cloud, const Options& options, const Parallel& parallel)
{
  return Preparation(cloud, options, parallel).run();
}

Metric choose_metric(const Neighborhoods& found, const Options& options, const Parallel& parallel, Report& report)
{
  const auto& [points, graph, surface, radius, interval_of_cloud] = found;
  Metric metric;
  const double interval = graph.sampling_interval;
  if (interval <= 0) return metric;
  const bool absolute = radius_is_absolute(options);
  metric.weights = curvature_weights(surface, graph, options.adaptive, {radius / interval, !absolute}, parallel);
  // Thinning changes the interval, but hardly what the weights do to it.
  const double stretch = mean_weighted_interval(points, graph, metric.weights, parallel) / interval;
  metric.radius = std::min(absolute ? radius : radius * stretch, largest_radius);
  report.sampling_interval = interval_of_cloud * stretch * points.unit;
  report.radius = metric.radius * points.unit;
  return metric;
}

}  // namespace pds
