// SPDX-License-Identifier: BSD-3-Clause
#include "report_json.h"

#include "stage_times.h"

#include <nlohmann/json.hpp>

namespace pds
{

namespace
{

using Json = nlohmann::ordered_json;

Json seconds_json(const StageSeconds& seconds)
{
  Json json;
  for (const auto& [stage, duration] : stage_times(seconds)) {
    json[stage] = duration;
  }
  json["total"] = seconds.total;
  return json;
}

Json peaks_json(const std::vector<StagePeak>& peaks)
{
  Json json = Json::object();
  for (const StagePeak& peak : peaks) {
    json[peak.stage] = peak.rss_bytes;
  }
  return json;
}

}  // namespace

std::string to_json(const Report& report)
{
  const Json json = {{"input_points", report.input_points},
                     {"valid_points", report.valid_points},
                     {"k", report.k},
                     {"sampling_interval", report.sampling_interval},
                     {"radius", report.radius},
                     {"seeds", report.seeds},
                     {"vertices", report.vertices},
                     {"faces", report.faces},
                     {"edges", report.edges},
                     {"components", report.components},
                     {"segments", report.segments},
                     {"curves", report.curves},
                     {"closed_curves", report.closed_curves},
                     {"curve_radius", report.curve_radius},
                     {"boundary_loops", report.boundary_loops},
                     {"nonmanifold_edges", report.nonmanifold_edges},
                     {"nonmanifold_vertices", report.nonmanifold_vertices},
                     {"inconsistent_edges", report.inconsistent_edges},
                     {"euler", report.euler},
                     {"closed", report.closed},
                     {"orientable", report.orientable},
                     {"filled_holes", report.filled_holes},
                     {"p99_distance", report.p99_distance},
                     {"merged_points", report.merged_points},
                     {"outliers", report.outliers},
                     {"thinned_points", report.thinned_points},
                     {"smoothed", report.smoothed},
                     {"min_seed_distance", report.min_seed_distance},
                     {"coverage_radius", report.coverage_radius},
                     {"threads", report.threads},
                     {"seconds", seconds_json(report.seconds)},
                     {"peak_rss_bytes", report.peak_rss_bytes},
                     {"stage_peak_rss_bytes", peaks_json(report.stage_peaks)},
                     {"version", report.version}};
  constexpr int indent = 2;
  return json.dump(indent) + "\n";
}

}  // namespace pds
