// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/options.h>
#include <pcl_pds_recon/ordered_points.h>

#include <algorithm>
#include <cmath>

#include "cloud_frame.h"
#include "radix_sort.h"

namespace pds
{
namespace
{

constexpr std::size_t max_points = (std::size_t{1} << 31) - 1;  // PCL's indices are 32-bit and signed
constexpr int axis_bits = 21;                                   // of a Morton key; three axes fill 63 of its 64 bits
constexpr std::size_t block = 16384;                            // points per block: some 0.2 ms
constexpr std::size_t few = 64;  // points of a cell that are ordered by comparison and not along a finer curve

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

/** \brief Morton curve through the cube on the lower corner of a box. */
class MortonCurve
{
 public:
  explicit MortonCurve(const Bounds& bounds)
      : low_(bounds.low), cells_per_unit_(bounds.extent() > 0 ? cells / bounds.extent() : 0.0)
  {
  }

  /** \brief Place of \a p on the curve. */
  [[nodiscard]] std::uint64_t key(const Eigen::Vector3d& p) const
  {
    std::uint64_t key = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double cell = std::min((p[axis] - low_[axis]) * cells_per_unit_, cells - 1);
      // By way of a signed number: conversion to an unsigned one of 64 bits takes a branch.
      key |= spread_bits(static_cast<std::uint64_t>(static_cast<std::int64_t>(cell))) << axis;
    }
    return key;
  }

 private:
  static constexpr auto cells = static_cast<double>(1 << axis_bits);
  Eigen::Vector3d low_;
  double cells_per_unit_;
};

/** \brief The points in their own frame, and the order of those that the curve does not tell apart. */
class FramedCloud
{
 public:
  FramedCloud(const PointCloudView& cloud, const OrderedPoints& points)
      : cloud_(cloud),
        origin_(points.origin),
        half_per_unit_(std::ldexp(1.0, -(std::ilogb(points.unit) / 2))),
        rest_per_unit_(std::ldexp(1.0, std::ilogb(points.unit) / 2 - std::ilogb(points.unit)))
  {
  }

  void prefetch(std::uint32_t index) const { cloud_.positions.prefetch(index); }

  /** \brief A point of the cloud in the frame, at the precision it is kept with.
   *
   * Not inlined: GCC 12 leaves out the rounding where it vectorises a conversion to float and back to double. */
  [[nodiscard, gnu::noinline]] Eigen::Vector3f position(const Eigen::Vector3d& p) const
  {
    return ((p - origin_) * half_per_unit_ * rest_per_unit_).cast<float>();
  }
  [[nodiscard]] Eigen::Vector3f position(std::uint32_t index) const { return position(cloud_.positions[index]); }

  /** \brief Lexicographic by position, input coordinates, the caller's record order, index. */
  [[nodiscard]] bool before(std::uint32_t a, std::uint32_t b) const
  {
    if (const int c = compare(position(a), position(b)); c != 0) return c < 0;
    if (const int c = compare(cloud_.positions[a], cloud_.positions[b]); c != 0) return c < 0;
    if (cloud_.record_less) {
      if (cloud_.record_less(a, b)) return true;
      if (cloud_.record_less(b, a)) return false;
    }
    return a < b;
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
  Eigen::Vector3d origin_;
  // Factors of the unit's inverse, which would overflow for the least of units. Exact, for it is a power of two.
  double half_per_unit_, rest_per_unit_;
};

/** \brief Sorts points along the curve; those that share a cell of it by FramedCloud::before or, if they are many,
 * along a finer curve through their own box. The latter happens where a stray point far away makes cells huge. */
class CurveSort
{
 public:
  explicit CurveSort(const FramedCloud& cloud) : cloud_(cloud) {}

  /** \brief Sorts points that agree in all bits of their keys but the lowest \a open_bits.
   * \param other an array as large
   * \return which of the two arrays holds the sorted points
   */
  KeyedPoint* sort(
      KeyedPoint* points, KeyedPoint* other, std::size_t count, int open_bits, const Parallel& parallel) const
  {
    const auto less = [this](const KeyedPoint& a, const KeyedPoint& b) {
      return a.key != b.key ? a.key < b.key : cloud_.before(a.index, b.index);
    };
    if (count <= few || (open_bits == 0 && !enter_cell(points, count, parallel))) {
      std::sort(points, points + count, less);
      return points;
    }
    if (open_bits == 0) open_bits = 3 * axis_bits;
    // As many bits as tell most points of a surface apart; the rest is settled run by run.
    const int bits = std::min(open_bits, std::min(3 * ((std::ilogb(count) + 2) / 2), most_radix_bits));
    open_bits -= bits;
    KeyedPoint* sorted = radix_sort(
        points, other, count, {open_bits, bits}, [](const KeyedPoint& p) { return p.key; }, parallel);
    sort_runs(sorted, sorted == points ? other : points, count, open_bits, parallel);
    return sorted;
  }

 private:
  static constexpr int most_radix_bits = 33;  // three passes

  /** \brief Gives points of one cell keys on a curve of their own; false if they all are in one place. */
  bool enter_cell(KeyedPoint* points, std::size_t count, const Parallel& parallel) const
  {
    const auto bounds = parallel.sum(count, block, [&](std::size_t begin, std::size_t end) {
      Bounds part;
      for (std::size_t i = begin; i < end; ++i) part.extend(cloud_.position(points[i].index).cast<double>());
      return part;
    });
    if (bounds.extent() <= 0) return false;
    const MortonCurve curve(bounds);
    parallel.each(count, block,
                  [&](std::size_t i) { points[i].key = curve.key(cloud_.position(points[i].index).cast<double>()); });
    return true;
  }

  /** \brief Sorts each run of points that agree in all but \a open_bits bits. */
  void sort_runs(
      KeyedPoint* points, KeyedPoint* other, std::size_t count, int open_bits, const Parallel& parallel) const
  {
    const auto prefix = [=](std::size_t i) { return points[i].key >> open_bits; };
    const auto end_of_run = [&](std::size_t i, std::size_t limit) {
      const std::uint64_t own = prefix(i++);
      while (i < limit && prefix(i) == own) ++i;
      return i;
    };
    const auto sort_run = [&](std::size_t begin, std::size_t end, const Parallel& workers) {
      const KeyedPoint* sorted = sort(points + begin, other + begin, end - begin, open_bits, workers);
      if (sorted != points + begin) std::copy(sorted, sorted + (end - begin), points + begin);
    };
    // A block has the runs that begin in it. Neighbours sort theirs at the same time, so this is settled before.
    std::vector<std::size_t> begin_of_block{0};
    for (std::size_t i = block; i < count; i += block)
      begin_of_block.push_back(i <= begin_of_block.back() ? begin_of_block.back() : end_of_run(i - 1, count));
    begin_of_block.push_back(count);

    std::vector<std::size_t> long_run(begin_of_block.size() - 1, count);  // a block's last run, if left to all workers
    parallel.each(long_run.size(), 1, [&](std::size_t b) {
      for (std::size_t begin = begin_of_block[b]; begin < begin_of_block[b + 1];) {
        const std::size_t end = end_of_run(begin, begin_of_block[b + 1]);
        if (end - begin > block)
          long_run[b] = begin;
        else if (end - begin > 1)
          sort_run(begin, end, alone_);
        begin = end;
      }
    });
    for (std::size_t b = 0; b < long_run.size(); ++b)
      if (long_run[b] < count) sort_run(long_run[b], begin_of_block[b + 1], parallel);
  }

  const FramedCloud& cloud_;
  Parallel alone_{1};
};

/** \brief Sets origin and unit of \a points, and counts the finite ones.
 * \return box of these in the input's coordinates
 */
Bounds set_frame(const PointCloudView& cloud, OrderedPoints& points, const Parallel& parallel)
{
  const CloudFrame frame = measure_frame(cloud, parallel);
  points.valid_points = frame.finite_points;
  if (frame.finite_points == 0) return frame.bounds;
  const double extent = frame.bounds.extent();
  // The median may lie in a corner of the box: twice the extent, rounded up to a power of two, brings all into reach.
  if (extent > 0 && std::isfinite(extent)) points.unit = std::ldexp(1.0, std::ilogb(extent) + 2);
  if (!std::isfinite(extent) || !std::isfinite(points.unit))
    throw InvalidInput("the extent of the points overflows; scale the coordinates down");
  points.origin = frame.median;
  return frame.bounds;
}

/** \brief For each block of input points, how many finite ones come before it. */
std::vector<std::size_t> finite_points_before_blocks(const PointCloudView& cloud,
                                                     bool all_finite,
                                                     const Parallel& parallel)
{
  std::vector<std::size_t> before((cloud.size + block - 1) / block);
  parallel.blocks(cloud.size, block, [&](std::size_t begin, std::size_t end, unsigned) {
    std::size_t count = end - begin;
    for (std::size_t i = begin; i < end && !all_finite; ++i) count -= cloud.positions[i].allFinite() ? 0U : 1U;
    before[begin / block] = count;
  });
  std::size_t sum = 0;
  for (std::size_t& b : before) sum += std::exchange(b, sum);
  return before;
}

/** \brief Gives places to sorted points, coincident ones the same. */
void assign_ranks(const FramedCloud& cloud, const KeyedPoint* sorted, OrderedPoints& points, const Parallel& parallel)
{
  // Points in one place have one key, so only equal keys are worth a look at the positions.
  const auto new_place = [&](std::size_t i) {
    return i == 0 || sorted[i].key != sorted[i - 1].key ||
           cloud.position(sorted[i].index) != cloud.position(sorted[i - 1].index);
  };
  std::vector<std::size_t> places_before((points.valid_points + block - 1) / block);
  parallel.blocks(points.valid_points, block, [&](std::size_t begin, std::size_t end, unsigned) {
    std::size_t count = 0;  // written once: the counts of other workers are close by in memory
    for (std::size_t i = begin; i < end; ++i) count += new_place(i) ? 1U : 0U;
    places_before[begin / block] = count;
  });
  std::size_t places = 0;
  for (std::size_t& before : places_before) places += std::exchange(before, places);

  constexpr std::size_t ahead = 32;  // points that get their place while one comes from memory
  points.merged_points = points.valid_points - places;
  points.position.resize(places);
  points.input_index.resize(places);
  parallel.blocks(points.valid_points, block, [&](std::size_t begin, std::size_t end, unsigned) {
    std::size_t next = places_before[begin / block];
    for (std::size_t i = begin; i < end; ++i) {
      if (i + ahead < end) {
        cloud.prefetch(sorted[i + ahead].index);
        __builtin_prefetch(&points.rank_of_input[sorted[i + ahead].index], 1);
      }
      const std::uint32_t index = sorted[i].index;
      if (new_place(i)) {
        points.position[next] = cloud.position(index);
        points.input_index[next] = index;
        ++next;
      }
      points.rank_of_input[index] = static_cast<std::uint32_t>(next - 1);
    }
  });
}

}  // namespace

OrderedPoints order_points(const PointCloudView& cloud, const Parallel& parallel)
{
  if (cloud.size > max_points) throw InvalidInput("more than 2^31 - 1 points; split the cloud into tiles");
  OrderedPoints points;
  const Bounds input_bounds = set_frame(cloud, points, parallel);
  points.rank_of_input.assign(cloud.size, no_rank);
  if (points.valid_points == 0) return points;

  const FramedCloud framed(cloud, points);
  Bounds bounds;  // rounding keeps the order of coordinates, so the box of the rounded points is the rounded box
  for (const Eigen::Vector3d& corner : {input_bounds.low, input_bounds.high})
    bounds.extend(framed.position(corner).cast<double>());
  const MortonCurve curve(bounds);
  PointArray<KeyedPoint> keyed(points.valid_points);
  PointArray<KeyedPoint> other(points.valid_points);
  const std::vector<std::size_t> finite_before =
      finite_points_before_blocks(cloud, points.valid_points == cloud.size, parallel);
  parallel.blocks(cloud.size, block, [&](std::size_t begin, std::size_t end, unsigned) {
    KeyedPoint* next = keyed.data() + finite_before[begin / block];
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector3d p = cloud.positions[i];
      if (p.allFinite()) *next++ = {curve.key(framed.position(p).cast<double>()), static_cast<std::uint32_t>(i)};
    }
  });
  const KeyedPoint* sorted =
      CurveSort(framed).sort(keyed.data(), other.data(), points.valid_points, 3 * axis_bits, parallel);
  assign_ranks(framed, sorted, points, parallel);
  return points;
}

}  // namespace pds
