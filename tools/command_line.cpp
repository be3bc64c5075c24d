// SPDX-License-Identifier: BSD-3-Clause
#include "command_line.h"

#include "io/atomic_file.h"
#include "io/file_extension.h"
#include "io/write_mesh.h"
#include "option_table.h"

#include <pcl_pds_recon/reconstruction.h>
#include <pcl_pds_recon/version.h>

#include <algorithm>
#include <boost/algorithm/string/join.hpp>
#include <boost/algorithm/string/replace.hpp>
#include <boost/program_options.hpp>
#include <filesystem>
#include <fstream>

namespace pds
{

namespace
{

namespace po = boost::program_options;

constexpr const char* usage_hint = "; see pcl_pds_recon --help";

po::options_description saved_options()
{
  po::options_description description;
  for (const OptionRow& row : option_table()) {
    if (row.get) {
      description.add_options()(row.name.c_str(), po::value<std::string>());
    }
  }
  return description;
}

po::options_description command_line_options()
{
  po::options_description description;
  for (const OptionRow& row : option_table()) {
    const std::string names = row.letter != 0 ? row.name + "," + row.letter : row.name;
    auto* value = po::value<std::string>();
    description.add_options()(names.c_str(), row.is_switch() ? value->zero_tokens()->implicit_value("true") : value);
  }
  description.add_options()("config", po::value<std::string>())("help,h", "")("version", "");
  description.add_options()("files", po::value<std::vector<std::string>>());
  return description;
}

po::variables_map parse_arguments(int argc, const char* const* argv)
{
  po::positional_options_description positional;
  positional.add("files", -1);
  const int style = po::command_line_style::unix_style & ~po::command_line_style::allow_guessing;
  po::variables_map values;
  const auto description = command_line_options();
  po::store(po::command_line_parser(argc, argv).options(description).positional(positional).style(style).run(), values);
  return values;
}

po::variables_map parse_config(const std::string& path)
{
  std::ifstream stream(path);
  if (!stream || std::filesystem::is_directory(path)) {
    throw UsageError("--config: " + path + ": cannot be read; check the path and its permissions");
  }
  try {
    po::variables_map values;
    po::store(po::parse_config_file(stream, saved_options()), values);
    return values;
  } catch (const po::unknown_option& error) {
    throw UsageError(path + ": unknown option '" + error.get_option_name() + "'" + usage_hint);
  } catch (const po::error& error) {
    throw UsageError(path + ": " + error.what() + usage_hint);
  }
}

void apply(const po::variables_map& values, const std::string& source, CommandLine& command_line)
{
  for (const OptionRow& row : option_table()) {
    if (values.count(row.name) == 0) {
      continue;
    }
    const auto& argument = values[row.name].as<std::string>();
    // An option that is off is saved with an empty file name.
    const bool is_unset_file = !source.empty() && argument.empty();
    if (!is_unset_file && !row.set(command_line, argument)) {
      std::string message = source;
      message.append("--").append(row.name).append(": '").append(argument).append("' does not fit: ");
      throw UsageError(message.append(row.is_switch() ? "true or false" : row.help));
    }
  }
}

/** The library's message starts with the option spelled as a variable: radius_factor for --radius-factor. */
std::string spell_for_command_line(const std::string& message)
{
  std::string name = message.substr(0, message.find_first_not_of("abcdefghijklmnopqrstuvwxyz_"));
  boost::algorithm::replace_all(name, "_", "-");
  const auto& table = option_table();
  const bool is_option =
      std::any_of(table.begin(), table.end(), [&name](const OptionRow& row) { return row.name == name; });
  return is_option ? "--" + name + message.substr(name.size()) : message;
}

void validate_options(const Options& options)
{
  try {
    validate(options);
  } catch (const InvalidOption& error) {
    throw UsageError(spell_for_command_line(error.what()));
  }
}

void check_output_names(const CommandLine& command_line)
{
  const std::vector<std::string> extensions = mesh_extensions();
  const std::string extension = output_extension(command_line);
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

/** A radius factor on the command line also wins over a radius in the configuration file. */
void let_factor_win(const po::variables_map& arguments, CommandLine& command_line)
{
  if (arguments.count("radius-factor") != 0 && arguments.count("radius") == 0) {
    command_line.options.radius = 0;
  }
}

void take_files(const po::variables_map& arguments, CommandLine& command_line)
{
  const auto files =
      arguments.count("files") == 0 ? std::vector<std::string>() : arguments["files"].as<std::vector<std::string>>();
  if (files.size() < 2) {
    throw UsageError("needs an INPUT and an OUTPUT, got " + std::to_string(files.size()) + " file names" + usage_hint);
  }
  command_line.inputs.assign(files.begin(), files.end() - 1);
  command_line.output = files.back();
}

CommandLine interpret(const po::variables_map& arguments)
{
  CommandLine command_line;
  if (arguments.count("help") != 0) {
    command_line.information = help_text();
    return command_line;
  }
  if (arguments.count("version") != 0) {
    command_line.information = "pcl_pds_recon " PCL_PDS_RECON_VERSION "\n";
    return command_line;
  }
  if (arguments.count("quiet") != 0 && arguments.count("verbose") != 0) {
    throw UsageError("-q and -v exclude each other; give one");
  }
  take_options(arguments, command_line);
  check_levels(command_line);
  check_curves(command_line);
  take_files(arguments, command_line);
  check_output_names(command_line);
  check_format_of_curves(command_line);
  check_outputs_of_levels(command_line);
  check_files_differ(command_line);
  return command_line;
}

}  // namespace

std::string output_extension(const CommandLine& command_line)
{
  return command_line.output == standard_stream ? ".ply" : file_extension(command_line.output);
}

void take_options(const po::variables_map& arguments, CommandLine& command_line)
{
  if (arguments.count("config") != 0) {
    const auto& path = arguments["config"].as<std::string>();
    apply(parse_config(path), path + ": ", command_line);
  }
  apply(arguments, "", command_line);
  let_factor_win(arguments, command_line);
  validate_options(command_line.options);
}

std::string level_path(const std::string& output, unsigned level)
{
  if (level == 0) {
    return output;
  }
  std::filesystem::path path(output);
  path.replace_filename(path.stem().string() + "_" + std::to_string(level) + path.extension().string());
  return path.string();
}

CommandLine parse_command_line(int argc, const char* const* argv)
{
  try {
    return interpret(parse_arguments(argc, argv));
  } catch (const po::error& error) {
    throw UsageError(error.what() + std::string(usage_hint));
  }
}

std::string to_config(const CommandLine& command_line)
{
  std::string text = "# pcl_pds_recon " PCL_PDS_RECON_VERSION "\n";
  for (const OptionRow& row : option_table()) {
    if (row.get) {
      const std::string value = row.get(command_line);
      if (value.find_first_of("#\n") != std::string::npos) {
        throw UsageError("--" + row.name + ": '" + value + "' cannot stand in a configuration file; rename it");
      }
      text += row.name + " = " + value + "\n";
    }
  }
  return text;
}

}  // namespace pds
