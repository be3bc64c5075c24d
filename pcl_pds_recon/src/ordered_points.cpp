// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/options.h>
#include <pcl_pds_recon/ordered_points.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace pds
{
namespace
{

constexpr std::size_t max_points = (std::size_t{1} << 31) - 1;  // PCL's indices are 32-bit and signed
constexpr int morton_bits = 21;                                 // per axis; three fill a 64-bit key

struct KeyedPoint
{
  std::uint64_t key;
  std::uint32_t index;
};

/** \brief Spreads the low 21 bits so that two zero bits follow each. */
std::uint64_t spread_bits(std::uint64_t v)
{
  v &= 0x1fffff;
  v = (v | v << 32) & 0x1f00000000ffffULL;
  v = (v | v << 16) & 0x1f0000ff0000ffULL;
  v = (v | v << 8) & 0x100f00f00f00f00fULL;
  v = (v | v << 4) & 0x10c30c30c30c30c3ULL;
  v = (v | v << 2) & 0x1249249249249249ULL;
  return v;
}

std::uint64_t morton_key(const Eigen::Vector3f& p)
{
  constexpr auto cells = static_cast<float>(1 << morton_bits);
  constexpr auto last_cell = static_cast<float>((1 << morton_bits) - 1);
  std::uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const float cell = std::clamp((p[axis] + 0.5F) * cells, 0.0F, last_cell);
    key |= spread_bits(static_cast<std::uint64_t>(cell)) << axis;
  }
  return key;
}

/** \brief Stable least-significant-digit radix sort by key. */
void sort_by_key(std::vector<KeyedPoint>& points)
{
  constexpr int digit_bits = 11;  // 2048 counters stay in the first-level cache
  constexpr std::size_t digits = std::size_t{1} << digit_bits;
  std::vector<KeyedPoint> other(points.size());
  for (int shift = 0; shift < 3 * morton_bits; shift += digit_bits) {
    std::array<std::size_t, digits> begin{};
    const auto digit_of = [shift](const KeyedPoint& p) { return (p.key >> shift) & (digits - 1); };
    for (const KeyedPoint& p : points) ++begin[digit_of(p)];
    std::size_t sum = 0;
    for (std::size_t& b : begin) sum += std::exchange(b, sum);
    for (const KeyedPoint& p : points) other[begin[digit_of(p)]++] = p;
    points.swap(other);
  }
}

/** \brief Sets origin and unit of \a points from the bounding box of the finite input points, and counts these. */
void set_frame(const PointCloudView& cloud, OrderedPoints& points)
{
  constexpr double inf = std::numeric_limits<double>::infinity();
  Eigen::Vector3d low(inf, inf, inf);
  Eigen::Vector3d high(-inf, -inf, -inf);
  for (std::size_t i = 0; i < cloud.size; ++i) {
    const Eigen::Vector3d p = cloud.positions[i];
    if (!p.allFinite()) continue;
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
    ++points.valid_points;
  }
  if (points.valid_points == 0) return;
  const double extent = (high - low).maxCoeff();
  if (extent > 0 && std::isfinite(extent)) points.unit = std::ldexp(1.0, std::ilogb(extent) + 1);
  if (!std::isfinite(extent) || !std::isfinite(points.unit))
    throw InvalidInput("the extent of the points overflows; scale the coordinates down");
  points.origin = low + 0.5 * (high - low);
}

class InputOrder
{
 public:
  InputOrder(const PointCloudView& cloud, const OrderedPoints& points) : cloud_(cloud), points_(points) {}

  [[nodiscard]] Eigen::Vector3f local(std::uint32_t index) const
  {
    return ((cloud_.positions[index] - points_.origin) / points_.unit).cast<float>();
  }

  [[nodiscard]] bool coincident(std::uint32_t a, std::uint32_t b) const
  {
    return cloud_.positions[a] == cloud_.positions[b];
  }

  /** \brief Lexicographic by coordinates, then by the caller's record order, then by index. */
  bool operator()(const KeyedPoint& a, const KeyedPoint& b) const
  {
    const Eigen::Vector3d pa = cloud_.positions[a.index];
    const Eigen::Vector3d pb = cloud_.positions[b.index];
    for (int axis = 0; axis < 3; ++axis)
      if (pa[axis] != pb[axis]) return pa[axis] < pb[axis];
    if (cloud_.record_less) {
      if (cloud_.record_less(a.index, b.index)) return true;
      if (cloud_.record_less(b.index, a.index)) return false;
    }
    return a.index < b.index;
  }

 private:
  const PointCloudView& cloud_;
  const OrderedPoints& points_;
};

}  // namespace

OrderedPoints order_points(const PointCloudView& cloud, const Parallel& parallel)
{
  if (cloud.size > max_points) throw InvalidInput("more than 2^31 - 1 points; split the cloud into tiles");
  OrderedPoints points;
  set_frame(cloud, points);
  const InputOrder order(cloud, points);

  std::vector<KeyedPoint> keyed;
  keyed.reserve(points.valid_points);
  for (std::uint32_t i = 0; i < cloud.size; ++i)
    if (cloud.positions[i].allFinite()) keyed.push_back({0, i});
  constexpr std::size_t block = 16384;
  parallel.each(keyed.size(), block, [&](std::size_t i) { keyed[i].key = morton_key(order.local(keyed[i].index)); });
  sort_by_key(keyed);

  points.rank_of_input.assign(cloud.size, no_rank);
  points.position.reserve(keyed.size());
  points.input_index.reserve(keyed.size());
  for (std::size_t begin = 0; begin < keyed.size();) {
    std::size_t end = begin + 1;
    while (end < keyed.size() && keyed[end].key == keyed[begin].key) ++end;
    std::sort(keyed.begin() + static_cast<std::ptrdiff_t>(begin), keyed.begin() + static_cast<std::ptrdiff_t>(end),
              order);
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t index = keyed[i].index;
      if (i == begin || !order.coincident(index, points.input_index.back())) {
        points.input_index.push_back(index);
        points.position.push_back(order.local(index));
      }
      points.rank_of_input[index] = static_cast<std::uint32_t>(points.input_index.size() - 1);
    }
    begin = end;
  }
  points.merged_points = points.valid_points - points.size();
  return points;
}

}  // namespace pds
