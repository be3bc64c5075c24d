// SPDX-License-Identifier: BSD-3-Clause
// The command tool: reads a point cloud, reconstructs its surface, writes the mesh.
#include "command_line.h"
#include "input.h"
#include "no_mesh.h"
#include "option_table.h"
#include "outputs.h"
#include "program.h"
#include "progress.h"
#include "stage_times.h"

#include <pcl_pds_recon/reconstruction.h>

#include <spdlog/fmt/fmt.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <iostream>
#include <string>
#include <vector>

namespace pds
{

namespace
{

// Parts of the run before and after the reconstruction, for the progress bar; a guess that suits binary files.
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

std::vector<Reconstruction> reconstruct_table(const PointTable& points,
                                              const CommandLine& command_line,
                                              ProgressReporter& progress)
{
  const auto on_stage = [&progress](const char* stage, double fraction) {
    progress.start_stage(stage, load_share + fraction * (1 - load_share - save_share));
  };
  try {
    std::vector<Reconstruction> levels =
        reconstruct_levels(points.view(), command_line.options, command_line.levels, on_stage);
    for (const Reconstruction& level : levels) {
      if (level.triangles.empty() && level.segments.empty()) {
        throw InvalidInput(why_no_mesh(points, level.report, command_line.options.dimension));
      }
    }
    return levels;
  } catch (const InvalidInput& error) {
    throw InvalidInput(input_name(command_line) + ": " + error.what());
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

/** \brief What was made; with curves, how many there are, so that it shows what each part was taken for. */
std::string summary(const Report& report, Dimension dimension)
{
  if (dimension == Dimension::surface) {
    return fmt::format("{} vertices, {} faces, {} components, {} boundary loops", report.vertices, report.faces,
                       report.components, report.boundary_loops);
  }
  return fmt::format("{} vertices; curves: {} ({} closed), {} segments; surfaces: {}, {} faces, {} boundary loops",
                     report.vertices, report.curves, report.closed_curves, report.segments,
                     report.components - report.curves, report.faces, report.boundary_loops);
}

/** \brief Counts points whose vertex is in no face. */
std::size_t points_beside_mesh(const Reconstruction& level)
{
  const std::vector<std::uint32_t>& labels = level.voronoi.label;
  return static_cast<std::size_t>(std::count_if(labels.begin(), labels.end(), [&](std::uint32_t label) {
    return label != no_label && label >= level.report.vertices;
  }));
}

void print_summary(const Reconstruction& level, Dimension dimension, ProgressReporter& progress)
{
  constexpr std::size_t least_share = 100;  // one in so many; less is usual, at rims
  const Report& report = level.report;
  for (const auto& [stage, duration] : stage_times(report.seconds)) {
    progress.detail(fmt::format("{}: {:.3f} s", stage, duration));
  }
  if (report.outliers > 0) {
    progress.info(fmt::format("{} outliers left out", report.outliers));
  }
  if (const std::size_t beside = points_beside_mesh(level); beside * least_share > report.valid_points) {
    progress.info(fmt::format(
        "{} of {} points are on no face: on parts smaller than the radius, too far apart for it, or scattered", beside,
        report.valid_points));
  }
  progress.info(fmt::format("{}; {:.2f} s", summary(report, dimension), report.seconds.total));
}

void run(const CommandLine& command_line)
{
  const Stopwatch since_start;
  check_outputs(command_line);
  if (!command_line.config_to_save.empty()) {
    save_config(command_line);
  }
  ProgressReporter progress(command_line.verbosity);
  print_options(command_line, progress);

  progress.start_stage("load", 0);
  std::vector<std::string> warnings;
  const PointTable points = load_points(command_line, warnings);
  const double load_seconds = since_start.seconds();
  const std::size_t load_peak = peak_rss_bytes();

  std::vector<Reconstruction> levels = reconstruct_table(points, command_line, progress);

  progress.start_stage("save", 1 - save_share);
  const Stopwatch since_save;
  const std::vector<std::string> losses = save_outputs(command_line, points, levels, [&](Report& report) {
    report.seconds.load = load_seconds;
    report.seconds.save = since_save.seconds();
    report.seconds.total = since_start.seconds();
    report.peak_rss_bytes = peak_rss_bytes();
    report.stage_peaks.insert(report.stage_peaks.begin(), {"load", load_peak});
    report.stage_peaks.push_back({"save", report.peak_rss_bytes});
  });
  warnings.insert(warnings.end(), losses.begin(), losses.end());
  progress.finish();
  for (const std::string& warning : warnings) {
    if (!warning.empty()) {
      progress.warn(warning);
    }
  }
  for (const Reconstruction& level : levels) {
    print_summary(level, command_line.options.dimension, progress);
  }
}

}  // namespace

}  // namespace pds

int main(int argc, char** argv)
{
  return pds::run_program("pcl_pds_recon", [argc, argv] {
    const pds::CommandLine command_line = pds::parse_command_line(argc, argv);
    if (command_line.information.empty()) {
      pds::run(command_line);
    } else {
      std::cout << command_line.information;
    }
    return 0;
  });
}
