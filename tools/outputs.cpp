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

/** Files that appear together, when all of them are complete. */
class OutputFiles
{
 public:
  /** \param write puts the content into the file */
  template <typename Write>
  void add(const std::string& path, const Write& write)
  {
    AtomicFile& file = files_.emplace_back(path);
    write(file);
    file.finish();
  }

  void add_text(const std::string& path, const std::string& text)
  {
    add(path, [&text](AtomicFile& file) { file.write(text.data(), text.size()); });
  }

  void commit()
  {
    for (AtomicFile& file : files_) {
      file.commit();
    }
  }

 private:
  std::list<AtomicFile> files_;
};

PointTable make_vertices(const CommandLine& command_line, const PointTable& points, const Reconstruction& result)
{
  PointTable vertices = points.select(result.seeds, result.report.vertices);
  apply_moves(vertices, points, result.moved, Parallel(command_line.options.threads));
  return command_line.normals ? with_vertex_normals(vertices, result.triangles) : std::move(vertices);
}

void add_meshes(const CommandLine& command_line,
                const PointTable& points,
                const PointTable& vertices,
                const std::vector<Reconstruction>& levels,
                OutputFiles& files)
{
  const std::string extension = output_extension(command_line);
  for (unsigned level = 0; level < levels.size(); ++level) {
    const Reconstruction& mesh = levels[level];
    files.add(level_path(command_line.output, level), [&](AtomicFile& file) {
      if (level == 0) {
        write_mesh(file, extension, vertices, mesh.triangles, command_line.ascii, mesh.segments);
      } else {
        write_mesh(file, extension, make_vertices(command_line, points, mesh), mesh.triangles, command_line.ascii);
      }
    });
  }
}

void warn_of_losses(const CommandLine& command_line, const PointTable& vertices, std::vector<std::string>& warnings)
{
  const std::string extension = output_extension(command_line);
  if (const std::string lost = lost_in_format(extension, vertices, command_line.ascii); !lost.empty()) {
    const char* who_can = extension == ".ply" ? ".vtp can" : "binary .ply can";  // but for wide integers
    warnings.push_back(command_line.output + ": " + extension + " cannot hold " + lost + "; " + who_can);
  }
}

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
  OutputFiles files;
  files.add_text(command_line.config_to_save, to_config(command_line));
  files.commit();
}

std::vector<std::string> save_outputs(const CommandLine& command_line,
                                      const PointTable& points,
                                      std::vector<Reconstruction>& levels,
                                      const std::function<void(Report&)>& complete_report)
{
  Reconstruction& result = levels.front();
  const PointTable vertices = make_vertices(command_line, points, result);
  OutputFiles files;
  add_meshes(command_line, points, vertices, levels, files);
  if (!command_line.voronoi_file.empty()) {
    files.add(command_line.voronoi_file, [&](AtomicFile& file) {
      write_ply(file, make_voronoi_table(points, result, Parallel(command_line.options.threads)), {},
                command_line.ascii);
    });
  }
  std::optional<ReportPage> page;
  if (!command_line.html_file.empty()) {
    page = make_report_page(command_line, points, vertices, result);
  }
  complete_report(result.report);
  if (!command_line.report_file.empty()) {
    files.add_text(command_line.report_file, to_json(result.report));
  }
  if (page) {
    files.add_text(command_line.html_file, to_html(*page, command_line, result.report));
  }
  files.commit();

  std::vector<std::string> warnings;
  warn_of_losses(command_line, vertices, warnings);
  if (page) {
    warn_of_page(command_line.html_file, *page, warnings);
  }
  return warnings;
}

}  // namespace pds
