// SPDX-License-Identifier: BSD-3-Clause
#include "html/assets.h"
#include "html/html_text.h"
#include "html/page_sections.h"
#include "html/report_page.h"
#include "io/atomic_file.h"

#include <boost/algorithm/string/join.hpp>
#include <ctime>
#include <filesystem>

namespace pds
{

namespace
{

std::string name_of(const std::string& path, const char* stream)
{
  return path == standard_stream ? stream : std::filesystem::path(path).filename().string();
}

std::string input_names(const CommandLine& command_line)
{
  std::vector<std::string> names;
  for (const std::string& path : command_line.inputs) {
    names.push_back(name_of(path, "standard input"));
  }
  return boost::algorithm::join(names, ", ");
}

std::string today()
{
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[32];
  return std::string(text, std::strftime(text, sizeof text, "%Y-%m-%d %H:%M UTC", &utc));
}

constexpr const char* credit =
    "The mesh is turned by model-viewer (Google LLC and others, Apache License 2.0), which is part of this page; "
    "nothing "
    "is loaded from elsewhere.";

/** Without the pointer to a file of the package, which browsers' tools would look for beside the page. */
std::string script_html(std::string_view script)
{
  return "<script>" + std::string(script.substr(0, script.rfind("//# sourceMappingURL"))) + "</script>";
}

}  // namespace

std::string why_nothing_to_turn()
{
  return model_viewer_script().empty()
             ? "this build is without model-viewer; configure it again where npm and a network are there, or as its "
               "CMake summary says"
             : "";
}

std::string to_html(const ReportPage& page, const CommandLine& command_line, const Report& report)
{
  return fill_template(page_template(),
                       {{"title", escape_html(name_of(command_line.output, "standard output"))},
                        {"inputs", escape_html(input_names(command_line))},
                        {"version", escape_html(report.version)},
                        {"date", today()},
                        {"key_figures", key_figures_html(report)},
                        {"viewer", viewer_html(page)},
                        {"pictures", pictures_html(page)},
                        {"certificate", certificate_html(report)},
                        {"counts", counts_html(report)},
                        {"histograms", histograms_html(page, report)},
                        {"timings", timings_html(report.seconds)},
                        {"parameters", parameters_html(command_line)},
                        {"credit", model_viewer_script().empty() ? "" : credit},
                        {"script", model_viewer_script().empty() ? "" : script_html(model_viewer_script())}});
}

}  // namespace pds
