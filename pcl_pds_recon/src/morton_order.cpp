// SPDX-License-Identifier: BSD-3-Clause
#include "morton_order.h"

#include <pcl_pds_recon/options.h>
#include <utility>
#include "radix_sort.h"

namespace pds
{
namespace
{

constexpr std::size_t max_points = (std::size_t{1} << 31) - 1;  // PCL's indices are 32-bit and signed
constexpr std::size_t block = 16384;                            // points per block: some 0.2 ms
constexpr std::size_t few = 64;      // points of a cell that are ordered by comparison and not along a finer curve
constexpr int most_radix_bits = 33;  // three passes

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

}  // namespace

KeyedPoint* CurveSort::sort(
    KeyedPoint* points, KeyedPoint* other, std::size_t count, int open_bits, const Parallel& parallel) const
{
  const auto less = [this](const KeyedPoint& a, const KeyedPoint& b) {
    return a.key != b.key ? a.key < b.key : cloud_.before(a.index, b.index);
  };
  if (count <= few || (open_bits == 0 && !enter_cell(points, count, parallel))) {
    std::sort(points, points + count, less);
    return points;
  }
  if (open_bits == 0) open_bits = 3 * MortonCurve::axis_bits;
  // As many bits as tell most points of a surface apart; the rest is settled run by run.
  const int bits = std::min(open_bits, std::min(3 * ((std::ilogb(count) + 2) / 2), most_radix_bits));
  open_bits -= bits;
  KeyedPoint* sorted = radix_sort(
      points, other, count, {open_bits, bits}, [](const KeyedPoint& p) { return p.key; }, parallel);
  sort_runs(sorted, sorted == points ? other : points, count, open_bits, parallel);
  return sorted;
}

/** \brief Gives points of one cell keys on a curve of their own; false if they all are in one place. */
bool CurveSort::enter_cell(KeyedPoint* points, std::size_t count, const Parallel& parallel) const
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

void CurveSort::sort_runs(
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

PointArray<KeyedPoint> keyed_points(const PointCloudView& cloud,
                                    const FramedCloud& framed,
                                    std::size_t finite_points,
                                    const MortonCurve& curve,
                                    const Parallel& parallel)
{
  PointArray<KeyedPoint> keyed(finite_points);
  const std::vector<std::size_t> finite_before =
      finite_points_before_blocks(cloud, finite_points == cloud.size, parallel);
  parallel.blocks(cloud.size, block, [&](std::size_t begin, std::size_t end, unsigned) {
    KeyedPoint* next = keyed.data() + finite_before[begin / block];
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector3d p = cloud.positions[i];
      if (p.allFinite()) *next++ = {curve.key(framed.position(p).cast<double>()), static_cast<std::uint32_t>(i)};
    }
  });
  return keyed;
}

Bounds set_frame(const PointCloudView& cloud, OrderedPoints& points, const Parallel& parallel)
{
  if (cloud.size > max_points) throw InvalidInput("more than 2^31 - 1 points; split the cloud into tiles");
  const CloudFrame frame = measure_frame(cloud, parallel);
  points.valid_points = frame.finite_points;
  points.rank_of_input.assign(cloud.size, no_rank);
  Bounds bounds;
  if (frame.finite_points == 0) return bounds;
  const double extent = frame.bounds.extent();
  // The median may lie in a corner of the box: twice the extent, rounded up to a power of two, brings all into reach.
  if (extent > 0 && std::isfinite(extent)) points.unit = std::ldexp(1.0, std::ilogb(extent) + 2);
  if (!std::isfinite(extent) || !std::isfinite(points.unit))
    throw InvalidInput("the extent of the points overflows; scale the coordinates down");
  points.origin = frame.median;
  const FramedCloud framed(cloud, points);
  // Rounding keeps the order of coordinates, so the box of the rounded points is the rounded box.
  for (const Eigen::Vector3d& corner : {frame.bounds.low, frame.bounds.high})
    bounds.extend(framed.position(corner).cast<double>());
  return bounds;
}

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

  points.merged_points = points.valid_points - places;
  points.position.resize(places);
  points.input_index.resize(places);
  parallel.blocks(points.valid_points, block, [&](std::size_t begin, std::size_t end, unsigned) {
    std::size_t next = places_before[begin / block];
    for (std::size_t i = begin; i < end; ++i) {
      if (i + places_ahead < end) fetch(cloud, sorted[i + places_ahead].index, points);
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

}  // namespace pds
