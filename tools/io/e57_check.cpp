// SPDX-License-Identifier: BSD-3-Clause
#include "io/e57_check.h"

#include "io/number_at.h"

#include <pcl_pds_recon/options.h>

#include <array>
#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <cmath>
#include <limits>
#include <sstream>
#include <vector>

namespace pds
{

namespace
{

using Tree = boost::property_tree::ptree;

/** A field of the points, whose scalars fill a stream. */
struct Stream
{
  unsigned bits = 0;  ///< of a scalar; 0 if all are the same number, or if it is text
  bool is_float = false;
  bool is_text = false;
  std::uint64_t bytes = 0;
};

[[noreturn]] void throw_damaged(const std::string& what)
{
  throw InvalidInput("has " + what + ": the file is damaged; copy it again");
}

template <typename Number>
Number attribute(const Tree& element, const char* name, Number default_value)
{
  const auto text = element.get_optional<std::string>(std::string("<xmlattr>.") + name);
  if (!text) {
    return default_value;
  }
  const auto number = element.get_optional<Number>(std::string("<xmlattr>.") + name);
  if (!number) {
    throw_damaged(std::string("an E57 description with an impossible ") + name);
  }
  return *number;
}

unsigned bits_of_integers(std::int64_t least, std::int64_t greatest)
{
  if (least > greatest) {
    throw_damaged("an E57 description with numbers whose minimum is above their maximum");
  }
  unsigned bits = 0;
  for (auto states = static_cast<std::uint64_t>(greatest) - static_cast<std::uint64_t>(least); states > 0;
       states >>= 1) {
    ++bits;
  }
  return bits;
}

Stream make_stream(const Tree& field)
{
  constexpr unsigned single_bits = 32;
  constexpr unsigned double_bits = 64;
  const std::string type = field.get<std::string>("<xmlattr>.type", "");
  if (type == "Float") {
    const bool is_single = field.get<std::string>("<xmlattr>.precision", "double") == "single";
    return {is_single ? single_bits : double_bits, true};
  }
  if (type == "Integer" || type == "ScaledInteger") {
    using Limits = std::numeric_limits<std::int64_t>;
    return {bits_of_integers(attribute(field, "minimum", Limits::min()), attribute(field, "maximum", Limits::max()))};
  }
  return {0, false, true};
}

/** The fields in the order of their streams; those of a structure stand where it stands. */
void append_streams(const Tree& prototype, std::vector<Stream>& streams)
{
  for (const auto& [name, field] : prototype) {
    if (name == "<xmlattr>" || name == "<xmlcomment>") {
      continue;
    }
    if (field.get<std::string>("<xmlattr>.type", "") == "Structure") {
      append_streams(field, streams);
    } else {
      streams.push_back(make_stream(field));
    }
  }
}

/** Adds up what the packets of a binary section hold of each stream (ASTM E2807, section 9). \return packets of data */
std::uint64_t measure_streams(const E57File& file, std::uint64_t place, std::vector<Stream>& streams)
{
  constexpr std::uint8_t packet_of_data = 1;
  constexpr std::uint64_t least_packet_bytes = 4;
  constexpr std::size_t head_bytes = 6;    // type, flags, length - 1, number of streams
  std::array<std::uint64_t, 3> section{};  // identifier, length, place of the first packet
  file.read(place, section.data(), sizeof section);
  if (static_cast<std::uint8_t>(section[0]) != 1) {
    throw_damaged("no points where its E57 description says");
  }
  const std::uint64_t end = place + section[1];
  std::uint64_t packets = 0;
  for (place = E57File::logical(section[2]); place + head_bytes <= end;) {
    std::array<char, head_bytes> head{};
    file.read(place, head.data(), head.size());
    if (static_cast<std::uint8_t>(head[0]) == packet_of_data) {
      std::vector<std::uint16_t> lengths(number_at<std::uint16_t>(&head[4]));
      if (lengths.size() != streams.size()) {
        throw_damaged("packets of other fields than its E57 description names");
      }
      file.read(place + head_bytes, lengths.data(), lengths.size() * sizeof lengths.front());
      for (std::size_t i = 0; i < streams.size(); ++i) {
        streams[i].bytes += lengths[i];
      }
      ++packets;
    }
    const std::uint64_t length = std::uint64_t{number_at<std::uint16_t>(&head[2])} + 1;
    if (length < least_packet_bytes) {
      throw_damaged("E57 packets of an impossible length");
    }
    place += length;
  }
  return packets;
}

void check_count(const E57File& file, const Tree& points)
{
  std::vector<Stream> streams;
  append_streams(points.get_child("prototype"), streams);
  const auto count = attribute<std::int64_t>(points, "recordCount", 0);
  const std::uint64_t packets =
      measure_streams(file, E57File::logical(attribute<std::uint64_t>(points, "fileOffset", 0)), streams);
  constexpr double word_bits = 64;  // the longest that integers are packed into
  for (const Stream& stream : streams) {
    if (stream.bits == 0) {
      if (!stream.is_text && stream.bytes > 0) {
        throw_damaged("an E57 description with a constant field that is none");
      }
      continue;
    }
    const double bits = 8 * static_cast<double>(stream.bytes);
    const double spare = stream.is_float ? 0 : word_bits * static_cast<double>(packets);
    const auto announced = static_cast<double>(count);
    if (announced < 0 || bits < announced * stream.bits) {
      throw InvalidInput("announces " + std::to_string(count) +
                         " points and holds data of fewer: the file is cut short or damaged; copy it again");
    }
    if (bits >= (announced + 1) * stream.bits + spare) {
      throw InvalidInput(
          "announces " + std::to_string(count) +
          " points and holds data of more: the file is damaged, or its writer was stopped; write it again");
    }
  }
}

void check_pose(const Tree& scan)
{
  constexpr double tolerance = 1e-3;  // of a rotation in single precision
  const auto rotation = scan.get_child_optional("pose.rotation");
  if (!rotation) {
    return;
  }
  double square = 0;
  for (const char* name : {"w", "x", "y", "z"}) {
    const auto number = rotation->get<double>(name, 0);  // empty elements are 0
    square += number * number;
  }
  if (!(std::abs(square - 1) <= tolerance)) {  // nor NaN
    throw_damaged("a scan whose pose is no rotation");
  }
}

Tree parse(const std::string& description)
{
  std::istringstream stream(description);
  Tree tree;
  try {
    boost::property_tree::read_xml(stream, tree);
  } catch (const boost::property_tree::xml_parser_error& error) {
    throw_damaged("a description in XML that is wrong in line " + std::to_string(error.line()));
  }
  return tree;
}

}  // namespace

void check_e57_points(const E57File& file)
{
  const Tree tree = parse(file.description());
  const auto scans = tree.get_child_optional("e57Root.data3D");
  if (!scans) {
    throw_damaged("no scans in its E57 description");
  }
  for (const auto& [name, scan] : *scans) {
    if (name != "vectorChild") {
      continue;
    }
    const auto points = scan.get_child_optional("points");
    if (!points || !points->get_child_optional("prototype")) {
      throw_damaged("a scan without points in its E57 description");
    }
    check_pose(scan);
    check_count(file, *points);
  }
}

}  // namespace pds
