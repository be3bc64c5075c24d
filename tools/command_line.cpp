// SPDX-License-Identifier: BSD-3-Clause
#include "command_line.h"

#include "command_line_checks.h"
#include "io/atomic_file.h"
#include "io/file_extension.h"
#include "option_table.h"

#include <pcl_pds_recon/reconstruction.h>
#include <pcl_pds_recon/version.h>

#include <algorithm>
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

/** What the library does not say of -q3: a letter that takes no value has one. */
std::string why_unknown(const std::string& word)
{
  const auto& table = option_table();
  const bool is_switch_and_more =
      word.size() > 2 && std::any_of(table.begin(), table.end(), [&word](const OptionRow& row) {
        return row.is_switch() && row.letter != 0 && word[0] == '-' && word[1] == row.letter;
      });
  return is_switch_and_more ? ": " + word.substr(0, 2) + " takes no value; only letters of other options may follow it"
                            : "";
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
  check_combination(command_line);
  take_files(arguments, command_line);
  check_files(command_line);
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
  } catch (const po::unknown_option& error) {
    throw UsageError(error.what() + why_unknown(error.get_option_name()) + usage_hint);
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
