// SPDX-License-Identifier: BSD-3-Clause
#include "render/picture.h"

#include <cstdio>
#include <stdexcept>

#include <vtkCamera.h>
#include <vtkErrorCode.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkRenderStepsPass.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSSAAPass.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

namespace pds
{

void aim_camera(vtkRenderer* renderer, const CameraPlace& place)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetFocalPoint(0, 0, 0);
  if (place.up == 'z') {
    camera->SetPosition(0, -1, 0);
    camera->SetViewUp(0, 0, 1);
  } else {
    camera->SetPosition(0, 0, 1);
    camera->SetViewUp(0, 1, 0);
  }
  camera->Azimuth(place.azimuth);
  camera->Elevation(place.elevation);
  renderer->ResetCamera();
  camera->Zoom(place.zoom);
  renderer->ResetCameraClippingRange();
}

void save_picture(vtkRenderWindow* window, const std::string& path)
{
  vtkNew<vtkWindowToImageFilter> picture;
  picture->SetInput(window);
  picture->ReadFrontBufferOff();
  const std::string unfinished = path + ".part";
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(picture->GetOutputPort());
  writer->SetFileName(unfinished.c_str());
  writer->GlobalWarningDisplayOff();  // reported below
  writer->Write();
  if (writer->GetErrorCode() != vtkErrorCode::NoError || std::rename(unfinished.c_str(), path.c_str()) != 0) {
    std::remove(unfinished.c_str());
    throw std::runtime_error(path + ": cannot be written; is the directory there, writable and not full?");
  }
}

namespace
{

vtkSmartPointer<vtkRenderWindow> draw_offscreen(vtkRenderer* renderer, int width, int height)
{
  vtkNew<vtkRenderStepsPass> steps;
  vtkNew<vtkSSAAPass> antialiasing;
  antialiasing->SetDelegatePass(steps);
  renderer->SetPass(antialiasing);
  auto window = vtkSmartPointer<vtkRenderWindow>::New();
  window->SetOffScreenRendering(1);
  window->SetSize(width, height);
  window->AddRenderer(renderer);
  window->Render();
  return window;
}

}  // namespace

std::string draw_png(vtkRenderer* renderer, int width, int height)
{
  const auto window = draw_offscreen(renderer, width, height);
  vtkNew<vtkWindowToImageFilter> picture;
  picture->SetInput(window);
  picture->ReadFrontBufferOff();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(picture->GetOutputPort());
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray* bytes = writer->GetResult();
  return {reinterpret_cast<const char*>(bytes->GetPointer(0)), static_cast<std::size_t>(bytes->GetNumberOfValues())};
}

void draw_picture(vtkRenderer* renderer, int width, int height, const std::string& path)
{
  save_picture(draw_offscreen(renderer, width, height), path);
}

}  // namespace pds
