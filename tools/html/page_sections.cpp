// SPDX-License-Identifier: BSD-3-Clause
#include "html/page_sections.h"

#include "html/html_text.h"
#include "option_table.h"
#include "stage_times.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

namespace pds
{

namespace
{

using Rows = std::vector<std::pair<std::string, std::string>>;

std::string number(double value) { return fmt::format("{:.4g}", value); }

std::string note_html(const std::string& text) { return "<p class=\"note\">" + escape_html(text) + "</p>"; }

std::string figure_html(const std::string& title, const std::string& content, const std::string& caption)
{
  return "<figure><h3>" + escape_html(title) + "</h3>" + content + "<figcaption>" + escape_html(caption) +
         "</figcaption></figure>";
}

std::string summary_text(const ValueSummary& summary, const std::string& unit)
{
  return fmt::format("mean {1}{0}, median {2}{0}, 95 % up to {3}{0}, least {4}{0}, greatest {5}{0}", unit,
                     number(summary.mean), number(summary.median), number(summary.p95), number(summary.min),
                     number(summary.max));
}

std::string outside_text(const Histogram& histogram)
{
  return histogram.outside == 0 ? "" : "; " + group_digits(histogram.outside) + " beyond this range";
}

constexpr std::size_t bins = 48;

std::string edge_histogram(const ReportPage& page, const Report& report)
{
  const double longest = percentile(page.edge_lengths, 0.999);
  const Histogram histogram = make_histogram(page.edge_lengths, 0, longest > 0 ? longest : 1, bins);
  return figure_html("Edge length", to_svg(histogram, "Histogram of edge lengths", ""),
                     summary_text(summarize(page.edge_lengths), "") + "; Poisson-disk radius " + number(report.radius) +
                         outside_text(histogram));
}

std::string angle_histogram(const ReportPage& page)
{
  constexpr double largest = 60;  // degrees: of an equilateral triangle
  const Histogram histogram = make_histogram(page.smallest_angles, 0, largest, bins);
  return figure_html("Smallest angle of each triangle", to_svg(histogram, "Histogram of smallest angles", "°"),
                     summary_text(summarize(page.smallest_angles), "°"));
}

std::string deviation_histogram(const ReportPage& page, const Report& report)
{
  const std::string title = "Deviation of the points from the mesh";
  if (!page.why_no_deviation.empty()) {
    return "<figure><h3>" + title + "</h3>" + note_html("Not measured: " + page.why_no_deviation + ".") + "</figure>";
  }
  std::vector<double> sizes(page.cloud_deviation.size());
  std::transform(page.cloud_deviation.begin(), page.cloud_deviation.end(), sizes.begin(),
                 [](double deviation) { return std::abs(deviation); });
  const double reach = percentile(sizes, 0.99);
  const Histogram histogram =
      make_histogram(page.cloud_deviation, reach > 0 ? -reach : -1, reach > 0 ? reach : 1, bins + 1);
  const ValueSummary summary = summarize(sizes);
  return figure_html(title, to_svg(histogram, "Histogram of deviations", ""),
                     fmt::format("outside is positive; distance: mean {}, median {}, 95 % up to {}, greatest {}; "
                                 "mean / radius {}{}",
                                 number(summary.mean), number(summary.median), number(summary.p95), number(summary.max),
                                 number(summary.mean / report.radius), outside_text(histogram)));
}

std::string check_html(bool is_good, const std::string& text)
{
  return fmt::format(R"(<li class="{}">{}</li>)", is_good ? "good" : "bad", escape_html(text));
}

}  // namespace

std::string group_digits(std::size_t number)
{
  std::string text = std::to_string(number);
  constexpr std::size_t group = 3;
  for (std::size_t place = text.size(); place > group;) {
    place -= group;
    text.insert(place, ",");
  }
  return text;
}

std::string table_html(const Rows& rows)
{
  std::string html = "<table>";
  for (const auto& [name, value] : rows) {
    html += fmt::format(R"(<tr><th scope="row">{}</th><td>{}</td></tr>)", escape_html(name), escape_html(value));
  }
  return html + "</table>";
}

std::string key_figures_html(const Report& report)
{
  const Rows figures = {{"points", group_digits(report.input_points)},
                        {"vertices", group_digits(report.vertices)},
                        {"triangles", group_digits(report.faces)},
                        {"components", group_digits(report.components)},
                        {"boundary loops", group_digits(report.boundary_loops)},
                        {"seconds", fmt::format("{:.2f}", report.seconds.total)}};
  std::string html;
  for (const auto& [name, value] : figures) {
    html += fmt::format("<div><b>{}</b><span>{}</span></div>", value, name);
  }
  return html;
}

std::string counts_html(const Report& report)
{
  Rows rows = {{"Points given", group_digits(report.input_points)},
               {"with finite coordinates", group_digits(report.valid_points)},
               {"coincident with another", group_digits(report.merged_points)},
               {"outliers left out", group_digits(report.outliers)},
               {"not needed at this radius", group_digits(report.thinned_points)},
               {"Noise smoothed", report.smoothed ? "yes" : "no"},
               {"Neighbours of a point", std::to_string(report.k)},
               {"Sampling interval", number(report.sampling_interval)},
               {"Poisson-disk radius", number(report.radius)},
               {"Poisson-disk samples", group_digits(report.seeds)},
               {"Vertices", group_digits(report.vertices)},
               {"Edges", group_digits(report.edges)},
               {"Triangles", group_digits(report.faces)},
               {"Holes filled", group_digits(report.filled_holes)},
               {"Nearest samples, in radii", number(report.min_seed_distance)},
               {"Farthest point from its sample, in radii", number(report.coverage_radius)}};
  if (report.p99_distance > 0) {
    rows.emplace_back("99 % of the points are as near to the mesh as", number(report.p99_distance));
  }
  rows.emplace_back("Threads", std::to_string(report.threads));
  rows.emplace_back("Peak memory", fmt::format("{:.0f} MB", static_cast<double>(report.peak_rss_bytes) / 1e6));
  return table_html(rows);
}

std::string certificate_html(const Report& report)
{
  const auto counted = [](std::size_t count, const std::string& what) {
    return check_html(count == 0, group_digits(count) + " " + what);
  };
  std::string html = "<ul class=\"checks\">";
  html += counted(report.nonmanifold_edges, "edges of more than two triangles");
  html += counted(report.nonmanifold_vertices, "vertices of more than one fan");
  html += counted(report.inconsistent_edges, "edges whose triangles face opposite sides");
  html += check_html(report.orientable,
                     report.orientable ? "orientable" : "one-sided: the surface was cut to be orientable");
  html += "</ul><p>";
  html += report.closed ? "The surface is closed"
                        : "The surface has " + group_digits(report.boundary_loops) +
                              (report.boundary_loops == 1 ? " boundary loop" : " boundary loops");
  html += fmt::format("; {} {}; Euler characteristic {}", group_digits(report.components),
                      report.components == 1 ? "component" : "components", report.euler);
  // Each boundary loop counts as a disk that is missing.
  const long long closed_euler = report.euler + static_cast<long long>(report.boundary_loops);
  html += fmt::format("; genus {}.</p>", static_cast<long long>(report.components) - closed_euler / 2);
  return html;
}

std::string timings_html(const StageSeconds& seconds)
{
  const auto stages = stage_times(seconds);
  double longest = 0;
  for (const auto& [name, duration] : stages) {
    longest = std::max(longest, duration);
  }
  std::string html = "<table class=\"bars\">";
  for (const auto& [stage, duration] : stages) {
    std::string name = stage == std::string("save") ? "save, and this page" : stage;
    std::replace(name.begin(), name.end(), '_', ' ');
    html += fmt::format(R"(<tr><th scope="row">{}</th><td>{:.3f} s</td><td><i style="width:{:.1f}%"></i></td></tr>)",
                        name, duration, longest > 0 ? 100 * duration / longest : 0);
  }
  return html + fmt::format("<tr><th scope=\"row\">total</th><td>{:.3f} s</td><td></td></tr></table>", seconds.total);
}

std::string parameters_html(const CommandLine& command_line)
{
  Rows rows;
  for (const OptionRow& row : option_table()) {
    const std::string value = row.get ? row.get(command_line) : "";
    if (!value.empty()) {
      rows.emplace_back("--" + row.name, value);
    }
  }
  return table_html(rows);
}

std::string histograms_html(const ReportPage& page, const Report& report)
{
  return edge_histogram(page, report) + angle_histogram(page) + deviation_histogram(page, report);
}

std::string pictures_html(const ReportPage& page)
{
  if (page.pictures.empty()) {
    return note_html("No pictures: " + page.why_no_pictures + ".");
  }
  std::string html;
  for (const PagePicture& picture : page.pictures) {
    const std::string caption = escape_html(picture.caption);
    html +=
        fmt::format(R"(<figure><img alt="{0}" src="data:image/png;base64,{1}"><figcaption>{0}</figcaption></figure>)",
                    caption, to_base64(picture.png));
  }
  return html;
}

std::string viewer_html(const ReportPage& page)
{
  const std::string why = why_nothing_to_turn();
  if (!why.empty()) {
    return note_html("No mesh to turn: " + why + ".");
  }
  const bool is_z_up = page.camera.up == 'z';
  constexpr double zenith = 90;  // degrees; model-viewer counts from there
  return fmt::format(
      R"(<model-viewer id="mesh" alt="The mesh" camera-controls touch-action="pan-y" interaction-prompt="none" )"
      R"(shadow-intensity="0.7" exposure="0.9" tone-mapping="neutral" min-field-of-view="1deg" )"
      R"(orientation="0deg {}deg 0deg" camera-orbit="{}deg {}deg 90%" )"
      R"(src="data:model/gltf-binary;base64,{}"></model-viewer>)"
      R"(<p class="hint">Drag to turn, two fingers or the right button to move, wheel to come closer. )"
      R"(<label>Up is <select id="up"><option{}>y</option><option{}>z</option></select></label></p>)",
      is_z_up ? -90 : 0, page.camera.azimuth, zenith - page.camera.elevation, to_base64(page.glb),
      is_z_up ? "" : " selected", is_z_up ? " selected" : "");
}

}  // namespace pds
