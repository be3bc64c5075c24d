// SPDX-License-Identifier: BSD-3-Clause
#include "io/read_points.h"
#include "las_testing.h"
#include "run_testing.h"

#include <set>

namespace pds
{
namespace
{

using Names = std::vector<std::string>;

std::string ply_sphere(double center_x, const char* property, const char* value)
{
  constexpr std::size_t count = 3000;
  return "ply\nformat ascii 1.0\nelement vertex " + std::to_string(count) +
         "\nproperty double x\nproperty double y\nproperty double z\n" + property + "end_header\n" +
         sphere_rows(count, 1, center_x, 0, value);
}

class RunPipe : public RunTool
{
};

TEST_F(RunPipe, reads_ply_and_pcd_from_standard_input_and_writes_ply_to_standard_output)
{
  write("in.ply", ply_sphere(0, "", ""));
  ASSERT_EQ(run("-q in.ply out.ply"), 0) << errors();
  ASSERT_EQ(run("-q - - <in.ply"), 0) << errors();
  EXPECT_EQ(output(), read("out.ply"));
  EXPECT_EQ(errors(), "");
  ASSERT_EQ(run("-q in.ply - | '" TOOL "' -q -r 0.5 - piped.ply"), 0) << errors();
  EXPECT_LT(read_points(path("piped.ply"), Parallel(1)).size(), read_points(path("out.ply"), Parallel(1)).size());

  write("in.pcd",
        "VERSION 0.7\nFIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 3000\nHEIGHT 1\nPOINTS 3000\n"
        "DATA ascii\n" +
            sphere_rows(3000, 1, 0, 0));
  ASSERT_EQ(run("-q - - <in.pcd"), 0) << errors();
  EXPECT_EQ(output(), read("out.ply"));
}

TEST_F(RunPipe, says_what_is_wrong_with_standard_input_and_leaves_standard_output_empty)
{
  for (const char* text : {"", "ply\n", "1 2 3\n",
                           "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\n"
                           "property float y\nproperty float z\nend_header\n1 2 3\n"}) {
    write("in", text);
    EXPECT_EQ(run("-q - - <in"), 1) << text;
    EXPECT_TRUE(complained_of("standard input: ")) << text;
  }
  write("in", "LASF");
  EXPECT_EQ(run("-q - - <in"), 1);
  EXPECT_TRUE(complained_of("is neither a PLY nor a PCD; "));
  write("in.ply", ply_sphere(0, "", ""));
  EXPECT_EQ(run("-q - - - <in.ply"), 2);
  EXPECT_TRUE(complained_of("named twice"));
  EXPECT_EQ(run("-q in.ply - >/dev/full; }", "{"), 1);
  EXPECT_TRUE(complained_of("standard output: cannot be written"));
}

TEST_F(RunPipe, merges_inputs_and_numbers_their_points)
{
  write("a.ply", ply_sphere(0, "property uchar class\n", " 2"));
  write("b.ply", ply_sphere(5, "property float intensity\n", " 0.5"));
  ASSERT_EQ(run("a.ply b.ply out.ply"), 0) << errors();
  EXPECT_NE(errors().find("a.ply: has no intensity"), std::string::npos);
  EXPECT_NE(errors().find("b.ply: has no class"), std::string::npos);
  const PointTable mesh = read_points(path("out.ply"), Parallel(1));
  EXPECT_EQ(describe_fields(mesh), "x:double y:double z:double class:uchar intensity:float scan:ushort");
  std::size_t of_second = 0;
  for (std::size_t row = 0; row < mesh.size(); ++row) {
    const std::vector<double> values = row_values(mesh, row);
    of_second += values[0] > 2.5;
    ASSERT_EQ(values[5], values[0] > 2.5 ? 2 : 1);
    ASSERT_EQ(values[3], values[0] > 2.5 ? 0 : 2);
  }
  EXPECT_GT(of_second, 50U);
  EXPECT_LT(of_second, mesh.size() - 50);

  EXPECT_EQ(run("-q a.ply missing.ply out2.ply"), 1);
  EXPECT_TRUE(complained_of("missing.ply: there is no such file"));
  EXPECT_EQ(files(), (Names{"a.ply", "b.ply", "out.ply"}));
}

TEST_F(RunPipe, turns_each_scan_to_where_its_own_sensor_stood)
{
  const auto wall = [](double z, double sensor_z) {
    std::string rows;
    constexpr int side = 50;  // points
    for (int i = 0; i < side; ++i) {
      for (int j = 0; j < side; ++j) {
        rows += std::to_string(i) + ' ' + std::to_string(j + 0.3 * (i % 3)) + ' ' + std::to_string(z) + '\n';
      }
    }
    const std::string count = std::to_string(side * side);
    return "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " + count +
           "\nHEIGHT 1\nVIEWPOINT 25 25 " + std::to_string(sensor_z) + " 1 0 0 0\nPOINTS " + count + "\nDATA ascii\n" +
           rows;
  };
  for (const double side : {1.0, -1.0}) {
    write("a.pcd", wall(0, 100 * side));
    write("b.pcd", wall(-30, -100 * side));
    ASSERT_EQ(run("-q --normals a.pcd b.pcd out.ply"), 0) << errors();
    const PointTable mesh = read_points(path("out.ply"), Parallel(1));
    ASSERT_GT(mesh.size(), 100U);
    for (std::size_t row = 0; row < mesh.size(); ++row) {
      const double of_scan = mesh.value(row, *mesh.find("scan")) == 1 ? side : -side;
      ASSERT_EQ(mesh.value(row, *mesh.find("vp_z")), 100 * of_scan);
      ASSERT_GT(mesh.value(row, *mesh.find("nz")) * of_scan, 0.9);
    }
  }
  write("c.ply", ply_sphere(200, "property float vp_x\nproperty float vp_y\nproperty float vp_z\n", " 5 6 7"));
  ASSERT_EQ(run("a.pcd c.ply out.ply"), 0) << errors();
  EXPECT_EQ(errors().find("has no"), std::string::npos) << "the first has a viewpoint: " << errors();
}

TEST_F(RunPipe, meshes_the_wanted_classes_of_a_las_file_and_keeps_its_coordinates_to_the_last_bit)
{
  LasFile file(2, 1, 28);
  std::set<std::vector<double>> ground;
  for (std::int32_t i = 0; i < 60; ++i) {
    for (std::int32_t j = 0; j < 60; ++j) {
      file.add(las_record(1000 * i + 7 * j, 1000 * j + 3 * i, (i * i + j) % 17, 2));
      ground.insert(
          {0.001 * (1000 * i + 7 * j) + 500000, 0.001 * (1000 * j + 3 * i) + 5000000, 0.01 * ((i * i + j) % 17)});
      file.add(las_record(1000 * i, 1000 * j, 900, 5));
    }
  }
  write("in.las", file.bytes());
  ASSERT_EQ(run("-q --class 2 --normals in.las out.ply"), 0) << errors();
  const PointTable mesh = read_points(path("out.ply"), Parallel(1));
  ASSERT_GT(mesh.size(), 100U);
  for (std::size_t row = 0; row < mesh.size(); ++row) {
    const std::vector<double> values = row_values(mesh, row);
    ASSERT_EQ(ground.count({values[0], values[1], values[2]}), 1U);
    ASSERT_GT(mesh.value(row, *mesh.find("nz")), 0.5) << "terrain faces up";
  }
  EXPECT_EQ(run("-q --class 9 in.las none.ply"), 1);
  EXPECT_TRUE(complained_of("in.las: has no points of the classes of --class; it holds 2, 5"));
}

}  // namespace
}  // namespace pds
