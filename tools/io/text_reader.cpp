// SPDX-License-Identifier: BSD-3-Clause
#include "io/text_reader.h"

#include "io/text_columns.h"
#include "io/text_scanner.h"

#include <pcl_pds_recon/options.h>

#include <algorithm>

namespace pds
{

namespace
{

using Words = std::vector<std::string_view>;

/** Commas or semicolons part the columns if there are any, so that names may hold blanks; otherwise blanks do. */
void split_columns(std::string_view line, Words& words)
{
  constexpr std::string_view blanks = " \t";
  const bool has_marks = line.find_first_of(",;") != std::string_view::npos;
  split(line, has_marks ? ",;" : blanks, words);
  for (std::string_view& word : words) {
    word.remove_prefix(std::min(word.find_first_not_of(blanks), word.size()));
    word = word.substr(0, word.find_last_not_of(blanks) + 1);
  }
}

bool starts_with(std::string_view text, std::string_view beginning)
{
  return text.substr(0, beginning.size()) == beginning;
}

/** The text of a comment line without its mark, nothing if the line is none. */
std::optional<std::string_view> comment_text(std::string_view line)
{
  line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  if (starts_with(line, "#")) {
    return line.substr(1);
  }
  if (starts_with(line, "//")) {
    return line.substr(2);
  }
  return std::nullopt;
}

/** The rows of the file as they are parsed, and the names if the file gives any. */
class RowParser
{
 public:
  void parse_line(std::string_view line, std::size_t line_number)
  {
    if (const auto comment = comment_text(line)) {
      parse_comment(*comment);
      return;
    }
    split_columns(line, words_);
    if (words_.empty()) {
      return;
    }
    const std::string place = "line " + std::to_string(line_number);
    if (line.find(';') != std::string_view::npos && line.find(',') != std::string_view::npos) {
      throw InvalidInput(place + " has both ';' and ',': write decimal points, not decimal commas");
    }
    const bool is_first = columns_ == 0;
    if (is_first) {
      columns_ = words_.size();
    }
    if (words_.size() != columns_) {
      throw InvalidInput(place + " has " + std::to_string(words_.size()) + " columns where the lines before have " +
                         std::to_string(columns_) + "; give every line the same columns");
    }
    if (!parse_row() && !(is_first && parse_names(words_))) {
      throw InvalidInput(place + " is not a row of numbers; correct it or start it with '#'");
    }
  }

  /** \return the columns named and typed */
  [[nodiscard]] PointTable table() const
  {
    const bool has_names = names_.size() == columns_;
    return make_table(TextColumns{values_, columns_}, has_names ? names_ : std::vector<std::string>());
  }

 private:
  bool parse_row()
  {
    const std::size_t begin = values_.size();
    values_.resize(begin + columns_);
    for (std::size_t i = 0; i < columns_; ++i) {
      if (!parse_number(words_[i], values_[begin + i])) {
        values_.resize(begin);
        return false;
      }
    }
    return true;
  }

  bool parse_names(const Words& words)
  {
    std::vector<std::string> names;
    std::transform(words.begin(), words.end(), std::back_inserter(names), canonical_column_name);
    for (const char* coordinate : {"x", "y", "z"}) {
      if (std::find(names.begin(), names.end(), coordinate) == names.end()) {
        return false;
      }
    }
    names_ = std::move(names);
    return true;
  }

  /** Some tools, CloudCompare among them, write the names as a comment. */
  void parse_comment(std::string_view comment)
  {
    if (values_.empty()) {
      split_columns(comment, words_);
      parse_names(words_);
    }
  }

  std::size_t columns_ = 0;
  std::vector<double> values_;
  std::vector<std::string> names_;
  Words words_;
};

}  // namespace

PointTable read_text(std::string_view file)
{
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (starts_with(file, byte_order_mark)) {
    file.remove_prefix(byte_order_mark.size());
  }
  RowParser parser;
  TextScanner scanner(file);
  std::string_view line;
  while (scanner.next_line(line)) {
    parser.parse_line(line, scanner.line_number());
  }
  return parser.table();
}

}  // namespace pds
