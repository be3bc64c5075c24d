// SPDX-License-Identifier: BSD-3-Clause
#include "preparation.h"

#include <pcl_pds_recon/outliers.h>
#include <pcl_pds_recon/scan_noise.h>
#include <pcl_pds_recon/sheet_separation.h>
#include <pcl_pds_recon/thinning.h>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace pds
{
namespace
{

constexpr int most_sortings = 2;    // of outliers; more find little
constexpr int most_smoothings = 4;  // noise of one interval takes three; what is left then is no surface

bool radius_is_absolute(const Options& options)
{
  return options.radius > 0 && options.vertices == 0 && options.max_error == 0;
}

/** \brief Radius in units of position that gives about so many vertices.
 *
 * k neighbours lie on a disk of k / n of the area, at 2/3 of its radius in the mean; Poisson-disk samples are so dense
 * that their number times the squared radius is 0.65 of the area. */
double radius_for(std::uint64_t vertices, const Neighborhoods& found, int k)
{
  constexpr double density = 0.65;
  constexpr double pi = 3.14159265358979323846;
  const double area_of_point = pi * 9 / 4 * found.interval * found.interval / k;
  return std::sqrt(density * static_cast<double>(found.points.size()) * area_of_point / static_cast<double>(vertices));
}

/** \brief Throws if so many vertices would be closer to each other than the least radius factor allows. */
void require_enough_points(const Neighborhoods& found, const Options& options)
{
  const double factor = found.radius / found.interval;
  if (factor >= least_radius_factor) return;
  const auto most = static_cast<std::uint64_t>(static_cast<double>(options.vertices) * factor * factor /
                                               (least_radius_factor * least_radius_factor));
  throw InvalidInput("vertices: " + std::to_string(options.vertices) + " are too many for " +
                     std::to_string(found.points.size()) + " points; ask for " + std::to_string(most) + " at most");
}

}  // namespace

Neighborhoods find_neighborhoods(const PointCloudView& cloud, const Options& options, const Parallel& parallel)
{
  Neighborhoods found;
  const double fineness = options.adaptive == 0 ? voxels_per_radius : voxels_per_adaptive_radius;
  const auto thin = [&](double radius) {
    found.points = thin_points(std::move(found.points), radius / fineness, parallel);
  };
  const auto join = [&] {
    found.graph = {};  // before the next one is made: two of them would be the peak of the run's memory
    found.surface = {};
    // A search that the caller brings knows nothing of smoothed positions.
    PointCloudView searched = cloud;
    if (found.points.smoothed) searched.neighbor_search = nullptr;
    found.graph = list_neighbors(found.points, searched, options.k_neighbors, parallel);
    found.surface = estimate_surface(found.points, found.graph, parallel);
    separate_sheets(cloud, found.points, found.graph, found.surface, parallel);
    join_neighbors(found.points, searched, found.graph, parallel);
  };
  const bool absolute = radius_is_absolute(options);
  found.points =
      absolute ? order_and_thin_points(cloud, options.radius / fineness, parallel) : order_points(cloud, parallel);
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
  found.radius = absolute               ? options.radius / found.points.unit
                 : options.vertices > 0 ? radius_for(options.vertices, found, options.k_neighbors)
                                        : options.radius_factor * found.interval;
  if (!absolute && options.max_error == 0 && found.interval > 0) {
    if (options.vertices > 0) require_enough_points(found, options);
    const std::size_t points = found.points.size();
    thin(found.radius);
    if (found.points.size() < points) join();
  }
  PointArray<Reach>().swap(found.graph.reach);  // of no more use
  return found;
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
