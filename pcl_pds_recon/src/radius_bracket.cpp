// SPDX-License-Identifier: BSD-3-Clause
#include "radius_bracket.h"

#include <algorithm>
#include <cmath>

namespace pds
{

double RadiusBracket::inside(double guess) const
{
  if (!closed()) return guess;
  constexpr double margin = 0.1;  // of the bracket: each try narrows it by that at least
  const double width = std::log(high_ / low_);
  return low_ * std::exp(width * std::clamp(std::log(guess / low_) / width, margin, 1 - margin));
}

}  // namespace pds
