// SPDX-License-Identifier: BSD-3-Clause
#include "io/pcd_reader.h"

#include "io/record_reader.h"
#include "reader_testing.h"
#include "temporary_directory.h"

#include <pcl/PCLPointCloud2.h>
#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>

#include <cmath>
#include <cstring>

namespace pds
{
namespace
{

using Values = std::vector<double>;

std::string header(const std::string& fields, const std::string& points, const std::string& data)
{
  return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n" + fields + "WIDTH " + points +
         "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + points + "\nDATA " + data + "\n";
}

const std::string xyz = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n";

class PcdReader : public TemporaryDirectory
{
 protected:
  [[nodiscard]] static PointTable parse(const std::string& file) { return read_pcd(ByteSource(file), Parallel(2)); }
  [[nodiscard]] static std::string complaint_about(const std::string& file)
  {
    return complaint([&] { return parse(file); });
  }
};

TEST_F(PcdReader, unpacks_colors_and_keeps_the_other_fields)
{
  const PointTable table = parse(header("FIELDS x y z rgb intensity normal_x normal_y normal_z\nSIZE 4 4 4 4 4 4 4 4\n"
                                        "TYPE F F F U F F F F\nCOUNT 1 1 1 1 1 1 1 1\n",
                                        "1", "ascii") +
                                 "1 2 3 16744703 0.1 0 0 1\n");  // 0xFF80FF
  EXPECT_EQ(describe_fields(table),
            "x:float y:float z:float nx:float ny:float nz:float red:uchar green:uchar blue:uchar intensity:float");
  EXPECT_EQ(row_values(table, 0), (Values{1, 2, 3, 0, 0, 1, 255, 128, 255, static_cast<double>(0.1F)}));
}

TEST_F(PcdReader, reads_binary_doubles_padding_arrays_and_wide_integers)
{
  const std::string fields = "FIELDS x y z _ pair time\nSIZE 8 8 8 1 2 8\nTYPE F F F U I U\nCOUNT 1 1 1 3 2 1\n";
  const std::string row = bytes_of(500000.001) + bytes_of(5234567.123) + bytes_of(1.0) + "abc" +
                          bytes_of(std::int16_t{-5}) + bytes_of(std::int16_t{6}) +
                          bytes_of((std::uint64_t{1} << 60) + 1);
  const PointTable table = parse(header(fields, "2", "binary") + row + row);
  EXPECT_EQ(describe_fields(table), "x:double y:double z:double pair_0:short pair_1:short time:double");
  ASSERT_EQ(table.size(), 2U);
  EXPECT_EQ(row_values(table, 1), (Values{500000.001, 5234567.123, 1, -5, 6, std::ldexp(1.0, 60)}));
  EXPECT_EQ(std::memcmp(table.record(1) + table.find("time")->offset, row.data() + row.size() - 8, 8), 0) << "all bits";
}

TEST_F(PcdReader, reads_what_pcl_compressed)
{
  pcl::PCLPointCloud2 cloud;
  const std::string ascii = write("ascii.pcd", header(xyz, "3", "ascii") + "1 2 3\n4 5 6\n7 8 0.1\n");
  ASSERT_EQ(pcl::PCDReader().read(ascii, cloud), 0);
  ASSERT_GE(pcl::PCDWriter().writeBinaryCompressed(path("compressed.pcd"), cloud), 0);
  const PointTable table = read_pcd(ByteSource::from_file(path("compressed.pcd")), Parallel(2));
  ASSERT_EQ(table.size(), 3U);
  EXPECT_EQ(row_values(table, 2), (Values{7, 8, static_cast<double>(0.1F)}));
}

TEST_F(PcdReader, reads_what_pcl_writes_of_any_cloud_as_pcl_reads_it)
{
  pcl::PointCloud<pcl::PointXYZRGBNormal> cloud(500, 100);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const auto number = static_cast<float>(i);
    cloud[i] = pcl::PointXYZRGBNormal(number / 7, -number, 1 / (number + 1), static_cast<std::uint8_t>(i),
                                      static_cast<std::uint8_t>(i / 256), 7, 0, 0.6F, 0.8F);
    cloud[i].curvature = number * number;
  }
  pcl::PCDWriter writer;
  ASSERT_GE(writer.writeBinary(path("binary.pcd"), cloud), 0);
  ASSERT_GE(writer.writeBinaryCompressed(path("compressed.pcd"), cloud), 0);
  constexpr int float_digits = 9;  // give every bit back
  ASSERT_GE(writer.writeASCII(path("ascii.pcd"), cloud, float_digits), 0);
  for (const char* name : {"binary.pcd", "compressed.pcd", "ascii.pcd"}) {
    pcl::PointCloud<pcl::PointXYZRGBNormal> expected;
    ASSERT_EQ(pcl::PCDReader().read(path(name), expected), 0) << name;
    const PointTable table = read_pcd(ByteSource::from_file(path(name)), Parallel(2));
    ASSERT_EQ(table.size(), expected.size()) << name;
    ASSERT_EQ(describe_fields(table),
              "x:float y:float z:float nx:float ny:float nz:float red:uchar green:uchar blue:uchar curvature:float")
        << name;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const pcl::PointXYZRGBNormal& point = expected[i];
      const std::vector<float> floats = {point.x, point.y, point.z, point.normal_x, point.normal_y, point.normal_z};
      Values values(floats.begin(), floats.end());
      values.insert(values.end(), {static_cast<double>(point.r), static_cast<double>(point.g),
                                   static_cast<double>(point.b), static_cast<double>(point.curvature)});
      ASSERT_EQ(row_values(table, i), values) << name << ' ' << i;
    }
  }
}

TEST_F(PcdReader, complains_of_a_header_that_announces_too_few_points)
{
  const std::string point = bytes_of(1.F) + bytes_of(2.F) + bytes_of(3.F);
  const std::string binary = header(xyz, "1", "binary") + point;
  const std::string ascii = header(xyz, "1", "ascii") + "1 2 3\n";
  EXPECT_NE(complaint_about(binary + point).find("goes on after the last point"), std::string::npos);
  EXPECT_EQ(complaint_about(binary + "padding"), "");
  EXPECT_NE(complaint_about(ascii + "\n4 5 6\n").find("goes on after the last point"), std::string::npos);
  EXPECT_EQ(complaint_about(ascii + " \n\n"), "");
}

TEST_F(PcdReader, does_not_take_compressed_points_for_fewer)
{
  pcl::PCLPointCloud2 cloud;
  const std::string ascii = write("ascii.pcd", header(xyz, "3", "ascii") + "1 2 3\n4 5 6\n7 8 0.1\n");
  ASSERT_EQ(pcl::PCDReader().read(ascii, cloud), 0);
  ASSERT_GE(pcl::PCDWriter().writeBinaryCompressed(path("compressed.pcd"), cloud), 0);
  std::string file = read("compressed.pcd");
  EXPECT_EQ(complaint_about(file), "");
  for (const std::string key : {"WIDTH 3", "POINTS 3"}) {
    file.replace(file.find(key) + key.size() - 1, 1, "2");
  }
  EXPECT_NE(complaint_about(file).find("more points than"), std::string::npos);
}

TEST_F(PcdReader, takes_the_sensor_origin_from_a_viewpoint_of_its_own)
{
  std::string file = header(xyz, "1", "ascii") + "1 2 3\n";
  EXPECT_FALSE(parse(file).sensor_origin);
  const std::string standard = "VIEWPOINT 0 0 0 1 0 0 0";
  file.replace(file.find(standard), standard.size(), "VIEWPOINT 7 8 9 1 0 0 0");
  ASSERT_TRUE(parse(file).sensor_origin);
  EXPECT_EQ(*parse(file).sensor_origin, Eigen::Vector3d(7, 8, 9));
}

TEST_F(PcdReader, names_what_is_wrong)
{
  EXPECT_NE(complaint_about("ply\n").find("not a PCD file"), std::string::npos);
  EXPECT_NE(
      complaint_about(header("FIELDS x y\nSIZE 4 4\nTYPE F F\nCOUNT 1 1\n", "1", "ascii") + "1 2\n").find("x, y and z"),
      std::string::npos);
  EXPECT_NE(complaint_about(header("FIELDS x y z\nSIZE 4 4 -4\nTYPE F F F\nCOUNT 1 1 1\n", "1", "ascii")).find("SIZE"),
            std::string::npos);
  EXPECT_NE(
      complaint_about(header("FIELDS x y \033z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n", "1", "ascii")).find("FIELDS"),
      std::string::npos);
  const std::string two_points = std::string(24, '\0');
  EXPECT_EQ(complaint_about(header(xyz, "2", "binary") + two_points), "");
  EXPECT_NE(complaint_about(header(xyz, "2", "binary") + two_points.substr(1)).find("cut short"), std::string::npos);
  const std::string ascii = header(xyz, "3", "ascii");
  EXPECT_NE(complaint_about(ascii + "1 2 3\n4 5 6\n").find("cut short"), std::string::npos);
  EXPECT_NE(complaint_about(ascii + "1 2 3\n4 5 6\n7 8\n").find("line 3"), std::string::npos);
  EXPECT_NE(complaint_about(ascii + "1 2 3\n4 5 6x\n7 8 9\n").find("line 2"), std::string::npos);
}

TEST_F(PcdReader, does_not_believe_a_compressed_size_that_the_file_cannot_hold)
{
  const auto complaint_about_sizes = [](std::uint32_t compressed, std::uint32_t uncompressed) {
    return complaint_about(header(xyz, "2", "binary_compressed") + bytes_of(compressed) + bytes_of(uncompressed) +
                           "oops");
  };
  EXPECT_NE(complaint_about_sizes(4000000000, 24).find("cut short"), std::string::npos);
  EXPECT_NE(complaint_about_sizes(4, 23).find("cut short"), std::string::npos);
  EXPECT_NE(complaint_about_sizes(4, 4000000000).find("impossible size"), std::string::npos);
  EXPECT_NE(complaint_about_sizes(4, 24).find("cannot be unpacked"), std::string::npos);
}

TEST_F(PcdReader, does_not_believe_a_count_that_the_file_cannot_hold)
{
  for (const char* encoding : {"ascii", "binary", "binary_compressed"}) {
    const std::string file = header(xyz, "2000000000", encoding) + "1 2 3\n4 5 6\n";
    EXPECT_NE(complaint_about(file).find("cut short"), std::string::npos) << encoding;
  }
}

}  // namespace
}  // namespace pds
