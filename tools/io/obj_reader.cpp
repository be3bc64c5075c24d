// SPDX-License-Identifier: BSD-3-Clause
#include "io/obj_reader.h"

#include "io/obj_colors.h"
#include "io/obj_normals.h"
#include "io/sentence_list.h"
#include "io/text_scanner.h"

#include <pcl_pds_recon/options.h>

#include <algorithm>
#include <array>
#include <utility>

namespace pds
{

namespace
{

using Vector = std::array<double, 3>;
using Words = std::vector<std::string_view>;

/** What the keyword of a line stands for that no point cloud has. */
const char* name_of_other(std::string_view keyword)
{
  constexpr std::array<std::pair<std::string_view, const char*>, 8> names = {{{"f", "faces"},
                                                                              {"l", "lines"},
                                                                              {"vt", "texture coordinates"},
                                                                              {"usemtl", "materials"},
                                                                              {"mtllib", "materials"},
                                                                              {"g", "groups"},
                                                                              {"o", "groups"},
                                                                              {"s", "groups"}}};
  const auto* found =
      std::find_if(names.begin(), names.end(), [keyword](const auto& name) { return name.first == keyword; });
  return found == names.end() ? "statements that are not of polygons" : found->second;
}

void add_fields(std::vector<Field>& fields, const FieldTriple& names, ScalarType type)
{
  for (const char* name : names) {
    fields.push_back({name, type});
  }
}

void fill(PointTable& table, const FieldTriple& names, const std::vector<Vector>& vectors)
{
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Field& field = *table.find(names[i]);
    for (std::size_t row = 0; row < vectors.size(); ++row) {
      table.set_value(row, field, vectors[row][i]);
    }
  }
}

/** Gathers what the lines of a file say of its vertices. */
class ObjContent
{
 public:
  void add_line(const Words& words, std::size_t line_number)
  {
    const std::string_view keyword = words.front();
    if (keyword == "v") {
      add_vertex(words, line_number);
    } else if (keyword == "vn") {
      normals_.add_normal(words, line_number);
    } else if (keyword.front() != '#') {
      leave_out(name_of_other(keyword));
      if (keyword == "f") {
        normals_.add_face(words, positions_.size(), line_number);
      }
    }
  }

  [[nodiscard]] PointTable make_table()
  {
    const std::vector<Vector> normals = normals_.of_vertices(positions_.size());
    if (normals.empty() && !normals_.empty()) {
      leave_out("normals (not one for each vertex)");
    }
    const std::vector<Vector> colors = colors_.of_vertices(positions_.size());
    if (colors.empty() && !colors_.empty()) {
      leave_out("colours (not one in 0 ... 1 for each vertex)");
    }
    std::vector<Field> fields;
    add_fields(fields, position_fields, ScalarType::float64);
    if (!normals.empty()) {
      add_fields(fields, normal_fields, ScalarType::float64);
    }
    if (!colors.empty()) {
      add_fields(fields, color_fields, colors_.type());
    }
    PointTable table(std::move(fields), positions_.size());
    fill(table, position_fields, positions_);
    if (!normals.empty()) {
      fill(table, normal_fields, normals);
    }
    if (!colors.empty()) {
      fill(table, color_fields, colors);
    }
    table.not_read = sentence_list(left_out_);
    return table;
  }

 private:
  /** 'v x y z', and after it a weight w, a colour, or both. */
  void add_vertex(const Words& words, std::size_t line_number)
  {
    constexpr std::size_t of_position = 4;
    constexpr std::size_t of_color = 3;
    Vector& position = positions_.emplace_back();
    const bool has_color = words.size() >= of_position + of_color;
    bool understood = words.size() >= of_position && (!has_color || colors_.add(&words[words.size() - of_color]));
    for (std::size_t i = 0; i < position.size() && understood; ++i) {
      understood = parse_number(words[i + 1], position[i]);
    }
    if (!understood) {
      throw InvalidInput("line " + std::to_string(line_number) +
                         " is not 'v x y z [w] [r g b]' in numbers; correct it");
    }
    if (words.size() != of_position && words.size() != of_position + of_color) {
      leave_out("weights");
    }
  }

  void leave_out(const char* what)
  {
    if (std::find(left_out_.begin(), left_out_.end(), what) == left_out_.end()) {
      left_out_.emplace_back(what);
    }
  }

  std::vector<Vector> positions_;
  ObjNormals normals_;
  ObjColors colors_;
  std::vector<std::string> left_out_;
};

}  // namespace

PointTable read_obj(std::string_view file)
{
  ObjContent content;
  TextScanner scanner(file);
  std::string_view line;
  Words words;
  while (scanner.next_line(line)) {
    split(line, " \t", words);
    if (!words.empty()) {
      content.add_line(words, scanner.line_number());
    }
  }
  return content.make_table();
}

}  // namespace pds
