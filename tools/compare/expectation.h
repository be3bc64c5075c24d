// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace pds
{

/** \brief A condition on a report, such as "mesh_to_reference.mean<=0.001". */
struct Expectation
{
  std::string text;      ///< as given
  std::string key;       ///< names of nested objects are parted by dots
  std::string relation;  ///< one of <= >= == != < >
  double value = 0;      ///< of a condition on a boolean: 0 or 1
};

/** \throws UsageError if \a text is not KEY, a relation and a number, true or false */
[[nodiscard]] Expectation parse_expectation(const std::string& text);

/** \brief Says how a report fails a condition, such as "components<=1 (is 2)"; empty if it is met. A value that is not
 * there (null) meets none.
 * \throws UsageError if the report has no such key, or no number under it
 */
[[nodiscard]] std::string unmet(const Expectation& expectation, const nlohmann::ordered_json& report);

}  // namespace pds
