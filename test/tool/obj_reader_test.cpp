// SPDX-License-Identifier: BSD-3-Clause
#include "io/obj_reader.h"

#include "reader_testing.h"

namespace pds
{
namespace
{

using Values = std::vector<double>;

TEST(ObjReader, reads_vertices_in_double_and_passes_over_the_rest)
{
  const PointTable table =
      read_obj("# cube\r\nv 500000.001 5234567.123 1\r\nvn 0 0 1\r\nv 4 5 6 1.0\r\nf 1//1 2//1 1//1\r\n");
  EXPECT_EQ(describe_fields(table), "x:double y:double z:double");
  ASSERT_EQ(table.size(), 2U);
  EXPECT_EQ(row_values(table, 0), (Values{500000.001, 5234567.123, 1}));
  EXPECT_EQ(row_values(table, 1), (Values{4, 5, 6}));
}

TEST(ObjReader, reads_colors_that_every_vertex_has)
{
  const PointTable table = read_obj("v 1 2 3 1 0 0.2\nv 4 5 6 1.0 0 0.4 1\n");
  EXPECT_EQ(describe_fields(table), "x:double y:double z:double red:uchar green:uchar blue:uchar");
  EXPECT_EQ(row_values(table, 0), (Values{1, 2, 3, 255, 0, 51}));
  EXPECT_EQ(row_values(table, 1), (Values{4, 5, 6, 0, 102, 255}));
  EXPECT_EQ(read_obj("v 1 2 3 1 0 0.2\nv 4 5 6\n").fields().size(), 3U);
}

TEST(ObjReader, names_the_line_that_is_wrong)
{
  EXPECT_NE(complaint([] { return read_obj("v 1 2 3\nv 1 2\n"); }).find("line 2"), std::string::npos);
  EXPECT_NE(complaint([] { return read_obj("v 1 2 z\n"); }).find("line 1"), std::string::npos);
}

}  // namespace
}  // namespace pds
