// SPDX-License-Identifier: BSD-3-Clause
#include "io/obj_normals.h"

#include "io/obj_index.h"

#include <algorithm>
#include <limits>
#include <string>

namespace pds
{

namespace
{

constexpr std::uint32_t no_normal = std::numeric_limits<std::uint32_t>::max();

}  // namespace

void ObjNormals::add_normal(const std::vector<std::string_view>& words, std::size_t line_number)
{
  Vector& normal = normals_.emplace_back();
  bool understood = words.size() == 1 + normal.size();
  for (std::size_t i = 0; i < normal.size() && understood; ++i) {
    understood = parse_number(words[i + 1], normal[i]);
  }
  if (!understood) {
    throw InvalidInput("line " + std::to_string(line_number) + " is not 'vn x y z' in numbers; correct it");
  }
}

void ObjNormals::add_face(const std::vector<std::string_view>& words,
                          std::size_t vertices_so_far,
                          std::size_t line_number)
{
  for (std::size_t i = 1; i < words.size(); ++i) {
    const std::size_t first_slash = words[i].find('/');
    const std::size_t last_slash = words[i].rfind('/');
    if (first_slash != last_slash) {
      const std::uint32_t vertex = parse_obj_index(words[i].substr(0, first_slash), vertices_so_far, line_number);
      const std::uint32_t normal = parse_obj_index(words[i].substr(last_slash + 1), normals_.size(), line_number);
      in_order_ = in_order_ && vertex == normal;
      if (vertex < vertices_so_far) {
        name_normal(vertex, normal);
      }
    }
  }
}

void ObjNormals::name_normal(std::uint32_t vertex, std::uint32_t normal)
{
  if (vertex >= normal_of_vertex_.size()) {
    normal_of_vertex_.resize(vertex + std::size_t{1}, no_normal);
  }
  std::uint32_t& known = normal_of_vertex_[vertex];
  if (known == no_normal) {
    known = normal;
  }
  const bool are_both_read = std::max(known, normal) < normals_.size();
  one_each_ = one_each_ && (known == normal || (are_both_read && normals_[known] == normals_[normal]));
}

std::vector<ObjNormals::Vector> ObjNormals::of_vertices(std::size_t count) const
{
  if (in_order_ && normals_.size() == count) {
    return normals_;
  }
  const auto is_there = [this](std::uint32_t normal) { return normal < normals_.size(); };
  if (!one_each_ || normal_of_vertex_.size() != count ||
      !std::all_of(normal_of_vertex_.begin(), normal_of_vertex_.end(), is_there)) {
    return {};
  }
  std::vector<Vector> normals(count);
  std::transform(normal_of_vertex_.begin(), normal_of_vertex_.end(), normals.begin(),
                 [this](std::uint32_t normal) { return normals_[normal]; });
  return normals;
}

}  // namespace pds
