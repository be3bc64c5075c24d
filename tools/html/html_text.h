// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace pds
{

/** \brief Text as it stands in HTML, between tags or in a quoted attribute. */
[[nodiscard]] std::string escape_html(std::string_view text);

/** \brief Bytes in the alphabet of RFC 4648, with padding. */
[[nodiscard]] std::string to_base64(std::string_view bytes);

/** \brief The template with each {{name}} replaced by the HTML of that name; what is put in is not searched again.
 * \throws std::out_of_range if a name is not known
 */
[[nodiscard]] std::string fill_template(std::string_view text, const std::map<std::string, std::string>& html_by_name);

}  // namespace pds
