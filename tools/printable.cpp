// SPDX-License-Identifier: BSD-3-Clause
#include "printable.h"

#include <spdlog/fmt/fmt.h>

namespace pds
{

namespace
{

constexpr unsigned char delete_character = 0x7F;
constexpr unsigned char lead_of_controls = 0xC2;  // in UTF-8 the control characters 0x80 ... 0x9F are two bytes
constexpr unsigned char first_control = 0x80;
constexpr unsigned char last_control = 0x9F;

}  // namespace

std::string printable(const std::string& text)
{
  std::string line;
  unsigned char previous = 0;
  for (const char letter : text) {
    const auto byte = static_cast<unsigned char>(letter);
    const bool is_wide_control = previous == lead_of_controls && byte >= first_control && byte <= last_control;
    if (letter == '\n') {
      line += "\\n";
    } else if (byte < ' ' || byte == delete_character) {
      line += fmt::format("\\x{:02x}", byte);
    } else if (is_wide_control) {
      line.pop_back();
      line += fmt::format("\\u00{:02x}", byte);
    } else {
      line += letter;
    }
    previous = byte;
  }
  return line;
}

}  // namespace pds
