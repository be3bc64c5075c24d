// SPDX-License-Identifier: BSD-3-Clause
#include "tool/run_testing.h"

namespace pds
{
namespace
{

/** \brief Starts pcl_pds_viewer as a user without a display does. */
class RunViewer : public RunTool
{
 protected:
  int view(const std::string& arguments) { return run(arguments, "env -u DISPLAY"); }
};

const char* const one_triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

TEST_F(RunViewer, draws_the_same_picture_twice)
{
  write("cloud.xyz", sphere_rows(4000, 1, 0, 0));
  ASSERT_EQ(view("--show cells,seeds --size 200x150 --screenshot a.png cloud.xyz"), 0) << errors();
  ASSERT_EQ(view("--show cells,seeds --size 200x150 --screenshot b.png cloud.xyz"), 0) << errors();
  EXPECT_EQ(read("a.png"), read("b.png"));
  EXPECT_EQ(read("a.png").substr(1, 3), "PNG");
  ASSERT_EQ(view("--show mesh --size 200x150 --screenshot c.png cloud.xyz"), 0) << errors();
  EXPECT_NE(read("a.png"), read("c.png"));
  ASSERT_EQ(view("--show mesh --camera 30,20,1 --size 200x150 --screenshot d.png cloud.xyz"), 0) << errors();
  EXPECT_NE(read("c.png"), read("d.png"));
}

TEST_F(RunViewer, draws_a_single_triangle_and_its_deviation)
{
  write("one.obj", one_triangle);
  write("cloud.xyz", "0.2 0.2 1\n");
  EXPECT_EQ(view("--screenshot a.png --size 64x64 one.obj"), 0) << errors();
  EXPECT_EQ(view("--screenshot b.png --size 64x64 --reference cloud.xyz one.obj"), 0) << errors();
  EXPECT_NE(read("a.png"), read("b.png"));
}

TEST_F(RunViewer, draws_a_mesh_in_its_colors_or_plain)
{
  write("red.obj", "v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\nf 1 2 3\n");
  write("plain.obj", one_triangle);
  ASSERT_EQ(view("--screenshot red.png --size 64x64 red.obj"), 0) << errors();
  ASSERT_EQ(view("--screenshot plain.png --size 64x64 --colors plain red.obj"), 0) << errors();
  ASSERT_EQ(view("--screenshot none.png --size 64x64 plain.obj"), 0) << errors();
  EXPECT_NE(read("red.png"), read("plain.png"));
  EXPECT_EQ(read("none.png"), read("plain.png"));
}

TEST_F(RunViewer, draws_merged_clouds_and_meshes_beside_each_other)
{
  const std::string small = " --size 200x150 --screenshot ";
  write("left.xyz", sphere_rows(4000, 1, 0, 0));
  write("right.xyz", sphere_rows(4000, 1, 3, 0));
  ASSERT_EQ(view("--show mesh" + small + "one.png left.xyz"), 0) << errors();
  ASSERT_EQ(view("--show mesh" + small + "two.png left.xyz right.xyz"), 0) << errors();
  EXPECT_NE(read("one.png"), read("two.png"));
  write("one.obj", one_triangle);
  write("two.obj", one_triangle);
  ASSERT_EQ(view("--show mesh" + small + "mesh.png one.obj"), 0) << errors();
  ASSERT_EQ(view("--show mesh" + small + "meshes.png one.obj two.obj"), 0) << errors();
  EXPECT_NE(read("mesh.png"), read("meshes.png"));
  ASSERT_EQ(view("--show cloud,mesh" + small + "both.png one.obj left.xyz"), 0) << errors();
  EXPECT_EQ(view("--show cells" + small + "none.png one.obj left.xyz"), 1);
  EXPECT_TRUE(complained_of("there is nothing to show"));
}

TEST_F(RunViewer, draws_with_the_command_tools_options)
{
  write("cloud.xyz", sphere_rows(4000, 1, 0, 0));
  write("coarse.ini", "radius-factor = 6\n");
  const std::string edges = "--show mesh,edges --size 200x150 --screenshot ";
  ASSERT_EQ(view(edges + "a.png cloud.xyz"), 0) << errors();
  ASSERT_EQ(view(edges + "b.png -f 6 cloud.xyz"), 0) << errors();
  ASSERT_EQ(view(edges + "c.png --config coarse.ini cloud.xyz"), 0) << errors();
  EXPECT_NE(read("a.png"), read("b.png"));
  EXPECT_EQ(read("b.png"), read("c.png"));
  ASSERT_EQ(view(edges + "d.png --seed 7 cloud.xyz"), 0) << errors();
  EXPECT_NE(read("a.png"), read("d.png"));
  ASSERT_EQ(view(edges + "e.png --placement quadric cloud.xyz"), 0) << errors();
  EXPECT_NE(read("a.png"), read("e.png"));
  EXPECT_EQ(view("--report a.json cloud.xyz"), 2) << "it writes none";
}

TEST_F(RunViewer, names_what_is_wrong_in_one_line)
{
  write("one.obj", one_triangle);
  write("empty.ply", "");
  write("points.ply",
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
        "0 0 0\n");
  write("nan.xyz", "nan nan nan\n");
  write("empty.stl", "solid x\nendsolid x\n");
  const auto before = files();
  for (const char* bad : {"empty.ply", "empty.stl", "missing.ply", "one.las", "one.obj empty.ply",
                          "--reference empty.ply one.obj", "--reference nan.xyz one.obj"}) {
    EXPECT_EQ(view(std::string("--screenshot a.png ") + bad), 1) << bad;
    EXPECT_TRUE(complained_of("")) << bad;
  }
  EXPECT_EQ(view("--show cells --screenshot a.png one.obj"), 1);
  EXPECT_TRUE(complained_of("one.obj: there is nothing to show"));
  EXPECT_EQ(view("--show mesh --screenshot a.png points.ply"), 1);
  EXPECT_TRUE(complained_of("points.ply: there is nothing to show"));
  EXPECT_EQ(view("--screenshot missing/a.png one.obj"), 1);
  EXPECT_TRUE(complained_of("missing"));
  EXPECT_EQ(view("one.obj"), 1);
  EXPECT_TRUE(complained_of("no X display"));
  EXPECT_EQ(files(), before);
}

TEST_F(RunViewer, explains_its_usage)
{
  write("one.obj", one_triangle);
  EXPECT_EQ(view("--help"), 0);
  EXPECT_NE(output().find("Usage: pcl_pds_viewer"), std::string::npos);
  EXPECT_EQ(view("--version"), 0);
  for (const char* wrong :
       {"", "--show nothing one.obj", "--shading round one.obj", "--colors red one.obj", "--config missing.ini one.obj",
        "--radius-factor x one.obj", "--size 5 one.obj", "--size 0x0 one.obj", "--camera 1,2 one.obj",
        "--camera 0,95,1 one.obj", "--screenshot a.jpg one.obj", "-k 1 one.obj", "--nonsense one.obj"}) {
    EXPECT_EQ(view(wrong), 2) << wrong;
    EXPECT_TRUE(complained_of("")) << wrong;
  }
}

}  // namespace
}  // namespace pds
