// SPDX-License-Identifier: BSD-3-Clause
#include "io/read_points.h"
#include "reader_testing.h"
#include "run_testing.h"

#include <nlohmann/json.hpp>
#include <set>

namespace pds
{
namespace
{

using Names = std::vector<std::string>;

constexpr std::size_t point_count = 4000;

/** The coordinates of every point, bit by bit. */
std::set<std::vector<double>> positions(const PointTable& table)
{
  std::set<std::vector<double>> all;
  for (std::size_t row = 0; row < table.size(); ++row) {
    const std::vector<double> values = row_values(table, row);
    all.insert({values[0], values[1], values[2]});
  }
  return all;
}

class Run : public RunTool
{
};

TEST_F(Run, utm_coordinates_come_back_to_the_last_bit)
{
  write("in.xyz", sphere_rows(point_count, 10, 500000.001, 5234567.123));
  ASSERT_EQ(run("-q in.xyz text.ply"), 0) << errors();
  EXPECT_EQ(output() + errors(), "");
  const PointTable mesh = read_points(path("text.ply"), Parallel(2));
  EXPECT_TRUE(mesh.has_double_positions());
  const auto input = positions(read_points(path("in.xyz"), Parallel(2)));
  const auto vertices = positions(mesh);
  EXPECT_EQ(vertices.size(), mesh.size()) << "each input point once";
  EXPECT_TRUE(std::includes(input.begin(), input.end(), vertices.begin(), vertices.end()));

  ASSERT_EQ(run("-q --voronoi cloud.ply in.xyz again.ply"), 0) << errors();  // the cloud as a PLY of doubles
  ASSERT_EQ(run("-q cloud.ply ply.ply"), 0) << errors();
  EXPECT_EQ(positions(read_points(path("ply.ply"), Parallel(2))), vertices);
}

TEST_F(Run, says_how_many_points_are_on_no_face)
{
  constexpr std::size_t few = 500;
  write("in.xyz", sphere_rows(point_count, 1, 0, 0) + sphere_rows(few, 0.01, 3, 0));
  ASSERT_EQ(run("in.xyz out.ply"), 0) << errors();
  EXPECT_NE((output() + errors()).find("500 of 4500 points are on no face"), std::string::npos) << errors();
  write("in.xyz", sphere_rows(point_count, 1, 0, 0));
  ASSERT_EQ(run("in.xyz out.ply"), 0) << errors();
  EXPECT_EQ((output() + errors()).find("on no face"), std::string::npos) << errors();
}

TEST_F(Run, colors_and_intensity_of_a_pcd_reach_the_ply)
{
  write("in.pcd", "VERSION 0.7\nFIELDS x y z rgb intensity\nSIZE 4 4 4 4 4\nTYPE F F F U F\nCOUNT 1 1 1 1 1\nWIDTH " +
                      std::to_string(point_count) + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " +
                      std::to_string(point_count) + "\nDATA ascii\n" +
                      sphere_rows(point_count, 1, 0, 0, " 16744703 0.1"));
  ASSERT_EQ(run("-q in.pcd out.ply"), 0) << errors();
  const PointTable mesh = read_points(path("out.ply"), Parallel(2));
  EXPECT_EQ(describe_fields(mesh), "x:float y:float z:float red:uchar green:uchar blue:uchar intensity:float");
  for (std::size_t row = 0; row < mesh.size(); ++row) {
    const std::vector<double> values = row_values(mesh, row);
    ASSERT_EQ(std::vector<double>(values.begin() + 3, values.end()),
              (std::vector<double>{255, 128, 255, static_cast<double>(0.1F)}));
  }
}

TEST_F(Run, report_and_voronoi_file_agree_with_the_mesh)
{
  write("in.xyz", sphere_rows(point_count, 1, 0, 0) + "nan nan nan\n");
  ASSERT_EQ(run("--report r.json --voronoi v.ply in.xyz out.ply"), 0) << errors();
  EXPECT_EQ(files(), (Names{"in.xyz", "out.ply", "r.json", "v.ply"}));
  const auto report = nlohmann::ordered_json::parse(read("r.json"));
  EXPECT_EQ(report["input_points"], point_count + 1);
  EXPECT_EQ(report["valid_points"], point_count);
  EXPECT_EQ(report["vertices"], read_points(path("out.ply"), Parallel(2)).size());
  EXPECT_GT(report["peak_rss_bytes"], 1000000);
  std::vector<std::string> stages;
  std::size_t peak = 1000000;
  for (const auto& [stage, bytes] : report["stage_peak_rss_bytes"].items()) {
    stages.push_back(stage);
    EXPECT_GE(bytes, peak) << stage;
    peak = bytes;
  }
  EXPECT_EQ(stages.front(), "load");
  EXPECT_EQ(stages.back(), "save");
  EXPECT_EQ(peak, report["peak_rss_bytes"]);
  const auto& seconds = report["seconds"];
  EXPECT_GT(seconds["load"], 0);
  EXPECT_GT(seconds["save"], 0);
  EXPECT_GE(seconds["total"].get<double>(), seconds["load"].get<double>() + seconds["save"].get<double>());

  const PointTable cloud = read_points(path("v.ply"), Parallel(2));
  EXPECT_EQ(describe_fields(cloud), "x:double y:double z:double label:int distance:float witness:uchar seed:uchar");
  ASSERT_EQ(cloud.size(), point_count + 1);
  EXPECT_EQ(cloud.value(point_count, *cloud.find("label")), -1);
  EXPECT_TRUE(std::isnan(cloud.value(point_count, *cloud.find("distance"))));
  std::size_t seeds = 0;
  std::size_t witnesses = 0;
  for (std::size_t row = 0; row < point_count; ++row) {
    seeds += cloud.value(row, *cloud.find("seed")) == 1;
    witnesses += cloud.value(row, *cloud.find("witness")) == 1;
    EXPECT_LE(cloud.value(row, *cloud.find("distance")), report["radius"].get<double>() * 1.001);
    EXPECT_LT(cloud.value(row, *cloud.find("label")), report["seeds"].get<double>());
    EXPECT_GE(cloud.value(row, *cloud.find("label")), 0);
  }
  EXPECT_EQ(report["seeds"], seeds);
  EXPECT_GT(witnesses, 0U);
  EXPECT_LT(witnesses, point_count / 2);
}

TEST_F(Run, quadric_placement_gives_means_of_quantities_and_keeps_classes)
{
  write("in.txt", "x y z nx ny nz intensity classification\n" + sphere_rows(point_count, 1, 0, 0, " 0 0 2 0.25 6"));
  ASSERT_EQ(run("-q in.txt point.ply"), 0) << errors();
  ASSERT_EQ(run("-q --placement quadric in.txt quadric.ply"), 0) << errors();
  const PointTable on_points = read_points(path("point.ply"), Parallel(2));
  const PointTable moved = read_points(path("quadric.ply"), Parallel(2));
  ASSERT_EQ(moved.size(), on_points.size());
  EXPECT_EQ(describe_fields(moved), describe_fields(on_points));
  std::size_t on_sphere = 0;
  for (std::size_t row = 0; row < moved.size(); ++row) {
    const std::vector<double> values = row_values(moved, row);
    on_sphere += std::abs(std::hypot(values[0], values[1], values[2]) - 1) < 1e-6 ? 1U : 0U;
    EXPECT_EQ((std::vector<double>(values.begin() + 3, values.end())), (std::vector<double>{0, 0, 1, 0.25, 6}));
  }
  EXPECT_LT(on_sphere, moved.size() / 2) << "vertices lie beyond the bend of the surface";
}

TEST_F(Run, levels_are_written_beside_each_other_and_nested)
{
  write("in.xyz", sphere_rows(point_count, 10, 0, 0));
  ASSERT_EQ(run("-q --levels 2 in.xyz out.ply"), 0) << errors();
  const auto fine = positions(read_points(path("out.ply"), Parallel(2)));
  const auto coarse = positions(read_points(path("out_1.ply"), Parallel(2)));
  EXPECT_LT(coarse.size(), fine.size() / 3);
  EXPECT_TRUE(std::includes(fine.begin(), fine.end(), coarse.begin(), coarse.end()));
  EXPECT_EQ(run("-q --levels 16 in.xyz none.ply"), 1);
  EXPECT_TRUE(complained_of("in.xyz: no faces"));
  EXPECT_FALSE(std::filesystem::exists(path("none.ply")));
}

TEST_F(Run, logs_stages_unless_quiet_and_more_if_verbose)
{
  write("in.xyz", sphere_rows(point_count, 1, 0, 0));
  ASSERT_EQ(run("in.xyz out.ply"), 0);
  EXPECT_NE(errors().find("sampling"), std::string::npos);
  EXPECT_NE(errors().find("vertices"), std::string::npos);
  EXPECT_EQ(errors().find("k-neighbors"), std::string::npos);
  ASSERT_EQ(run("-v in.xyz out.ply"), 0);
  EXPECT_NE(errors().find("k-neighbors = 15"), std::string::npos);
  EXPECT_NE(errors().find("sampling: "), std::string::npos);
  EXPECT_EQ(output(), "");
}

TEST_F(Run, says_what_a_format_drops_unless_quiet)
{
  write("in.xyz", sphere_rows(point_count, 1, 0, 0, " 0.5"));
  ASSERT_EQ(run("in.xyz out.obj"), 0);
  EXPECT_NE(errors().find("cannot hold the fields intensity"), std::string::npos);
  ASSERT_EQ(run("-q in.xyz out.obj"), 0);
  EXPECT_EQ(errors(), "");
}

TEST_F(Run, saved_config_makes_the_same_mesh)
{
  write("in.xyz", sphere_rows(point_count, 1, 0, 0));
  ASSERT_EQ(run("-q -k 20 -f 2.5 -a 0.2 --seed 5 --save-config run.ini in.xyz a.ply"), 0) << errors();
  ASSERT_EQ(run("--config run.ini in.xyz b.ply"), 0) << errors();
  EXPECT_EQ(errors(), "") << "quiet is saved too";
  EXPECT_EQ(read("a.ply"), read("b.ply"));
  ASSERT_EQ(run("-q in.xyz c.ply"), 0);
  EXPECT_NE(read("a.ply"), read("c.ply")) << "the options matter";
}

}  // namespace
}  // namespace pds
