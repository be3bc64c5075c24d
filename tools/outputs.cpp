// SPDX-License-Identifier: BSD-3-Clause
#include "outputs.h"

#include "html/report_page.h"
#include "io/atomic_file.h"
#include "io/cell_means.h"
#include "io/vertex_normals.h"
#include "io/write_mesh.h"
#include "report_json.h"
#include "voronoi_table.h"

#include <spdlog/fmt/fmt.h>

#include <list>
#include <optional>
#include <utility>

namespace pds
{

namespace
{

void write_text(AtomicFile& file, const std::string& text)
{
  file.write(text.data(), text.size());
  file.finish();
}

PointTable make_vertices(const CommandLine& command_line, const PointTable& points, const Reconstruction& result)
{
  PointTable vertices = points.select(result.seeds, result.report.vertices);
  apply_moves(vertices, points, result.moved, Parallel(command_line.options.threads));
  return command_line.normals ? with_vertex_normals(vertices, result.triangles) : std::move(vertices);
}

/** Wide integers are what PLY cannot hold. */
std::string who_can(const std::string& extension) { return extension == ".ply" ? ".vtp can" : "binary .ply can"; }

void warn_of_page(const std::string& path, const ReportPage& page, std::vector<std::string>& warnings)
{
  const std::initializer_list<std::pair<const char*, std::string>> parts = {{"mesh to turn", why_nothing_to_turn()},
                                                                            {"pictures", page.why_no_pictures},
                                                                            {"deviation", page.why_no_deviation}};
  for (const auto& [part, why] : parts) {
    if (!why.empty()) {
      warnings.push_back(fmt::format("{}: has no {}: {}", path, part, why));
    }
  }
}

}  // namespace

void check_outputs(const CommandLine& command_line)
{
  for (unsigned level = 1; level < command_line.levels; ++level) {
    check_writable(level_path(command_line.output, level));
  }
  for (const auto& path : {command_line.output, command_line.report_file, command_line.html_file,
                           command_line.voronoi_file, command_line.config_to_save}) {
    if (!path.empty()) {
      check_writable(path);
    }
  }
}

void save_config(const CommandLine& command_line)
{
  AtomicFile file(command_line.config_to_save);
  write_text(file, to_config(command_line));
  file.commit();
}

std::vector<std::string> save_outputs(const CommandLine& command_line,
                                      const PointTable& points,
                                      std::vector<Reconstruction>& levels,
                                      const std::function<void(Report&)>& complete_report)
{
  Reconstruction& result = levels.front();
  const std::string extension = output_extension(command_line);
  const PointTable vertices = make_vertices(command_line, points, result);
  std::list<AtomicFile> mesh_files;
  for (unsigned level = 0; level < levels.size(); ++level) {
    AtomicFile& file = mesh_files.emplace_back(level_path(command_line.output, level));
    const Reconstruction& mesh = levels[level];
    if (level == 0) {
      write_mesh(file, extension, vertices, mesh.triangles, command_line.ascii, mesh.segments);
    } else {
      write_mesh(file, extension, make_vertices(command_line, points, mesh), mesh.triangles, command_line.ascii);
    }
    file.finish();
  }
  std::optional<AtomicFile> voronoi_file;
  if (!command_line.voronoi_file.empty()) {
    voronoi_file.emplace(command_line.voronoi_file);
    write_ply(*voronoi_file, make_voronoi_table(points, result, Parallel(command_line.options.threads)), {},
              command_line.ascii);
    voronoi_file->finish();
  }
  std::optional<ReportPage> page;
  if (!command_line.html_file.empty()) {
    page = make_report_page(command_line, points, vertices, result);
  }
  complete_report(result.report);
  std::optional<AtomicFile> report_file;
  if (!command_line.report_file.empty()) {
    report_file.emplace(command_line.report_file);
    write_text(*report_file, to_json(result.report));
  }
  std::optional<AtomicFile> page_file;
  if (page) {
    page_file.emplace(command_line.html_file);
    write_text(*page_file, to_html(*page, command_line, result.report));
  }

  for (AtomicFile& file : mesh_files) {
    file.commit();
  }
  for (auto* file : {&voronoi_file, &report_file, &page_file}) {
    if (*file) {
      (*file)->commit();
    }
  }
  std::vector<std::string> warnings;
  if (const std::string lost = lost_in_format(extension, vertices, command_line.ascii); !lost.empty()) {
    warnings.push_back(command_line.output + ": " + extension + " cannot hold " + lost + "; " + who_can(extension));
  }
  if (page) {
    warn_of_page(command_line.html_file, *page, warnings);
  }
  return warnings;
}

}  // namespace pds
