// SPDX-License-Identifier: BSD-3-Clause
#include "html/html_text.h"

#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>

namespace pds
{

std::string escape_html(std::string_view text)
{
  std::string html;
  for (const char character : text) {
    switch (character) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      case '\'':
        html += "&#39;";
        break;
      default:
        html += character;
    }
  }
  return html;
}

std::string to_base64(std::string_view bytes)
{
  using Sextets = boost::archive::iterators::transform_width<const char*, 6, 8>;
  using Letters = boost::archive::iterators::base64_from_binary<Sextets>;
  constexpr std::size_t group =
      3;  // bytes that become four letters; Boost reads beyond the end of one that is not full
  const std::size_t left_over = bytes.size() % group;
  const std::string_view whole = bytes.substr(0, bytes.size() - left_over);
  std::string text(Letters(whole.data()), Letters(whole.data() + whole.size()));
  if (left_over > 0) {
    std::string last(bytes.substr(whole.size()));
    last.resize(group, '\0');
    text.append(Letters(last.data()), Letters(last.data() + group));
    text.replace(text.size() - (group - left_over), group - left_over, group - left_over, '=');
  }
  return text;
}

std::string fill_template(std::string_view text, const std::map<std::string, std::string>& html_by_name)
{
  constexpr std::string_view opening = "{{";
  constexpr std::string_view closing = "}}";
  std::string page;
  while (true) {
    const std::size_t place = text.find(opening);
    page += text.substr(0, place);
    if (place == std::string_view::npos) {
      return page;
    }
    text.remove_prefix(place + opening.size());
    const std::size_t length = text.find(closing);
    page += html_by_name.at(std::string(text.substr(0, length)));
    text.remove_prefix(length + closing.size());
  }
}

}  // namespace pds
