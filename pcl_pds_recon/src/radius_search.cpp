// SPDX-License-Identifier: BSD-3-Clause
#include "radius_search.h"

#include <pcl_pds_recon/options.h>
#include <algorithm>
#include <cmath>

namespace pds
{

ErrorSearch::ErrorSearch(double max_error, double radius, double least_radius)
    : max_error_(max_error), radius_(std::max(radius, least_radius)), least_radius_(least_radius)
{
}

bool ErrorSearch::measured(double error)
{
  const bool near_enough = error <= max_error_;
  const bool is_last = ++meshes_ >= most_meshes || (bracket_.closed() && bracket_.high() < narrow * bracket_.low());
  if (near_enough && is_last) return true;
  if (!near_enough && radius_ <= least_radius_)
    throw InvalidInput("max_error: 1 % of the points are farther from the finest mesh than that; give more than " +
                       std::to_string(error));
  if (near_enough)
    bracket_.too_small(radius_);
  else
    bracket_.too_large(radius_);
  if (bracket_.closed() && (is_last || bracket_.high() < narrow * bracket_.low())) {
    if (near_enough) return true;
    radius_ = bracket_.low();  // known to be near enough
    return false;
  }
  constexpr double most_change = 3.0;
  const double least_change = bracket_.closed() ? 1.0 : 1.1;  // lest a bracket takes many steps to close
  const double change = std::sqrt(max_error_ / error);
  const double guess = radius_ * (near_enough ? std::clamp(change, least_change, most_change)
                                              : std::clamp(change, 1 / most_change, 1 / least_change));
  radius_ = std::max(bracket_.inside(guess), least_radius_);
  return false;
}

RadiusSearch::RadiusSearch(const Options& options, double radius, double least_radius) : radius_(radius)
{
  if (radius <= 0) return;
  if (options.vertices > 0) count_.emplace(options.vertices, radius);
  if (options.max_error > 0) error_.emplace(options.max_error, radius, least_radius);
}

double RadiusSearch::radius() const
{
  if (count_) return count_->radius();
  return error_ ? error_->radius() : radius_;
}

bool RadiusSearch::meshed(const std::function<std::size_t()>& vertices, const std::function<double()>& error)
{
  if (count_) return count_->meshed(vertices());
  return !error_ || error_->measured(error());
}

}  // namespace pds
