// SPDX-License-Identifier: BSD-3-Clause
#include "io/pcd_check.h"

#include "io/text_scanner.h"

#include <pcl_pds_recon/options.h>

#include <cstdint>
#include <cstring>
#include <numeric>
#include <string>
#include <vector>

namespace pds
{

namespace
{

using Words = std::vector<std::string_view>;
using Sizes = std::vector<std::uint64_t>;

/** What the header says about the size of the body. */
struct PcdLayout
{
  std::uint64_t points = 0;
  Sizes scalar_bytes;
  Sizes scalar_counts;
  std::string_view encoding;
  std::size_t header_bytes = 0;

  [[nodiscard]] std::uint64_t scalars() const
  {
    return std::accumulate(scalar_counts.begin(), scalar_counts.end(), std::uint64_t{0});
  }
  [[nodiscard]] std::uint64_t record_bytes() const
  {
    return std::inner_product(scalar_bytes.begin(), scalar_bytes.end(), scalar_counts.begin(), std::uint64_t{0});
  }
};

[[noreturn]] void throw_bad_header(const std::string& what)
{
  throw InvalidInput("is not a PCD file: its header " + what + "; write it again or check its extension");
}

[[noreturn]] void throw_truncated()
{
  throw InvalidInput("holds fewer data than its PCD header announces: the file is cut short; copy it again");
}

Sizes parse_sizes(const Words& words, std::uint64_t greatest)
{
  Sizes sizes(words.size() - 1);
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    if (!parse_number(words[i + 1], sizes[i]) || sizes[i] == 0 || sizes[i] > greatest) {
      throw_bad_header("has an impossible " + std::string(words.front()));
    }
  }
  return sizes;
}

PcdLayout parse_layout(std::string_view file)
{
  constexpr std::uint64_t greatest_scalar = 8;            // bytes of a double
  constexpr std::uint64_t greatest_scalar_count = 65536;  // of one field; the longest feature histograms have 2000
  PcdLayout layout;
  TextScanner scanner(file);
  std::string_view line;
  Words words;
  while (layout.encoding.empty() && scanner.next_line(line)) {
    split(line, " \t", words);
    const std::string_view keyword = words.empty() ? std::string_view() : words.front();
    if (keyword == "SIZE") {
      layout.scalar_bytes = parse_sizes(words, greatest_scalar);
      for (const std::uint64_t size : layout.scalar_bytes) {
        if ((size & (size - 1)) != 0) {
          throw_bad_header("has a SIZE that is not 1, 2, 4 or 8");
        }
      }
    } else if (keyword == "COUNT") {
      layout.scalar_counts = parse_sizes(words, greatest_scalar_count);
    } else if (keyword == "POINTS" && (words.size() != 2 || !parse_number(words[1], layout.points))) {
      throw_bad_header("has no number of POINTS");
    } else if (keyword == "DATA" && words.size() == 2) {
      layout.encoding = words[1];
    }
  }
  if (layout.encoding.empty() || layout.scalar_bytes.empty()) {
    throw_bad_header(layout.encoding.empty() ? "has no line 'DATA'" : "has no line 'SIZE'");
  }
  layout.scalar_counts.resize(layout.scalar_bytes.size(), 1);  // COUNT may be left out
  layout.header_bytes = scanner.position();
  return layout;
}

void check_ascii(std::string_view body, const PcdLayout& layout)
{
  TextScanner scanner(body);
  std::string_view line;
  Words words;
  for (std::uint64_t row = 0; row < layout.points;) {
    if (!scanner.next_line(line)) {
      throw_truncated();
    }
    split(line, " \t", words);
    if (words.empty()) {
      continue;
    }
    bool is_row = words.size() == layout.scalars();
    for (const std::string_view word : words) {
      double value = 0;
      is_row = is_row && parse_number(word, value);
    }
    if (!is_row) {
      throw InvalidInput("line " + std::to_string(scanner.line_number()) + " of the data is not a row of " +
                         std::to_string(layout.scalars()) + " numbers; correct it");
    }
    ++row;
  }
}

void check_binary(std::string_view body, const PcdLayout& layout)
{
  if (layout.points > body.size() / layout.record_bytes()) {
    throw_truncated();
  }
}

/** The compressed size, the size of all records, and the compressed bytes. */
void check_compressed(std::string_view body, const PcdLayout& layout)
{
  std::uint32_t sizes[2] = {};
  if (body.size() < sizeof sizes) {
    throw_truncated();
  }
  std::memcpy(sizes, body.data(), sizeof sizes);
  const auto [compressed_bytes, bytes] = sizes;
  if (compressed_bytes > body.size() - sizeof sizes || layout.points > bytes / layout.record_bytes()) {
    throw_truncated();
  }
  constexpr std::uint64_t greatest_compression = 88;  // a match of LZF copies at most 264 bytes and takes three
  if (bytes > greatest_compression * compressed_bytes) {
    throw InvalidInput("holds compressed data of an impossible size: the file is damaged; write it again");
  }
}

}  // namespace

void check_pcd(std::string_view file)
{
  const PcdLayout layout = parse_layout(file);
  const std::string_view body = file.substr(layout.header_bytes);
  if (layout.encoding == "ascii") {
    check_ascii(body, layout);
  } else if (layout.encoding == "binary_compressed") {
    check_compressed(body, layout);
  } else {
    check_binary(body, layout);
  }
}

}  // namespace pds
