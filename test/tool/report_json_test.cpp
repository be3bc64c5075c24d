// SPDX-License-Identifier: BSD-3-Clause
#include "report_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

namespace pds
{
namespace
{

std::string keys(const nlohmann::ordered_json& json)
{
  std::string text;
  for (const auto& item : json.items()) {
    text += item.key() + " ";
  }
  return text;
}

TEST(ReportJson, has_the_promised_keys)
{
  const auto json = nlohmann::ordered_json::parse(to_json(Report()));
  EXPECT_EQ(
      keys(json),
      "input_points valid_points k sampling_interval radius seeds vertices faces edges components segments "
      "curves closed_curves curve_radius boundary_loops "
      "nonmanifold_edges nonmanifold_vertices inconsistent_edges euler closed orientable filled_holes p99_distance "
      "merged_points outliers thinned_points smoothed min_seed_distance coverage_radius threads seconds "
      "peak_rss_bytes stage_peak_rss_bytes version ");
  EXPECT_EQ(keys(json["seconds"]),
            "load neighbors weights sampling voronoi seed_graph faces holes orientation placement save total ");
}

TEST(ReportJson, keeps_values)
{
  Report report;
  report.euler = -2;
  report.closed = true;
  report.radius = 0.1;
  report.seconds.seed_graph = 0.25;
  report.stage_peaks = {{"neighbors", 100}, {"sampling", 200}};
  report.version = "1.2.3";
  const auto json = nlohmann::json::parse(to_json(report));
  EXPECT_EQ(json["euler"], -2);
  EXPECT_EQ(json["closed"], true);
  EXPECT_EQ(json["radius"], 0.1);
  EXPECT_EQ(json["seconds"]["seed_graph"], 0.25);
  EXPECT_EQ(json["stage_peak_rss_bytes"]["sampling"], 200);
  EXPECT_EQ(json["version"], "1.2.3");
}

}  // namespace
}  // namespace pds
