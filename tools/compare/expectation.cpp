// SPDX-License-Identifier: BSD-3-Clause
#include "compare/expectation.h"

#include "io/text_scanner.h"
#include "program.h"

#include <cmath>

namespace pds
{

namespace
{

bool holds(double left, const std::string& relation, double right)
{
  if (relation == "<=") {
    return left <= right;
  }
  if (relation == ">=") {
    return left >= right;
  }
  if (relation == "==") {
    return left == right;
  }
  if (relation == "!=") {
    return left != right;
  }
  return relation == "<" ? left < right : left > right;
}

const nlohmann::ordered_json& find(const nlohmann::ordered_json& report, const Expectation& expectation)
{
  const nlohmann::ordered_json* at = &report;
  for (std::size_t begin = 0; begin <= expectation.key.size();) {
    const std::size_t end = std::min(expectation.key.find('.', begin), expectation.key.size());
    const std::string name = expectation.key.substr(begin, end - begin);
    if (!at->is_object() || !at->contains(name)) {
      throw UsageError("--expect: '" + expectation.text + "': the report has no key '" + expectation.key +
                       "'; --json shows all");
    }
    at = &(*at)[name];
    begin = end + 1;
  }
  return *at;
}

}  // namespace

Expectation parse_expectation(const std::string& text)
{
  Expectation result;
  result.text = text;
  const std::size_t begin = text.find_first_of("<>=!");
  const std::size_t end = text.find_first_not_of("<>=!", begin);
  if (begin != std::string::npos && begin > 0 && end != std::string::npos) {
    result.key = text.substr(0, begin);
    result.relation = text.substr(begin, end - begin);
    const std::string value = text.substr(end);
    const bool is_relation = result.relation == "<=" || result.relation == ">=" || result.relation == "==" ||
                             result.relation == "!=" || result.relation == "<" || result.relation == ">";
    const bool is_true = value == "true";
    if (is_relation && (is_true || value == "false")) {
      result.value = is_true ? 1 : 0;
      return result;
    }
    if (is_relation && parse_number(value, result.value) && !std::isnan(result.value)) {
      return result;
    }
  }
  throw UsageError("--expect: '" + text +
                   "' is not KEY, one of <= >= == != < > and a number, such as 'hausdorff<=0.1'");
}

std::string unmet(const Expectation& expectation, const nlohmann::ordered_json& report)
{
  const nlohmann::ordered_json& found = find(report, expectation);
  if (found.is_structured() || found.is_string()) {
    throw UsageError("--expect: '" + expectation.text + "': there is no number under '" + expectation.key + "'");
  }
  const double value = found.is_null()      ? std::nan("")
                       : found.is_boolean() ? (found.get<bool>() ? 1.0 : 0.0)
                                            : found.get<double>();
  if (!std::isnan(value) && holds(value, expectation.relation, expectation.value)) {
    return "";
  }
  return expectation.text + " (is " + found.dump() + ")";
}

}  // namespace pds
