// SPDX-License-Identifier: BSD-3-Clause
#include "html/histogram.h"

#include "html/html_text.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

namespace pds
{

namespace
{

std::vector<double> finite(const std::vector<double>& values)
{
  std::vector<double> kept;
  std::copy_if(values.begin(), values.end(), std::back_inserter(kept), [](double v) { return std::isfinite(v); });
  return kept;
}

/** The rank of a percentile: the least value that so many do not exceed. \param values not empty */
double nth(std::vector<double>& values, double share)
{
  const double rank = std::max(1.0, std::ceil(share * static_cast<double>(values.size())));
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(rank) - 1;
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

}  // namespace

Histogram make_histogram(const std::vector<double>& values, double low, double high, std::size_t bins)
{
  Histogram histogram{low, high, std::vector<std::size_t>(bins, 0), 0};
  for (const double value : values) {
    if (value >= low && value <= high) {
      const double place = (value - low) / (high - low) * static_cast<double>(bins);
      ++histogram.counts[std::min(static_cast<std::size_t>(place), bins - 1)];
    } else if (std::isfinite(value)) {
      ++histogram.outside;
    }
  }
  return histogram;
}

ValueSummary summarize(const std::vector<double>& values)
{
  std::vector<double> known = finite(values);
  ValueSummary summary;
  summary.count = known.size();
  if (known.empty()) {
    return summary;
  }
  for (const double value : known) {
    summary.mean += value / static_cast<double>(known.size());
  }
  summary.median = nth(known, 0.5);
  summary.p95 = nth(known, 0.95);
  const auto [min, max] = std::minmax_element(known.begin(), known.end());
  summary.min = *min;
  summary.max = *max;
  return summary;
}

double percentile(const std::vector<double>& values, double share)
{
  std::vector<double> known = finite(values);
  return known.empty() ? 0 : nth(known, share);
}

std::vector<double> axis_marks(double low, double high)
{
  constexpr double most = 6;  // steps: labels of six characters do not touch
  const double least_step = (high - low) / most;
  if (!(least_step > 0 && std::isfinite(least_step))) {
    return {low};
  }
  const double power = std::pow(10, std::floor(std::log10(least_step)));
  double step = 10 * power;
  for (const double digit : {1.0, 2.0, 5.0}) {
    if (digit * power >= least_step) {
      step = digit * power;
      break;
    }
  }
  std::vector<double> marks;
  constexpr double slack = 1e-9;  // of a step, for what rounding takes away
  for (double i = std::ceil(low / step - slack); i <= high / step + slack; ++i) {
    marks.push_back(i == 0 ? 0 : i * step);
  }
  return marks;
}

std::string to_svg(const Histogram& histogram, const std::string& label, const std::string& unit)
{
  constexpr double width = 480;
  constexpr double height = 150;
  constexpr double axis_height = 30;
  constexpr double side = 24;  // left and right, for the numbers of the outermost marks
  const std::size_t most =
      std::max<std::size_t>(1, *std::max_element(histogram.counts.begin(), histogram.counts.end()));
  const double range = histogram.high - histogram.low;
  const double bin_width = width / static_cast<double>(histogram.counts.size());
  std::string svg = fmt::format(R"(<svg class="histogram" viewBox="{} 0 {} {}" role="img" aria-label="{}">)", -side,
                                width + 2 * side, height + axis_height, escape_html(label));
  for (std::size_t bin = 0; bin < histogram.counts.size(); ++bin) {
    const double bar = height * static_cast<double>(histogram.counts[bin]) / static_cast<double>(most);
    const double left = static_cast<double>(bin) * bin_width;
    svg += fmt::format(
        R"(<rect x="{:.2f}" y="{:.2f}" width="{:.2f}" height="{:.2f}"><title>{:.4g} to {:.4g}{}: {}</title></rect>)",
        left, height - bar, bin_width * 0.9, bar, histogram.low + left / width * range,
        histogram.low + (left + bin_width) / width * range, escape_html(unit), histogram.counts[bin]);
  }
  svg += fmt::format(R"(<line x1="0" y1="{0}" x2="{1}" y2="{0}"/>)", height, width);
  for (const double mark : axis_marks(histogram.low, histogram.high)) {
    const double x = range > 0 ? (mark - histogram.low) / range * width : 0;
    svg += fmt::format(R"(<line x1="{0:.2f}" y1="{1}" x2="{0:.2f}" y2="{2}"/><text x="{0:.2f}" y="{3}">{4:.4g}</text>)",
                       x, height, height + 5, height + 22, mark);
  }
  return svg + "</svg>";
}

}  // namespace pds
