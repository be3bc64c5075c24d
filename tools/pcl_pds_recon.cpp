// SPDX-License-Identifier: BSD-3-Clause
// The command tool: reads a point cloud, reconstructs its surface, writes the mesh.
#include "command_line.h"
#include "io/atomic_file.h"
#include "io/file_extension.h"
#include "io/read_points.h"
#include "io/write_mesh.h"
#include "option_table.h"
#include "progress.h"
#include "report_json.h"
#include "voronoi_table.h"

#include <pcl_pds_recon/reconstruction.h>

#include <sys/resource.h>

#include <chrono>
#include <iostream>
#include <new>
#include <optional>

namespace pds
{

namespace
{

// Shares of the run for the progress bar, measured on the Dragon.
constexpr double load_share = 0.05;
constexpr double save_share = 0.05;

class Stopwatch
{
 public:
  [[nodiscard]] double seconds() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

std::size_t peak_rss_bytes()
{
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;  // Linux counts in KiB
}

void write_text(AtomicFile& file, const std::string& text)
{
  file.write(text.data(), text.size());
}

void save_config(const CommandLine& command_line)
{
  AtomicFile file(command_line.config_to_save);
  write_text(file, to_config(command_line));
  file.finish();
  file.commit();
}

/** Before the work and not after it. */
void check_outputs(const CommandLine& command_line)
{
  for (const auto& path :
       {command_line.output, command_line.report_file, command_line.voronoi_file, command_line.config_to_save}) {
    if (!path.empty()) {
      check_writable(path);
    }
  }
}

Reconstruction reconstruct_table(const PointTable& points, const CommandLine& command_line, ProgressReporter& progress)
{
  const auto on_stage = [&progress](const char* stage, double fraction) {
    progress.start_stage(stage, load_share + fraction * (1 - load_share - save_share));
  };
  try {
    Reconstruction result = reconstruct(points.view(), command_line.options, on_stage);
    if (result.triangles.empty()) {
      throw InvalidInput(
          "no faces came out of " + std::to_string(result.report.valid_points) + " valid points with radius " +
          std::to_string(result.report.radius) +
          ": too few points for this radius, or all on a line; use a smaller -f or -r, or a denser cloud");
    }
    return result;
  } catch (const InvalidInput& error) {
    throw InvalidInput(command_line.input + ": " + error.what());
  }
}

/** Writes all files under temporary names, then gives them theirs: either all appear or none. */
void save(const CommandLine& command_line,
          const PointTable& points,
          Reconstruction& result,
          const Stopwatch& since_start,
          ProgressReporter& progress)
{
  const Stopwatch since_save;
  const std::string extension = file_extension(command_line.output);
  const PointTable vertices = points.select(result.seeds, result.report.vertices);
  const std::string lost = lost_in_format(extension, vertices, command_line.ascii);
  if (!lost.empty()) {
    progress.warn(command_line.output + ": the format " + extension + " cannot hold " + lost + "; .ply can");
  }

  AtomicFile mesh_file(command_line.output);
  write_mesh(mesh_file, extension, vertices, result.triangles, command_line.ascii);
  mesh_file.finish();
  std::optional<AtomicFile> voronoi_file;
  if (!command_line.voronoi_file.empty()) {
    voronoi_file.emplace(command_line.voronoi_file);
    write_ply(*voronoi_file, make_voronoi_table(points, result), {}, command_line.ascii);
    voronoi_file->finish();
  }
  result.report.seconds.save = since_save.seconds();
  result.report.seconds.total = since_start.seconds();
  result.report.peak_rss_bytes = peak_rss_bytes();
  std::optional<AtomicFile> report_file;
  if (!command_line.report_file.empty()) {
    report_file.emplace(command_line.report_file);
    write_text(*report_file, to_json(result.report));
    report_file->finish();
  }

  mesh_file.commit();
  for (auto* file : {&voronoi_file, &report_file}) {
    if (*file) {
      (*file)->commit();
    }
  }
}

void print_options(const CommandLine& command_line, ProgressReporter& progress)
{
  for (const OptionRow& row : option_table()) {
    if (row.get) {
      progress.detail(row.name + " = " + row.get(command_line));
    }
  }
}

void print_summary(const Report& report, ProgressReporter& progress)
{
  const StageSeconds& s = report.seconds;
  for (const auto& [stage, seconds] :
       std::initializer_list<std::pair<const char*, double>>{{"load", s.load},
                                                             {"neighbors", s.neighbors},
                                                             {"weights", s.weights},
                                                             {"sampling", s.sampling},
                                                             {"voronoi", s.voronoi},
                                                             {"seed graph", s.seed_graph},
                                                             {"faces", s.faces},
                                                             {"holes", s.holes},
                                                             {"orientation", s.orientation},
                                                             {"save", s.save}}) {
    progress.detail(std::string(stage) + ": " + std::to_string(seconds) + " s");
  }
  progress.info(std::to_string(report.vertices) + " vertices, " + std::to_string(report.faces) + " faces, " +
                std::to_string(report.components) + " components, " + std::to_string(report.boundary_loops) +
                " boundary loops; " + std::to_string(report.seconds.total) + " s");
}

void run(const CommandLine& command_line, const Stopwatch& since_start)
{
  check_outputs(command_line);
  if (!command_line.config_to_save.empty()) {
    save_config(command_line);
  }
  ProgressReporter progress(command_line.verbosity);
  print_options(command_line, progress);

  progress.start_stage("load", 0);
  const Stopwatch since_load;
  const PointTable points = read_points(command_line.input);
  const double load_seconds = since_load.seconds();

  Reconstruction result = reconstruct_table(points, command_line, progress);
  result.report.seconds.load = load_seconds;

  progress.start_stage("save", 1 - save_share);
  save(command_line, points, result, since_start, progress);
  progress.finish();
  print_summary(result.report, progress);
}

constexpr int exit_bad_data = 1;
constexpr int exit_bad_usage = 2;

int fail(int status, const std::string& message)
{
  std::cerr << "pcl_pds_recon: " << message << std::endl;
  return status;
}

int guarded_main(int argc, const char* const* argv)
{
  const Stopwatch since_start;
  try {
    const CommandLine command_line = parse_command_line(argc, argv);
    if (!command_line.information.empty()) {
      std::cout << command_line.information;
      return 0;
    }
    run(command_line, since_start);
    return 0;
  } catch (const UsageError& error) {
    return fail(exit_bad_usage, error.what());
  } catch (const std::bad_alloc&) {
    return fail(exit_bad_data, "not enough memory for this cloud; thin it out or use a larger machine");
  } catch (const std::exception& error) {
    return fail(exit_bad_data, error.what());
  }
}

}  // namespace

}  // namespace pds

int main(int argc, char** argv)
{
  return pds::guarded_main(argc, argv);
}
