// SPDX-License-Identifier: BSD-3-Clause
#include "count_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pds
{
namespace
{

// Radii that points draw differ by so much: distances that are equal but for rounding are told apart, and no others.
constexpr double spread_of_radii = 1e-6;

// Distances of seeds on a lattice are taken to be equal if they differ by no more, relatively: normals are estimated.
constexpr double equal_distances = 1e-4;
constexpr double equal_share =
    0.05;                           // of the seeds is in such a group on a lattice; of 4,000 among random points 0.004
constexpr double fewest_equal = 6;  // seeds, of three pairs: where there are few a pair or two may be equal by chance

/** \brief From each seed to its nearest one, ascending, where that is within the reach of the disks. */
std::vector<float> nearest_seed_distances(const PoissonDiskSampling& sampling)
{
  std::vector<float> distances;
  distances.reserve(sampling.seeds.size());
  for (const std::uint32_t s : sampling.seeds)
    if (sampling.nearest[s].distance[1] < NearestSeeds::infinity) distances.push_back(sampling.nearest[s].distance[1]);
  std::sort(distances.begin(), distances.end());
  return distances;
}

/** \brief True if so many of the distances are equal that the points are on a lattice. */
bool many_are_equal(const std::vector<float>& distances)
{
  const double many = std::max(fewest_equal, equal_share * static_cast<double>(distances.size()));
  const auto step = static_cast<std::size_t>(many) - 1;
  for (std::size_t i = 0; i + step < distances.size(); ++i)
    if (static_cast<double>(distances[i + step]) <= (1 + equal_distances) * static_cast<double>(distances[i]))
      return true;
  return false;
}

/** \brief How many seeds have another within a drawn radius, in the mean over the lots. */
double expected_below(const std::vector<float>& distances, double radius)
{
  const double largest = radius * (1 + spread_of_radii);
  double sum = 0;
  for (const float distance : distances) {
    const auto d = static_cast<double>(distance);
    if (d >= largest) break;
    sum += std::min(1.0, (largest - d) / (largest - radius));
  }
  return sum;
}

}  // namespace

VertexCountSearch::VertexCountSearch(std::uint64_t vertices, double radius)
    : vertices_(static_cast<double>(vertices)),
      seeds_(vertices_),
      radius_(radius),
      best_miss_(std::numeric_limits<double>::infinity()),
      tolerance_(std::max(2.0, 0.005 * vertices_))
{
}

bool VertexCountSearch::sampled(const PoissonDiskSampling& sampling)
{
  last_ = {radius_, steady_, static_cast<double>(sampling.seeds.size()), nearest_seed_distances(sampling)};
  const double miss = std::abs(last_.seeds - seeds_);
  if (miss < best_miss_) {
    best_miss_ = miss;
    best_ = last_;
  }
  if (miss <= tolerance_ / 2 || ++samplings_ > most_samplings) return true;
  if (samplings_ == most_samplings) {
    radius_ = best_.radius;
    steady_ = best_.steady;
    return false;
  }
  learn();
  if (!is_steady() && bracket_.closed() && (samplings_ >= most_guesses || many_are_equal(low_.distances)))
    begin_steady_count();
  radius_ = next_radius();
  return false;
}

/** \brief Narrows the bracket by the last trial. */
void VertexCountSearch::learn()
{
  if (last_.seeds > seeds_) {
    bracket_.too_small(radius_);
    low_ = last_;
    too_few_ = 0;
    return;
  }
  if (radius_ <= bracket_.low()) bracket_ = RadiusBracket();  // what gave too many with other cells gives too few
  bracket_.too_large(radius_);
  high_ = last_;
  ++too_few_;
}

void VertexCountSearch::begin_steady_count()
{
  steady_ = {spread_of_radii, high_.radius};
  first_low_ = low_;
  first_high_ = high_;
  too_few_ = 0;
}

double VertexCountSearch::next_radius() const
{
  constexpr double most_change = 2.0;    // a count far off says little about the next one
  constexpr double least_change = 1.04;  // on a lattice: beyond the next of the distances, where the count changes
  constexpr int most_too_few = 2;        // then the lower end is tried anew
  double change = std::clamp(std::sqrt(last_.seeds / seeds_), 1 / most_change, most_change);
  if (bracket_.closed() && is_steady()) {
    const bool has_other_cells = low_.steady.radius_of_cells == 0;
    return has_other_cells && too_few_ >= most_too_few ? low_.radius : radius_by_distances();
  }
  if (!bracket_.closed() && samplings_ > 1 && many_are_equal(last_.distances))
    change = change < 1 ? std::min(change, 1 / least_change) : std::max(change, least_change);
  return bracket_.inside(radius_ * change);
}

/** \brief The radius in the bracket below which so many of the seeds' distances are as there are seeds too many, of
 * those that make the difference of its two ends. */
double VertexCountSearch::radius_by_distances() const
{
  constexpr double margin = 0.1;
  const double share = std::clamp((low_.seeds - seeds_) / (low_.seeds - high_.seeds), margin, 1 - margin);
  double low = low_.radius, high = high_.radius;
  const double at_low = expected_below(low_.distances, low);
  const double at_high = expected_below(low_.distances, high);
  if (at_high <= at_low) return std::sqrt(low * high);
  const double wanted = at_low + share * (at_high - at_low);
  constexpr int halvings = 50;  // double precision
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (low + high);
    (expected_below(low_.distances, middle) < wanted ? low : high) = middle;
  }
  return high;
}

bool VertexCountSearch::meshed(std::size_t vertices)
{
  const double missing = vertices_ - static_cast<double>(vertices);
  if (std::abs(missing) <= tolerance_ || ++meshes_ == most_meshes) return true;
  seeds_ = std::max(1.0, last_.seeds + missing);
  best_miss_ = std::numeric_limits<double>::infinity();
  samplings_ = 0;
  bracket_ = RadiusBracket();
  if (is_steady() && first_high_.seeds < seeds_ && seeds_ < first_low_.seeds) {
    low_ = first_low_;
    high_ = first_high_;
    bracket_.too_small(low_.radius);
    bracket_.too_large(high_.radius);
    learn();
    radius_ = next_radius();
  } else {
    steady_ = SteadyCount();
    radius_ *= std::sqrt(last_.seeds / seeds_);
  }
  return false;
}

}  // namespace pds
