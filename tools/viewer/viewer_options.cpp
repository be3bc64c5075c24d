// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/viewer_options.h"

#include "io/file_extension.h"
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
  std::string size;
  std::string camera;
};

po::options_description visible_options(ViewerOptions& options, Texts& texts)
{
  Options& reconstruction = options.reconstruction;
  po::options_description description("Options", 100);
  auto add = description.add_options();
  add("show", po::value(&texts.layers)->value_name("LAYER,..."),
      "what is shown first: cloud seeds disks cells witnesses mesh edges loops normals deviation");
  add("points", po::bool_switch(&options.points_only), "take the vertices of a mesh as a cloud");
  add("flat", po::bool_switch(&options.flat), "flat faces");
  add("k-neighbors,k", po::value(&reconstruction.k_neighbors)->value_name("N"), "as in pcl_pds_recon");
  add("radius-factor,f", po::value(&reconstruction.radius_factor)->value_name("X"), "as in pcl_pds_recon");
  add("radius,r", po::value(&reconstruction.radius)->value_name("R"), "as in pcl_pds_recon");
  add("adaptive,a", po::value(&reconstruction.adaptive)->value_name("C"), "as in pcl_pds_recon");
  add("hole-size", po::value(&reconstruction.hole_size)->value_name("X"), "as in pcl_pds_recon");
  add("threads,j", po::value(&reconstruction.threads)->value_name("N"), "as in pcl_pds_recon");
  add("screenshot", po::value(&options.screenshot)->value_name("FILE.png"), "write a picture instead of a window");
  add("frames", po::value(&options.frames)->value_name("N"), "turn the camera N times and print the frames per second");
  add("size", po::value(&texts.size)->value_name("WxH"), "of the window or picture in pixels (default 1200x900)");
  add("camera", po::value(&texts.camera)->value_name("AZ,EL,ZOOM[,z]"),
      "degrees around and above, magnification (default 0,0,1.4); z: that axis points up");
  add("help,h", "print this help and exit");
  add("version", "print the version and exit");
  return description;
}

std::string help_text(const po::options_description& options)
{
  std::ostringstream text;
  text << "Usage: pcl_pds_viewer [OPTION]... CLOUD_OR_MESH [REFERENCE]\n"
          "Show a mesh, or a point cloud and its reconstruction, step by step; with a REFERENCE the deviation from "
          "it.\n\n"
       << options << "\nKeys in the window:\n"
       << key_help()
       << "\nExamples:\n"
          "  pcl_pds_viewer -a 0.25 scan.pcd\n"
          "  pcl_pds_viewer --show deviation mesh.ply reference.ply\n"
          "  pcl_pds_viewer --show cells,seeds --screenshot cells.png --size 800x600 scan.ply\n"
          "\nExit status: 0; 1 a file or the display is at fault; 2 the command line is\n";
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
      throw ViewerUsageError("--show: there is no layer '" + name + "'" + usage_hint);
    }
    layers.push_back(known->layer);
  }
  return layers;
}

void parse_size(const std::string& text, ViewerOptions& options)
{
  constexpr int least = 16;
  constexpr int most = 8192;
  std::istringstream stream(text);
  char by = 0;
  if (!(stream >> options.width >> by >> options.height) || by != 'x' || stream.peek() != EOF ||
      std::min(options.width, options.height) < least || std::max(options.width, options.height) > most) {
    throw ViewerUsageError("--size: '" + text + "' is not WxH with 16 ... 8192 pixels each");
  }
}

void parse_camera(const std::string& text, CameraPlace& camera)
{
  std::istringstream stream(text);
  char comma[2] = {0, 0};
  const bool understood = stream >> camera.azimuth >> comma[0] >> camera.elevation >> comma[1] >> camera.zoom &&
                          comma[0] == ',' && comma[1] == ',' && camera.zoom > 0 && std::abs(camera.elevation) < 90;
  std::string rest;
  stream >> rest;
  if (!understood || !(rest.empty() || rest == ",y" || rest == ",z")) {
    throw ViewerUsageError("--camera: '" + text +
                           "' is not AZ,EL,ZOOM or AZ,EL,ZOOM,z with -90 < EL < 90 and a positive ZOOM");
  }
  camera.up = rest == ",z" ? 'z' : 'y';
}

void understand(const Texts& texts, ViewerOptions& options)
{
  if (!texts.layers.empty()) {
    options.layers = parse_layers(texts.layers);
  }
  if (!texts.size.empty()) {
    parse_size(texts.size, options);
  }
  if (!texts.camera.empty()) {
    parse_camera(texts.camera, options.camera);
  }
  if (!options.screenshot.empty() && file_extension(options.screenshot) != ".png") {
    throw ViewerUsageError("--screenshot: " + options.screenshot + ": is written as PNG; let its name end in .png");
  }
  if (options.frames < 0) {
    throw ViewerUsageError("--frames must not be negative");
  }
  validate(options.reconstruction);
}

}  // namespace

ViewerOptions parse_viewer_options(int argc, const char* const* argv)
{
  ViewerOptions options;
  Texts texts;
  const po::options_description visible = visible_options(options, texts);
  po::options_description all;
  std::vector<std::string> files;
  all.add(visible).add_options()("files", po::value(&files));
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
    if (files.empty() || files.size() > 2) {
      throw ViewerUsageError("needs one CLOUD_OR_MESH and perhaps a REFERENCE, got " + std::to_string(files.size()) +
                             " file names" + usage_hint);
    }
    options.input = files[0];
    options.reference = files.size() == 2 ? files[1] : "";
    understand(texts, options);
  } catch (const po::error& error) {
    throw ViewerUsageError(error.what() + std::string(usage_hint));
  } catch (const InvalidOption& error) {
    throw ViewerUsageError(error.what());
  }
  return options;
}

}  // namespace pds
