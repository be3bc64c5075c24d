// SPDX-License-Identifier: BSD-3-Clause
#include "dimension.h"

#include <pcl_pds_recon/curve_shape.h>
#include <pcl_pds_recon/neighbor_graph.h>
#include <pcl_pds_recon/ordered_points.h>
#include <pcl_pds_recon/outliers.h>
#include <algorithm>
#include <chrono>
#include <numeric>
#include <utility>
#include "curve_reconstruction.h"
#include "run_report.h"

namespace pds
{
namespace
{

using Indices = std::vector<std::uint32_t>;

/** \brief What tells a curve from a surface without being told: what is narrower than a disk of the default radius
 * factor gives no triangles, and what is short is as likely a speck of a surface. */
constexpr LineLimits curve_limits{6.0, 8.0};

/** \brief Input indices of the points of curves, and of all others. */
struct Parts
{
  Indices curves;
  Indices surfaces;
};

Parts tell_apart(const PointCloudView& cloud, const Options& options)
{
  const Parallel parallel(options.threads);
  OrderedPoints points = order_points(cloud, parallel);
  NeighborGraph graph = build_neighbor_graph(points, cloud, options.k_neighbors, parallel);
  // Strays join what is apart. They stay with the surfaces, which leave them out.
  if (const std::vector<std::uint8_t> stray = find_outliers(points, graph, parallel); !stray.empty()) {
    points = without_outliers(std::move(points), stray, parallel);
    graph = build_neighbor_graph(points, cloud, options.k_neighbors, parallel);
  }
  const PointComponents components = find_components(graph);
  const std::vector<LineScale> scales = find_line_scales(points, graph, components, curve_limits, parallel);
  const auto on_curve = [&](std::uint32_t rank) {
    return rank != no_rank && scales[components.component[rank]].radius > 0;
  };
  Parts parts;
  for (std::uint32_t i = 0; i < cloud.size; ++i)
    (on_curve(points.rank_of_input[i]) ? parts.curves : parts.surfaces).push_back(i);
  const bool all_on_curves = std::all_of(scales.begin(), scales.end(), [](const LineScale& s) { return s.radius > 0; });
  if (all_on_curves && !scales.empty()) {
    parts.curves.resize(cloud.size);
    std::iota(parts.curves.begin(), parts.curves.end(), 0U);
    parts.surfaces.clear();
  }
  return parts;
}

/** \brief Some points of a cloud as a cloud of their own. Their neighbours are found by the library's own search, for a
 * caller's would find those of the whole. */
class PartOfCloud
{
 public:
  PartOfCloud(const PointCloudView& cloud, const Indices& indices)
  {
    for (const std::uint32_t i : indices) {
      positions_.push_back(cloud.positions[i]);
      if (cloud.normals) normals_.push_back(cloud.normals[i]);
      if (cloud.viewpoints) viewpoints_.push_back(cloud.viewpoints[i]);
    }
    view_.size = indices.size();
    view_.positions = Vector3View(positions_.front().data(), sizeof(Eigen::Vector3d));
    if (cloud.normals) view_.normals = Vector3View(normals_.front().data(), sizeof(Eigen::Vector3d));
    if (cloud.viewpoints) view_.viewpoints = Vector3View(viewpoints_.front().data(), sizeof(Eigen::Vector3d));
    view_.sensor_origin = cloud.sensor_origin;
    if (cloud.record_less)
      view_.record_less = [&cloud, &indices](std::uint32_t a, std::uint32_t b) {
        return cloud.record_less(indices[a], indices[b]);
      };
  }
  PartOfCloud(const PartOfCloud&) = delete;  // the view points into it
  PartOfCloud& operator=(const PartOfCloud&) = delete;

  [[nodiscard]] const PointCloudView& view() const { return view_; }

 private:
  std::vector<Eigen::Vector3d> positions_, normals_, viewpoints_;
  PointCloudView view_;
};

/** \brief Puts two results of parts of a cloud together, surfaces first. */
class Union
{
 public:
  Union(const Parts& parts, Reconstruction surfaces, Reconstruction curves)
      : parts_(parts), surfaces_(std::move(surfaces)), curves_(std::move(curves))
  {
  }

  Reconstruction result()
  {
    Reconstruction all;
    add_seeds(all);
    all.triangles = std::move(surfaces_.triangles);  // their vertices keep their numbers
    all.boundary_loops = std::move(surfaces_.boundary_loops);
    for (const auto& [a, b] : curves_.segments) all.segments.push_back({number_on_curve(a), number_on_curve(b)});
    const std::size_t points = parts_.surfaces.size() + parts_.curves.size();
    all.voronoi.label.resize(points);
    all.voronoi.distance.resize(points);
    const auto on_surface = [this](std::uint32_t seed) { return number_on_surface(seed); };
    const auto on_curve = [this](std::uint32_t seed) { return number_on_curve(seed); };
    add_points(surfaces_, parts_.surfaces, on_surface, all);
    add_points(curves_, parts_.curves, on_curve, all);
    std::sort(all.witness_points.begin(), all.witness_points.end());
    std::sort(all.seed_edges.begin(), all.seed_edges.end());
    all.report = report();
    return all;
  }

 private:
  void add_seeds(Reconstruction& all) const
  {
    const auto add = [&all](const Indices& indices, const Indices& seeds, std::size_t begin, std::size_t end) {
      for (std::size_t s = begin; s < end; ++s) all.seeds.push_back(indices[seeds[s]]);
    };
    add(parts_.surfaces, surfaces_.seeds, 0, surfaces_.report.vertices);
    add(parts_.curves, curves_.seeds, 0, curves_.report.vertices);
    add(parts_.surfaces, surfaces_.seeds, surfaces_.report.vertices, surfaces_.seeds.size());
    add(parts_.curves, curves_.seeds, curves_.report.vertices, curves_.seeds.size());
  }

  [[nodiscard]] std::uint32_t number_on_surface(std::uint32_t seed) const
  {
    return static_cast<std::uint32_t>(seed < surfaces_.report.vertices ? seed : seed + curves_.report.vertices);
  }
  [[nodiscard]] std::uint32_t number_on_curve(std::uint32_t seed) const
  {
    const bool is_vertex = seed < curves_.report.vertices;
    return static_cast<std::uint32_t>(seed + (is_vertex ? surfaces_.report.vertices : surfaces_.seeds.size()));
  }

  template <typename Number>
  void add_points(const Reconstruction& part, const Indices& indices, const Number& number, Reconstruction& all) const
  {
    for (std::size_t i = 0; i < indices.size(); ++i) {
      const std::uint32_t label = part.voronoi.label[i];
      all.voronoi.label[indices[i]] = label == no_label ? no_label : number(label);
      all.voronoi.distance[indices[i]] = part.voronoi.distance[i];
    }
    for (const std::uint32_t i : part.witness_points) all.witness_points.push_back(indices[i]);
    for (const auto& [a, b] : part.seed_edges) {
      const std::pair<std::uint32_t, std::uint32_t> ends = std::minmax({number(a), number(b)});
      all.seed_edges.push_back({ends.first, ends.second});
    }
  }

  /** \brief Sums; radius and sampling interval are those of the surfaces. */
  [[nodiscard]] Report report() const
  {
    Report sum = surfaces_.report;
    const Report& curves = curves_.report;
    for (const auto count : {&Report::input_points, &Report::valid_points, &Report::merged_points, &Report::outliers,
                             &Report::thinned_points, &Report::seeds, &Report::vertices, &Report::edges,
                             &Report::components, &Report::segments, &Report::curves, &Report::closed_curves})
      sum.*count += curves.*count;
    sum.euler += curves.euler;
    sum.smoothed = sum.smoothed || curves.smoothed;
    sum.closed = sum.closed && curves.closed_curves == curves.curves;
    sum.curve_radius = curves.curve_radius;
    if (surfaces_.seeds.empty() || (!curves_.seeds.empty() && curves.min_seed_distance < sum.min_seed_distance))
      sum.min_seed_distance = curves.min_seed_distance;
    sum.coverage_radius = std::max(sum.coverage_radius, curves.coverage_radius);
    for (const auto seconds :
         {&StageSeconds::neighbors, &StageSeconds::weights, &StageSeconds::sampling, &StageSeconds::voronoi,
          &StageSeconds::seed_graph, &StageSeconds::orientation, &StageSeconds::total})
      sum.seconds.*seconds += curves.seconds.*seconds;
    sum.peak_rss_bytes = peak_resident_bytes();
    return sum;
  }

  const Parts& parts_;
  Reconstruction surfaces_, curves_;
};

/** \brief Progress of one part of the work. */
Progress share_of(const Progress& progress, double begin, double end)
{
  if (!progress) return {};
  return [&progress, begin, end](const char* stage, double fraction) {
    progress(stage, begin + fraction * (end - begin));
  };
}

/** \brief Reconstructs each part as what it is. */
Reconstruction reconstruct_parts(const PointCloudView& cloud,
                                 const Parts& parts,
                                 const Options& options,
                                 const Progress& progress)
{
  constexpr double told_apart = 0.2;  // of the work
  constexpr double curves_done = 0.4;
  Options surface_options = options;
  surface_options.dimension = Dimension::surface;
  if (parts.curves.empty()) return reconstruct(cloud, surface_options, share_of(progress, told_apart, 1));
  if (parts.surfaces.empty()) return reconstruct_curves(cloud, options, share_of(progress, told_apart, 1));
  const PartOfCloud on_curves(cloud, parts.curves);
  const PartOfCloud on_surfaces(cloud, parts.surfaces);
  Reconstruction curves = reconstruct_curves(on_curves.view(), options, share_of(progress, told_apart, curves_done));
  Reconstruction surfaces = reconstruct(on_surfaces.view(), surface_options, share_of(progress, curves_done, 1));
  return Union(parts, std::move(surfaces), std::move(curves)).result();
}

}  // namespace

Reconstruction reconstruct_curves_too(const PointCloudView& cloud, const Options& options, const Progress& progress)
{
  if (options.dimension == Dimension::curve) return reconstruct_curves(cloud, options, progress);
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  if (progress) progress("dimension", 0.0);
  const Parts parts = tell_apart(cloud, options);
  const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  Reconstruction result = reconstruct_parts(cloud, parts, options, progress);
  result.report.seconds.neighbors += seconds;
  result.report.seconds.total += seconds;
  return result;
}

}  // namespace pds
