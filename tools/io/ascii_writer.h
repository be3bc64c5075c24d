// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/atomic_file.h"

#include <charconv>
#include <cstddef>
#include <string>
#include <string_view>

namespace pds
{

/** \brief Writes words and numbers in lines, and hands them on to the file in blocks.
 *
 * A number has the fewest digits that give the same bits back.
 */
class AsciiWriter
{
 public:
  explicit AsciiWriter(AtomicFile& file) : file_(file) { text_.reserve(2 * block_bytes); }

  void append(std::string_view word)
  {
    text_ += word;
    text_ += ' ';
  }

  template <typename Number>
  void append_number(Number number)
  {
    constexpr std::size_t longest_number = 32;  // "-2.2250738585072014e-308" has 24 characters
    char digits[longest_number];
    const char* end = std::to_chars(digits, digits + longest_number, number).ptr;
    append(std::string_view(digits, static_cast<std::size_t>(end - digits)));
  }

  /** \brief Ends a line of at least one word. */
  void end_line()
  {
    text_.back() = '\n';
    if (text_.size() >= block_bytes) {
      flush();
    }
  }

  /** \brief To be called at the end: the destructor could not report that the disk is full. */
  void flush()
  {
    file_.write(text_.data(), text_.size());
    text_.clear();
  }

 private:
  static constexpr std::size_t block_bytes = 1 << 16;

  AtomicFile& file_;
  std::string text_;
};

}  // namespace pds
