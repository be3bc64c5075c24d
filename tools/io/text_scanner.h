// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <vector>

namespace pds
{

/** \brief Reads all of \a token as a number in the C locale.
 * \return false, and \a number unchanged, if the token is anything else or out of the type's range
 */
template <typename Number>
[[nodiscard]] bool parse_number(std::string_view token, Number& number)
{
  if (token.size() > 1 && token.front() == '+' && token[1] != '-') {
    token.remove_prefix(1);  // from_chars does not take the sign that other tools may write
  }
  Number parsed{};
  const char* end = token.data() + token.size();
  const auto [stop, error] = std::from_chars(token.data(), end, parsed);
  if (error != std::errc() || stop != end) {
    return false;
  }
  number = parsed;
  return true;
}

/** \brief Reads all of \a token as a value of the type of \a scalar, as files hold them: whole numbers may be written
 * as 255.000000, and floating-point numbers may be too small or too large for their type.
 * \return false, and \a scalar unchanged, if the token is anything else
 */
template <typename Scalar>
[[nodiscard]] bool parse_scalar(std::string_view token, Scalar& scalar)
{
  if (parse_number(token, scalar)) {
    return true;
  }
  double value = 0;
  if (!parse_number(token, value)) {
    return false;
  }
  if constexpr (std::is_integral_v<Scalar>) {
    // Exact for all types: the greatest value of a 64-bit integer rounds up to a power of two.
    if (std::trunc(value) != value || value < static_cast<double>(std::numeric_limits<Scalar>::lowest()) ||
        value >= std::ldexp(1.0, std::numeric_limits<Scalar>::digits)) {
      return false;
    }
  }
  scalar = static_cast<Scalar>(value);
  return true;
}

/** \brief Hands out the lines and blank-separated tokens of a text in memory. Lines may end in LF or CR LF. */
class TextScanner
{
 public:
  explicit TextScanner(std::string_view text) : text_(text) {}

  /** \brief The next line without its end. \return false at the end of the text */
  [[nodiscard]] bool next_line(std::string_view& line)
  {
    if (position_ >= text_.size()) {
      return false;
    }
    const std::size_t end = text_.find('\n', position_);
    line = text_.substr(position_, end == std::string_view::npos ? end : end - position_);
    if (!line.empty() && line.back() == '\r') {
      line.remove_suffix(1);
    }
    position_ = end == std::string_view::npos ? text_.size() : end + 1;
    ++line_number_;
    return true;
  }

  /** \brief The next run of characters other than blanks and line ends. \return false at the end of the text */
  [[nodiscard]] bool next_token(std::string_view& token)
  {
    const auto is_blank = [](char letter) {
      return letter == ' ' || letter == '\n' || letter == '\t' || letter == '\r';
    };
    const auto begin = std::find_if_not(text_.begin() + position_, text_.end(), is_blank);
    const auto end = std::find_if(begin, text_.end(), is_blank);
    position_ = static_cast<std::size_t>(end - text_.begin());
    if (begin == end) {
      return false;
    }
    token = text_.substr(static_cast<std::size_t>(begin - text_.begin()), static_cast<std::size_t>(end - begin));
    return true;
  }

  [[nodiscard]] std::size_t position() const { return position_; }        ///< bytes handed out so far
  [[nodiscard]] std::size_t line_number() const { return line_number_; }  ///< of the last line, from 1

 private:
  std::string_view text_;
  std::size_t position_ = 0;
  std::size_t line_number_ = 0;
};

/** \brief Splits \a line at every run of \a separators into \a tokens, which are cleared first. */
inline void split(std::string_view line, std::string_view separators, std::vector<std::string_view>& tokens)
{
  tokens.clear();
  std::size_t begin = line.find_first_not_of(separators);
  while (begin != std::string_view::npos) {
    const std::size_t end = line.find_first_of(separators, begin);
    tokens.push_back(line.substr(begin, end == std::string_view::npos ? end : end - begin));
    begin = line.find_first_not_of(separators, end);
  }
}

/** \brief Whether a word has no control characters, as those of damaged files do: no format can hold such a name. */
inline bool is_printable(std::string_view word)
{
  constexpr char delete_character = 127;
  return std::all_of(word.begin(), word.end(), [](char c) {
    return static_cast<unsigned char>(c) > static_cast<unsigned char>(' ') && c != delete_character;
  });
}

}  // namespace pds
