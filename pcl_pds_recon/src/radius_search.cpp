// SPDX-License-Identifier: BSD-3-Clause
#include "radius_search.h"

#include <pcl_pds_recon/options.h>
#include <algorithm>
#include <cmath>
#include <limits>

namespace pds
{

double RadiusBracket::inside(double guess) const
{
  if (!closed()) return guess;
  constexpr double margin = 0.1;  // of the bracket: each try narrows it by that at least
  const double width = std::log(high_ / low_);
  return low_ * std::exp(width * std::clamp(std::log(guess / low_) / width, margin, 1 - margin));
}

VertexCountSearch::VertexCountSearch(std::uint64_t vertices, double radius)
    : vertices_(static_cast<double>(vertices)),
      seeds_(vertices_),
      radius_(radius),
      best_radius_(radius),
      best_miss_(std::numeric_limits<double>::infinity()),
      tolerance_(std::max(2.0, 0.005 * vertices_))
{
}

bool VertexCountSearch::sampled(std::size_t seeds)
{
  last_seeds_ = seeds;
  const auto count = static_cast<double>(seeds);
  const double miss = std::abs(count - seeds_);
  if (miss < best_miss_) {
    best_miss_ = miss;
    best_radius_ = radius_;
  }
  if (miss <= tolerance_ / 2 || ++samplings_ > most_samplings) return true;
  if (samplings_ == most_samplings) {
    radius_ = best_radius_;
    return false;
  }
  if (count > seeds_)
    bracket_.too_small(radius_);
  else
    bracket_.too_large(radius_);
  constexpr double most_change = 2.0;  // a count far off says little about the next one
  radius_ = bracket_.inside(radius_ * std::clamp(std::sqrt(count / seeds_), 1 / most_change, most_change));
  return false;
}

bool VertexCountSearch::meshed(std::size_t vertices)
{
  const double missing = vertices_ - static_cast<double>(vertices);
  if (std::abs(missing) <= tolerance_ || ++meshes_ == most_meshes) return true;
  seeds_ = std::max(1.0, static_cast<double>(last_seeds_) + missing);
  radius_ *= std::sqrt(static_cast<double>(last_seeds_) / seeds_);
  bracket_ = RadiusBracket();
  best_miss_ = std::numeric_limits<double>::infinity();
  samplings_ = 0;
  return false;
}

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
