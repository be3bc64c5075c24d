// SPDX-License-Identifier: BSD-3-Clause
#include "io/pdal_reader.h"

#include "io/las_reader.h"
#include "io/read_points.h"
#include "las_testing.h"
#include "temporary_directory.h"

#include <pdal/PipelineManager.hpp>

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
    pdal::PipelineManager pipeline;
    pipeline.setLog(pdal::Log::makeLog("", "devnull"));
    pdal::Options reader_options;
    reader_options.add("use_eb_vlr", true);
    pdal::Stage& reader = pipeline.makeReader(path("cloud.las"), "readers.las", reader_options);
    pdal::Options options;
    if (driver != std::string("writers.e57")) {
      options.add("forward", "all");
    }
    if (driver == std::string("writers.las")) {
      options.add("compression", true);
      options.add("extra_dims", "all");
    }
    pipeline.makeWriter(path(name), driver, reader, options);
    ASSERT_EQ(pipeline.execute(), 5000U);
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
};

TEST_F(PdalReader, gives_of_laz_what_our_reader_gives_of_the_same_las_to_the_last_bit)
{
  const PointTable las = read_las(ByteSource::from_file(path("cloud.las")), Parallel(1));
  ASSERT_NO_FATAL_FAILURE(convert("cloud.laz", "writers.las"));
  const PointTable laz = read_points(path("cloud.laz"), Parallel(1));
  std::vector<Field> common;
  for (const Field& field : las.fields()) {
    if (const Field* same = laz.find(field.name)) {
      EXPECT_EQ(same->type, field.type) << field.name;
      common.push_back(field);
    }
  }
  EXPECT_GE(common.size(), 16U) << "all but some flags, which PDAL names by its version";
  EXPECT_EQ(values(laz, common), values(las, common));
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
    for (const char* name : {"x", "y", "z"}) {  // PDAL 2.x writes single precision
      ASSERT_EQ(e57.value(row, *e57.find(name)), static_cast<float>(las.value(row, *las.find(name)))) << name;
    }
    ASSERT_EQ(e57.value(row, *e57.find("intensity")), las.value(row, *las.find("intensity")));
  }
}

TEST_F(PdalReader, names_an_e57_file_that_is_cut_short_or_whose_header_lies)
{
  ASSERT_NO_FATAL_FAILURE(convert("cloud.e57", "writers.e57"));
  const std::string e57 = read("cloud.e57");
  ASSERT_GT(e57.size(), 5000U);
  std::string lying = e57;
  const std::uint64_t more = e57.size() + 4096;
  constexpr std::size_t file_bytes_at = 16;  // ASTM E2807, table 1
  std::memcpy(lying.data() + file_bytes_at, &more, sizeof more);
  for (const auto& [name, bytes] : std::vector<std::pair<std::string, std::string>>{
           {"short.e57", e57.substr(0, e57.size() / 2)}, {"header.e57", e57.substr(0, 40)}, {"lying.e57", lying}}) {
    const std::string file = write(name, bytes);
    const std::string message = complaint([&file] { return read_points(file, Parallel(1)); });
    EXPECT_EQ(message.rfind(file + ": ", 0), 0U) << name << ": " << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST_F(PdalReader, names_a_file_that_is_empty_cut_short_or_no_cloud_at_all)
{
  ASSERT_NO_FATAL_FAILURE(convert("cloud.laz", "writers.las"));
  const std::string laz = read("cloud.laz");
  std::string lying = laz;
  const std::uint64_t count = std::uint64_t{1} << 40;
  std::memcpy(lying.data() + 247, &count, sizeof count);
  for (const auto& [name, bytes] : std::vector<std::pair<std::string, std::string>>{{"empty.laz", ""},
                                                                                    {"short.laz", laz.substr(0, 9000)},
                                                                                    {"header.laz", laz.substr(0, 200)},
                                                                                    {"lying.laz", lying},
                                                                                    {"text.laz", "1 2 3\n"},
                                                                                    {"empty.e57", ""},
                                                                                    {"text.e57", "1 2 3\n"}}) {
    const std::string file = write(name, bytes);
    const std::string message = complaint([&file] { return read_points(file, Parallel(1)); });
    EXPECT_EQ(message.rfind(file + ": ", 0), 0U) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace pds
