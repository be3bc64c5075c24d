// SPDX-License-Identifier: BSD-3-Clause
#include "io/glb_writer.h"

#include "reader_testing.h"
#include "temporary_directory.h"

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

namespace pds
{
namespace
{

using Json = nlohmann::json;

template <typename Number>
Number number_at(const std::string& bytes, std::size_t place)
{
  Number number;
  std::memcpy(&number, bytes.data() + place, sizeof number);
  return number;
}

/** The parts of a .glb file, read by the book. */
struct Glb
{
  Json description;
  std::string binary;

  [[nodiscard]] std::vector<double> vector(const char* attribute, std::size_t row) const
  {
    const Json& accessor = description["accessors"][primitive()["attributes"][attribute].get<std::size_t>()];
    const std::size_t size = accessor["type"] == "VEC4" ? 4 : 3;
    const bool is_float = accessor["componentType"] == 5126;
    const std::size_t bytes = is_float ? sizeof(float) : sizeof(std::uint16_t);
    const std::size_t begin = description["bufferViews"][accessor["bufferView"].get<std::size_t>()]["byteOffset"];
    std::vector<double> values;
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t place = begin + (row * size + i) * bytes;
      values.push_back(is_float ? static_cast<double>(number_at<float>(binary, place))
                                : number_at<std::uint16_t>(binary, place) / 65535.0);
    }
    return values;
  }

  [[nodiscard]] const Json& primitive() const { return description["meshes"][0]["primitives"][0]; }
};

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
    const std::string bytes = read("mesh.glb");
    EXPECT_EQ(bytes.substr(0, 4), "glTF");
    EXPECT_EQ(number_at<std::uint32_t>(bytes, 4), 2U);
    EXPECT_EQ(number_at<std::uint32_t>(bytes, 8), bytes.size());
    const auto text_bytes = number_at<std::uint32_t>(bytes, 12);
    EXPECT_EQ(bytes.substr(16, 4), "JSON");
    EXPECT_EQ(text_bytes % 4, 0U);
    const auto binary_bytes = number_at<std::uint32_t>(bytes, 20 + text_bytes);
    EXPECT_EQ(bytes.substr(24 + text_bytes, 4), std::string("BIN\0", 4));
    EXPECT_EQ(28 + text_bytes + binary_bytes, bytes.size());
    return {Json::parse(bytes.substr(20, text_bytes)), bytes.substr(28 + text_bytes)};
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
  const auto corners = number_at<std::array<std::uint32_t, 6>>(glb.binary, begin);
  EXPECT_EQ(corners, (std::array<std::uint32_t, 6>{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(glb.description["asset"]["version"], "2.0");
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

}  // namespace
}  // namespace pds
