// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "meshes.h"
#include "viewer/private_x_server.h"
#include "viewer/viewer_window.h"

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <thread>
#include <vector>

#include <vtkUnsignedCharArray.h>

namespace pds
{

using Pixels = std::vector<unsigned char>;

inline PointTable to_table(const TriangleMesh& mesh)
{
  PointTable table({{"x", ScalarType::float64}, {"y", ScalarType::float64}, {"z", ScalarType::float64}});
  table.resize(mesh.vertices.size());
  for (std::size_t i = 0; i < table.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      table.set_value(i, table.fields()[k], mesh.vertices[i][static_cast<Eigen::Index>(k)]);
  return table;
}

/** \brief The window with the points of a sphere and their reconstruction, and a sphere a little larger as reference.
 */
class ViewerWindowTest : public testing::Test
{
 protected:
  ViewerWindowTest() : ViewerWindowTest(make_source(make_sphere(1, 5))) {}
  explicit ViewerWindowTest(ViewSource source) : source_(std::move(source)), view_(make_view_data(source_, Options()))
  {
    view_.show(Layer::mesh, true);
    view_.aim({});
    options_.width = 300;
    options_.height = 300;
    window_ = std::make_unique<ViewerWindow>(view_, source_, options_);
    window_->open();
  }

  /** \brief The vertices as a cloud, to be compared with a sphere. */
  static ViewSource make_source(const TriangleMesh& mesh)
  {
    ViewSource source;
    source.cloud = to_table(mesh);
    source.reference = make_sphere(1.1, 4);
    source.reference_name = "sphere";
    return source;
  }

  /** \brief Presses a key as the X server reports it. */
  void press(char key, int x = 150, int y = 150) { send(vtkCommand::CharEvent, x, y, key); }

  void send(unsigned long event, int x, int y, char key = 0)
  {
    vtkRenderWindowInteractor* interactor = window_->interactor();
    interactor->SetEventInformation(x, y, 0, 0, key, 0, nullptr);
    interactor->InvokeEvent(event, nullptr);
  }

  /** \brief Waits for all details, as the window does. */
  void rest()
  {
    while (view_.is_coarse()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      window_->poll();
    }
  }

  Pixels pixels()
  {
    window_->window()->Render();
    vtkNew<vtkUnsignedCharArray> data;
    window_->window()->GetPixelData(0, 40, 299, 299, 0, data);  // above the line of text
    return {data->GetPointer(0), data->GetPointer(0) + data->GetNumberOfValues()};
  }

  /** \brief Waits for a reconstruction, as the window does. */
  void wait()
  {
    while (window_->is_busy()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      window_->poll();
    }
  }

  PrivateXServer server_;
  ViewSource source_;
  View view_;
  ViewerOptions options_;
  std::unique_ptr<ViewerWindow> window_;
};

template <typename Test>
std::size_t count_if_pixel(const Pixels& pixels, const Test& test)
{
  std::size_t count = 0;
  for (std::size_t i = 0; i + 2 < pixels.size(); i += 3) count += test(pixels[i], pixels[i + 1], pixels[i + 2]) ? 1 : 0;
  return count;
}

inline bool is_mark(int red, int green, int blue) { return red > 200 && green < 40 && blue > 180; }
inline bool is_drawn(int red, int green, int blue) { return red + green + blue < 3 * 250; }

}  // namespace pds
