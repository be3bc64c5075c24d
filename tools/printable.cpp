// SPDX-License-Identifier: BSD-3-Clause
#include "printable.h"

#include <spdlog/fmt/fmt.h>
#include <boost/locale/utf.hpp>

namespace pds
{

namespace
{

namespace utf = boost::locale::utf;

bool is_control(utf::code_point letter)
{
  constexpr utf::code_point blank = 0x20;
  constexpr utf::code_point delete_character = 0x7F;
  constexpr utf::code_point last_control = 0x9F;
  return letter < blank || (letter >= delete_character && letter <= last_control);
}

}  // namespace

std::string printable(const std::string& text)
{
  std::string line;
  for (auto place = text.begin(); place != text.end();) {
    const auto begin = place;
    const utf::code_point letter = utf::utf_traits<char>::decode(place, text.end());
    if (letter == '\n') {
      line += "\\n";
    } else if (!utf::is_valid_codepoint(letter)) {  // no UTF-8, but bytes of a damaged file
      place = begin + 1;
      line += fmt::format("\\x{:02x}", static_cast<unsigned char>(*begin));
    } else if (is_control(letter)) {
      line += fmt::format("\\x{:02x}", letter);
    } else {
      line.append(begin, place);
    }
  }
  return line;
}

}  // namespace pds
