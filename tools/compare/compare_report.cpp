// SPDX-License-Identifier: BSD-3-Clause
#include "compare/compare_report.h"

#include <pcl_pds_recon/version.h>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace pds
{

namespace
{

using Json = nlohmann::ordered_json;

Json distribution_json(const Distribution& values, double unit = 1)
{
  return {{"mean", values.mean / unit}, {"rms", values.rms / unit}, {"median", values.median / unit},
          {"p95", values.p95 / unit},   {"p99", values.p99 / unit}, {"max", values.max / unit}};
}

template <typename Value>
Json optional_json(const std::optional<Value>& value)
{
  return value ? Json(*value) : Json(nullptr);
}

Json certificate_json(const CompareReport& report)
{
  const MeshInspection& c = report.certificate;
  return {{"vertices", c.vertices},
          {"faces", c.faces},
          {"edges", c.edges},
          {"components", c.components},
          {"boundary_edges", c.boundary_edges},
          {"boundary_loops", c.boundary_loops},
          {"nonmanifold_edges", c.nonmanifold_edges},
          {"nonmanifold_vertices", c.nonmanifold_vertices},
          {"inconsistent_edges", c.inconsistent_edges},
          {"euler", c.euler},
          {"closed", c.closed},
          {"orientable", c.orientable},
          {"genus", optional_json(c.genus)},
          {"duplicate_faces", c.duplicate_faces},
          {"degenerate_faces", c.degenerate_faces},
          {"unreferenced_vertices", c.unreferenced_vertices},
          {"self_intersections", optional_json(report.self_intersections)}};
}

std::string row(const std::string& name, const Distribution& values, double unit = 1)
{
  return fmt::format("{:<20}{:>12.5g}{:>12.5g}{:>12.5g}{:>12.5g}{:>12.5g}{:>12.5g}\n", name, values.mean / unit,
                     values.rms / unit, values.median / unit, values.p95 / unit, values.p99 / unit, values.max / unit);
}

/** \brief Bars of the shares of samples; the first and the last one hold what lies beyond them, too. */
std::string histogram(const Deviation& deviation)
{
  constexpr std::size_t bars = 15;  // odd: the middle one holds what agrees
  constexpr double widest_bar = 50;
  const double reach = deviation.mesh_to_reference.p99;
  if (!(reach > 0)) {
    return "";
  }
  std::array<std::size_t, bars> count{};
  for (const double value : deviation.sample_deviation) {
    const double place = (value + reach) / (2 * reach) * bars;
    ++count[static_cast<std::size_t>(std::clamp(place, 0.0, bars - 0.5))];
  }
  const auto most = static_cast<double>(*std::max_element(count.begin(), count.end()));
  const auto all = static_cast<double>(deviation.sample_deviation.size());
  std::string text = "\nSigned deviation of the mesh, share of its area\n";
  for (std::size_t bar = 0; bar < bars; ++bar) {
    const double center = reach * ((2 * static_cast<double>(bar) + 1) / bars - 1);
    const auto samples = static_cast<double>(count[bar]);
    text += fmt::format("{:>12.3g} {:>6.2f} %  {}\n", std::abs(center) < 1e-9 * reach ? 0 : center, 100 * samples / all,
                        std::string(static_cast<std::size_t>(std::ceil(widest_bar * samples / most)), '#'));
  }
  return text;
}

std::string deviation_text(const Deviation& deviation)
{
  const double diagonal = deviation.diagonal > 0 ? deviation.diagonal : 1;
  std::string text = fmt::format("{:<20}{:>12}{:>12}{:>12}{:>12}{:>12}{:>12}\n", "Distance", "mean", "rms", "median",
                                 "95 %", "99 %", "max");
  text += row("mesh to reference", deviation.mesh_to_reference);
  text += row("  / diagonal", deviation.mesh_to_reference, diagonal);
  text += row("reference to mesh", deviation.reference_to_mesh);
  text += row("  / diagonal", deviation.reference_to_mesh, diagonal);
  if (deviation.normal_deviation) {
    text += row("normals, degrees", *deviation.normal_deviation);
  }
  text += fmt::format("Hausdorff distance {:.5g}, {:.5g} of the diagonal {:.5g}\n", deviation.hausdorff,
                      deviation.hausdorff / diagonal, deviation.diagonal);
  return text + histogram(deviation) + "\n";
}

}  // namespace

Json to_json(const CompareReport& report)
{
  Json json;
  if (report.deviation) {
    const Deviation& deviation = *report.deviation;
    const double diagonal = deviation.diagonal > 0 ? deviation.diagonal : std::nan("");
    json["mesh_to_reference"] = distribution_json(deviation.mesh_to_reference);
    json["reference_to_mesh"] = distribution_json(deviation.reference_to_mesh);
    json["hausdorff"] = deviation.hausdorff;
    json["diagonal"] = deviation.diagonal;
    json["relative"] = {{"mesh_to_reference", distribution_json(deviation.mesh_to_reference, diagonal)},
                        {"reference_to_mesh", distribution_json(deviation.reference_to_mesh, diagonal)},
                        {"hausdorff", deviation.hausdorff / diagonal}};
    const auto& normals = deviation.normal_deviation;
    json["normal_deviation"] = normals ? Json(normals->mean) : Json(nullptr);
    json["normal_deviation_degrees"] = normals ? distribution_json(*normals) : Json(nullptr);
    json["samples"] = deviation.sample_deviation.size();
  }
  json["certificate"] = certificate_json(report);
  json["version"] = PCL_PDS_RECON_VERSION;
  return json;
}

std::string to_text(const CompareReport& report)
{
  std::string text = report.deviation ? deviation_text(*report.deviation) : "";
  text += "Certificate of the mesh\n";
  const Json certificate = certificate_json(report);
  for (const auto& [key, value] : certificate.items()) {
    if (!value.is_null()) {
      text += fmt::format("  {:<24}{}\n", key, value.dump());
    }
  }
  return text;
}

}  // namespace pds
