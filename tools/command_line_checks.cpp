// SPDX-License-Identifier: BSD-3-Clause
#include "command_line_checks.h"

#include "io/atomic_file.h"
#include "io/file_extension.h"
#include "io/write_mesh.h"

#include <pcl_pds_recon/reconstruction.h>

#include <algorithm>
#include <boost/algorithm/string/join.hpp>
#include <filesystem>

namespace pds
{

namespace
{

void check_output_names(const CommandLine& command_line)
{
  const std::vector<std::string> extensions = mesh_extensions();
  const std::string extension = output_extension(command_line);
  if (extension == ".gz") {
    throw UsageError(command_line.output +
                     ": meshes are not compressed; do so behind: pcl_pds_recon scan.ply - | gzip >mesh.ply.gz");
  }
  if (std::find(extensions.begin(), extensions.end(), extension) == extensions.end()) {
    const bool lacks_vtk = extension == ".vtk" || extension == ".vtp";
    throw UsageError(command_line.output + ": cannot write a mesh as '" + extension + "'" +
                     (lacks_vtk ? " in this build without VTK" : "") + "; use " +
                     boost::algorithm::join(extensions, ", "));
  }
  if (!command_line.voronoi_file.empty() && file_extension(command_line.voronoi_file) != ".ply") {
    throw UsageError("--voronoi: " + command_line.voronoi_file + ": is written as PLY; let its name end in .ply");
  }
}

bool are_same_file(const std::string& a, const std::string& b)
{
  namespace fs = std::filesystem;
  std::error_code error;
  return fs::equivalent(a, b, error) ||
         fs::weakly_canonical(fs::absolute(a), error) == fs::weakly_canonical(fs::absolute(b), error);
}

void check_files_differ(const CommandLine& command_line)
{
  std::vector<std::string> files = {command_line.output, command_line.report_file, command_line.html_file,
                                    command_line.voronoi_file, command_line.config_to_save};
  files.insert(files.end(), command_line.inputs.begin(), command_line.inputs.end());
  for (unsigned level = 1; level < command_line.levels; ++level) {
    files.push_back(level_path(command_line.output, level));
  }
  files.erase(std::remove(files.begin(), files.end(), ""), files.end());
  if (command_line.output == standard_stream) {
    files.erase(files.begin());  // not the standard input of the same name
  }
  for (std::size_t i = 0; i < files.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (are_same_file(files[i], files[j])) {
        throw UsageError(files[i] + ": is named twice; name each input once and let outputs have names of their own");
      }
    }
  }
}

/** What is about triangles alone is refused where there may be curves. */
void check_curves(const CommandLine& command_line)
{
  if (command_line.options.dimension == Dimension::surface) {
    return;
  }
  if (command_line.levels > 1) {
    throw UsageError("--levels is for surfaces only; leave it out, or take --dimension 2");
  }
  if (command_line.normals) {
    throw UsageError("--normals: curves have none; leave it out, or take --dimension 2");
  }
  if (!command_line.html_file.empty()) {
    throw UsageError("--html: the page shows surfaces only; leave it out, or take --dimension 2");
  }
}

void check_format_of_curves(const CommandLine& command_line)
{
  const std::string extension = output_extension(command_line);
  if (command_line.options.dimension != Dimension::surface && !holds_segments(extension)) {
    throw UsageError(command_line.output + ": '" + extension +
                     "' holds triangles only, no curves; write .ply, or take --dimension 2");
  }
}

void check_levels(const CommandLine& command_line)
{
  if (command_line.levels < 1 || command_line.levels > most_levels) {
    throw UsageError("--levels must be 1 to " + std::to_string(most_levels));
  }
  if (command_line.levels > 1 && command_line.options.relax > 0) {
    throw UsageError("--levels and --relax exclude each other: relaxation would move the vertices of one level only");
  }
}

void check_outputs_of_levels(const CommandLine& command_line)
{
  if (command_line.levels > 1 && command_line.output == standard_stream) {
    throw UsageError("--levels: several meshes cannot go to standard output; name a file as OUTPUT");
  }
}

}  // namespace

void check_combination(const CommandLine& command_line)
{
  check_levels(command_line);
  check_curves(command_line);
}

void check_files(const CommandLine& command_line)
{
  check_output_names(command_line);
  check_format_of_curves(command_line);
  check_outputs_of_levels(command_line);
  check_files_differ(command_line);
}

}  // namespace pds
