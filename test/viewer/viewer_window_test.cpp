// SPDX-License-Identifier: BSD-3-Clause
// Drives the window in a private Xvfb and looks at what it draws.
#include "viewer/keys.h"
#include "window_testing.h"

#include <algorithm>
#include <cmath>

#include <vtkCamera.h>

namespace pds
{
namespace
{

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

TEST_F(ViewerWindowTest, HelpListsEveryKeyAndGoesAgain)
{
  const std::string help = key_help();
  for (const LayerName& layer : layer_names)
    EXPECT_NE(help.find(std::string("  ") + layer.key + "        " + layer.name), std::string::npos) << layer.name;
  const Pixels before = pixels();
  press('h');
  EXPECT_NE(pixels(), before);
  press('h');
  EXPECT_EQ(pixels(), before);
}

TEST_F(ViewerWindowTest, FacesAreSmoothFlatOrWireframe)
{
  const Pixels smooth = pixels();
  press('f');
  const Pixels flat = pixels();
  EXPECT_NE(flat, smooth);
  EXPECT_EQ(count_if_pixel(flat, is_drawn), count_if_pixel(smooth, is_drawn));
  press('f');
  EXPECT_LT(count_if_pixel(pixels(), is_drawn), count_if_pixel(smooth, is_drawn));  // one sees through it
  press('f');
  EXPECT_EQ(pixels(), smooth);
}

TEST_F(ViewerWindowTest, ThePointerReadsTheVertexUnderItAndMarksIt)
{
  press('p');
  for (const char* part : {"vertex ", "input point ", "cell of ", "deviation -0.", "x ", "z "})
    EXPECT_NE(window_->status().find(part), std::string::npos) << window_->status();
  EXPECT_EQ(window_->status().find("cell of 0 "), std::string::npos) << window_->status();
  EXPECT_GT(count_if_pixel(pixels(), is_mark), 20U);
  press('p', 2, 298);
  EXPECT_EQ(window_->status(), "nothing there");
  EXPECT_EQ(count_if_pixel(pixels(), is_mark), 0U);
}

TEST_F(ViewerWindowTest, ThePointerReadsAPointWhereOnlyPointsAreShown)
{
  press('m');
  press('s');
  press('l');
  int seed_x = 0;
  for (int x = 140; x < 160 && seed_x == 0; ++x)  // the sphere's points are not everywhere
    if (view_.renderer()->GetZ(x, 150) < 1) seed_x = x;
  ASSERT_NE(seed_x, 0);
  press('p', seed_x, 150);
  EXPECT_EQ(window_->status().rfind("input point ", 0), 0U) << window_->status();
  EXPECT_NE(window_->status().find(", of seed "), std::string::npos) << window_->status();
}

TEST_F(ViewerWindowTest, TheCameraIsSavedRestoredAndPrintedForAnotherDay)
{
  view_.renderer()->GetActiveCamera()->Azimuth(20);
  view_.renderer()->GetActiveCamera()->Zoom(1.2);
  testing::internal::CaptureStdout();
  press('K');
  const std::string printed = testing::internal::GetCapturedStdout();
  const Pixels before = pixels();
  view_.renderer()->GetActiveCamera()->Azimuth(40);
  EXPECT_NE(pixels(), before);
  press('k');
  EXPECT_EQ(pixels(), before);

  ASSERT_EQ(printed.rfind("--camera ", 0), 0U) << printed;
  const std::string numbers = printed.substr(9, printed.size() - 10);
  const char* arguments[] = {"pcl_pds_viewer", "--camera", numbers.c_str(), "a.ply"};
  const ViewerOptions another_day = parse_viewer_options(4, arguments);
  ASSERT_TRUE(another_day.pose) << printed;
  view_.renderer()->GetActiveCamera()->Elevation(30);
  view_.set_pose(*another_day.pose);
  // A sum with the centre may round: no more than a few pixels at the rim may notice.
  const Pixels again = pixels();
  std::size_t different = 0;
  for (std::size_t i = 0; i < again.size(); ++i) different += again[i] != before[i] ? 1 : 0;
  EXPECT_LT(different, again.size() / 1000);
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

TEST_F(ViewerWindowTest, ARunIsGivenUpForTheNextAndWhenTheWindowCloses)
{
  const double radius = view_.data().radius;
  for (int i = 0; i < 3; ++i) press('+');
  wait();
  EXPECT_NEAR(view_.data().radius, std::pow(1.25, 3) * radius, 1e-6 * radius);
  press('+');
  window_.reset();  // must neither hang nor crash
}

/** \brief A scan of green points. */
class ViewerWindowOfColors : public ViewerWindowTest
{
 protected:
  ViewerWindowOfColors() : ViewerWindowTest(make_green_source()) {}

  static ViewSource make_green_source()
  {
    ViewSource source = make_source(make_sphere(1, 5));
    source.cloud = source.cloud->with_fields(
        {{"red", ScalarType::uint8}, {"green", ScalarType::uint8}, {"blue", ScalarType::uint8}}, Parallel(1));
    for (std::size_t i = 0; i < source.cloud->size(); ++i)
      source.cloud->set_value(i, *source.cloud->find("green"), 200);
    return source;
  }

  static bool is_green(int red, int green, int blue) { return red < 20 && green > 60 && blue < 20; }
};

TEST_F(ViewerWindowOfColors, CloudAndMeshAreInTheColorsOfTheScanOrInOurs)
{
  const Pixels mesh = pixels();
  EXPECT_GT(count_if_pixel(mesh, is_green), 10000U);
  press('o');
  EXPECT_EQ(count_if_pixel(pixels(), is_green), 0U);
  EXPECT_EQ(count_if_pixel(pixels(), is_drawn), count_if_pixel(mesh, is_drawn));
  press('o');
  EXPECT_EQ(pixels(), mesh);
  press('v');
  EXPECT_EQ(count_if_pixel(pixels(), is_green), 0U) << "the deviation has colours of its own";
  press('v');
  press('c');
  EXPECT_GT(count_if_pixel(pixels(), is_green), 300U);
  press('o');
  EXPECT_EQ(count_if_pixel(pixels(), is_green), 0U);
  EXPECT_GT(count_if_pixel(pixels(), is_drawn), 300U);
}

TEST_F(ViewerWindowOfColors, ANewMeshHasThemToo)
{
  press('+');
  wait();
  EXPECT_GT(count_if_pixel(pixels(), is_green), 10000U);
}

TEST_F(ViewerWindowTest, SaysThatAScanHasNoColors)
{
  press('o');
  EXPECT_EQ(window_->status(), "the scan has no colours");
}

/** \brief A rim and too many points to move them fluently. */
class ViewerWindowOfPlane : public ViewerWindowTest
{
 protected:
  ViewerWindowOfPlane() : ViewerWindowTest(make_source(make_plane(0, 400))) {}
};

TEST_F(ViewerWindowOfPlane, TheRimIsDrawn)
{
  const auto is_orange = [](int red, int green, int blue) {
    return red > 220 && green > 90 && green < 160 && blue < 50;
  };
  EXPECT_EQ(count_if_pixel(pixels(), is_orange), 0U);
  press('b');
  EXPECT_GT(count_if_pixel(pixels(), is_orange), 300U);
}

TEST_F(ViewerWindowOfPlane, HasFewerPointsWhileItMovesAndAllWhenItRests)
{
  press('m');
  press('c');
  rest();
  const Pixels all = pixels();
  send(vtkCommand::LeftButtonPressEvent, 150, 150);
  EXPECT_TRUE(view_.is_coarse());
  send(vtkCommand::MouseMoveEvent, 170, 150);
  const Pixels moving = pixels();
  EXPECT_GT(count_if_pixel(moving, is_drawn), 300U);
  window_->poll();
  EXPECT_TRUE(view_.is_coarse());  // the button is still down
  send(vtkCommand::MouseMoveEvent, 150, 150);
  send(vtkCommand::LeftButtonReleaseEvent, 150, 150);
  rest();
  EXPECT_TRUE(pixels() != moving);
  press('k');
  rest();
  EXPECT_TRUE(pixels() == all);
}

}  // namespace
}  // namespace pds
