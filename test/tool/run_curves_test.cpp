// SPDX-License-Identifier: BSD-3-Clause
#include "run_testing.h"

#include <nlohmann/json.hpp>

namespace pds
{
namespace
{

class RunCurves : public RunTool
{
 protected:
  /** \brief Points of a circle about the origin. */
  static std::string circle_rows(double radius)
  {
    constexpr int count = 3000;
    std::string rows;
    for (int i = 0; i < count; ++i) {
      const double angle = 2 * 3.14159265358979323846 * i / count;
      rows += std::to_string(radius * std::cos(angle)) + " " + std::to_string(radius * std::sin(angle)) + " 0\n";
    }
    return rows;
  }

  [[nodiscard]] nlohmann::json report() const { return nlohmann::json::parse(read("report.json")); }
};

TEST_F(RunCurves, a_circle_becomes_a_polyline_in_every_format_that_has_them)
{
  write("in.xyz", circle_rows(1));
  for (const char* output : {"out.ply", "out.obj", "out.glb"}) {
    ASSERT_EQ(run(std::string("--dimension 1 --report report.json in.xyz ") + output), 0) << errors();
    EXPECT_NE(errors().find("curves: 1 (1 closed)"), std::string::npos) << errors();
    EXPECT_GT(read(output).size(), 1000U);
  }
  EXPECT_EQ(report()["curves"], 1);
  EXPECT_EQ(report()["closed_curves"], 1);
  EXPECT_EQ(report()["segments"], report()["vertices"]);
  EXPECT_EQ(report()["faces"], 0);
}

TEST_F(RunCurves, auto_says_what_each_part_is)
{
  write("in.xyz", circle_rows(5) + sphere_rows(4000, 1, 0, 0));
  ASSERT_EQ(run("--dimension auto --report report.json --voronoi v.ply in.xyz out.ply"), 0) << errors();
  EXPECT_NE(errors().find("curves: 1 (1 closed)"), std::string::npos) << errors();
  EXPECT_NE(errors().find("surfaces: 1, "), std::string::npos) << errors();
  EXPECT_EQ(report()["curves"], 1);
  EXPECT_EQ(report()["components"], 2);
  EXPECT_EQ(report()["closed"], true);
  const std::string header = read("out.ply").substr(0, 400);
  EXPECT_NE(header.find("element face "), std::string::npos);
  EXPECT_NE(header.find("element edge " + report()["segments"].dump() + "\n"), std::string::npos);
}

TEST_F(RunCurves, what_is_no_curve_is_refused_in_one_line)
{
  write("sphere.xyz", sphere_rows(4000, 1, 0, 0));
  EXPECT_EQ(run("--quiet --dimension 1 sphere.xyz out.ply"), 1);
  EXPECT_TRUE(complained_of("sphere.xyz: no curves came out of 4000 points"));
  write("point.xyz", "1 2 3\n1 2 3\n");
  EXPECT_EQ(run("--quiet --dimension 1 point.xyz out.ply"), 1);
  EXPECT_TRUE(complained_of("all points are in one place"));
  EXPECT_EQ(run("--dimension 1 sphere.xyz out.stl"), 2);
  EXPECT_TRUE(complained_of("'.stl' holds triangles only"));
  EXPECT_FALSE(std::filesystem::exists(path("out.ply")) || std::filesystem::exists(path("out.stl")));
}

}  // namespace
}  // namespace pds
