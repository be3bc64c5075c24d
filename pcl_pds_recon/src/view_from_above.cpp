// SPDX-License-Identifier: BSD-3-Clause
#include "view_from_above.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>

#include "seed_grid.h"

namespace pds
{
namespace
{

using Eigen::Vector3d;

constexpr double least_rise = 0.5;    // cosine between a cell's plane and the horizon: steeper ones may show any side
constexpr double least_lying = 0.85;  // share of seeds on surfaces that are less steep: airborne scans have 0.99
constexpr double least_open = 0.9;  // share of those that no other surface hides: airborne scans have 0.94, bodies 0.5
constexpr double roughest = 0.1;    // mean curvature of a cell: what has more is no surface, but leaves

/** \brief Which seeds can be seen from where a coordinate grows. */
class ViewFromAbove
{
 public:
  ViewFromAbove(const SeedGeometry& seeds, int axis) : seeds_(seeds), axis_(axis) {}

  /** \brief Looks from there.
   * \return true if that is where the cloud was seen from */
  bool look(const Parallel& parallel)
  {
    std::size_t surface = 0;
    std::size_t lying = 0;
    for (std::size_t s = 0; s < seeds_.position.size(); ++s) {
      surface += is_rough(s) ? 0U : 1U;
      lying += is_rough(s) || is_steep(s) ? 0U : 1U;
    }
    if (lying == 0 || static_cast<double>(lying) < least_lying * static_cast<double>(surface)) return false;
    find_open(parallel);
    const auto open = std::count(open_.begin(), open_.end(), std::uint8_t{1});
    return static_cast<double>(open) >= least_open * static_cast<double>(lying);
  }

  [[nodiscard]] std::vector<Vector3d> outward() const
  {
    std::vector<Vector3d> outward(open_.size(), Vector3d::Zero());
    for (std::size_t s = 0; s < open_.size(); ++s)
      if (open_[s] != 0) outward[s] = upward_normal(s);
    return outward;
  }

 private:
  static constexpr double aside = 1.0;   // radii: no point of a surface is farther from its seeds
  static constexpr double higher = 0.3;  // radii off a cell's plane: two sheets may be an interval apart

  [[nodiscard]] Vector3d upward_normal(std::size_t seed) const
  {
    return seeds_.normal[seed][axis_] < 0 ? Vector3d(-seeds_.normal[seed]) : seeds_.normal[seed];
  }

  [[nodiscard]] bool is_rough(std::size_t seed) const { return seeds_.curvature[seed] > roughest; }
  [[nodiscard]] bool is_steep(std::size_t seed) const { return std::abs(seeds_.normal[seed][axis_]) < least_rise; }

  void find_open(const Parallel& parallel)
  {
    constexpr std::size_t block = 256;
    std::vector<Vector3d> on_map = seeds_.position;
    for (Vector3d& p : on_map) p[axis_] = 0;
    std::vector<std::uint32_t> all(on_map.size());
    std::iota(all.begin(), all.end(), 0U);
    const SeedGrid map(on_map, all, aside);
    open_.resize(on_map.size());
    parallel.each(open_.size(), block, [&](std::size_t s) {
      open_[s] = is_rough(s) || is_steep(s) || is_hidden(s, on_map[s], map) ? 0 : 1;
    });
  }

  [[nodiscard]] bool is_hidden(std::size_t seed, const Vector3d& place, const SeedGrid& map) const
  {
    const Vector3d up = upward_normal(seed);
    bool hidden = false;
    map.visit_near(place, aside, [&](std::uint32_t other) {
      const Vector3d way = seeds_.position[other] - seeds_.position[seed];
      hidden = hidden || (!is_rough(other) && way[axis_] > 0 && way.dot(up) > higher);
    });
    return hidden;
  }

  const SeedGeometry& seeds_;
  int axis_;
  std::vector<std::uint8_t> open_;  ///< by seed: 1 if it lies and nothing hides it
};

}  // namespace

std::vector<Vector3d> outward_from_above(const SeedGeometry& seeds, const Parallel& parallel)
{
  for (const int axis : {2, 1, 0})
    if (ViewFromAbove view(seeds, axis); view.look(parallel)) return view.outward();
  return {};
}

}  // namespace pds
