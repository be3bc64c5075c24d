// SPDX-License-Identifier: BSD-3-Clause
#include "io/glb_writer.h"

#include "glb_testing.h"
#include "reader_testing.h"
#include "temporary_directory.h"

#include <Eigen/Geometry>
#include <cmath>

namespace pds
{
namespace
{

class GlbWriter : public TemporaryDirectory
{
 protected:
  [[nodiscard]] Glb write_and_parse(const PointTable& points,
                                    const Triangles& triangles,
                                    const Segments& segments = {}) const
  {
    {
      AtomicFile file(path("mesh.glb"));
      write_glb(file, points, triangles, segments);
      file.finish();
      file.commit();
    }
    return parse_glb(read("mesh.glb"));
  }
};

TEST_F(GlbWriter, places_a_utm_mesh_by_a_translation)
{
  PointTable points = table_with({{"x y z", ScalarType::float64}}, 4);
  const std::vector<std::vector<double>> rows = {{500000.001, 5234567.123, 0},
                                                 {500002.001, 5234567.123, 0},
                                                 {500000.001, 5234569.123, 0},
                                                 {500000.5, 5234568, 7.25}};
  for (std::size_t row = 0; row < rows.size(); ++row) {
    set_row(points, row, rows[row]);
  }
  const Glb glb = write_and_parse(points, {{0, 1, 2}, {0, 2, 3}});
  const auto translation = glb.description["nodes"][0]["translation"].get<std::vector<double>>();
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const std::vector<double> position = glb.vector("POSITION", row);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(position[i] + translation[i], rows[row][i], 1e-6);
    }
  }
  const Json& indices = glb.description["accessors"][glb.primitive()["indices"].get<std::size_t>()];
  EXPECT_EQ(indices["count"], 6);
  const std::size_t begin = glb.description["bufferViews"][indices["bufferView"].get<std::size_t>()]["byteOffset"];
  const auto corners = number_at<std::array<std::uint32_t, 6>>(glb.binary.data() + begin);
  EXPECT_EQ(corners, (std::array<std::uint32_t, 6>{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(glb.description["asset"]["version"], "2.0");
}

TEST_F(GlbWriter, turns_z_up_by_the_node_alone)
{
  PointTable points = table_with({{"x y z", ScalarType::float64}}, 3);
  const std::vector<double> row = {500000.25, 5234567.5, 100};
  set_row(points, 0, row);
  set_row(points, 1, {500002.25, 5234567.5, 100});
  set_row(points, 2, {500000.25, 5234569.5, 107});
  const Glb before = write_and_parse(points, {{0, 1, 2}});
  EXPECT_FALSE(before.description["nodes"][0].contains("rotation"));
  points.z_is_up = true;
  const Glb glb = write_and_parse(points, {{0, 1, 2}});
  EXPECT_EQ(glb.binary, before.binary) << "the vertices stay as they are";
  const Json& node = glb.description["nodes"][0];
  const auto q = node["rotation"].get<std::vector<double>>();
  const auto translation = node["translation"].get<std::vector<double>>();
  const std::vector<double> position = glb.vector("POSITION", 0);
  const Eigen::Vector3d turned = Eigen::Quaterniond(q[3], q[0], q[1], q[2]) * Eigen::Vector3d(position.data());
  const std::vector<double> wanted = {row[0], row[2], -row[1]};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(turned[static_cast<Eigen::Index>(i)] + translation[i], wanted[i], 1e-6);
  }
}

TEST_F(GlbWriter, draws_curves_as_lines)
{
  const PointTable points({{"x", ScalarType::float32}, {"y", ScalarType::float32}, {"z", ScalarType::float32}}, 3);
  const Glb curves = write_and_parse(points, {}, {{0, 1}, {1, 2}});
  EXPECT_EQ(curves.description["meshes"][0]["primitives"].size(), 1U);
  EXPECT_EQ(curves.primitive()["mode"], 1);
  EXPECT_EQ(curves.description["accessors"][curves.primitive()["indices"].get<std::size_t>()]["count"], 4);
  const Glb both = write_and_parse(points, {{0, 1, 2}}, {{0, 1}});
  EXPECT_EQ(both.description["meshes"][0]["primitives"].size(), 2U);
  EXPECT_EQ(both.primitive()["mode"], 4);
}

TEST_F(GlbWriter, keeps_float_positions_to_the_last_bit_with_normals_and_linear_colors)
{
  PointTable points = table_with({{"x y z nx ny nz", ScalarType::float32}, {"red green blue", ScalarType::uint8}}, 3);
  const std::vector<double> row = {static_cast<double>(0.1F), 1000, -3, 0, 2, 0, 255, 128, 0};
  set_row(points, 1, row);
  const Glb glb = write_and_parse(points, {{0, 1, 2}});
  EXPECT_FALSE(glb.description["nodes"][0].contains("translation"));
  EXPECT_EQ(glb.vector("POSITION", 1), (std::vector<double>{row[0], row[1], row[2]}));
  EXPECT_EQ(glb.vector("NORMAL", 1), (std::vector<double>{0, 1, 0})) << "of unit length";
  EXPECT_EQ(glb.vector("NORMAL", 0), (std::vector<double>{0, 0, 1})) << "a zero normal is not allowed";
  const std::vector<double> color = glb.vector("COLOR_0", 1);
  EXPECT_EQ(color[0], 1);
  EXPECT_NEAR(color[1], 0.215861, 1e-5) << "sRGB 128 is 21.6 % of the light";
  EXPECT_EQ(color[2], 0);
  EXPECT_EQ(color[3], 1);
}

TEST_F(GlbWriter, has_colors_of_floats)
{
  PointTable points = table_with({{"x y z red green blue", ScalarType::float32}}, 3);
  set_row(points, 0, {0, 0, 0, 1, 0.5, std::nan("")});
  const std::vector<double> color = write_and_parse(points, {{0, 1, 2}}).vector("COLOR_0", 0);
  EXPECT_EQ(color[0], 1);
  EXPECT_NEAR(color[1], 0.214041, 1e-5);
  EXPECT_EQ(color[2], 0) << "no colour is black";
}

}  // namespace
}  // namespace pds
