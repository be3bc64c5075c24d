// SPDX-License-Identifier: BSD-3-Clause
#include "io/record_reader.h"
#include "ply_testing.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pds
{
namespace
{

using Values = std::vector<double>;

constexpr double utm_northing = 5234567.123;

TEST(PlyReader, reads_every_scalar_type_in_ascii)
{
  const PointTable table = read_ply(header("ascii", "1",
                                           "property char a\nproperty uint8 b\nproperty short c\nproperty uint16 "
                                           "d\nproperty int e\nproperty uint32 f\n" +
                                               xyz_float + "property float64 g\n") +
                                    "-128 255 -32768 65535 -2147483648 4294967295 0.1 2 nan 0.1\n");
  EXPECT_EQ(describe_fields(table), "x:float y:float z:float a:char b:uchar c:short d:ushort e:int f:uint g:double");
  const Values values = row_values(table, 0);
  EXPECT_TRUE(std::isnan(values[2]));
  EXPECT_EQ(values[0], static_cast<double>(0.1F));
  EXPECT_EQ(Values(values.begin() + 3, values.end()),
            (Values{-128, 255, -32768, 65535, -2147483648.0, 4294967295.0, 0.1}));
}

TEST(PlyReader, reads_every_scalar_type_in_both_byte_orders)
{
  const std::string properties = xyz_float +
                                 "property char a\nproperty uchar b\nproperty short c\nproperty ushort d\n"
                                 "property int e\nproperty uint f\nproperty double g\n";
  const std::vector<std::string> scalars = {bytes_of(0.1F),
                                            bytes_of(2.F),
                                            bytes_of(-3.F),
                                            bytes_of(std::int8_t{-128}),
                                            bytes_of(std::uint8_t{255}),
                                            bytes_of(std::int16_t{-32768}),
                                            bytes_of(std::uint16_t{65535}),
                                            bytes_of(std::numeric_limits<std::int32_t>::min()),
                                            bytes_of(std::uint32_t{4294967295}),
                                            bytes_of(0.1)};
  std::string little;
  std::string big;
  for (const std::string& scalar : scalars) {
    little += scalar;
    big += big_endian(scalar);
  }
  const Values expected = {
      static_cast<double>(0.1F), 2, -3, -128, 255, -32768, 65535, -2147483648.0, 4294967295.0, 0.1};
  EXPECT_EQ(row_values(read_ply(header("binary_little_endian", "1", properties) + little), 0), expected);
  EXPECT_EQ(row_values(read_ply(header("binary_big_endian", "1", properties) + big), 0), expected);
}

TEST(PlyReader, keeps_utm_doubles_to_the_last_bit_in_both_byte_orders)
{
  const Values expected = {500000.001, utm_northing, 412.0625};
  std::string little;
  std::string big;
  for (const double value : expected) {
    little += bytes_of(value);
    big += big_endian(bytes_of(value));
  }
  EXPECT_EQ(row_values(read_ply(header("binary_little_endian", "1", xyz_double) + little), 0), expected);
  EXPECT_EQ(row_values(read_ply(header("binary_big_endian", "1", xyz_double) + big), 0), expected);
}

TEST(PlyReader, passes_over_lists_and_elements_before_the_vertices)
{
  const std::string body =
      "ply\nformat binary_little_endian 1.0\nelement camera 2\nproperty short id\n"
      "property list uchar float matrix\nelement vertex 2\nproperty list uint16 int faces\n" +
      xyz_float + "end_header\n";
  const std::string camera = bytes_of(std::int16_t{7}) + bytes_of(std::uint8_t{2}) + bytes_of(1.F) + bytes_of(1.F);
  const auto vertex = [](float x, std::uint16_t list_size) {
    std::string bytes = bytes_of(list_size) + std::string(std::size_t{4} * list_size, '\x7f');
    return bytes + bytes_of(x) + bytes_of(2.F) + bytes_of(3.F);
  };
  const PointTable table = read_ply(body + camera + camera + vertex(1, 3) + vertex(4, 0));
  ASSERT_EQ(table.size(), 2U);
  EXPECT_EQ(row_values(table, 0), (Values{1, 2, 3}));
  EXPECT_EQ(row_values(table, 1), (Values{4, 2, 3}));
}

TEST(PlyReader, takes_crlf_and_integer_coordinates)
{
  const PointTable table = read_ply(
      "ply\r\nformat ascii 1.0\r\nelement vertex 1\r\nproperty int x\r\nproperty int y\r\nproperty int z\r\n"
      "end_header\r\n1 2.000 -2147483647\r\n");
  EXPECT_EQ(describe_fields(table), "x:double y:double z:double");
  EXPECT_EQ(row_values(table, 0), (Values{1, 2, -2147483647.0}));
}

TEST(PlyReader, reads_many_blocks_of_any_layout_with_any_number_of_threads)
{
  constexpr std::size_t count = 100000;
  const std::string coordinates_first = "property float x\nproperty float y\nproperty float z\nproperty short id\n";
  const std::string coordinates_last = "property short id\nproperty float x\nproperty float y\nproperty double z\n";
  std::string first;
  std::string last;
  std::string last_big;
  for (std::size_t i = 0; i < count; ++i) {
    const auto x = static_cast<float>(i);
    const auto id = static_cast<std::int16_t>(i % 30000);
    first += bytes_of(x) + bytes_of(x / 3) + bytes_of(-x) + bytes_of(id);
    last += bytes_of(id) + bytes_of(x) + bytes_of(x / 3) + bytes_of(static_cast<double>(-x));
    last_big += big_endian(bytes_of(id)) + big_endian(bytes_of(x)) + big_endian(bytes_of(x / 3)) +
                big_endian(bytes_of(static_cast<double>(-x)));
  }
  for (const std::string& file : {header("binary_little_endian", std::to_string(count), coordinates_first) + first,
                                  header("binary_little_endian", std::to_string(count), coordinates_last) + last,
                                  header("binary_big_endian", std::to_string(count), coordinates_last) + last_big}) {
    for (const unsigned threads : {1U, 3U}) {
      const PointTable table = read_ply(ByteSource(file), Parallel(threads));
      ASSERT_EQ(table.size(), count);
      for (std::size_t i = 0; i < count; ++i) {
        const auto x = static_cast<float>(i);
        ASSERT_EQ(row_values(table, i), (Values{static_cast<double>(x), static_cast<double>(x / 3),
                                                static_cast<double>(-x), static_cast<double>(i % 30000)}));
      }
    }
  }
}

TEST(PlyReader, complains_of_a_header_that_announces_too_few_points)
{
  const auto complaint_about = [](const std::string& file) { return complaint([&file] { return read_ply(file); }); };
  const auto goes_on = [&](const std::string& file) {
    return complaint_about(file).find("goes on after the last point") != std::string::npos;
  };
  const std::string point = bytes_of(1.F) + bytes_of(2.F) + bytes_of(3.F);
  const std::string little = "binary_little_endian";
  EXPECT_TRUE(goes_on(header(little, "1", xyz_float) + point + point));
  EXPECT_EQ(complaint_about(header(little, "1", xyz_float) + point + "padding"), "");
  const std::string list = "property list uchar float more\n";
  const std::string row_with_list = point + bytes_of(std::uint8_t{1}) + bytes_of(4.F);
  EXPECT_EQ(complaint_about(header(little, "1", xyz_float + list) + row_with_list), "");
  EXPECT_TRUE(goes_on(header(little, "1", xyz_float + list) + row_with_list + row_with_list));
  EXPECT_TRUE(goes_on(header("ascii", "1", xyz_float) + "1 2 3\n4 5 6\n"));
  EXPECT_EQ(complaint_about(header("ascii", "1", xyz_float) + "1 2 3\n\n"), "");
}

TEST(PlyReader, finds_by_the_faces_that_the_number_of_vertices_is_wrong)
{
  const std::string faces = "element face 2\nproperty list uchar int vertex_indices\n";
  const std::string face = bytes_of(std::uint8_t{3}) + bytes_of(0) + bytes_of(1) + bytes_of(2);
  std::string points;
  for (const float x : {1.F, 2.F, 3.F, 4.F}) {
    points.append(bytes_of(x)).append(bytes_of(2.F)).append(bytes_of(3.F));
  }
  const auto complaint_about = [&](const char* vertices, const std::string& body) {
    return complaint([&] { return read_ply(header("binary_little_endian", vertices, xyz_float + faces) + body); });
  };
  EXPECT_EQ(complaint_about("4", points + face + face), "");
  const std::string body = points + face + face;
  for (const char* wrong : {"0", "1", "2", "3", "5"}) {
    EXPECT_NE(complaint_about(wrong, body), "") << wrong;
  }
  EXPECT_NE(complaint_about("4", points + face + face.substr(0, 12)).find("cut short"), std::string::npos);
  const auto complaint_about_text = [&](const char* vertices) {
    return complaint([&] {
      return read_ply(header("ascii", vertices, xyz_float + faces) + "1 2 3\n4 5 6\n7 8 9\n3 0 1 2\n3 0 1 2\n");
    });
  };
  EXPECT_EQ(complaint_about_text("3"), "");
  EXPECT_NE(complaint_about_text("2"), "");
  EXPECT_NE(complaint_about_text("4"), "");
}

TEST(PlyReader, says_which_lists_and_other_elements_it_does_not_read)
{
  const std::string lists = "property list uchar float weights\nproperty list uchar int bones\n";
  const std::string others =
      "element face 1\nproperty list uchar int vertex_indices\nelement edge 0\nelement camera 1\n"
      "property float view_px\n";
  const PointTable table =
      read_ply(header("ascii", "1", xyz_float + lists + others) + "1 2 3 1 0.5 2 7 8\n3 0 0 0\n5\n");
  EXPECT_EQ(table.not_read, "the list properties weights bones and the rows of face camera");
  EXPECT_EQ(row_values(table, 0), (Values{1, 2, 3}));
}

TEST(PlyReader, names_what_is_wrong)
{
  const auto of = [](const std::string& file) { return complaint([&file] { return read_ply(file); }); };
  const std::string three_floats(12, '\0');
  EXPECT_NE(of("solid cube\n").find("not a PLY file"), std::string::npos);
  EXPECT_NE(of("ply\nformat ascii 1.0\nelement vertex 1\n").find("end_header"), std::string::npos);
  EXPECT_NE(of("ply\nelement vertex 0\nend_header\n").find("line 3"), std::string::npos);
  EXPECT_NE(of(header("ascii", "-1", xyz_float)).find("line 4"), std::string::npos);
  EXPECT_NE(of(header("ascii", "1", "property quad x\n")).find("line 5"), std::string::npos);
  EXPECT_NE(of(header("ascii", "1", std::string("property float x\0x\n", 19))).find("line 5"), std::string::npos);
  EXPECT_NE(of(header("ascii", "1", "property float x\nproperty float y\n") + "1 2\n").find("x, y and z"),
            std::string::npos);
  EXPECT_NE(of(header("ascii", "1", xyz_float) + "1 2\n").find("cut short"), std::string::npos);
  EXPECT_NE(of(header("ascii", "1", xyz_float) + "1 2 3x\n").find("'3x'"), std::string::npos);
  EXPECT_NE(of(header("ascii", "1", xyz_float + "property uchar red\n") + "1 2 3 256\n").find("'256'"),
            std::string::npos);
  EXPECT_NE(of(header("binary_little_endian", "2", xyz_float) + three_floats).find("cut short"), std::string::npos);
  EXPECT_NE(
      of(header("binary_little_endian", "1", xyz_float + "property float x\n") + std::string(16, '\0')).find("twice"),
      std::string::npos);
}

TEST(PlyReader, does_not_believe_a_count_that_the_file_cannot_hold)
{
  for (const char* count : {"1000000000000", "18446744073709551615"}) {
    for (const char* format : {"ascii", "binary_little_endian"}) {
      const std::string file = header(format, count, xyz_float) + std::string(100, '1');
      EXPECT_NE(complaint([&file] { return read_ply(file); }).find("cut short"), std::string::npos) << count << format;
    }
  }
}

}  // namespace
}  // namespace pds
