// SPDX-License-Identifier: BSD-3-Clause
// Every input format: one cloud of UTM coordinates that must come through to the last bit, and the same file damaged.
#include "io/read_points.h"
#include "run_testing.h"
#include "utm_cloud.h"

#include <algorithm>
#include <cstdio>

namespace pds
{
namespace
{

using Names = std::vector<std::string>;

std::string text_rows(const char* prefix = "")
{
  std::string rows;
  for (const auto& [x, y, z] : positions()) {
    char row[128];
    std::snprintf(row, sizeof row, "%s%.17g %.17g %.17g\n", prefix, x, y, z);
    rows += row;
  }
  return rows;
}

std::string binary_rows(bool is_big_endian = false)
{
  std::string rows;
  for (const Position& position : positions()) {
    for (const double x : position) {
      std::string bytes = bytes_of(x);
      if (is_big_endian) {
        std::reverse(bytes.begin(), bytes.end());
      }
      rows += bytes;
    }
  }
  return rows;
}

std::string ply(const std::string& format, const std::string& count, const std::string& rows)
{
  return "ply\nformat " + format + " 1.0\nelement vertex " + count +
         "\nproperty double x\nproperty double y\nproperty double z\nend_header\n" + rows;
}

std::string pcd(const std::string& encoding, const std::string& count, const std::string& rows)
{
  return "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " + count +
         "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + count + "\nDATA " + encoding + "\n" + rows;
}

/** As PCD has it: all x, all y, all z, here as LZF's runs of bytes that repeat nothing, behind their two sizes. */
std::string compressed_rows()
{
  std::string planes;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const Position& position : positions()) {
      planes += bytes_of(position[axis]);
    }
  }
  constexpr std::size_t longest_run = 32;
  std::string runs;
  for (std::size_t begin = 0; begin < planes.size(); begin += longest_run) {
    const std::string run = planes.substr(begin, longest_run);
    runs += static_cast<char>(run.size() - 1) + run;
  }
  return bytes_of(static_cast<std::uint32_t>(runs.size())) + bytes_of(static_cast<std::uint32_t>(planes.size())) + runs;
}

/** A file of the cloud, and one whose header says something else than what follows. */
struct Sample
{
  const char* name;
  std::string good;
  std::string lying;
};

std::vector<Sample> samples()
{
  const std::string count = std::to_string(utm_points);
  const std::string more = std::to_string(utm_points + 1);
  const std::string most = "1000000000000";
  return {{"ascii.ply", ply("ascii", count, text_rows()), ply("ascii", more, text_rows())},
          {"little.ply", ply("binary_little_endian", count, binary_rows()),
           ply("binary_little_endian", most, binary_rows())},
          {"big.ply", ply("binary_big_endian", count, binary_rows(true)),
           ply("binary_big_endian", more, binary_rows(true))},
          {"ascii.pcd", pcd("ascii", count, text_rows()), pcd("ascii", most, text_rows())},
          {"binary.pcd", pcd("binary", count, binary_rows()), pcd("binary", more, binary_rows())},
          {"compressed.pcd", pcd("binary_compressed", count, compressed_rows()),
           pcd("binary_compressed", more, compressed_rows())},
          {"cloud.las", utm_las(), utm_las(1)},
          {"cloud.obj", text_rows("v "), text_rows("v x ")},
          {"cloud.xyz", text_rows(), "x y z intensity\n" + text_rows()},
          {"cloud.txt", "// x y z\n" + text_rows(), "x y z intensity\n" + text_rows()},
          {"cloud.csv", "x y z\n" + text_rows(), "x y\n" + text_rows()}};
}

class RunFormats : public RunTool
{
 protected:
  static bool can_be_piped(const std::string& name)
  {
    const std::string extension = std::filesystem::path(name).extension();
    return extension == ".ply" || extension == ".pcd";
  }
};

TEST_F(RunFormats, carry_utm_coordinates_to_the_last_bit)
{
  for (const Sample& sample : samples()) {
    write(sample.name, sample.good);
    ASSERT_EQ(run(std::string("-q ") + sample.name + " out.ply"), 0) << errors();
    EXPECT_TRUE(has_only_points_of_the_cloud(read_points(path("out.ply"), Parallel(1)))) << sample.name;
  }
}

TEST_F(RunFormats, say_in_one_line_what_of_an_input_is_not_read)
{
  write("in.obj", text_rows("v ") + "vt 0 1\nusemtl skin\nf 1/1 2/1 3/1\n");
  ASSERT_EQ(run("in.obj out.ply"), 0);
  EXPECT_NE(errors().find("in.obj: texture coordinates, materials and faces are left out\n"), std::string::npos)
      << errors();
  const std::string face = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  std::string mesh = ply("ascii", std::to_string(utm_points), text_rows()) + "3 0 1 2\n";
  mesh.replace(mesh.find("end_header\n"), std::string("end_header\n").size(), face);
  write("in.ply", mesh);
  ASSERT_EQ(run("in.ply out.ply"), 0);
  EXPECT_NE(errors().find("in.ply: the rows of face are left out\n"), std::string::npos) << errors();
}

TEST_F(RunFormats, turn_glb_upright_if_the_format_of_the_input_says_that_z_is_up)
{
  write("cloud.las", utm_las());
  ASSERT_EQ(run("-q cloud.las las.glb"), 0) << errors();
  EXPECT_NE(read("las.glb").find("\"rotation\""), std::string::npos);
  write("cloud.xyz", text_rows());
  ASSERT_EQ(run("-q cloud.xyz xyz.glb"), 0) << errors();
  EXPECT_EQ(read("xyz.glb").find("\"rotation\""), std::string::npos);
}

TEST_F(RunFormats, complain_of_files_that_are_empty_cut_short_or_whose_header_lies)
{
  for (const Sample& sample : samples()) {
    // A text without a header is a cloud wherever it ends, unless that is within a row.
    const std::size_t row_end = sample.good.rfind('\n', sample.good.size() - 2);
    const bool is_text = sample.good.back() == '\n';
    const std::string in_data = sample.good.substr(0, is_text ? row_end + 5 : sample.good.size() - 1);
    const std::string in_header = sample.good.substr(0, is_text && sample.good.rfind("ply", 0) != 0 ? 3 : 40);
    for (const std::string& bytes : {std::string(), in_header, in_data, sample.lying}) {
      write(sample.name, bytes);
      EXPECT_EQ(run(std::string("-q ") + sample.name + " out.obj"), 1)
          << sample.name << ", " << bytes.size() << " bytes";
      EXPECT_TRUE(complained_of(std::string(sample.name) + ": ")) << bytes.size();
      EXPECT_TRUE(complained_of("; ")) << sample.name << ": how to mend it";
      EXPECT_EQ(files(), Names{sample.name});
      if (can_be_piped(sample.name)) {
        EXPECT_EQ(run(std::string("-q - out.obj <") + sample.name), 1) << sample.name;
        EXPECT_TRUE(complained_of("standard input: ")) << sample.name << ", " << bytes.size() << " bytes";
        EXPECT_EQ(files(), Names{sample.name});
      }
    }
    std::filesystem::remove(path(sample.name));
  }
}

}  // namespace
}  // namespace pds
