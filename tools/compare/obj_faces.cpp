// SPDX-License-Identifier: BSD-3-Clause
#include "compare/face_readers.h"
#include "io/obj_index.h"
#include "io/text_scanner.h"

namespace pds
{

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
        corners.push_back(parse_obj_index(words[i].substr(0, words[i].find('/')), vertices, scanner.line_number()));
      }
      add_polygon(corners, triangles);
    }
  }
  return triangles;
}

}  // namespace pds
