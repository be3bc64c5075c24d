// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "html/report_page.h"

#include <string>
#include <utility>
#include <vector>

namespace pds
{

/** \brief 1234567 as 1,234,567. */
[[nodiscard]] std::string group_digits(std::size_t number);

/** \brief A table of two columns. The texts are escaped. */
[[nodiscard]] std::string table_html(const std::vector<std::pair<std::string, std::string>>& rows);

[[nodiscard]] std::string key_figures_html(const Report& report);
[[nodiscard]] std::string counts_html(const Report& report);
[[nodiscard]] std::string certificate_html(const Report& report);
[[nodiscard]] std::string timings_html(const StageSeconds& seconds);
[[nodiscard]] std::string parameters_html(const CommandLine& command_line);
[[nodiscard]] std::string histograms_html(const ReportPage& page, const Report& report);
[[nodiscard]] std::string pictures_html(const ReportPage& page);

/** \brief The mesh to turn, or why there is none. */
[[nodiscard]] std::string viewer_html(const ReportPage& page);

}  // namespace pds
