// SPDX-License-Identifier: BSD-3-Clause
#include "compare/face_readers.h"
#include "io/text_scanner.h"

#include <pcl_pds_recon/options.h>

namespace pds
{

namespace
{

/** \brief A corner is "7", "7/1", "7//2" or "7/1/2": the 7th vertex; "-1" is the one read last.
 * \return its number from 0, or a number that no vertex has */
std::uint32_t parse_corner(std::string_view word, std::uint32_t vertices_so_far, std::size_t line_number)
{
  std::int64_t number = 0;
  if (!parse_number(word.substr(0, word.find('/')), number) || number == 0) {
    throw InvalidInput("line " + std::to_string(line_number) + " is not 'f' and numbers of vertices; correct it");
  }
  const std::int64_t index = number > 0 ? number - 1 : vertices_so_far + number;
  if (index < 0 || index >= std::int64_t{0xffffffff}) {
    throw InvalidInput("line " + std::to_string(line_number) + " names a vertex that is not there; correct it");
  }
  return static_cast<std::uint32_t>(index);
}

}  // namespace

Triangles read_obj_faces(std::string_view file)
{
  Triangles triangles;
  std::uint32_t vertices = 0;
  TextScanner scanner(file);
  std::string_view line;
  std::vector<std::string_view> words;
  std::vector<std::uint32_t> corners;
  while (scanner.next_line(line)) {
    split(line, " \t", words);
    if (words.empty()) {
      continue;
    }
    if (words.front() == "v") {
      ++vertices;
    } else if (words.front() == "f") {
      corners.clear();
      for (std::size_t i = 1; i < words.size(); ++i) {
        corners.push_back(parse_corner(words[i], vertices, scanner.line_number()));
      }
      add_polygon(corners, triangles);
    }
  }
  return triangles;
}

}  // namespace pds
