// SPDX-License-Identifier: BSD-3-Clause
#include "html/assets.h"
#include "io/read_points.h"
#include "run_testing.h"

#include <nlohmann/json.hpp>

namespace pds
{
namespace
{

using Names = std::vector<std::string>;

/** Pages, made without a display that could draw: only the cases whose names say so start one. */
class RunPage : public RunTool
{
 protected:
  RunPage() { write("in.xyz", sphere_rows(4000, 1, 500000, 5000000)); }

  int run_without_display(const std::string& arguments) { return run(arguments, "PATH= DISPLAY= "); }

  [[nodiscard]] bool holds(const std::string& text) const { return read("p.html").find(text) != std::string::npos; }
};

TEST_F(RunPage, shows_what_the_report_says)
{
  const std::string stray_points = "500000 5000000 40\n500000 5000030 0\n";
  write("in.xyz", read("in.xyz") + stray_points);
  ASSERT_EQ(run_without_display("-k 17 --html p.html --report r.json in.xyz out.ply"), 0) << errors();
  EXPECT_EQ(files(), (Names{"in.xyz", "out.ply", "p.html", "r.json"}));
  const auto report = nlohmann::json::parse(read("r.json"));
  const auto row = [](const std::string& name, const std::string& value) {
    return "<tr><th scope=\"row\">" + name + "</th><td>" + value + "</td></tr>";
  };
  EXPECT_TRUE(holds(row("--k-neighbors", "17")));
  EXPECT_TRUE(holds(row("--html", "p.html")));
  EXPECT_TRUE(holds(row("Points given", "4,002")));
  EXPECT_EQ(report["outliers"], 2);
  EXPECT_TRUE(holds(row("outliers left out", "2")));
  EXPECT_TRUE(holds(row("Noise smoothed", report["smoothed"].get<bool>() ? "yes" : "no")));
  EXPECT_TRUE(holds(row("Vertices", std::to_string(report["vertices"].get<int>()))));
  for (const auto& [stage, seconds] : report["seconds"].items()) {
    const std::string name = stage == "seed_graph" ? "seed graph" : stage == "save" ? "save, and this page" : stage;
    EXPECT_TRUE(holds("<th scope=\"row\">" + name + "</th>")) << stage;
  }
  EXPECT_TRUE(holds("<li class=\"good\">0 edges of more than two triangles</li>"));
  EXPECT_TRUE(holds("The surface is closed; 1 component; Euler characteristic 2; genus 0."));
  EXPECT_TRUE(holds("<h3>Edge length</h3><svg"));
  EXPECT_TRUE(holds("<h3>Smallest angle of each triangle</h3><svg"));
  EXPECT_FALSE(holds("class=\"bad\""));
  EXPECT_FALSE(holds("{{"));
}

TEST_F(RunPage, says_in_the_page_and_in_a_line_that_there_are_no_pictures_without_a_display)
{
  ASSERT_EQ(run_without_display("--html p.html in.xyz out.ply"), 0);
  EXPECT_NE(errors().find("p.html: has no pictures: "), std::string::npos) << errors();
  EXPECT_TRUE(holds("<p class=\"note\">No pictures: "));
}

TEST_F(RunPage, draws_pictures)
{
#ifdef PICTURES
  ASSERT_EQ(run("--html p.html in.xyz out.ply"), 0) << errors();
  EXPECT_EQ(errors().find("has no pictures"), std::string::npos) << errors();
  EXPECT_TRUE(holds("src=\"data:image/png;base64,iVBORw0KGgo"));
#else
  GTEST_SKIP() << "this build is without VTK or Embree";
#endif
}

TEST_F(RunPage, survives_a_display_that_vtk_does_not_like)
{
  ASSERT_EQ(run("--html p.html in.xyz out.ply", "DISPLAY=:12345 "), 0) << errors();
  EXPECT_NE(errors().find("p.html: has no pictures: "), std::string::npos) << errors();
  EXPECT_GT(read_points(path("out.ply"), Parallel(1)).size(), 0U);
}

TEST_F(RunPage, holds_the_mesh_and_the_script_that_turns_it)
{
  ASSERT_EQ(run_without_display("--html p.html in.xyz out.ply"), 0);
  if (model_viewer_script().empty()) {
    EXPECT_NE(errors().find("p.html: has no mesh to turn: "), std::string::npos) << errors();
    EXPECT_TRUE(holds("<p class=\"note\">No mesh to turn: "));
    return;
  }
  EXPECT_TRUE(holds("src=\"data:model/gltf-binary;base64,Z2xURg"));  // "glTF"
  EXPECT_TRUE(holds("customElements.define(\"model-viewer\""));
  EXPECT_FALSE(holds("sourceMappingURL"));
}

TEST_F(RunPage, does_not_let_file_names_become_html)
{
  const std::string input = "<b onload=\"x\">&'.xyz";
  const std::string output = "<script>alert(1)<&.ply";
  write(input, sphere_rows(4000, 1, 0, 0));
  const auto quoted = [](std::string name) {
    const std::size_t place = name.find('\'');
    return "'" + (place == std::string::npos ? name : name.replace(place, 1, "'\\''")) + "'";
  };
  ASSERT_EQ(run_without_display("-q --html p.html " + quoted(input) + " " + quoted(output)), 0) << errors();
  EXPECT_TRUE(holds("<h1>&lt;script&gt;alert(1)&lt;&amp;.ply</h1>"));
  EXPECT_TRUE(holds("&lt;b onload=&quot;x&quot;&gt;&amp;&#39;.xyz"));
  EXPECT_FALSE(holds("<script>alert"));
  EXPECT_FALSE(holds("<b onload"));
}

TEST_F(RunPage, is_not_written_where_it_cannot_be)
{
  EXPECT_EQ(run("--html missing/p.html in.xyz out.ply"), 1);
  EXPECT_TRUE(complained_of("no directory"));
  EXPECT_EQ(run("--html out.ply in.xyz out.ply"), 2);
  EXPECT_TRUE(complained_of("named twice"));
  EXPECT_EQ(files(), Names{"in.xyz"});
}

TEST_F(RunPage, that_outgrows_the_disk_keeps_back_the_mesh)
{
  EXPECT_EQ(run("-q -f 6 --html p.html in.xyz out.ply", "ulimit -f 32; PATH= DISPLAY= "), 1);
  EXPECT_TRUE(complained_of("p.html: cannot be written"));
  EXPECT_EQ(files(), Names{"in.xyz"});
}

}  // namespace
}  // namespace pds
