// SPDX-License-Identifier: BSD-3-Clause
#include "io/write_mesh.h"

#include "all_types.h"
#include "io/read_points.h"
#include "reader_testing.h"
#include "temporary_directory.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace pds
{
namespace
{

using Values = std::vector<double>;

const Triangles one_triangle = {{0, 1, 2}};
const Segments two_segments = {{0, 1}, {1, 2}};

/** Three points of a scan in UTM with fields of all kinds. */
PointTable utm_points()
{
  PointTable table = table_with({{"x y z", ScalarType::float64},
                                 {"nx ny nz", ScalarType::float32},
                                 {"red green blue", ScalarType::uint8},
                                 {"intensity", ScalarType::float32},
                                 {"class", ScalarType::int8}},
                                0);
  const std::vector<Values> rows = {{500000.001, 5234567.123, 1.0 / 3, 0, 0, 1, 255, 128, 3, 0.1, -128},
                                    {500001.002, 5234567.124, 1e-300, 0, 0.6, 0.8, 0, 1, 2, 1e-30, 127},
                                    {500000.003, 5234568.125, 0.1, 1, 0, 0, 4, 5, 6, -7.5, 0}};
  table.resize(rows.size());
  for (std::size_t row = 0; row < rows.size(); ++row) {
    set_row(table, row, rows[row]);
  }
  return table;
}

class WriteMesh : public TemporaryDirectory
{
 protected:
  /** \return path of the file */
  std::string save(const std::string& name,
                   const PointTable& points,
                   bool ascii = false,
                   const Triangles& triangles = one_triangle,
                   const Segments& segments = {}) const
  {
    AtomicFile file(path(name));
    write_mesh(file, std::filesystem::path(name).extension().string(), points, triangles, ascii, segments);
    file.finish();
    file.commit();
    return path(name);
  }
};

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST_F(WriteMesh, ply_gives_every_bit_of_every_field_back)
{
  std::vector<Field> types = all_types();
  const auto is_wide = [](const Field& field) {  // which PLY has not
    return field.type == ScalarType::int64 || field.type == ScalarType::uint64;
  };
  types.erase(std::remove_if(types.begin(), types.end(), is_wide), types.end());
  const PointTable points = points_with(types);
  for (const bool ascii : {false, true}) {
    const PointTable same = read_points(save("mesh.ply", points, ascii), Parallel(2));
    EXPECT_EQ(describe_fields(same), describe_fields(points));
    ASSERT_EQ(same.size(), points.size());
    for (std::size_t row = 0; row < points.size(); ++row) {
      EXPECT_EQ(row_values(same, row), row_values(points, row)) << "ascii: " << ascii;
    }
  }
}

TEST_F(WriteMesh, ply_has_curves)
{
  const PointTable points = utm_points();
  const std::string ascii = read(std::filesystem::path(save("a.ply", points, true, {}, two_segments)).filename());
  EXPECT_TRUE(contains(ascii, "element edge 2\nproperty int vertex1\nproperty int vertex2\nend_header\n"));
  EXPECT_FALSE(contains(ascii, "element face"));
  EXPECT_EQ(ascii.substr(ascii.size() - 8), "0 1\n1 2\n");
  const std::string binary = read(std::filesystem::path(save("b.ply", points, false, {}, two_segments)).filename());
  EXPECT_EQ(binary.substr(binary.size() - 16), std::string("\0\0\0\0\1\0\0\0\1\0\0\0\2\0\0\0", 16));
  const std::string both =
      read(std::filesystem::path(save("c.ply", points, true, one_triangle, two_segments)).filename());
  EXPECT_TRUE(contains(both, "3 0 1 2\n0 1\n1 2\n"));
  EXPECT_EQ(read_points(path("c.ply"), Parallel(1)).size(), points.size());
}

TEST_F(WriteMesh, obj_has_curves)
{
  const std::string text = read(std::filesystem::path(save("a.obj", utm_points(), false, {}, two_segments)).filename());
  EXPECT_TRUE(contains(text, "\nl 1 2\nl 2 3\n"));
  EXPECT_FALSE(contains(text, "\nf "));
}

TEST_F(WriteMesh, ply_has_faces)
{
  const std::string ascii = read(std::filesystem::path(save("a.ply", utm_points(), true)).filename());
  EXPECT_TRUE(contains(ascii, "element face 1\nproperty list uchar int vertex_indices\nend_header\n"));
  EXPECT_TRUE(contains(ascii, "\n3 0 1 2\n"));
  save("b.ply", utm_points());
  const std::string face = bytes_of(std::uint8_t{3}) + bytes_of(0) + bytes_of(1) + bytes_of(2);
  const std::string binary = read("b.ply");
  ASSERT_GE(binary.size(), face.size());
  EXPECT_EQ(binary.substr(binary.size() - face.size()), face);
}

TEST_F(WriteMesh, obj_gives_coordinates_normals_and_colors_back_to_the_last_bit)
{
  const PointTable points = utm_points();
  const PointTable same = read_points(save("mesh.obj", points), Parallel(2));
  ASSERT_EQ(same.size(), points.size());
  for (std::size_t row = 0; row < points.size(); ++row) {
    for (const Field& field : same.fields()) {
      const Field& original = *points.find(field.name);
      const double value = same.value(row, field);
      const bool is_float = original.type == ScalarType::float32;  // the text has as many digits as tell floats apart
      EXPECT_EQ(is_float ? static_cast<float>(value) : value, points.value(row, original)) << field.name;
    }
  }
  EXPECT_EQ(describe_fields(same),
            "x:double y:double z:double nx:double ny:double nz:double red:uchar green:uchar blue:uchar");
  EXPECT_TRUE(contains(read("mesh.obj"), "\nvn 0 0 1\n"));
  EXPECT_TRUE(contains(read("mesh.obj"), "\nf 1//1 2//2 3//3\n"));
}

TEST_F(WriteMesh, stl_holds_one_facet_facing_the_viewer_of_its_turn)
{
  PointTable points = table_with({{"x y z", ScalarType::float32}}, 0);
  points.resize(3);
  points.set_value(1, points.fields()[0], 1);
  points.set_value(2, points.fields()[1], 1);
  save("a.stl", points, true);
  EXPECT_EQ(read("a.stl"),
            "solid pcl_pds_recon\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
            "endfacet\nendsolid pcl_pds_recon\n");
  save("b.stl", points);
  const std::string binary = read("b.stl");
  ASSERT_EQ(binary.size(), 84U + 50U);
  EXPECT_EQ(binary.substr(80, 16), bytes_of(std::uint32_t{1}) + bytes_of(0.F) + bytes_of(0.F) + bytes_of(1.F));
}

TEST_F(WriteMesh, vtk_formats_name_the_fields)
{
#ifndef PCL_PDS_RECON_WITH_VTK
  GTEST_SKIP() << "built without VTK";
#endif
  for (const char* name : {"mesh.vtk", "mesh.vtp"}) {
    for (const bool ascii : {false, true}) {
      save(name, utm_points(), ascii);
      const std::string text = read(name);
      for (const char* field : {"Normals", "RGB", "intensity", "class"}) {
        EXPECT_TRUE(contains(text, field)) << name << ' ' << field;
      }
    }
  }
  EXPECT_TRUE(contains(read("mesh.vtp"), "500000.001 5234567.123 0.3333333333333333"));
  EXPECT_TRUE(contains(read("mesh.vtk"), "500000.001 5234567.123 0.33333333333 ")) << "VTK itself rounds to 11 digits";
}

TEST_F(WriteMesh, wide_integers_become_doubles_in_ply_which_says_if_that_rounds)
{
  PointTable points =
      table_with({{"x y z", ScalarType::float32}, {"time", ScalarType::uint64}, {"id", ScalarType::int64}}, 3);
  const std::uint64_t time = (std::uint64_t{1} << 60) + 1;
  const std::int64_t id = -(std::int64_t{1} << 40);
  std::memcpy(points.record(1) + points.find("time")->offset, &time, sizeof time);
  std::memcpy(points.record(1) + points.find("id")->offset, &id, sizeof id);
  const PointTable same = read_points(save("mesh.ply", points), Parallel(1));
  EXPECT_EQ(describe_fields(same), "x:float y:float z:float time:double id:double");
  EXPECT_EQ(row_values(same, 1), (Values{0, 0, 0, std::ldexp(1.0, 60), -std::ldexp(1.0, 40)}));
  EXPECT_EQ(lost_in_format(".ply", points, false), "the last digits of time");
  EXPECT_EQ(lost_in_format(".vtp", points, false), "");
#ifdef PCL_PDS_RECON_WITH_VTK
  save("mesh.vtp", points, true);
  EXPECT_TRUE(contains(read("mesh.vtp"), "1152921504606846977"));
#endif
}

TEST_F(WriteMesh, obj_gives_every_sixteen_bit_color_back)
{
  constexpr std::size_t colors = std::size_t{1} << 16;
  PointTable points = table_with({{"x y z", ScalarType::float32}, {"red green blue", ScalarType::uint16}}, colors);
  for (std::size_t row = 0; row < colors; ++row) {
    points.set_value(row, *points.find("green"), static_cast<double>(row));
  }
  const PointTable same = read_points(save("mesh.obj", points), Parallel(1));
  ASSERT_EQ(same.color_type(), ScalarType::uint16);
  for (std::size_t row = 0; row < colors; ++row) {
    ASSERT_EQ(same.value(row, *same.find("green")), static_cast<double>(row));
  }
  EXPECT_EQ(lost_in_format(".obj", points, false), "");
  EXPECT_EQ(lost_in_format(".glb", points, false), "the last digits of the colours");
}

TEST_F(WriteMesh, obj_gives_floating_point_colors_back)
{
  for (const ScalarType type : {ScalarType::float32, ScalarType::float64}) {
    PointTable points = table_with({{"x y z", ScalarType::float32}, {"red green blue", type}}, 3);
    set_row(points, 0, {0, 0, 0, 0.1, 1.0 / 3, 1});
    set_row(points, 1, {0, 0, 0, std::nan(""), std::nan(""), std::nan("")});
    const PointTable same = read_points(save("mesh.obj", points), Parallel(1));
    EXPECT_EQ(describe_fields(same), "x:double y:double z:double red:double green:double blue:double");
    EXPECT_EQ(row_values(same, 0), row_values(points, 0));
    EXPECT_EQ(row_values(same, 1), Values(6, 0)) << "no colour is black";
    EXPECT_EQ(lost_in_format(".obj", points, false), "");
    EXPECT_EQ(lost_in_format(".glb", points, false), "the last digits of the colours");
  }
}

TEST(LostInFormat, names_normals_that_are_rounded)
{
  const PointTable points = table_with({{"x y z", ScalarType::float32}, {"nx ny nz", ScalarType::float64}}, 3);
  EXPECT_EQ(lost_in_format(".glb", points, false), "the last digits of the normals");
  EXPECT_EQ(lost_in_format(".obj", points, false), "");
}

TEST(LostInFormat, says_which_colors_are_held)
{
  PointTable points = table_with({{"x y z red green blue intensity", ScalarType::float32}}, 3);
  points.set_value(2, *points.find("blue"), 1.5);
  const std::string lost = "the fields red green blue intensity";
  const std::string why = " (colours only if all are uchar, ushort, or floats of 0 to 1)";
  EXPECT_EQ(lost_in_format(".glb", points, false), lost + why);
  EXPECT_EQ(lost_in_format(".obj", points, false), lost + why);
  EXPECT_EQ(lost_in_format(".stl", points, false), lost);
  EXPECT_EQ(lost_in_format(".ply", points, false), "");
}

TEST(LostInFormat, names_what_a_format_cannot_hold)
{
  const PointTable points = utm_points();
  EXPECT_EQ(lost_in_format(".ply", points, true), "");
  EXPECT_EQ(lost_in_format(".vtp", points, true), "");
  EXPECT_EQ(lost_in_format(".vtk", points, false), "");
  EXPECT_EQ(lost_in_format(".vtk", points, true), "the last digits of x y z nx ny nz intensity");
  EXPECT_EQ(lost_in_format(".obj", points, false), "the fields intensity class");
  EXPECT_EQ(lost_in_format(".glb", points, false), "the fields intensity class and the last digits of the coordinates");
  EXPECT_EQ(lost_in_format(".stl", points, false),
            "the fields nx ny nz red green blue intensity class and the last digits of the coordinates");
}

}  // namespace
}  // namespace pds
