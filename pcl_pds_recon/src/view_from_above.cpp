// SPDX-License-Identifier: BSD-3-Clause
#include "view_from_above.h"

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

/** \brief How a seed is seen from above. */
enum class View : std::uint8_t
{
  rough,
  steep,
  hidden,
  open
};

/** \brief Which seeds can be seen from where a coordinate grows. */
class ViewFromAbove
{
 public:
  ViewFromAbove(const SeedGeometry& seeds, int axis, const Parallel& parallel) : seeds_(seeds), axis_(axis)
  {
    constexpr std::size_t block = 256;
    std::vector<Vector3d> on_map = seeds.position;
    for (Vector3d& p : on_map) p[axis] = 0;
    std::vector<std::uint32_t> all(on_map.size());
    std::iota(all.begin(), all.end(), 0U);
    const SeedGrid map(on_map, all, aside);
    view_.resize(on_map.size());
    parallel.each(view_.size(), block, [&](std::size_t s) { view_[s] = view_of(s, on_map[s], map); });
  }

  [[nodiscard]] bool shows_the_cloud() const
  {
    std::size_t surface = 0;
    std::size_t lying = 0;
    std::size_t open = 0;
    for (const View view : view_) {
      surface += view == View::rough ? 0U : 1U;
      lying += view == View::rough || view == View::steep ? 0U : 1U;
      open += view == View::open ? 1U : 0U;
    }
    return open > 0 && static_cast<double>(lying) >= least_lying * static_cast<double>(surface) &&
           static_cast<double>(open) >= least_open * static_cast<double>(lying);
  }

  [[nodiscard]] std::vector<Vector3d> outward() const
  {
    std::vector<Vector3d> outward(view_.size(), Vector3d::Zero());
    for (std::size_t s = 0; s < view_.size(); ++s)
      if (view_[s] == View::open) outward[s] = upward_normal(s);
    return outward;
  }

 private:
  static constexpr double aside = 1.0;  // radii: no point of a surface is farther from its seeds
  static constexpr double higher =
      0.3;  // radii off a cell's plane: an interval at the default factor, as of two sheets

  [[nodiscard]] Vector3d upward_normal(std::size_t seed) const
  {
    return seeds_.normal[seed][axis_] < 0 ? Vector3d(-seeds_.normal[seed]) : seeds_.normal[seed];
  }

  [[nodiscard]] View view_of(std::size_t seed, const Vector3d& place, const SeedGrid& map) const
  {
    if (seeds_.curvature[seed] > roughest) return View::rough;
    if (std::abs(seeds_.normal[seed][axis_]) < least_rise) return View::steep;
    const Vector3d up = upward_normal(seed);
    View view = View::open;
    map.visit_near(place, aside, [&](std::uint32_t other) {
      if (seeds_.curvature[other] > roughest) return;
      const Vector3d way = seeds_.position[other] - seeds_.position[seed];
      if (way[axis_] > 0 && way.dot(up) > higher) view = View::hidden;
    });
    return view;
  }

  const SeedGeometry& seeds_;
  int axis_;
  std::vector<View> view_;
};

}  // namespace

std::vector<Vector3d> outward_from_above(const SeedGeometry& seeds, const Parallel& parallel)
{
  for (const int axis : {2, 1, 0})
    if (const ViewFromAbove view(seeds, axis, parallel); view.shows_the_cloud()) return view.outward();
  return {};
}

}  // namespace pds
