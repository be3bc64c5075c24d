// SPDX-License-Identifier: BSD-3-Clause
#include "io/text_reader.h"

#include "reader_testing.h"

namespace pds
{
namespace
{

using Values = std::vector<double>;

TEST(TextReader, keeps_utm_coordinates_to_the_last_bit)
{
  const PointTable table = read_text("500000.001 5234567.123 +412.5\n500000.002\t5234567.124\t4.125e2\n");
  ASSERT_EQ(table.size(), 2U);
  EXPECT_EQ(row_values(table, 0), (Values{500000.001, 5234567.123, 412.5}));
  EXPECT_EQ(row_values(table, 1), (Values{500000.002, 5234567.124, 412.5}));
}

TEST(TextReader, takes_every_separator_crlf_comments_and_a_missing_last_line_end)
{
  for (const char* file :
       {"# c\r\n\r\n1 2 3\r\n4 5 6", "// c\n1,2,3\n4, 5, 6\n", "1;2;3\n4 ; 5;6\n", "1\t2 3\n  4 5 6  \n",
        "\xEF\xBB\xBF"
        "1 2 3\n4 5 6\n"}) {
    const PointTable table = read_text(file);
    ASSERT_EQ(table.size(), 2U) << file;
    EXPECT_EQ(row_values(table, 0), (Values{1, 2, 3})) << file;
    EXPECT_EQ(row_values(table, 1), (Values{4, 5, 6})) << file;
  }
}

TEST(TextReader, takes_names_from_a_header_line_or_comment)
{
  const PointTable csv = read_text("Return Number,\"Y\",X,Z,R,G,B\n1,2,3,4,255,0,7\n");
  EXPECT_EQ(describe_fields(csv), "x:double y:double z:double Return_Number:double red:uchar green:uchar blue:uchar");
  EXPECT_EQ(row_values(csv, 0), (Values{3, 2, 4, 1, 255, 0, 7}));
  EXPECT_EQ(describe_fields(read_text("//X Y Z Intensity\n1 2 3 4\n")), "x:double y:double z:double Intensity:double");
  EXPECT_EQ(describe_fields(read_text("# x y z\n1 2 3 4\n")), "x:double y:double z:double intensity:double");
}

TEST(TextReader, names_columns_without_a_header_as_documented)
{
  const auto names = [](const std::string& row) {
    std::string text;
    const PointTable table = read_text(row);
    for (const Field& field : table.fields()) {
      text += field.name + " ";
    }
    return text;
  };
  EXPECT_EQ(names("1 2 3 0.5"), "x y z intensity ");
  EXPECT_EQ(names("1 2 3 255 128 0"), "x y z red green blue ");
  EXPECT_EQ(names("1 2 3 0 0 1"), "x y z nx ny nz ");
  EXPECT_EQ(names("1 2 3 0.6 0.8 0"), "x y z nx ny nz ");
  EXPECT_EQ(names("1 2 3 255 128 0 0.5"), "x y z red green blue intensity ");
  EXPECT_EQ(names("1 2 3 0.5 255 128 0"), "x y z intensity red green blue ");
  EXPECT_EQ(names("1 2 3 10 20 3000"), "x y z intensity field_5 field_6 ");
}

TEST(TextReader, keeps_rows_that_are_not_finite) { EXPECT_EQ(read_text("1 2 3\nnan nan nan\n4 5 inf\n").size(), 3U); }

TEST(TextReader, names_the_line_that_is_wrong)
{
  const auto of = [](const std::string& file) { return complaint([&file] { return read_text(file); }); };
  EXPECT_NE(of("1 2 3\n4 5\n").find("line 2"), std::string::npos);
  EXPECT_NE(of("1 2 3\n\n4 5 6x\n").find("line 3"), std::string::npos);
  EXPECT_NE(of("1,5;2,5;3,5\n").find("decimal commas"), std::string::npos);
  EXPECT_NE(of("1,2,\n").find("columns"), std::string::npos);
  EXPECT_NE(of("1 2\n").find("2 columns"), std::string::npos);
  EXPECT_NE(of("a b c\n1 2 3\n").find("line 1"), std::string::npos);
  EXPECT_NE(of("x,y,z,x\n1,2,3,4\n").find("'x' appears twice"), std::string::npos);
}

}  // namespace
}  // namespace pds
