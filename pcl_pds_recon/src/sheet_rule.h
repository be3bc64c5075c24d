// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include <pcl_pds_recon/edge_weights.h>
#include <pcl_pds_recon/neighbor_graph.h>
#include <pcl_pds_recon/point_cloud_view.h>
#include "parallel_planes.h"
#include "sheets.h"

namespace pds
{

/** \brief Tells whether two parallel sheets go by a point. Holds the working memory of one thread. */
class SheetRule
{
 public:
  /** Curvature of a neighbourhood that may hold two sheets. Those one interval apart give 0.3 to 0.45; of the points of
   * clean scans one in sixty has more than this. */
  static constexpr float thick = 0.2F;

  SheetRule(const PointCloudView& cloud,
            const OrderedPoints& points,
            const NeighborGraph& graph,
            const SurfaceEstimate& surface)
      : cloud_(cloud), points_(points), graph_(graph), surface_(surface)
  {
  }

  /** \return false if there are no two sheets at the point; then \a sheet is as it was */
  bool find(std::uint32_t point, Sheet& sheet);

 private:
  /** \brief Between two parallel planes. */
  struct Layer
  {
    Eigen::Vector3f normal;
    float width, middle;
  };
  /** \brief Place of a hash table; an old round's entry is no entry. */
  struct Slot
  {
    std::uint32_t round = 0, rank = 0;
  };

  [[nodiscard]] Eigen::Vector3f normal_nearby(std::uint32_t point) const;
  [[nodiscard]] bool faces_both_ways(std::uint32_t point) const;
  Layer empty_layer(std::uint32_t point, const Eigen::Vector3f& normal);
  void collect(std::uint32_t point, float reach);
  void add(std::uint32_t rank);
  bool are_sheets(const Layer& layer, float reach);
  float noise_of_most();
  void describe(std::uint32_t point, float reach, Sheet& sheet);

  static constexpr int slot_bits = 9;  // twice as many slots as a full neighbourhood of 15 neighbours has points

  const PointCloudView& cloud_;
  const OrderedPoints& points_;
  const NeighborGraph& graph_;
  const SurfaceEstimate& surface_;
  ParallelPlanes planes_;
  float clear_ = 0;                      ///< no point is so near to the plane in the middle, in half gaps
  std::vector<std::uint32_t> rank_;      ///< of the point, its neighbours, and theirs
  std::vector<Eigen::Vector3f> around_;  ///< where these are, relative to the point and its reach
  std::vector<float> height_;            ///< scratch
  std::vector<std::pair<float, std::uint32_t>> nearest_;  ///< scratch: squared distance, rank
  std::array<Slot, std::size_t{1} << slot_bits> seen_{};  ///< ranks that are in rank_ already
  std::uint32_t round_ = 0;
};

}  // namespace pds
