// SPDX-License-Identifier: BSD-3-Clause
#include "compare/face_readers.h"
#include "io/text_scanner.h"

#include <pcl_pds_recon/options.h>

#include <cstring>

namespace pds
{

namespace
{

using Corners = std::vector<Eigen::Vector3d>;  // three for each facet

constexpr std::size_t header_bytes = 80;
constexpr std::size_t count_bytes = 4;
constexpr std::size_t facet_bytes = 50;  // normal, three corners, and 16 bits without a meaning
constexpr std::size_t normal_bytes = 12;

/** \brief Number of facets if the file is as long as a binary file must be; text may begin in the same way. */
std::size_t binary_facets(std::string_view file)
{
  std::uint32_t count = 0;
  if (file.size() < header_bytes + count_bytes) {
    return 0;
  }
  std::memcpy(&count, file.data() + header_bytes, count_bytes);  // little endian, as this machine (see ply_writer)
  return (file.size() - header_bytes - count_bytes) / facet_bytes >= count ? count : 0;
}

Corners read_binary(std::string_view file, std::size_t count)
{
  Corners corners;
  corners.reserve(3 * count);
  for (std::size_t facet = 0; facet < count; ++facet) {
    float values[9];
    std::memcpy(values, file.data() + header_bytes + count_bytes + facet * facet_bytes + normal_bytes, sizeof values);
    for (int i = 0; i < 9; i += 3) {
      corners.emplace_back(values[i], values[i + 1], values[i + 2]);
    }
  }
  return corners;
}

Corners read_text(std::string_view file)
{
  Corners corners;
  TextScanner scanner(file);
  std::string_view line;
  std::vector<std::string_view> words;
  std::size_t loop_begin = 0;
  bool is_complete = false;
  while (scanner.next_line(line)) {
    split(line, " \t", words);
    if (words.empty()) {
      continue;
    }
    const auto require = [&scanner](bool condition, const char* what) {
      if (!condition) {
        throw InvalidInput("line " + std::to_string(scanner.line_number()) + ": " + what + "; write the mesh again");
      }
    };
    if (words.front() == "outer") {
      loop_begin = corners.size();
    } else if (words.front() == "vertex") {
      Eigen::Vector3d& p = corners.emplace_back();
      require(words.size() == 4 && parse_number(words[1], p.x()) && parse_number(words[2], p.y()) &&
                  parse_number(words[3], p.z()),
              "not 'vertex x y z' in numbers");
    } else if (words.front() == "endloop") {
      require(corners.size() == loop_begin + 3, "the facet does not have three corners");
    } else if (words.front() == "endsolid") {
      is_complete = true;
    }
  }
  if (!is_complete || corners.size() % 3 != 0) {
    throw InvalidInput("has no 'endsolid': the file is cut short; copy it again");
  }
  return corners;
}

MeshFile join_corners(const Corners& corners)
{
  const std::vector<std::uint32_t> first = coincident_vertices(corners);
  MeshFile mesh{PointTable({{"x", ScalarType::float64}, {"y", ScalarType::float64}, {"z", ScalarType::float64}}), {}};
  std::vector<std::uint32_t> number(corners.size());
  std::vector<std::uint32_t> kept;
  for (std::uint32_t corner = 0; corner < corners.size(); ++corner) {
    if (first[corner] == corner) {
      number[corner] = static_cast<std::uint32_t>(kept.size());
      kept.push_back(corner);
    }
  }
  mesh.points.resize(kept.size());
  for (std::size_t i = 0; i < kept.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      mesh.points.set_value(i, mesh.points.fields()[k], corners[kept[i]][static_cast<Eigen::Index>(k)]);
    }
  }
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    mesh.triangles.push_back({number[first[i]], number[first[i + 1]], number[first[i + 2]]});
  }
  return mesh;
}

}  // namespace

MeshFile read_stl(std::string_view file)
{
  const std::size_t count = binary_facets(file);
  if (count > 0) {
    return join_corners(read_binary(file, count));
  }
  constexpr std::string_view text_begin = "solid";
  if (file.substr(0, text_begin.size()) != text_begin) {
    throw InvalidInput("holds no facets, or fewer than it announces: the file is damaged; write it again");
  }
  return join_corners(read_text(file));
}

}  // namespace pds
