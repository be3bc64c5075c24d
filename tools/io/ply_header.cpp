// SPDX-License-Identifier: BSD-3-Clause
#include "io/ply_header.h"

#include "io/text_scanner.h"

#include <pcl_pds_recon/options.h>

#include <array>
#include <utility>

namespace pds
{

namespace
{

using Words = std::vector<std::string_view>;

std::optional<ScalarType> parse_type(std::string_view name)
{
  constexpr std::array<std::pair<std::string_view, ScalarType>, 16> types = {{
      {"char", ScalarType::int8},
      {"int8", ScalarType::int8},
      {"uchar", ScalarType::uint8},
      {"uint8", ScalarType::uint8},
      {"short", ScalarType::int16},
      {"int16", ScalarType::int16},
      {"ushort", ScalarType::uint16},
      {"uint16", ScalarType::uint16},
      {"int", ScalarType::int32},
      {"int32", ScalarType::int32},
      {"uint", ScalarType::uint32},
      {"uint32", ScalarType::uint32},
      {"float", ScalarType::float32},
      {"float32", ScalarType::float32},
      {"double", ScalarType::float64},
      {"float64", ScalarType::float64},
  }};
  for (const auto& [type_name, type] : types) {
    if (name == type_name) {
      return type;
    }
  }
  return std::nullopt;
}

bool parse_format(const Words& words, PlyEncoding& encoding)
{
  if (words.size() != 3 || words[2] != "1.0") {
    return false;
  }
  if (words[1] == "ascii") {
    encoding = PlyEncoding::ascii;
  } else if (words[1] == "binary_little_endian") {
    encoding = PlyEncoding::little_endian;
  } else if (words[1] == "binary_big_endian") {
    encoding = PlyEncoding::big_endian;
  } else {
    return false;
  }
  return true;
}

bool parse_element(const Words& words, std::vector<PlyElement>& elements)
{
  PlyElement element;
  if (words.size() != 3 || !parse_number(words[2], element.count)) {
    return false;
  }
  element.name = words[1];
  elements.push_back(std::move(element));
  return true;
}

bool parse_property(const Words& words, std::vector<PlyElement>& elements)
{
  const bool is_list = words.size() == 5 && words[1] == "list";
  if (elements.empty() || (!is_list && words.size() != 3) || !is_printable(words.back())) {
    return false;
  }
  PlyProperty property;
  property.name = words.back();
  const auto type = parse_type(words[words.size() - 2]);
  if (is_list) {
    property.list_size_type = parse_type(words[2]);
  }
  if (!type || (is_list && !property.list_size_type)) {
    return false;
  }
  property.type = *type;
  elements.back().properties.push_back(std::move(property));
  return true;
}

}  // namespace

PlyHeader parse_ply_header(std::string_view file)
{
  PlyHeader header;
  TextScanner scanner(file);
  std::string_view line;
  if (!scanner.next_line(line) || line != "ply") {
    throw InvalidInput("is not a PLY file, which starts with the line 'ply'; check the file's extension");
  }
  Words words;
  bool has_format = false;
  while (scanner.next_line(line)) {
    split(line, " \t", words);
    const std::string_view keyword = words.empty() ? std::string_view("comment") : words.front();
    bool understood = keyword == "comment" || keyword == "obj_info" || keyword == "end_header";
    if (keyword == "format") {
      understood = has_format = parse_format(words, header.encoding);
    } else if (keyword == "element") {
      understood = parse_element(words, header.elements);
    } else if (keyword == "property") {
      understood = parse_property(words, header.elements);
    }
    if (!understood || (keyword == "end_header" && !has_format)) {
      throw InvalidInput("line " + std::to_string(scanner.line_number()) +
                         " of the PLY header is not understood; write the file again with the tool that made it");
    }
    if (keyword == "end_header") {
      header.bytes = scanner.position();
      return header;
    }
  }
  throw InvalidInput("the PLY header has no 'end_header': the file is cut short; copy it again");
}

}  // namespace pds
