// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include <pcl_pds_recon/edge_weights.h>
#include <pcl_pds_recon/neighbor_graph.h>
#include <pcl_pds_recon/options.h>
#include <pcl_pds_recon/ordered_points.h>

namespace pds
{

/** \brief Working memory with one zero per point of the cloud, which patches without a common point may share in
 * different threads. Atomic because edges lead out of a patch, to points that another thread may be marking. */
using PatchMarks = std::vector<std::atomic<std::uint32_t>>;

/** \brief Ranks begin ... end - 1. */
struct RankRange
{
  std::uint32_t begin;  ///< the first
  std::uint32_t end;    ///< behind the last
};

struct SurfaceColumns;
enum class InstructionSet;

/** \brief Grows geodesic disks on a patch of the neighbourhood graph (paper, flowchart step 3).
 *
 * Where the surface bends gently, the geodesic to a point is an arc between two known tangent planes, and its length
 * has a closed form. Arcs count for points from which edges of the graph lead to the source by way of points with ever
 * shorter arcs, so that no gap lies in between. All others are reached from these by fast marching: points are settled
 * in order of distance, as in Dijkstra's method, but a distance also takes the two-point update, in which two settled
 * neighbours a and b fix the source's place in the plane of the triangle (a, b, p), and the distance is the straight
 * line from there. Where no source fits, the shortest edge path counts. No distance falls below the Euclidean one times
 * the least weight.
 *
 * An object holds the working memory of one thread; its size follows the largest patch.
 */
class GeodesicDisk
{
 public:
  /** \brief A point reached, and its distance in units of position. */
  struct Reached
  {
    std::uint32_t point;  ///< its rank
    float distance;       ///< from the source, in the run's metric
  };

  /** \param marks as many as there are points */
  GeodesicDisk(const OrderedPoints& points,
               const NeighborGraph& graph,
               const SurfaceEstimate& surface,
               const EdgeWeights& weights,
               GeodesicSolver solver,
               PatchMarks& marks);
  ~GeodesicDisk();
  GeodesicDisk(const GeodesicDisk&) = delete;
  GeodesicDisk& operator=(const GeodesicDisk&) = delete;

  /** \brief Makes these points the patch on which disks grow. O(m).
   * \param patch ranks, each in one range; all that a disk may reach must be among them
   */
  void enter(const std::vector<RankRange>& patch);

  /** \brief Ends work on the patch: others may have its points on theirs. O(m). */
  void leave();

  /** \brief Finds all points of the patch within \a limit of \a source, which is one of them.
   *
   * O(n + m k) for n points in the patch and m in the disk; O(m k log m) where all is marched.
   * \return the points reached, in an order that depends only on the patch; valid until the next call
   */
  const std::vector<Reached>& grow(std::uint32_t source, float limit);

 private:
  static constexpr std::uint32_t none = 0;  ///< a node that is beyond every limit: points outside the patch

  /** \brief An entry of the front; a point's outdated entries are skipped when they come up. */
  struct Front
  {
    float distance;
    std::uint32_t node;

    bool operator<(const Front& other) const
    {
      return distance > other.distance || (distance == other.distance && node > other.node);
    }
  };

  /** \brief What marching knows of a point. */
  struct March
  {
    float straight;         ///< from the source at the least weight: a lower bound
    float path;             ///< length of the shortest path of edges
    float distance;         ///< best distance so far
    std::uint32_t nearest;  ///< settled neighbour on that path, or none
  };

  [[nodiscard]] std::uint32_t node_of(std::uint32_t point) const
  {
    const std::uint32_t node = marks_[point].load(std::memory_order_relaxed);
    return node < patch_.size() && patch_[node] == point ? node : none;  // else it is another patch's mark
  }
  [[nodiscard]] NeighborRange neighbors(std::uint32_t node) const { return graph_.neighbors(patch_[node]); }
  [[nodiscard]] Eigen::Vector3f position(std::uint32_t node) const;
  void measure(std::uint32_t source, float limit);
  [[nodiscard]] bool all_arcs_supported(std::uint32_t source) const;
  void reject_unsupported_arcs(std::uint32_t source);
  void fetch_row(std::uint32_t node) const;
  [[nodiscard]] bool is_supported(std::uint32_t node) const;
  void march(std::uint32_t source, float limit);
  void start_from_settled(std::uint32_t node);
  [[nodiscard]] bool is_good_enough(std::uint32_t node) const;
  void relax_path(std::uint32_t from, std::uint32_t node);
  void relax_two_point(std::uint32_t from, std::uint32_t node);
  void offer(std::uint32_t node, float limit);

  const OrderedPoints& points_;
  const NeighborGraph& graph_;
  const SurfaceEstimate& surface_;
  const EdgeWeights& weights_;
  GeodesicSolver solver_;
  float good_enough_;
  PatchMarks& marks_;                 ///< the node of each point of the patch
  std::vector<std::uint32_t> patch_;  ///< points by node, from node 1
  InstructionSet instruction_set_;
  std::unique_ptr<SurfaceColumns> columns_;
  std::vector<float> settled_;         ///< by node: distance if settled, else no_arc within the limit, or beyond_limit
  std::vector<std::uint32_t> within_;  ///< nodes within the limit
  std::vector<std::uint32_t> marched_;
  std::vector<March> march_;  ///< by node, valid for those marched
  std::vector<Front> front_;  ///< binary heap
  std::vector<Reached> reached_;
};

}  // namespace pds
