// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reader_testing.h"

#include <boost/crc.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

// Writes E57 files byte by byte, as ASTM E2807 lays them out: PDAL's own writer knows single precision only.

namespace pds
{

constexpr std::size_t e57_header_bytes = 48;
constexpr std::size_t e57_page_bytes = 1024;
constexpr std::size_t e57_page_content = e57_page_bytes - 4;  // the rest is a checksum

inline std::uint64_t e57_physical(std::uint64_t logical)
{
  return logical / e57_page_content * e57_page_bytes + logical % e57_page_content;
}

/** \brief A field of the points. */
struct E57Column
{
  std::string name;
  std::vector<double> values;
};

/** \brief The points as binary data: packets with all columns of some points. */
inline std::string e57_points(const std::vector<E57Column>& columns)
{
  constexpr std::size_t points_of_packet = 1000;
  const std::size_t size = columns.front().values.size();
  std::string packets;
  for (std::size_t first = 0; first < size; first += points_of_packet) {
    const std::size_t count = std::min(points_of_packet, size - first);
    std::string lengths = bytes_of(static_cast<std::uint16_t>(columns.size()));
    std::string buffers;
    for (const E57Column& column : columns) {
      lengths += bytes_of(static_cast<std::uint16_t>(count * sizeof(double)));
      for (std::size_t i = first; i < first + count; ++i) {
        buffers += bytes_of(column.values[i]);
      }
    }
    std::string content = lengths + buffers;
    content.resize((content.size() + 3) / 4 * 4, '\0');
    const auto length = static_cast<std::uint16_t>(4 + content.size() - 1);
    packets += bytes_of(std::uint8_t{1}) + bytes_of(std::uint8_t{0}) + bytes_of(length) + content;
  }
  constexpr std::size_t head_bytes = 32;
  const std::uint64_t data_at = e57_physical(e57_header_bytes + head_bytes);
  return bytes_of(std::uint64_t{1}) + bytes_of(std::uint64_t{head_bytes + packets.size()}) + bytes_of(data_at) +
         bytes_of(std::uint64_t{0}) + packets;
}

/** \brief The content of a file without checksums: a scan with these fields, all in double precision.
 * \param announced number of points, as the file says
 * \param of_scan what the description says of the scan besides */
inline std::string e57_content(const std::vector<E57Column>& columns,
                               std::size_t announced,
                               const std::string& of_scan = "")
{
  const std::string data = e57_points(columns);
  std::string prototype;
  for (const E57Column& column : columns) {
    prototype.append("<").append(column.name).append(" type=\"Float\"/>");
  }
  const std::string xml =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>"
      "<e57Root type=\"Structure\" xmlns=\"http://www.astm.org/COMMIT/E57/2010-e57-v1.0\">"
      "<formatName type=\"String\">ASTM E57 3D Imaging Data File</formatName><guid type=\"String\">{1}</guid>"
      "<versionMajor type=\"Integer\">1</versionMajor><versionMinor type=\"Integer\">0</versionMinor>"
      "<data3D type=\"Vector\" allowHeterogeneousChildren=\"1\"><vectorChild type=\"Structure\">"
      "<guid type=\"String\">{2}</guid><points type=\"CompressedVector\" fileOffset=\"" +
      std::to_string(e57_physical(e57_header_bytes)) + "\" recordCount=\"" + std::to_string(announced) +
      "\"><prototype type=\"Structure\">" + prototype +
      "</prototype><codecs type=\"Vector\" "
      "allowHeterogeneousChildren=\"1\"/></points>" +
      of_scan + "</vectorChild></data3D></e57Root>";
  const std::uint64_t xml_at = e57_header_bytes + data.size();
  const std::uint64_t logical_bytes = xml_at + xml.size();
  const std::uint64_t pages = (logical_bytes + e57_page_content - 1) / e57_page_content;
  std::string logical = "ASTM-E57" + bytes_of(std::uint32_t{1}) + bytes_of(std::uint32_t{0}) +
                        bytes_of(std::uint64_t{pages * e57_page_bytes}) + bytes_of(e57_physical(xml_at)) +
                        bytes_of(std::uint64_t{xml.size()}) + bytes_of(std::uint64_t{e57_page_bytes}) + data + xml;
  logical.resize(pages * e57_page_content, '\0');
  return logical;
}

/** \brief The file with this content, each page with its checksum. */
inline std::string e57_file(const std::string& content)
{
  std::string file;
  for (std::size_t begin = 0; begin < content.size(); begin += e57_page_content) {
    boost::crc_optimal<32, 0x1EDC6F41, 0xFFFFFFFF, 0xFFFFFFFF, true, true> checksum;  // CRC-32C
    checksum.process_bytes(content.data() + begin, e57_page_content);
    std::string bytes = bytes_of(static_cast<std::uint32_t>(checksum.checksum()));
    std::reverse(bytes.begin(), bytes.end());
    file += content.substr(begin, e57_page_content) + bytes;
  }
  return file;
}

inline std::string e57(const std::vector<E57Column>& columns, std::size_t announced)
{
  return e57_file(e57_content(columns, announced));
}

}  // namespace pds
