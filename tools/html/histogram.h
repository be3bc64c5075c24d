// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace pds
{

/** \brief How many values lie in each of equal parts of a range. */
struct Histogram
{
  double low = 0;                   ///< begin of the first bin
  double high = 1;                  ///< end of the last bin, which belongs to it
  std::vector<std::size_t> counts;  ///< by bin
  std::size_t outside = 0;          ///< values that are not in the range
};

/** \brief Counts values; those that are not finite are passed over. */
[[nodiscard]] Histogram make_histogram(const std::vector<double>& values, double low, double high, std::size_t bins);

/** \brief Percentiles and mean of the finite values; all zero if there are none. */
struct ValueSummary
{
  std::size_t count = 0;
  double min = 0, median = 0, p95 = 0, max = 0, mean = 0;
};

[[nodiscard]] ValueSummary summarize(const std::vector<double>& values);

/** \brief The value that \a share of the finite values do not exceed; 0 if there are none. */
[[nodiscard]] double percentile(const std::vector<double>& values, double share);

/** \brief Round numbers from \a low to \a high, at most seven, for the marks of an axis. */
[[nodiscard]] std::vector<double> axis_marks(double low, double high);

/** \brief The histogram as an SVG element with its axis. \param unit what stands after the numbers */
[[nodiscard]] std::string to_svg(const Histogram& histogram, const std::string& label, const std::string& unit);

}  // namespace pds
