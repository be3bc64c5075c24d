// SPDX-License-Identifier: BSD-3-Clause
#include "io/las_header.h"

#include "io/number_at.h"
#include "io/record_reader.h"

#include <pcl_pds_recon/options.h>

#include <algorithm>
#include <boost/endian/conversion.hpp>
#include <cmath>
#include <limits>
#include <string>

namespace pds
{

namespace
{

static_assert(boost::endian::order::native == boost::endian::order::little, "LAS files are little endian");

// ASPRS LAS 1.4 R15, table 3: places in the public header block.
constexpr std::size_t major_version_at = 24;
constexpr std::size_t minor_version_at = 25;
constexpr std::size_t header_bytes_at = 94;
constexpr std::size_t point_format_at = 104;
constexpr std::size_t record_bytes_at = 105;
constexpr std::size_t legacy_count_at = 107;
constexpr std::size_t scale_at = 131;
constexpr std::size_t offset_at = 155;
constexpr std::size_t bounds_at = 179;     // greatest x, least x, greatest y, ...
constexpr std::size_t header_bytes = 227;  // of versions 1.0 to 1.2
constexpr std::size_t waveforms_at = 227;  // from version 1.3 on
constexpr std::size_t header_bytes_1_3 = 235;
constexpr std::size_t extended_records_at = 235;  // from version 1.4 on

constexpr std::array<std::size_t, 11> standard_bytes = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};  // by format

[[noreturn]] void throw_damaged(const std::string& what)
{
  throw InvalidInput("has a LAS header with " + what + ": the file is damaged; copy it again");
}

[[noreturn]] void throw_cut_short()
{
  throw InvalidInput("holds fewer data than its LAS header announces: the file is cut short; copy it again");
}

std::size_t parse_point_format(std::uint8_t code, LasCompression compression)
{
  constexpr std::uint8_t compressed = 0xC0;  // LASzip sets one of the two highest bits
  const std::size_t format = code & ~compressed;
  if (format >= standard_bytes.size()) {
    throw_damaged("the unknown point format " + std::to_string(code));
  }
  const bool is_compressed = (code & compressed) != 0;
  if (is_compressed && compression == LasCompression::none) {
    throw InvalidInput("is compressed; let its name end in .laz, which a build with PDAL reads");
  }
  if (!is_compressed && compression == LasCompression::laszip) {
    throw InvalidInput("is not compressed; let its name end in .las");
  }
  return format;
}

/** Whether it is one of the standard's, and has the point format. */
void check_version(const std::string& header, std::size_t point_format)
{
  const auto major = number_at<std::uint8_t>(header.data() + major_version_at);
  const auto minor = number_at<std::uint8_t>(header.data() + minor_version_at);
  constexpr std::size_t first_format_of_1_4 = 6;
  if (major != 1 || minor > 4) {
    throw InvalidInput("is LAS of the unknown version " + std::to_string(major) + "." + std::to_string(minor) +
                       ": it is damaged or too new; convert it to LAS 1.4");
  }
  if (minor < 4 && point_format >= first_format_of_1_4) {
    throw_damaged("point format " + std::to_string(point_format) + ", which version 1." + std::to_string(minor) +
                  " does not have");
  }
}

/** Version 1.4 has a number of 64 bits, which writers of older point formats sometimes leave at 0. */
std::uint64_t parse_count(const std::string& header)
{
  const auto legacy_count = number_at<std::uint32_t>(header.data() + legacy_count_at);
  if (number_at<std::uint8_t>(header.data() + minor_version_at) < 4) {
    return legacy_count;
  }
  if (number_at<std::uint16_t>(header.data() + header_bytes_at) < las_header_bytes_1_4 ||
      header.size() < las_header_bytes_1_4) {
    throw_damaged("too few bytes for version 1.4");
  }
  const auto count = number_at<std::uint64_t>(header.data() + las_count_at);
  return count == 0 ? legacy_count : count;
}

void parse_end(const std::string& bytes, std::size_t file_bytes, LasHeader& header)
{
  const auto minor_version = number_at<std::uint8_t>(bytes.data() + minor_version_at);
  std::uint64_t end = file_bytes;
  if (minor_version >= 3 && las_has_waveforms(header.point_format) && bytes.size() >= header_bytes_1_3) {
    const auto waveforms = number_at<std::uint64_t>(bytes.data() + waveforms_at);
    end = waveforms == 0 ? end : std::min(end, waveforms);  // 0: they are in a file of their own
  }
  if (minor_version >= 4) {
    header.extended_count = number_at<std::uint32_t>(bytes.data() + las_extended_record_count_at);
    header.extended_begin = number_at<std::uint64_t>(bytes.data() + extended_records_at);
    end = header.extended_count > 0 ? std::min(end, header.extended_begin) : end;
  }
  header.end = end;
}

void parse_bounds(const std::string& bytes, LasHeader& header)
{
  for (std::size_t axis = 0; axis < header.least.size(); ++axis) {
    const auto [greatest, least] =
        number_at<std::array<double, 2>>(bytes.data() + bounds_at + axis * 2 * sizeof(double));
    header.greatest[axis] = greatest;
    header.least[axis] = least;
  }
}

/** Whether the records fill the file up to what follows; a few bytes behind them, too few for one more, do no harm. */
void check_count(const LasHeader& header)
{
  const std::uint64_t room = header.end < header.begin ? 0 : (header.end - header.begin) / header.record_bytes;
  if (header.count > room) {
    throw_cut_short();
  }
  if (header.count < room) {
    throw_data_after_points();
  }
}

/** Whether all coordinates are numbers that a double holds with decimals; others are of a damaged header. */
bool has_sensible_range(const LasHeader& header)
{
  constexpr double greatest_integer = std::numeric_limits<std::int32_t>::max();
  constexpr double greatest_coordinate = 1e15;
  for (std::size_t axis = 0; axis < header.scale.size(); ++axis) {
    const double greatest = std::abs(header.scale[axis]) * greatest_integer + std::abs(header.offset[axis]);
    if (!(header.scale[axis] > 0 && greatest <= greatest_coordinate)) {  // nor NaN
      return false;
    }
  }
  return true;
}

}  // namespace

bool las_has_waveforms(std::size_t point_format) { return point_format == 4 || point_format == 5 || point_format >= 9; }

std::size_t las_standard_bytes(std::size_t point_format) { return standard_bytes.at(point_format); }

LasHeader read_las_header(const ByteSource& source, LasCompression compression)
{
  const std::string bytes = source.head(las_header_bytes_1_4);
  if (bytes.compare(0, 4, "LASF") != 0) {
    throw InvalidInput("is not a LAS file, which starts with 'LASF'; check the file's extension");
  }
  if (bytes.size() < header_bytes) {
    throw InvalidInput("the LAS header is cut short; copy the file again");
  }
  LasHeader header;
  header.point_format = parse_point_format(number_at<std::uint8_t>(bytes.data() + point_format_at), compression);
  check_version(bytes, header.point_format);
  header.header_bytes = number_at<std::uint16_t>(bytes.data() + header_bytes_at);
  header.record_count = number_at<std::uint32_t>(bytes.data() + las_record_count_at);
  header.record_bytes = number_at<std::uint16_t>(bytes.data() + record_bytes_at);
  header.begin = number_at<std::uint32_t>(bytes.data() + las_begin_at);
  header.count = parse_count(bytes);
  parse_end(bytes, source.size(), header);
  header.scale = number_at<std::array<double, 3>>(bytes.data() + scale_at);
  header.offset = number_at<std::array<double, 3>>(bytes.data() + offset_at);
  parse_bounds(bytes, header);
  if (header.record_bytes < las_standard_bytes(header.point_format)) {
    throw_damaged("records shorter than their point format");
  }
  if (header.header_bytes < header_bytes) {
    throw_damaged("a length below that of any version");
  }
  if (!has_sensible_range(header)) {
    throw_damaged("an impossible scale or offset");
  }
  if (header.begin < std::max(header.header_bytes, header_bytes)) {
    throw_damaged("points inside the header");
  }
  if (header.record_count > (header.begin - header.header_bytes) / las_record_head_bytes) {
    throw_damaged("records that reach into the points");
  }
  if (header.begin > source.size()) {
    throw_cut_short();
  }
  if (compression == LasCompression::none) {
    check_count(header);
  }
  return header;
}

}  // namespace pds
