// SPDX-License-Identifier: BSD-3-Clause
#include "io/obj_reader.h"

#include "io/text_scanner.h"

#include <pcl_pds_recon/options.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace pds
{

namespace
{

struct Vertex
{
  std::array<double, 3> position{};
  std::array<double, 3> color{};
};

constexpr double greatest_color = 255;  // of an unsigned char

/** \return whether the line holds a colour, in which case it follows the position and an optional weight w. */
bool parse_vertex(const std::vector<std::string_view>& words, std::size_t line_number, Vertex& vertex)
{
  constexpr std::size_t first_color = 4;
  const bool has_color = words.size() >= first_color + 3;
  bool understood = words.size() >= 4;
  for (std::size_t i = 0; i < 3 && understood; ++i) {
    understood = parse_number(words[i + 1], vertex.position[i]) &&
                 (!has_color || parse_number(words[words.size() - 3 + i], vertex.color[i]));
  }
  if (!understood) {
    throw InvalidInput("line " + std::to_string(line_number) + " is not 'v x y z [w] [r g b]' in numbers; correct it");
  }
  return has_color;
}

bool is_color(const std::array<double, 3>& color)
{
  return std::all_of(color.begin(), color.end(), [](double channel) { return channel >= 0 && channel <= 1; });
}

}  // namespace

PointTable read_obj(std::string_view file)
{
  std::vector<Vertex> vertices;
  bool has_colors = true;
  TextScanner scanner(file);
  std::string_view line;
  std::vector<std::string_view> words;
  while (scanner.next_line(line)) {
    split(line, " \t", words);
    if (!words.empty() && words.front() == "v") {
      const bool has_color = parse_vertex(words, scanner.line_number(), vertices.emplace_back());
      has_colors = has_colors && has_color && is_color(vertices.back().color);
    }
  }

  std::vector<Field> fields = {{"x", ScalarType::float64}, {"y", ScalarType::float64}, {"z", ScalarType::float64}};
  if (has_colors) {
    fields.insert(fields.end(),
                  {{"red", ScalarType::uint8}, {"green", ScalarType::uint8}, {"blue", ScalarType::uint8}});
  }
  PointTable table(std::move(fields));
  table.resize(vertices.size());
  for (std::size_t row = 0; row < vertices.size(); ++row) {
    for (std::size_t i = 0; i < 3; ++i) {
      table.set_value(row, table.fields()[i], vertices[row].position[i]);
      if (has_colors) {
        table.set_value(row, table.fields()[i + 3], std::round(greatest_color * vertices[row].color[i]));
      }
    }
  }
  return table;
}

}  // namespace pds
