// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/ordered_points.h>

#include "morton_order.h"

namespace pds
{

OrderedPoints order_points(const PointCloudView& cloud, const Parallel& parallel)
{
  OrderedPoints points;
  const Bounds bounds = set_frame(cloud, points, parallel);
  if (points.valid_points == 0) return points;
  const FramedCloud framed(cloud, points);
  PointArray<KeyedPoint> keyed = keyed_points(cloud, framed, points.valid_points, MortonCurve(bounds), parallel);
  PointArray<KeyedPoint> other(keyed.size());
  const KeyedPoint* sorted =
      CurveSort(framed).sort(keyed.data(), other.data(), keyed.size(), 3 * MortonCurve::axis_bits, parallel);
  assign_ranks(framed, sorted, points, parallel);
  return points;
}

}  // namespace pds
