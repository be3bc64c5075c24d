// SPDX-License-Identifier: BSD-3-Clause
#include "compare/compare_options.h"

#include "compare/mesh_file.h"
#include "io/file_extension.h"
#include "io/text_scanner.h"
#include "io/write_mesh.h"
#include "program.h"

#include <pcl_pds_recon/version.h>

#include <algorithm>
#include <boost/algorithm/string/join.hpp>
#include <boost/program_options.hpp>
#include <filesystem>
#include <sstream>

namespace pds
{

namespace
{

namespace po = boost::program_options;

constexpr const char* usage_hint = "; see pcl_pds_compare --help";

po::options_description visible_options()
{
  po::options_description options("Options", 100);
  auto add = options.add_options();
  add("samples,n", po::value<std::string>()->value_name("N"), "samples on each surface (default 400000)");
  add("seed", po::value<std::string>()->value_name("N"), "picks the samples (default 0)");
  add("threads,j", po::value<std::string>()->value_name("N"),
      "worker threads; 0: all cores. No figure depends on it (default 0)");
  add("weld", po::bool_switch(), "let coincident vertices of MESH count as one in the certificate");
  add("self-intersections", po::bool_switch(), "count pairs of faces that intersect, too");
  add("output,o", po::value<std::string>()->value_name("FILE"), "write MESH with its deviation at each vertex");
  add("picture", po::value<std::string>()->value_name("FILE.png"), "draw MESH coloured by its deviation");
  add("json", po::bool_switch(), "print the report as JSON");
  add("expect", po::value<std::vector<std::string>>()->value_name("COND"),
      "'KEY<=NUMBER' (or >= == != < >), KEY of the JSON report with dots; may be repeated");
  add("help,h", "print this help and exit");
  add("version", "print the version and exit");
  return options;
}

std::string help_text()
{
  std::ostringstream text;
  text << "Usage: pcl_pds_compare [OPTION]... MESH [REFERENCE]\n"
          "Measure how far MESH is from REFERENCE, a mesh or a point cloud, and back; certify the topology of MESH.\n\n"
          "MESH and REFERENCE are "
       << boost::algorithm::join(readable_extensions(), " ") << " files.\n\n"
       << visible_options()
       << "\nExamples:\n"
          "  pcl_pds_compare mesh.ply scan.pcd\n"
          "  pcl_pds_compare --json --expect 'hausdorff<=0.01' --expect 'certificate.components==1' mesh.ply ref.ply\n"
          "  pcl_pds_compare --output deviation.ply --picture deviation.png mesh.ply reference.ply\n"
          "\nExit status:\n"
          "  0  done, and every expectation is met\n"
          "  1  a file is at fault; no file was written\n"
          "  2  the command line is at fault\n"
          "  3  an expectation is not met\n";
  return text.str();
}

template <typename Number>
void take_number(const po::variables_map& values, const std::string& name, Number least, Number& number)
{
  if (values.count(name) == 0) {
    return;
  }
  const auto& text = values[name].as<std::string>();
  if (!parse_number(text, number) || number < least) {
    throw UsageError("--" + name + ": '" + text + "' is not a whole number of at least " + std::to_string(least) +
                     usage_hint);
  }
}

void take_file(const po::variables_map& values, const std::string& name, std::string& file)
{
  if (values.count(name) != 0) {
    file = values[name].as<std::string>();
  }
}

bool are_same_file(const std::string& a, const std::string& b)
{
  namespace fs = std::filesystem;
  std::error_code error;
  return fs::equivalent(a, b, error) ||
         fs::weakly_canonical(fs::absolute(a), error) == fs::weakly_canonical(fs::absolute(b), error);
}

void check_outputs(const CompareOptions& options)
{
  std::vector<std::string> holding;  // formats that have room for a field
  for (const std::string& extension : mesh_extensions()) {
    if (extension != ".obj" && extension != ".stl") {
      holding.push_back(extension);
    }
  }
  const std::string extension = file_extension(options.output);
  if (!options.output.empty() && std::find(holding.begin(), holding.end(), extension) == holding.end()) {
    throw UsageError("--output: " + options.output + ": '" + extension + "' cannot hold the deviation; use " +
                     boost::algorithm::join(holding, ", "));
  }
  if (!options.picture.empty() && file_extension(options.picture) != ".png") {
    throw UsageError("--picture: " + options.picture + ": is drawn as PNG; let its name end in .png");
  }
#ifndef PCL_PDS_RECON_WITH_RENDERING
  if (!options.picture.empty()) {
    throw UsageError("--picture: this build cannot draw, because VTK's rendering was not found");
  }
#endif
  const bool has_output = !options.output.empty() || !options.picture.empty();
  if (has_output && options.reference.empty()) {
    throw UsageError(std::string("--output and --picture need a REFERENCE") + usage_hint);
  }
  for (const auto& output : {options.output, options.picture}) {
    for (const auto& other : {options.mesh, options.reference}) {
      if (!output.empty() && are_same_file(output, other)) {
        throw UsageError(output + ": is an input and would be overwritten; choose another name for the output");
      }
    }
  }
}

CompareOptions interpret(const po::variables_map& values)
{
  CompareOptions options;
  if (values.count("help") != 0) {
    options.information = help_text();
    return options;
  }
  if (values.count("version") != 0) {
    options.information = "pcl_pds_compare " PCL_PDS_RECON_VERSION "\n";
    return options;
  }
  take_number<std::size_t>(values, "samples", 1, options.deviation.samples);
  take_number<std::uint64_t>(values, "seed", 0, options.deviation.seed);
  take_number<unsigned>(values, "threads", 0, options.deviation.threads);
  options.weld = values["weld"].as<bool>();
  options.self_intersections = values["self-intersections"].as<bool>();
  options.json = values["json"].as<bool>();
  take_file(values, "output", options.output);
  take_file(values, "picture", options.picture);
  if (values.count("expect") != 0) {
    for (const std::string& text : values["expect"].as<std::vector<std::string>>()) {
      options.expectations.push_back(parse_expectation(text));
    }
  }
  const auto files =
      values.count("files") == 0 ? std::vector<std::string>() : values["files"].as<std::vector<std::string>>();
  if (files.empty() || files.size() > 2) {
    throw UsageError("needs one MESH and one REFERENCE, or one MESH alone, got " + std::to_string(files.size()) +
                     " file names" + usage_hint);
  }
  options.mesh = files[0];
  options.reference = files.size() == 2 ? files[1] : "";
  check_outputs(options);
  return options;
}

}  // namespace

CompareOptions parse_compare_options(int argc, const char* const* argv)
{
  try {
    po::options_description all = visible_options();
    all.add_options()("files", po::value<std::vector<std::string>>());
    po::positional_options_description positional;
    positional.add("files", -1);
    const int style = po::command_line_style::unix_style & ~po::command_line_style::allow_guessing;
    po::variables_map values;
    po::store(po::command_line_parser(argc, argv).options(all).positional(positional).style(style).run(), values);
    return interpret(values);
  } catch (const po::error& error) {
    throw UsageError(error.what() + std::string(usage_hint));
  }
}

}  // namespace pds
