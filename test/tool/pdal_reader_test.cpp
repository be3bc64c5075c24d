// SPDX-License-Identifier: BSD-3-Clause
#include "io/pdal_reader.h"

#include "io/las_header.h"
#include "io/las_reader.h"
#include "io/read_points.h"
#include "las_testing.h"
#include "pdal_testing.h"
#include "temporary_directory.h"

#include <algorithm>

namespace pds
{
namespace
{

/** PDAL itself writes the files. */
class PdalReader : public TemporaryDirectory
{
 protected:
  PdalReader()
  {
    LasFile file(4, 7, 36);
    for (std::int32_t i = 0; i < 5000; ++i) {
      const auto number = static_cast<std::uint16_t>(i);
      file.add(bytes_of(i) + bytes_of(-7 * i) + bytes_of(i % 50) + bytes_of(number) + bytes_of(std::uint8_t{0x21}) +
               bytes_of(std::uint8_t{0}) + bytes_of(static_cast<std::uint8_t>(i % 3)) + bytes_of(std::uint8_t{4}) +
               bytes_of(std::int16_t{1000}) + bytes_of(std::uint16_t{3}) + bytes_of(0.1 * i) +
               bytes_of(static_cast<std::uint16_t>(257 * (i % 256))) + bytes_of(std::uint16_t{0}) +
               bytes_of(std::uint16_t{65535}));
    }
    write("cloud.las", file.bytes());
  }

  void convert(const std::string& name, const char* driver) const
  {
    ASSERT_EQ(write_with_pdal(path("cloud.las"), path(name), driver), 5000U);
  }

  /** The values of these fields, row by row, sorted: COPC puts the points into an order of its own. */
  static std::vector<std::vector<double>> values(const PointTable& table, const std::vector<Field>& fields)
  {
    std::vector<std::vector<double>> rows(table.size());
    for (std::size_t row = 0; row < table.size(); ++row) {
      for (const Field& field : fields) {
        rows[row].push_back(table.value(row, *table.find(field.name)));
      }
    }
    std::sort(rows.begin(), rows.end());
    return rows;
  }

  static void expect_same_fields(const PointTable& table, const PointTable& expected)
  {
    ASSERT_EQ(table.fields().size(), expected.fields().size()) << describe_fields(table);
    for (const Field& field : expected.fields()) {
      ASSERT_TRUE(table.find(field.name)) << field.name << " is not in " << describe_fields(table);
      EXPECT_EQ(table.find(field.name)->type, field.type) << field.name;
    }
  }
};

TEST_F(PdalReader, gives_of_laz_what_our_reader_gives_of_the_same_las_to_the_last_bit)
{
  const PointTable las = read_las(ByteSource::from_file(path("cloud.las")), Parallel(1));
  ASSERT_NO_FATAL_FAILURE(convert("cloud.laz", "writers.las"));
  const PointTable laz = read_points(path("cloud.laz"), Parallel(1));
  expect_same_fields(laz, las);
  EXPECT_EQ(values(laz, las.fields()), values(las, las.fields()));
}

TEST_F(PdalReader, gives_flags_and_angles_of_the_old_point_formats_their_names_too)
{
  for (std::uint8_t format = 0; format < 4; ++format) {
    LasFile file(2, format, static_cast<std::uint16_t>(las_standard_bytes(format)));
    for (std::int32_t i = 0; i < 500; ++i) {
      std::string record = las_record(i, 2 * i, 3 * i, static_cast<std::uint8_t>(i % 256));
      record += bytes_of(static_cast<std::int8_t>(i % 180 - 90));
      file.add(record);
    }
    write("old.las", file.bytes());
    ASSERT_EQ(write_with_pdal(path("old.las"), path("old.laz"), "writers.las"), 500U);
    const PointTable las = read_las(ByteSource::from_file(path("old.las")), Parallel(1));
    const PointTable laz = read_points(path("old.laz"), Parallel(1));
    expect_same_fields(laz, las);
    EXPECT_EQ(values(laz, las.fields()), values(las, las.fields()));
  }
}

TEST_F(PdalReader, gives_extra_bytes_the_names_that_our_reader_gives_them)
{
  LasFile file(2, 0, 20 + 2 + 4);
  file.describe_extra(4, 8 + 16, "HeightAboveGround", 0.01, -5);
  file.describe_extra(9, 0, "pulse width", 0, 0);
  for (std::int16_t i = 0; i < 5000; ++i) {
    std::string record = las_record(i, 2 * i, 3, 2);
    record.resize(20, '\0');
    file.add(record + bytes_of(i) + bytes_of(0.1F * static_cast<float>(i)));
  }
  write("cloud.las", file.bytes());
  const PointTable las = read_las(ByteSource::from_file(path("cloud.las")), Parallel(1));
  ASSERT_NO_FATAL_FAILURE(convert("cloud.laz", "writers.las"));
  const PointTable laz = read_points(path("cloud.laz"), Parallel(1));
  const std::vector<Field> fields = {{"height_above_ground"}, {"pulse_width"}};
  ASSERT_TRUE(laz.find("height_above_ground") && laz.find("pulse_width")) << describe_fields(laz);
  EXPECT_EQ(values(laz, fields), values(las, fields));
}

TEST_F(PdalReader, reads_copc)
{
  const PointTable las = read_las(ByteSource::from_file(path("cloud.las")), Parallel(1));
  ASSERT_NO_FATAL_FAILURE(convert("cloud.copc.laz", "writers.copc"));
  const PointTable copc = read_points(path("cloud.copc.laz"), Parallel(1));
  const std::vector<Field> fields = {{"gps_time"}, {"intensity"}, {"classification"}, {"red"}, {"green"}, {"blue"}};
  EXPECT_EQ(values(copc, fields), values(las, fields));
}

TEST_F(PdalReader, reads_e57)
{
  const PointTable las = read_las(ByteSource::from_file(path("cloud.las")), Parallel(1));
  ASSERT_NO_FATAL_FAILURE(convert("cloud.e57", "writers.e57"));
  const PointTable e57 = read_points(path("cloud.e57"), Parallel(1));
  ASSERT_EQ(e57.size(), las.size());
  for (std::size_t row = 0; row < las.size(); ++row) {
    for (const char* name : {"x", "y", "z"}) {  // PDAL's writer knows single precision only
      ASSERT_EQ(e57.value(row, *e57.find(name)), static_cast<float>(las.value(row, *las.find(name)))) << name;
    }
    for (const char* name : {"intensity", "red", "green", "blue"}) {
      ASSERT_EQ(e57.value(row, *e57.find(name)), las.value(row, *las.find(name))) << name;
    }
  }
}

}  // namespace
}  // namespace pds
