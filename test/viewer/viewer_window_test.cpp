// SPDX-License-Identifier: BSD-3-Clause
// Drives the real window in a private Xvfb and looks at what is on the screen.
#include "viewer/viewer_window.h"
#include "meshes.h"
#include "viewer/private_x_server.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <thread>

#include <vtkCamera.h>
#include <vtkUnsignedCharArray.h>

namespace pds
{
namespace
{

using Pixels = std::vector<unsigned char>;

/** \brief The window with the points of a sphere and their reconstruction, and a sphere a little larger as reference.
 */
class ViewerWindowTest : public testing::Test
{
 protected:
  ViewerWindowTest() : source_(make_source()), view_(make_view_data(source_, Options()))
  {
    view_.show(Layer::mesh, true);
    view_.aim({});
    options_.width = 300;
    options_.height = 300;
    window_ = std::make_unique<ViewerWindow>(view_, source_, options_);
    window_->open();
  }

  static ViewSource make_source()
  {
    const TriangleMesh sphere = make_sphere(1, 5);
    PointTable table({{"x", ScalarType::float64}, {"y", ScalarType::float64}, {"z", ScalarType::float64}});
    table.resize(sphere.vertices.size());
    for (std::size_t i = 0; i < table.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k)
        table.set_value(i, table.fields()[k], sphere.vertices[i][static_cast<Eigen::Index>(k)]);
    return {MeshFile{std::move(table), {}}, true, make_sphere(1.1, 4)};
  }

  /** \brief Presses a key as the X server reports it. */
  void press(char key, int x = 150, int y = 150)
  {
    vtkRenderWindowInteractor* interactor = window_->interactor();
    interactor->SetEventInformation(x, y, 0, 0, key, 0, nullptr);
    interactor->InvokeEvent(vtkCommand::CharEvent, nullptr);
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

std::size_t count_if_pixel(const Pixels& pixels, bool (*test)(int red, int green, int blue))
{
  std::size_t count = 0;
  for (std::size_t i = 0; i + 2 < pixels.size(); i += 3) count += test(pixels[i], pixels[i + 1], pixels[i + 2]) ? 1 : 0;
  return count;
}

bool is_drawn(int red, int green, int blue) { return red + green + blue < 3 * 250; }

TEST_F(ViewerWindowTest, EveryLayerChangesThePictureAndGoesAgain)
{
  press('m');
  EXPECT_EQ(count_if_pixel(pixels(), is_drawn), 0U);
  for (const LayerName& layer : layer_names) {
    if (layer.layer == Layer::loops) continue;  // a sphere has none
    press(layer.key);
    EXPECT_TRUE(view_.is_shown(layer.layer)) << layer.name;
    EXPECT_GT(count_if_pixel(pixels(), is_drawn), 300U) << layer.name;
    press(layer.key);
    EXPECT_EQ(count_if_pixel(pixels(), is_drawn), 0U) << layer.name;
  }
  press('b');
  EXPECT_NE(window_->status().find("nothing to show as loops"), std::string::npos) << window_->status();
}

TEST_F(ViewerWindowTest, SeedsAreRedAndWitnessesBlue)
{
  press('m');
  press('s');
  EXPECT_GT(count_if_pixel(pixels(), [](int r, int g, int b) { return r > 200 && g < 60 && b < 60; }), 300U);
  press('s');
  press('w');
  EXPECT_GT(count_if_pixel(pixels(), [](int r, int g, int b) { return r < 60 && g < 110 && b > 180; }), 300U);
}

TEST_F(ViewerWindowTest, TheMeshTakesTurnsWithItsDeviation)
{
  press('v');
  EXPECT_TRUE(view_.is_shown(Layer::deviation));
  EXPECT_FALSE(view_.is_shown(Layer::mesh));
  // It lies 0.1 inside the reference: blue all over.
  EXPECT_GT(count_if_pixel(pixels(), [](int r, int, int b) { return b > r + 40; }), 10000U);
}

TEST_F(ViewerWindowTest, HelpAndShadingAreDrawn)
{
  const Pixels before = pixels();
  press('h');
  const Pixels with_help = pixels();
  EXPECT_NE(with_help, before);
  press('h');
  EXPECT_EQ(pixels(), before);
  press('f');
  EXPECT_NE(pixels(), before);
  press('f');
  EXPECT_EQ(pixels(), before);
}

TEST_F(ViewerWindowTest, ThePointerReadsTheVertexUnderIt)
{
  press('p');
  for (const char* part : {"vertex ", "input point ", "cell of ", "deviation -0.", "x ", "z "})
    EXPECT_NE(window_->status().find(part), std::string::npos) << window_->status();
  press('p', 2, 298);
  EXPECT_EQ(window_->status(), "nothing there");
}

TEST_F(ViewerWindowTest, TheCameraIsSavedAndRestored)
{
  press('K');
  const Pixels before = pixels();
  view_.renderer()->GetActiveCamera()->Azimuth(40);
  EXPECT_NE(pixels(), before);
  press('k');
  EXPECT_EQ(pixels(), before);
}

TEST_F(ViewerWindowTest, RadiusAndAdaptiveCoefficientReconstructWhileTheWindowLives)
{
  press('e');
  const std::size_t vertices = view_.data().mesh.vertices.size();
  const double radius = view_.data().radius;
  const Pixels before = pixels();
  press('+');
  EXPECT_TRUE(window_->is_busy());
  EXPECT_EQ(pixels(), before);  // still served, with the old mesh
  wait();
  EXPECT_NEAR(view_.data().radius, 1.25 * radius, 1e-6 * radius);
  EXPECT_LT(view_.data().mesh.vertices.size(), vertices);
  EXPECT_NE(pixels(), before);
  press('-');
  press('a');  // while it is busy: the last request counts
  wait();
  const auto before_all = static_cast<double>(vertices);
  EXPECT_NEAR(static_cast<double>(view_.data().mesh.vertices.size()), before_all, 0.2 * before_all);
  EXPECT_NE(window_->status().find("adaptive 0.1"), std::string::npos) << window_->status();
}

TEST(PrivateXServer, IsStartedAndEnded)
{
  std::string display;
  unsetenv("DISPLAY");
  {
    const PrivateXServer server;
    ASSERT_NE(std::getenv("DISPLAY"), nullptr);
    display = std::getenv("DISPLAY");
    const PrivateXServer second;  // takes the first one's display
    EXPECT_EQ(std::getenv("DISPLAY"), display);
  }
  EXPECT_EQ(std::getenv("DISPLAY"), nullptr);
}

TEST(PrivateXServer, SaysWhatIsMissing)
{
  unsetenv("DISPLAY");
  const std::string path = std::getenv("PATH");
  setenv("PATH", "/nowhere", 1);
  try {
    const PrivateXServer server;
    ADD_FAILURE() << "found an Xvfb nowhere";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("install xvfb"), std::string::npos) << error.what();
  }
  setenv("PATH", path.c_str(), 1);
}

}  // namespace
}  // namespace pds
