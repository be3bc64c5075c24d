// SPDX-License-Identifier: BSD-3-Clause
// The formats that PDAL reads: one cloud of UTM coordinates that must come through to the last bit, and the same file
// damaged.
#include "e57_testing.h"
#include "io/read_points.h"
#include "pdal_testing.h"
#include "run_testing.h"
#include "utm_cloud.h"

namespace pds
{
namespace
{

using Names = std::vector<std::string>;

/** A file of the cloud, and one whose header says something else than what follows. */
struct Sample
{
  const char* name;
  const char* driver;
  std::size_t lies_at;  ///< place of a number in the header
  std::uint64_t the_lie;
};

constexpr std::size_t las_1_2_count_at = 107;  // ASPRS LAS 1.2, number of points
constexpr std::size_t las_1_4_count_at = 247;  // ASPRS LAS 1.4, the same
constexpr std::size_t e57_length_at = 16;      // ASTM E2807, table 1: bytes of the file

constexpr std::array<Sample, 3> samples = {
    {{"cloud.laz", "writers.las", las_1_2_count_at, std::uint64_t{1} << 31},
     {"cloud.copc.laz", "writers.copc", las_1_4_count_at, std::uint64_t{1} << 40},
     {"cloud.e57", "writers.e57", e57_length_at, std::uint64_t{1} << 30}}};

std::vector<E57Column> e57_columns()
{
  std::vector<E57Column> columns = {{"cartesianX", {}}, {"cartesianY", {}}, {"cartesianZ", {}}};
  for (const Position& position : positions()) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      columns[axis].values.push_back(position[axis]);
    }
  }
  return columns;
}

class RunPdal : public RunTool
{
 protected:
  /** \return the bytes of the good file */
  std::string make(const Sample& sample)
  {
    write("cloud.las", utm_las());
    EXPECT_EQ(write_with_pdal(path("cloud.las"), path(sample.name), sample.driver), utm_points);
    std::filesystem::remove(path("cloud.las"));
    return read(sample.name);
  }
};

TEST_F(RunPdal, carries_utm_coordinates_to_the_last_bit)
{
  make(samples[0]);
  write("cloud.e57", e57(e57_columns(), utm_points));
  for (const char* name : {"cloud.laz", "cloud.e57"}) {
    ASSERT_EQ(run(std::string("-q ") + name + " out.ply"), 0) << errors();
    EXPECT_TRUE(has_only_points_of_the_cloud(read_points(path("out.ply"), Parallel(1)))) << name;
  }
  make(samples[1]);  // by PDAL's writer, which rounds millimetres down
  ASSERT_EQ(run("-q cloud.copc.laz out.ply"), 0) << errors();
  const PointTable mesh = read_points(path("out.ply"), Parallel(1));
  EXPECT_GT(mesh.size(), 50U);
  EXPECT_TRUE(has_only_las_coordinates(mesh));
}

TEST_F(RunPdal, needs_no_standard_streams)
{
  write("cloud.laz", make(samples[0]));
  ASSERT_EQ(run("-q cloud.laz out.ply"), 0) << errors();
  ASSERT_EQ(run("-q cloud.laz closed.ply <&- >&- 2>&- #"), 0);  // the rest of the line would open them again
  EXPECT_EQ(read("closed.ply"), read("out.ply"));
}

TEST_F(RunPdal, complains_of_an_e57_that_announces_more_points_than_it_holds)
{
  write("cloud.e57", e57(e57_columns(), utm_points + 500));
  EXPECT_EQ(run("-q cloud.e57 out.ply"), 1);
  EXPECT_TRUE(complained_of("cloud.e57: "));
  EXPECT_EQ(files(), Names{"cloud.e57"});
}

TEST_F(RunPdal, complains_of_an_e57_without_cartesian_coordinates)
{
  const std::vector<double> values(utm_points, 1);
  write("cloud.e57",
        e57({{"sphericalRange", values}, {"sphericalAzimuth", values}, {"sphericalElevation", values}}, utm_points));
  EXPECT_EQ(run("-q cloud.e57 out.ply"), 1);
  EXPECT_TRUE(complained_of("cloud.e57: "));
  EXPECT_TRUE(complained_of("; "));
  EXPECT_EQ(files(), Names{"cloud.e57"});
}

TEST_F(RunPdal, leaves_out_points_of_an_e57_without_coordinates_and_says_so)
{
  std::vector<E57Column> columns = e57_columns();
  columns.push_back({"cartesianInvalidState", std::vector<double>(utm_points, 0)});
  for (std::size_t i = 0; i < 700; ++i) {  // rays that met nothing have a direction at best
    columns[0].values[i] = 0;
    columns[3].values[i] = i % 2 == 0 ? 1 : 2;
  }
  write("cloud.e57", e57(columns, utm_points));
  ASSERT_EQ(run("--report r.json cloud.e57 out.ply"), 0) << errors();
  EXPECT_NE(errors().find("cloud.e57: 700 points without coordinates are left out"), std::string::npos) << errors();
  EXPECT_NE(read("r.json").find("\"input_points\": 2300"), std::string::npos) << read("r.json");
  const PointTable mesh = read_points(path("out.ply"), Parallel(1));
  EXPECT_EQ(describe_fields(mesh), "x:double y:double z:double");
  EXPECT_TRUE(has_only_points_of_the_cloud(mesh));
}

TEST_F(RunPdal, complains_of_files_that_are_empty_cut_short_or_whose_header_lies)
{
  for (const Sample& sample : samples) {
    const std::string good = make(sample);
    std::string lying = good;
    std::memcpy(lying.data() + sample.lies_at, &sample.the_lie, sizeof sample.the_lie);
    for (const std::string& bytes :
         {std::string(), good.substr(0, 40), good.substr(0, good.size() / 2), lying, std::string("1 2 3\n")}) {
      write(sample.name, bytes);
      EXPECT_EQ(run(std::string("-q ") + sample.name + " out.ply"), 1)
          << sample.name << ", " << bytes.size() << " bytes";
      EXPECT_TRUE(complained_of(std::string(sample.name) + ": ")) << bytes.size();
      EXPECT_TRUE(complained_of("; ")) << sample.name << ": how to mend it";
      EXPECT_EQ(files(), Names{sample.name});
    }
    std::filesystem::remove(path(sample.name));
  }
}

}  // namespace
}  // namespace pds
