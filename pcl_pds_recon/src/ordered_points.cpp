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

/** \brief Axis-aligned box. */
struct Bounds
{
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d high = Eigen::Vector3d::Constant(-std::numeric_limits<double>::infinity());

  void extend(const Eigen::Vector3d& p)
  {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  [[nodiscard]] double extent() const { return (high - low).maxCoeff(); }
};

/** \brief Place of \a p on the Morton curve through the cube on the lower corner of \a bounds. */
std::uint64_t morton_key(const Eigen::Vector3d& p, const Bounds& bounds)
{
  constexpr auto cells = static_cast<double>(1 << morton_bits);
  const double cells_per_unit = bounds.extent() > 0 ? cells / bounds.extent() : 0.0;
  std::uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double cell = std::min((p[axis] - bounds.low[axis]) * cells_per_unit, cells - 1);
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

/** \brief Component-wise median of the finite points: nearly all coordinates relative to it are small, whatever a few
 * strays do, and single precision is finest near zero. */
Eigen::Vector3d median_point(const PointCloudView& cloud, std::size_t valid_points)
{
  Eigen::Vector3d median;
  std::vector<double> coordinate;
  coordinate.reserve(valid_points);
  for (int axis = 0; axis < 3; ++axis) {
    coordinate.clear();
    for (std::size_t i = 0; i < cloud.size; ++i)
      if (const Eigen::Vector3d p = cloud.positions[i]; p.allFinite()) coordinate.push_back(p[axis]);
    const auto middle = coordinate.begin() + static_cast<std::ptrdiff_t>(coordinate.size() / 2);
    std::nth_element(coordinate.begin(), middle, coordinate.end());
    median[axis] = *middle;
  }
  return median;
}

/** \brief Sets origin and unit of \a points from the finite input points, and counts these. */
void set_frame(const PointCloudView& cloud, OrderedPoints& points)
{
  Bounds bounds;
  for (std::size_t i = 0; i < cloud.size; ++i) {
    const Eigen::Vector3d p = cloud.positions[i];
    if (!p.allFinite()) continue;
    bounds.extend(p);
    ++points.valid_points;
  }
  if (points.valid_points == 0) return;
  const double extent = bounds.extent();
  // The median may lie in a corner of the box: twice the extent, rounded up to a power of two, brings all into reach.
  if (extent > 0 && std::isfinite(extent)) points.unit = std::ldexp(1.0, std::ilogb(extent) + 2);
  if (!std::isfinite(extent) || !std::isfinite(points.unit))
    throw InvalidInput("the extent of the points overflows; scale the coordinates down");
  points.origin = median_point(cloud, points.valid_points);
}

class InputOrder
{
 public:
  InputOrder(const PointCloudView& cloud, const OrderedPoints& points) : cloud_(cloud), points_(points) {}

  /** \brief The point in the cloud's frame, at the precision it is kept with. */
  [[nodiscard]] Eigen::Vector3d position(std::uint32_t index) const
  {
    return ((cloud_.positions[index] - points_.origin) / points_.unit).cast<float>().cast<double>();
  }

  /** \brief Lexicographic by position, input coordinates, the caller's record order, index. */
  bool operator()(const KeyedPoint& a, const KeyedPoint& b) const
  {
    if (const int c = compare(position(a.index), position(b.index)); c != 0) return c < 0;
    if (const int c = compare(cloud_.positions[a.index], cloud_.positions[b.index]); c != 0) return c < 0;
    if (cloud_.record_less) {
      if (cloud_.record_less(a.index, b.index)) return true;
      if (cloud_.record_less(b.index, a.index)) return false;
    }
    return a.index < b.index;
  }

 private:
  template <typename Vector>
  static int compare(const Vector& a, const Vector& b)
  {
    for (int axis = 0; axis < 3; ++axis)
      if (a[axis] != b[axis]) return a[axis] < b[axis] ? -1 : 1;
    return 0;
  }

  const PointCloudView& cloud_;
  const OrderedPoints& points_;
};

/** \brief Puts points of equal key, begin ... end, in order: few by comparison, many along a finer curve through their
 * own box. The latter happens where a stray point far away makes the cells of the first curve huge. */
void order_cell(const InputOrder& order, std::vector<KeyedPoint>& keyed, std::size_t begin, std::size_t end)
{
  constexpr std::size_t few = 64;
  const auto first = keyed.begin() + static_cast<std::ptrdiff_t>(begin);
  const auto last = keyed.begin() + static_cast<std::ptrdiff_t>(end);
  Bounds bounds;
  for (auto p = first; p != last; ++p) bounds.extend(order.position(p->index));
  if (end - begin <= few || bounds.extent() <= 0) {
    std::sort(first, last, order);
    return;
  }
  std::vector<KeyedPoint> cell(first, last);
  for (KeyedPoint& p : cell) p.key = morton_key(order.position(p.index), bounds);
  sort_by_key(cell);
  std::copy(cell.begin(), cell.end(), first);
  for (std::size_t i = begin; i < end;) {
    std::size_t next = i + 1;
    while (next < end && keyed[next].key == keyed[i].key) ++next;
    if (next - i > 1) order_cell(order, keyed, i, next);
    i = next;
  }
}

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
  Bounds bounds;
  for (const KeyedPoint& p : keyed) bounds.extend(order.position(p.index));
  constexpr std::size_t block = 16384;
  parallel.each(keyed.size(), block,
                [&](std::size_t i) { keyed[i].key = morton_key(order.position(keyed[i].index), bounds); });
  sort_by_key(keyed);

  points.rank_of_input.assign(cloud.size, no_rank);
  points.position.reserve(keyed.size());
  points.input_index.reserve(keyed.size());
  for (std::size_t begin = 0; begin < keyed.size();) {
    std::size_t end = begin + 1;
    while (end < keyed.size() && keyed[end].key == keyed[begin].key) ++end;
    if (end - begin > 1) order_cell(order, keyed, begin, end);
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t index = keyed[i].index;
      const Eigen::Vector3f position = order.position(index).cast<float>();
      if (i == begin || position != points.position.back()) {
        points.input_index.push_back(index);
        points.position.push_back(position);
      }
      points.rank_of_input[index] = static_cast<std::uint32_t>(points.input_index.size() - 1);
    }
    begin = end;
  }
  points.merged_points = points.valid_points - points.size();
  return points;
}

}  // namespace pds
