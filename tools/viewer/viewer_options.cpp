// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/viewer_options.h"

#include "io/file_extension.h"
#include "option_table.h"
#include "viewer/keys.h"

#include <pcl_pds_recon/version.h>

#include <algorithm>
#include <boost/algorithm/string/classification.hpp>
#include <boost/algorithm/string/split.hpp>
#include <boost/program_options.hpp>
#include <cmath>
#include <sstream>

namespace pds
{

namespace
{

namespace po = boost::program_options;

constexpr const char* usage_hint = "; see pcl_pds_viewer --help";

/** \brief Texts that the parser fills in before they are understood. */
struct Texts
{
  std::string layers;
  std::string shading;
  std::string colors;
  std::string size;
  std::string camera;
};

/** \brief Options of the command tool that are about its outputs and messages, which the viewer has not. */
bool concerns_viewer(const OptionRow& row)
{
  constexpr std::array<const char*, 9> others = {"normals", "ascii",       "levels", "report", "html",
                                                 "voronoi", "save-config", "quiet",  "verbose"};
  return std::none_of(others.begin(), others.end(), [&row](const char* name) { return row.name == name; });
}

std::string layer_list()
{
  std::string text;
  for (const LayerName& layer : layer_names) {
    text += std::string(text.empty() ? "" : " ") + layer.name;
  }
  return text;
}

po::options_description visible_options(ViewerOptions& options, Texts& texts)
{
  po::options_description description("Options", 100);
  auto add = description.add_options();
  add("show", po::value(&texts.layers)->value_name("LAYER,..."), ("what is shown first: " + layer_list()).c_str());
  add("reference", po::value(&options.reference)->value_name("FILE"), "a mesh or cloud to show the deviation from");
  add("points", po::bool_switch(&options.points_only), "take the vertices of meshes as clouds");
  add("shading", po::value(&texts.shading)->value_name("NAME"), "smooth (default), flat or wireframe");
  add("colors", po::value(&texts.colors)->value_name("NAME"),
      "of cloud and mesh: scan (default), those of the scan if it has any, or plain, one each");
  add("screenshot", po::value(&options.screenshot)->value_name("FILE.png"), "write a picture instead of a window");
  add("frames", po::value(&options.frames)->value_name("N"), "turn the camera N times and print the frames per second");
  add("size", po::value(&texts.size)->value_name("WxH"), "of the window or picture in pixels (default 1200x900)");
  add("camera", po::value(&texts.camera)->value_name("AZ,EL,ZOOM[,z]"),
      "degrees around and above, magnification (default 0,0,1.4); z: that axis points up; or the ten numbers that the "
      "key K prints");
  for (const OptionRow& row : option_table()) {
    if (concerns_viewer(row)) {
      const std::string names = row.letter != 0 ? row.name + "," + row.letter : row.name;
      auto* value = po::value<std::string>()->value_name(row.argument);
      add(names.c_str(), row.is_switch() ? value->zero_tokens()->implicit_value("true") : value, row.help.c_str());
    }
  }
  add("config", po::value<std::string>()->value_name("FILE.ini"), "read options of pcl_pds_recon from a file");
  add("help,h", "print this help and exit");
  add("version", "print the version and exit");
  return description;
}

std::string help_text(const po::options_description& options)
{
  std::ostringstream text;
  text << "Usage: pcl_pds_viewer [OPTION]... CLOUD_OR_MESH...\n"
          "Show meshes, or a point cloud and its reconstruction, step by step.\n\n"
          "Several clouds are merged; several meshes lie beside each other, or with a cloud where they are.\n\n"
       << options << "\nKeys in the window:\n"
       << key_help()
       << "\nExamples:\n"
          "  pcl_pds_viewer -a 0.25 scan.pcd\n"
          "  pcl_pds_viewer --show deviation --reference reference.ply mesh.ply\n"
          "  pcl_pds_viewer --show cloud,mesh scan1.pcd scan2.pcd mesh.ply\n"
          "  pcl_pds_viewer --show cells,seeds --screenshot cells.png --size 800x600 scan.ply\n"
          "\nExit status:\n"
          "  0  done\n"
          "  1  a file or the display is at fault\n"
          "  2  the command line is at fault\n";
  return text.str();
}

std::vector<Layer> parse_layers(const std::string& text)
{
  std::vector<std::string> names;
  boost::algorithm::split(names, text, boost::algorithm::is_any_of(","));
  std::vector<Layer> layers;
  for (const std::string& name : names) {
    const auto* known = std::find_if(layer_names.begin(), layer_names.end(),
                                     [&name](const LayerName& layer) { return name == layer.name; });
    if (known == layer_names.end()) {
      throw UsageError("--show: there is no layer '" + name + "'; use " + layer_list());
    }
    layers.push_back(known->layer);
  }
  return layers;
}

Shading parse_shading(const std::string& text)
{
  if (text == "flat") {
    return Shading::flat;
  }
  if (text == "wireframe") {
    return Shading::wireframe;
  }
  if (text != "smooth") {
    throw UsageError("--shading: '" + text + "' is not smooth, flat or wireframe");
  }
  return Shading::smooth;
}

bool parse_colors(const std::string& text)
{
  if (text != "scan" && text != "plain") {
    throw UsageError("--colors: '" + text + "' is not scan or plain");
  }
  return text == "scan";
}

void parse_size(const std::string& text, ViewerOptions& options)
{
  constexpr int least = 16;
  constexpr int most = 8192;
  std::istringstream stream(text);
  char by = 0;
  if (!(stream >> options.width >> by >> options.height) || by != 'x' || stream.peek() != EOF ||
      std::min(options.width, options.height) < least || std::max(options.width, options.height) > most) {
    throw UsageError("--size: '" + text + "' is not WxH with 16 ... 8192 pixels each");
  }
}

void parse_camera(const std::string& text, ViewerOptions& options)
{
  options.pose = parse_pose(text);
  if (options.pose) {
    return;
  }
  CameraPlace& camera = options.camera;
  std::istringstream stream(text);
  char comma[2] = {0, 0};
  const bool understood = stream >> camera.azimuth >> comma[0] >> camera.elevation >> comma[1] >> camera.zoom &&
                          comma[0] == ',' && comma[1] == ',' && camera.zoom > 0 && std::abs(camera.elevation) < 90;
  std::string rest;
  stream >> rest;
  if (!understood || !(rest.empty() || rest == ",y" || rest == ",z")) {
    throw UsageError("--camera: '" + text +
                     "' is not AZ,EL,ZOOM or AZ,EL,ZOOM,z with -90 < EL < 90 and a positive ZOOM, nor the ten "
                     "numbers that the key K prints");
  }
  camera.up = rest == ",z" ? 'z' : 'y';
}

void understand(const Texts& texts, ViewerOptions& options)
{
  if (!texts.layers.empty()) {
    options.layers = parse_layers(texts.layers);
  }
  if (!texts.shading.empty()) {
    options.shading = parse_shading(texts.shading);
  }
  if (!texts.colors.empty()) {
    options.scan_colors = parse_colors(texts.colors);
  }
  if (!texts.size.empty()) {
    parse_size(texts.size, options);
  }
  if (!texts.camera.empty()) {
    parse_camera(texts.camera, options);
  }
  if (!options.screenshot.empty() && file_extension(options.screenshot) != ".png") {
    throw UsageError("--screenshot: " + options.screenshot + ": is written as PNG; let its name end in .png");
  }
  if (options.frames < 0) {
    throw UsageError("--frames must not be negative");
  }
  if (options.inputs.empty()) {
    throw UsageError(std::string("needs a CLOUD_OR_MESH") + usage_hint);
  }
}

}  // namespace

ViewerOptions parse_viewer_options(int argc, const char* const* argv)
{
  ViewerOptions options;
  Texts texts;
  const po::options_description visible = visible_options(options, texts);
  po::options_description all;
  all.add(visible).add_options()("files", po::value(&options.inputs));
  po::positional_options_description positional;
  positional.add("files", -1);
  const int style = po::command_line_style::unix_style & ~po::command_line_style::allow_guessing;
  try {
    po::variables_map values;
    po::store(po::command_line_parser(argc, argv).options(all).positional(positional).style(style).run(), values);
    po::notify(values);
    if (values.count("help") != 0) {
      options.information = help_text(visible);
      return options;
    }
    if (values.count("version") != 0) {
      options.information = "pcl_pds_viewer " PCL_PDS_RECON_VERSION "\n";
      return options;
    }
    take_options(values, options.tool);
    understand(texts, options);
  } catch (const po::error& error) {
    throw UsageError(error.what() + std::string(usage_hint));
  }
  return options;
}

}  // namespace pds
