// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/thinning.h>

#include <algorithm>
#include <cmath>

#include "morton_order.h"
#include "parallel_parts.h"
#include "radix_sort.h"

namespace pds
{
namespace
{

constexpr std::size_t block = 16384;  // points per block: some 0.2 ms

/** \brief Begins of runs of sorted points that agree in all but the lowest bits of their keys, and the end. */
PointArray<std::uint32_t> begins_of_voxels(const KeyedPoint* sorted,
                                           std::size_t count,
                                           int bits_within,
                                           const Parallel& parallel)
{
  using Begins = std::vector<std::uint32_t>;
  PointArray<std::uint32_t> begins =
      joined(parallel_parts<Begins>(count, block, parallel,
                                    [&](std::size_t begin, std::size_t end, Begins& part) {
                                      for (std::size_t i = begin; i < end; ++i)
                                        if (i == 0 || (sorted[i].key ^ sorted[i - 1].key) >> bits_within != 0)
                                          part.push_back(static_cast<std::uint32_t>(i));
                                    }),
             parallel);
  begins.push_back(static_cast<std::uint32_t>(count));
  return begins;
}

/** \brief The points of one voxel. */
class VoxelPoints
{
 public:
  void gather(const FramedCloud& cloud, const KeyedPoint* begin, const KeyedPoint* end)
  {
    points_ = begin;
    position_.clear();
    for (const KeyedPoint* point = begin; point != end; ++point) position_.push_back(cloud.position(point->index));
    places_ = position_;
    std::sort(places_.begin(), places_.end(), [](const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
      return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
    });
    places_.erase(std::unique(places_.begin(), places_.end()), places_.end());
  }

  /** \brief The one nearest to the mean of their places. */
  [[nodiscard]] std::size_t middle(const FramedCloud& cloud) const
  {
    const Eigen::Vector3f mean = this->mean();
    std::size_t middle = 0;
    float least = (position_[0] - mean).squaredNorm();
    for (std::size_t i = 1; i < position_.size(); ++i) {
      const float distance = (position_[i] - mean).squaredNorm();
      if (distance > least || (distance == least && !cloud.before(points_[i].index, points_[middle].index))) continue;
      least = distance;
      middle = i;
    }
    return middle;
  }

  [[nodiscard]] const Eigen::Vector3f& operator[](std::size_t i) const { return position_[i]; }
  /** \brief How many are in the place of another one. */
  [[nodiscard]] std::size_t coincident() const { return position_.size() - places_.size(); }

 private:
  /** \brief Added up in whole numbers, for these do not depend on the order: 2^32 of them fit. */
  [[nodiscard]] Eigen::Vector3f mean() const
  {
    constexpr double steps_per_unit = 0x1p31;
    Eigen::Array<std::int64_t, 3, 1> sum = Eigen::Array<std::int64_t, 3, 1>::Zero();
    for (const Eigen::Vector3f& p : places_) sum += (p.cast<double>() * steps_per_unit).array().cast<std::int64_t>();
    return (sum.cast<double>() / (steps_per_unit * static_cast<double>(places_.size()))).cast<float>();
  }

  const KeyedPoint* points_ = nullptr;
  std::vector<Eigen::Vector3f> position_;
  std::vector<Eigen::Vector3f> places_;  ///< the distinct ones
};

/** \brief Gives places to the points in the middle of the voxels, and to the others those of the former. */
void assign_ranks_of_voxels(const FramedCloud& cloud,
                            const KeyedPoint* sorted,
                            const PointArray<std::uint32_t>& begins,
                            OrderedPoints& points,
                            const Parallel& parallel)
{
  constexpr std::size_t voxels_per_block = 4096;
  const std::size_t voxels = begins.size() - 1;
  points.position.resize(voxels);
  points.input_index.resize(voxels);
  points.merged_points = parallel.sum(voxels, voxels_per_block, [&](std::size_t begin, std::size_t end) {
    VoxelPoints inside;
    std::size_t coincident = 0;
    for (std::size_t voxel = begin; voxel < end; ++voxel) {
      for (std::size_t i = begins[voxel]; i < begins[voxel + 1]; ++i) {
        if (i + places_ahead < points.valid_points) fetch(cloud, sorted[i + places_ahead].index, points);
        points.rank_of_input[sorted[i].index] = static_cast<std::uint32_t>(voxel);
      }
      inside.gather(cloud, sorted + begins[voxel], sorted + begins[voxel + 1]);
      const std::size_t middle = inside.middle(cloud);
      points.position[voxel] = inside[middle];
      points.input_index[voxel] = sorted[begins[voxel] + middle].index;
      coincident += inside.coincident();
    }
    return coincident;
  });
  points.thinned_points = points.valid_points - points.merged_points - voxels;
}

/** \brief Bits of a voxel's number along an axis of a box; more than the curve has if the voxels are too small. */
int bits_of_voxels(const Bounds& bounds, double voxel_side)
{
  const double voxels = bounds.extent() / voxel_side;
  return voxels < std::ldexp(1.0, MortonCurve::axis_bits) ? std::ilogb(voxels) + 1 : MortonCurve::axis_bits + 1;
}

}  // namespace

OrderedPoints order_and_thin_points(const PointCloudView& cloud, double voxel_side, const Parallel& parallel)
{
  OrderedPoints points;
  const Bounds bounds = set_frame(cloud, points, parallel);
  // At most the box's: half of it, and so on, is tried until there are enough voxels.
  const double side = std::min(voxel_side / points.unit, bounds.extent());
  // The curve goes through one voxel after the other: sorted by their bits, points are side by side in voxels.
  int bits_within = MortonCurve::axis_bits - bits_of_voxels(bounds, side);
  if (points.valid_points < fewest_points_to_thin || bits_within < 0) return order_points(cloud, parallel);
  const FramedCloud framed(cloud, points);
  const MortonCurve curve(bounds, side, std::ldexp(1.0, bits_within));
  PointArray<KeyedPoint> keyed = keyed_points(cloud, framed, points.valid_points, curve, parallel);
  PointArray<KeyedPoint> other_keyed(keyed.size());
  KeyedPoint* sorted = keyed.data();
  KeyedPoint* other = other_keyed.data();
  for (;; --bits_within) {
    const KeyBits bits{3 * bits_within, 3 * (MortonCurve::axis_bits - bits_within)};
    if (radix_sort(
            sorted, other, keyed.size(), bits, [](const KeyedPoint& p) { return p.key; }, parallel) != sorted)
      std::swap(sorted, other);
    const PointArray<std::uint32_t> begins = begins_of_voxels(sorted, keyed.size(), bits.first, parallel);
    const std::size_t voxels = begins.size() - 1;
    if (!thinning_pays(keyed.size(), voxels) || bits_within == 0) break;
    if (voxels < fewest_points_left) continue;
    assign_ranks_of_voxels(framed, sorted, begins, points, parallel);
    if (thinning_pays(points.valid_points - points.merged_points, voxels)) return points;
    break;  // there only seemed to be enough points in a voxel, for some coincide
  }
  points.thinned_points = 0;
  CurveSort(framed).sort_runs(sorted, other, keyed.size(), 3 * bits_within, parallel);
  assign_ranks(framed, sorted, points, parallel);
  return points;
}

}  // namespace pds
