// SPDX-License-Identifier: BSD-3-Clause
#include "io/las_reader.h"

#include "io/record_reader.h"
#include "las_testing.h"

namespace pds
{
namespace
{

using Values = std::vector<double>;

PointTable read(const std::string& file) { return read_las(ByteSource(file), Parallel(2)); }
std::string complaint_about(const std::string& file)
{
  return complaint([&file] { return read(file); });
}

Values values_of(const PointTable& table, std::size_t row, const std::vector<const char*>& names)
{
  Values values;
  for (const char* name : names) {
    values.push_back(table.value(row, *table.find(name)));
  }
  return values;
}

TEST(LasReader, reads_all_fields_of_a_format_with_narrow_flags)
{
  LasFile file(2, 3, 34);
  const std::uint8_t flags = 0b11'010'011;   // edge, direction, 2 returns, the third
  const std::uint8_t classes = 0b101'00110;  // withheld, synthetic, class 6
  file.add(bytes_of(1) + bytes_of(-2) + bytes_of(3) + bytes_of(std::uint16_t{65535}) + bytes_of(flags) +
           bytes_of(classes) + bytes_of(std::int8_t{-90}) + bytes_of(std::uint8_t{9}) + bytes_of(std::uint16_t{513}) +
           bytes_of(0.1) + bytes_of(std::uint16_t{1}) + bytes_of(std::uint16_t{2}) + bytes_of(std::uint16_t{255}));
  const PointTable table = read(file.bytes());
  EXPECT_EQ(describe_fields(table),
            "x:double y:double z:double intensity:ushort scan_angle:char user_data:uchar point_source_id:ushort "
            "gps_time:double return_number:uchar number_of_returns:uchar scan_direction_flag:uchar "
            "edge_of_flight_line:uchar classification:uchar synthetic:uchar key_point:uchar withheld:uchar red:uchar "
            "green:uchar blue:uchar");
  EXPECT_EQ(row_values(table, 0),
            (Values{500000.001, 4999999.998, 0.03, 65535, -90, 9, 513, 0.1, 3, 2, 1, 1, 6, 1, 0, 1, 1, 2, 255}));
  EXPECT_EQ(table.not_read, "");
}

TEST(LasReader, reads_all_fields_of_a_format_with_wide_flags)
{
  LasFile file(4, 8, 38);
  const std::uint8_t returns = 0b1111'0010;
  const std::uint8_t flags = 0b1'0'11'1010;  // edge, channel 3, overlap, key point
  file.add(bytes_of(0) + bytes_of(0) + bytes_of(0) + bytes_of(std::uint16_t{5}) + bytes_of(returns) + bytes_of(flags) +
           bytes_of(std::uint8_t{200}) + bytes_of(std::uint8_t{8}) + bytes_of(std::int16_t{-15000}) +
           bytes_of(std::uint16_t{4}) + bytes_of(1e9) + bytes_of(std::uint16_t{65535}) + bytes_of(std::uint16_t{256}) +
           bytes_of(std::uint16_t{1}) + bytes_of(std::uint16_t{300}));
  const PointTable table = read(file.bytes());
  EXPECT_EQ(values_of(table, 0,
                      {"return_number", "number_of_returns", "synthetic", "key_point", "withheld", "overlap",
                       "scan_channel", "scan_direction_flag", "edge_of_flight_line", "classification"}),
            (Values{2, 15, 0, 1, 0, 1, 3, 0, 1, 200}));
  EXPECT_EQ(values_of(table, 0, {"scan_angle", "gps_time", "infrared", "red", "green", "blue"}),
            (Values{-90, 1e9, 300, 65535, 256, 1}));
  EXPECT_EQ(table.find("red")->type, ScalarType::uint16) << "16 bits are used";
}

TEST(LasReader, narrows_colors_that_hold_eight_bits)
{
  for (const unsigned factor : {1U, 256U, 257U}) {
    LasFile file(2, 2, 26);
    for (const unsigned channel : {0U, 128U, 255U}) {
      std::string record = las_record(0, 0, 0, 2);
      record.resize(20, '\0');
      file.add(record + bytes_of(static_cast<std::uint16_t>(channel * factor)));
    }
    const PointTable table = read(file.bytes());
    ASSERT_EQ(table.color_type(), ScalarType::uint8) << factor;
    EXPECT_EQ(values_of(table, 1, {"red", "green"}), (Values{128, 0})) << factor;
    EXPECT_EQ(values_of(table, 2, {"red"}), Values{255}) << factor;
  }
}

TEST(LasReader, gives_coordinates_the_doubles_that_the_standard_defines)
{
  LasFile file(2, 0, 20);
  constexpr std::size_t count = 20000;  // several blocks
  for (std::size_t i = 0; i < count; ++i) {
    const auto number = static_cast<std::int32_t>(i * 104729);
    file.add(las_record(number, -number, 7, 2));
  }
  const PointTable table = read(file.bytes());
  ASSERT_EQ(table.size(), count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto number = static_cast<std::int32_t>(i * 104729);
    ASSERT_EQ(values_of(table, i, {"x", "y", "z"}),
              (Values{0.001 * number + 500000, 0.001 * -number + 5000000, 0.01 * 7}));
  }
}

/** A record of format 0 with these bytes after it. */
std::string with_extra(const std::string& extra)
{
  std::string record = las_record(1, 2, 3, 2);
  record.resize(20, '\0');
  return record + extra;
}

TEST(LasReader, makes_fields_of_extra_bytes)
{
  LasFile file(2, 0, 20 + 1 + 8 + 4 + 2 + 8);
  file.describe_extra(2, 0, "Amplitude", 0, 0);
  file.describe_extra(7, 0, "Pulse count", 0, 0);
  file.describe_extra(9, 0, "intensity", 0, 0);
  file.describe_extra(4, 8 + 16, "HeightAboveGround", 0.01, -5);
  file.describe_extra(10, 0, "", 0.5, 7);
  file.add(with_extra(bytes_of(std::int8_t{-3}) + bytes_of((std::uint64_t{1} << 63) + 1) + bytes_of(0.1F) +
                      bytes_of(std::int16_t{-1234}) + bytes_of(0.3)));
  const PointTable table = read(file.bytes());
  EXPECT_EQ(table.not_read, "");
  EXPECT_EQ(values_of(table, 0, {"amplitude", "intensity", "intensity_", "height_above_ground", "extra"}),
            (Values{-3, 77, static_cast<double>(0.1F), 0.01 * -1234 - 5, 0.3}));
  const Field& wide = *table.find("pulse_count");
  EXPECT_EQ(wide.type, ScalarType::uint64);
  std::uint64_t count = 0;
  std::memcpy(&count, table.record(0) + wide.offset, sizeof count);
  EXPECT_EQ(count, (std::uint64_t{1} << 63) + 1);
  EXPECT_EQ(table.find("height_above_ground")->type, ScalarType::float64);
}

TEST(LasReader, says_which_extra_bytes_it_does_not_read_and_finds_those_behind_them)
{
  LasFile file(2, 0, 20 + 3 + 4 + 1);
  file.describe_extra(0, 3, "raw", 0, 0);
  file.describe_extra(13, 0, "array of two ushorts", 0, 0);
  file.describe_extra(1, 0, "last", 0, 0);
  file.add(with_extra("abc1234" + bytes_of(std::uint8_t{9})));
  const PointTable table = read(file.bytes());
  EXPECT_EQ(table.not_read, "some of the extra bytes");
  EXPECT_EQ(values_of(table, 0, {"last"}), Values{9});
}

TEST(LasReader, does_not_believe_descriptions_of_bytes_that_are_not_there)
{
  LasFile file(2, 0, 22);
  file.describe_extra(5, 0, "four bytes", 0, 0);
  file.add(with_extra("ab"));
  EXPECT_NE(complaint_about(file.bytes()).find("more extra bytes"), std::string::npos);
  LasFile without(2, 0, 22);
  without.add(with_extra("ab"));
  without.set(100, std::uint32_t{4000000000});
  EXPECT_NE(complaint_about(without.bytes()).find("reach into the points"), std::string::npos);
}

TEST(LasReader, says_what_it_does_not_read)
{
  LasFile with_extra_bytes(4, 6, 33);
  with_extra_bytes.add(las_record(0, 0, 0, 0));
  EXPECT_EQ(read(with_extra_bytes.bytes()).not_read, "extra bytes");
  LasFile with_waveforms(3, 4, 60);
  with_waveforms.add(las_record(0, 0, 0, 0));
  EXPECT_EQ(read(with_waveforms.bytes()).not_read, "waveforms and extra bytes");
}

TEST(LasReader, complains_of_a_header_that_announces_too_few_points)
{
  const auto complaint_with = [](std::uint8_t minor_version, std::uint32_t records_behind, const std::string& behind) {
    LasFile file(minor_version, 0, 20);
    file.add(las_record(1, 2, 3, 6));
    if (minor_version >= 4) {
      file.set(235, static_cast<std::uint64_t>(file.bytes().size()));
      file.set(243, records_behind);
    }
    return complaint_about(file.bytes() + behind);
  };
  const std::string point = las_record(4, 5, 6, 2) + std::string(4, '\0');
  EXPECT_NE(complaint_with(4, 0, point).find("goes on after the last point"), std::string::npos);
  EXPECT_NE(complaint_with(2, 0, point).find("goes on after the last point"), std::string::npos);
  const std::string record = std::string(20, '\0') + bytes_of(std::uint64_t{20}) + std::string(32, '\0') + point;
  EXPECT_EQ(complaint_with(4, 1, record), "") << "an extended variable-length record";
  EXPECT_NE(complaint_with(4, 1, record.substr(0, 79)).find("extended records"), std::string::npos);
  EXPECT_NE(complaint_with(4, 2, record).find("extended records"), std::string::npos);
  EXPECT_EQ(complaint_with(4, 0, "padding"), "");
}

TEST(LasReader, does_not_take_waveforms_for_points)
{
  LasFile file(3, 4, 57);
  file.add(las_record(1, 2, 3, 6));
  const auto begin = static_cast<std::uint64_t>(file.bytes().size());
  EXPECT_NE(complaint_about(file.bytes() + std::string(100, '\0')).find("goes on"), std::string::npos);
  file.set(227, begin + 57);
  EXPECT_NE(complaint_about(file.bytes() + std::string(100, '\0')).find("goes on"), std::string::npos);
  file.set(227, begin);
  EXPECT_EQ(complaint_about(file.bytes() + std::string(100, '\0')), "");
  file.set(227, begin - 1);
  EXPECT_NE(complaint_about(file.bytes() + std::string(100, '\0')).find("cut short"), std::string::npos);
}

TEST(LasReader, takes_the_legacy_count_if_a_writer_of_1_4_has_left_the_other_at_0)
{
  LasFile file(4, 3, 34);
  file.add(las_record(1, 2, 3, 2));
  file.add(las_record(4, 5, 6, 2));
  file.set(107, std::uint32_t{2});
  file.set(247, std::uint64_t{0});
  EXPECT_EQ(read_las(ByteSource(file.bytes()), Parallel(1)).size(), 2U);
}

TEST(LasReader, names_what_is_wrong)
{
  LasFile good(2, 0, 20);
  good.add(las_record(1, 2, 3, 2));
  good.add(las_record(4, 5, 6, 2));
  EXPECT_EQ(complaint_about(good.bytes()), "");
  EXPECT_NE(complaint_about("LASX").find("not a LAS file"), std::string::npos);
  EXPECT_NE(complaint_about(good.bytes().substr(0, 100)).find("cut short"), std::string::npos);
  EXPECT_NE(complaint_about(good.bytes().substr(0, 227 + 39)).find("cut short"), std::string::npos);
  const auto with = [&good](std::size_t place, auto number) {
    LasFile file = good;
    file.set(place, number);
    return complaint_about(file.bytes());
  };
  EXPECT_NE(with(104, std::uint8_t{0x80}).find("compressed"), std::string::npos);
  EXPECT_NE(with(104, std::uint8_t{11}).find("point format 11"), std::string::npos);
  EXPECT_NE(with(104, std::uint8_t{77}).find("point format 77"), std::string::npos);
  EXPECT_NE(with(105, std::uint16_t{19}).find("shorter"), std::string::npos);
  EXPECT_NE(with(96, std::uint32_t{10}).find("inside the header"), std::string::npos);
  EXPECT_NE(with(96, std::uint32_t{4000000000}).find("cut short"), std::string::npos);
  EXPECT_NE(with(107, std::uint32_t{4000000000}).find("cut short"), std::string::npos);
  EXPECT_NE(with(24, std::uint8_t{2}).find("unknown version 2.2"), std::string::npos);
  EXPECT_NE(with(25, std::uint8_t{5}).find("unknown version 1.5"), std::string::npos);
  EXPECT_NE(with(104, std::uint8_t{6}).find("version 1.2 does not have"), std::string::npos);
  EXPECT_NE(with(100, std::uint32_t{1}).find("records"), std::string::npos);
  EXPECT_NE(with(131, 0.0).find("scale"), std::string::npos);
  EXPECT_NE(with(131, -0.001).find("scale"), std::string::npos);
  EXPECT_NE(with(131, 1e300).find("scale"), std::string::npos);
  EXPECT_NE(with(155, std::numeric_limits<double>::quiet_NaN()).find("scale"), std::string::npos);
  LasFile wide(4, 6, 30);
  wide.add(las_record(1, 2, 3, 2));
  wide.set(247, ~std::uint64_t{0});
  EXPECT_NE(complaint_about(wide.bytes()).find("cut short"), std::string::npos);
}

}  // namespace
}  // namespace pds
