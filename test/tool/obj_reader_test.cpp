// SPDX-License-Identifier: BSD-3-Clause
#include "io/obj_reader.h"

#include "reader_testing.h"

namespace pds
{
namespace
{

using Values = std::vector<double>;

TEST(ObjReader, reads_vertices_in_double)
{
  const PointTable table = read_obj("# two\r\nv 500000.001 5234567.123 1\r\nv 4 5 6 1.0\r\n");
  EXPECT_EQ(describe_fields(table), "x:double y:double z:double");
  ASSERT_EQ(table.size(), 2U);
  EXPECT_EQ(row_values(table, 0), (Values{500000.001, 5234567.123, 1}));
  EXPECT_EQ(row_values(table, 1), (Values{4, 5, 6}));
  EXPECT_EQ(table.not_read, "weights");
}

TEST(ObjReader, says_what_it_does_not_read)
{
  EXPECT_EQ(read_obj("# a comment\nv 1 2 3\n").not_read, "");
  EXPECT_EQ(read_obj("mtllib a.mtl\no duck\nv 1 2 3\nvt 0 1\nusemtl skin\nf 1/1 1/1 1/1\nl 1 1\nf 1 1 1\n").not_read,
            "materials, groups, texture coordinates, faces and lines");
  EXPECT_EQ(read_obj("v 1 2 3\ncurv 0 1 1 1\n").not_read, "statements that are not of polygons");
}

TEST(ObjReader, reads_normals_that_the_faces_give_to_the_vertices)
{
  const PointTable table = read_obj("v 1 2 3\nv 4 5 6\nvn 0 0 1\nvn 0 1 0\nvn 1 0 0\nf 1//3 2/1/-2 1//3\n");
  EXPECT_EQ(describe_fields(table), "x:double y:double z:double nx:double ny:double nz:double");
  EXPECT_EQ(row_values(table, 0), (Values{1, 2, 3, 1, 0, 0}));
  EXPECT_EQ(row_values(table, 1), (Values{4, 5, 6, 0, 1, 0}));
  const PointTable in_order = read_obj("v 1 2 3\nvn 0 0 1\nv 4 5 6\nvn 0 1 0\n");
  EXPECT_EQ(row_values(in_order, 1), (Values{4, 5, 6, 0, 1, 0})) << "a cloud without faces";
  const PointTable alike = read_obj("v 1 2 3\nvn 0 0 1\nvn 0 0 1\nf 1//1 1//2 1//1\n");
  EXPECT_EQ(row_values(alike, 0), (Values{1, 2, 3, 0, 0, 1})) << "two numbers, one normal";
}

TEST(ObjReader, says_that_it_leaves_out_normals_that_vertices_do_not_have_one_of)
{
  const std::string vertices = "v 1 2 3\nv 4 5 6\nvn 0 0 1\nvn 0 1 0\nvn 1 0 0\n";
  for (const char* faces : {"f 1//1 2//2 1//3\n", "f 1//1 1//1 1//1\n", "f 1//1 2//9 1//1\n", "f 1 2 1\n"}) {
    const PointTable table = read_obj(vertices + faces);
    EXPECT_FALSE(table.has_normals()) << faces;
    EXPECT_EQ(table.not_read, "faces and normals (not one for each vertex)") << faces;
  }
}

TEST(ObjReader, reads_colors_that_every_vertex_has)
{
  const PointTable table = read_obj("v 1 2 3 1 0 0.2\nv 4 5 6 1.0 0 0.4 1\n");
  EXPECT_EQ(describe_fields(table), "x:double y:double z:double red:uchar green:uchar blue:uchar");
  EXPECT_EQ(row_values(table, 0), (Values{1, 2, 3, 255, 0, 51}));
  EXPECT_EQ(row_values(table, 1), (Values{4, 5, 6, 0, 102, 255}));
  for (const char* file : {"v 1 2 3 1 0 0.2\nv 4 5 6\n", "v 1 2 3 1 0 2\n"}) {
    EXPECT_EQ(read_obj(file).fields().size(), 3U);
    EXPECT_EQ(read_obj(file).not_read, "colours (not one in 0 ... 1 for each vertex)");
  }
}

TEST(ObjReader, tells_the_bits_of_colors_by_their_digits)
{
  const auto color = [](const std::string& channel) {
    const PointTable table = read_obj("v 1 2 3 0 1 " + channel + "\n");
    return std::string(ply_name(*table.color_type())) + " " + std::to_string(table.value(0, *table.find("blue")));
  };
  EXPECT_EQ(color("0.501961"), "uchar 128.000000") << "128 / 255 to six digits";
  EXPECT_EQ(color("0.502"), "uchar 128.000000");
  EXPECT_EQ(color("0.5019607843137255"), "uchar 128.000000");
  EXPECT_EQ(color("0.501976"), "ushort 32897.000000") << "32897 / 65535 to six digits";
  EXPECT_EQ(color("0.5019760433356222"), "ushort 32897.000000");
  EXPECT_EQ(color("1.525902189669642e-05"), "ushort 1.000000");
  EXPECT_EQ(color("0.5"), "double 0.500000");
  EXPECT_EQ(color("0.1234567890"), "double 0.123457");
}

TEST(ObjReader, names_the_line_that_is_wrong)
{
  EXPECT_NE(complaint([] { return read_obj("v 1 2 3\nv 1 2\n"); }).find("line 2"), std::string::npos);
  for (const char* wrong : {"v 1 2 z\n", "v 1 2 3 4 5 z\n", "vn 0 1\n", "f 1//x\n", "f -1//1\n"}) {
    EXPECT_NE(complaint([wrong] { return read_obj(wrong); }).find("line 1"), std::string::npos) << wrong;
  }
}

}  // namespace
}  // namespace pds
