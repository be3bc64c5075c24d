// SPDX-License-Identifier: BSD-3-Clause
// Draws a mesh into a picture: front faces neutral, back faces red, boundary edges orange, so that a flaw catches the
// eye.
#include <algorithm>
#include <boost/program_options.hpp>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "render/picture.h"

#include <vtkActor.h>
#include <vtkAutoInit.h>
#include <vtkFeatureEdges.h>
#include <vtkLightKit.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkPLYReader.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkRenderingOpenGLConfigure.h>  // VTK_USE_X
#include <vtkSmartPointer.h>

VTK_MODULE_INIT(vtkRenderingOpenGL2)

namespace pds
{
namespace
{

namespace po = boost::program_options;

struct PictureSettings
{
  std::string input;
  std::string output;
  int width = 1600;   ///< pixels
  int height = 1200;  ///< pixels
  CameraPlace camera;
  bool edges = false;  ///< draw the edges of all triangles
};

/** \brief Turns the first complaint of VTK into an exception: after it VTK would go on with half a mesh or abort. */
class ComplaintThrower : public vtkOutputWindow
{
 public:
  static ComplaintThrower* New();

  void DisplayText(const char* text) override
  {
    std::string line(text);
    line.erase(std::min(line.find_last_not_of(" \n") + 1, line.size()));
    std::replace(line.begin(), line.end(), '\n', ' ');
    throw std::runtime_error(line);
  }
};
vtkStandardNewMacro(ComplaintThrower);

vtkSmartPointer<vtkPolyData> read_mesh(const std::string& path)
{
  if (!std::filesystem::is_regular_file(path)) {
    throw std::runtime_error(path + ": no such file; give a PLY mesh");
  }
  if (vtkPLYReader::CanReadFile(path.c_str()) == 0) {
    throw std::runtime_error(path + ": not a PLY mesh");
  }
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName(path.c_str());
  try {
    reader->Update();
  } catch (const std::runtime_error& complaint) {
    throw std::runtime_error(path + ": cannot be read, is it complete? " + complaint.what());
  }
  if (reader->GetOutput()->GetNumberOfPolys() == 0) {
    throw std::runtime_error(path + ": has no faces; give a mesh, not a point cloud");
  }
  return reader->GetOutput();
}

vtkSmartPointer<vtkActor> surface_actor(vtkPolyData* mesh, bool with_edges)
{
  // Neither split nor reoriented: the picture must show the faces as they are.
  vtkNew<vtkPolyDataNormals> shading;
  shading->SetInputData(mesh);
  shading->SplittingOff();
  shading->ConsistencyOff();

  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(shading->GetOutputPort());
  mapper->ScalarVisibilityOff();
  mapper->SetResolveCoincidentTopologyToPolygonOffset();  // lines in front of the faces they bound

  vtkNew<vtkProperty> back;
  back->SetColor(0.75, 0.25, 0.20);

  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->SetBackfaceProperty(back);
  vtkProperty* front = actor->GetProperty();
  front->SetColor(0.80, 0.79, 0.76);
  front->SetSpecular(0.15);
  front->SetSpecularPower(20);
  if (with_edges) {
    front->SetInterpolationToFlat();
    front->EdgeVisibilityOn();
    front->SetEdgeColor(0.25, 0.27, 0.30);
  }
  return actor;
}

vtkSmartPointer<vtkActor> boundary_actor(vtkPolyData* mesh)
{
  vtkNew<vtkFeatureEdges> boundary;
  boundary->SetInputData(mesh);
  boundary->FeatureEdgesOff();
  boundary->ManifoldEdgesOff();
  boundary->ColoringOff();

  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(boundary->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.95, 0.50, 0.05);
  actor->GetProperty()->SetLineWidth(4);
  actor->GetProperty()->LightingOff();
  return actor;
}

void draw(const PictureSettings& settings)
{
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  vtkNew<ComplaintThrower> thrower;
  vtkOutputWindow::SetInstance(thrower);

  const vtkSmartPointer<vtkPolyData> mesh = read_mesh(settings.input);
#ifdef VTK_USE_X
  if (std::getenv("DISPLAY") == nullptr) {
    throw std::runtime_error("no X display to draw on; run it as: xvfb-run -a render_mesh ...");
  }
#endif
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(surface_actor(mesh, settings.edges));
  renderer->AddActor(boundary_actor(mesh));
  renderer->SetBackground(1, 1, 1);

  vtkNew<vtkLightKit> lights;  // key, fill, back and head light
  lights->SetKeyLightAngle(45, -35);
  lights->SetKeyToFillRatio(1.7);
  lights->AddLightsToRenderer(renderer);

  aim_camera(renderer, settings.camera);
  draw_picture(renderer, settings.width, settings.height, settings.output);
}

void check(const PictureSettings& settings)
{
  if (settings.width < 16 || settings.width > 8192 || settings.height < 16 || settings.height > 8192) {
    throw po::error("--width and --height must be 16 to 8192 pixels");
  }
  if (settings.camera.up != 'y' && settings.camera.up != 'z') {
    throw po::error("--up must be y or z");
  }
  if (!(settings.camera.zoom > 0.0)) {
    throw po::error("--zoom must be positive");
  }
}

void run(int argc, char** argv)
{
  PictureSettings s;
  po::options_description options("Options");
  auto add = options.add_options();
  add("width", po::value(&s.width)->default_value(s.width), "of the picture, pixels");
  add("height", po::value(&s.height)->default_value(s.height), "of the picture, pixels");
  add("azimuth", po::value(&s.camera.azimuth)->default_value(s.camera.azimuth), "camera: degrees around the up axis");
  add("elevation", po::value(&s.camera.elevation)->default_value(s.camera.elevation),
      "camera: degrees above the horizon");
  add("zoom", po::value(&s.camera.zoom)->default_value(s.camera.zoom, "1.4"),
      "camera: 1 fits the sphere around the mesh");
  add("up", po::value(&s.camera.up)->default_value(s.camera.up), "axis of the mesh that points up: y or z");
  add("edges", po::bool_switch(&s.edges), "draw the edges of all triangles");
  add("help,h", "print this help");
  po::options_description all;
  all.add(options);
  all.add_options()("input", po::value(&s.input)->required())("output", po::value(&s.output)->required());
  po::positional_options_description files;
  files.add("input", 1).add("output", 1);

  po::variables_map values;
  po::store(po::command_line_parser(argc, argv).options(all).positional(files).run(), values);
  if (values.count("help") != 0) {
    std::cout << "Usage: render_mesh [options] MESH.ply PICTURE.png\n\n" << options;
    return;
  }
  po::notify(values);
  check(s);
  draw(s);
}

}  // namespace
}  // namespace pds

int main(int argc, char** argv)
{
  try {
    pds::run(argc, argv);
    return 0;
  } catch (const boost::program_options::error& e) {
    std::cerr << "render_mesh: " << e.what() << "; see --help\n";
    return 2;
  } catch (const std::exception& e) {
    std::cerr << "render_mesh: " << e.what() << "\n";
    return 1;
  }
}
