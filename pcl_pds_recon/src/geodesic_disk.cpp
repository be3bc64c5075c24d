// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/geodesic_disk.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include "arc_kernel.h"

namespace pds
{
namespace
{

constexpr float infinity = std::numeric_limits<float>::infinity();

// A distance this close to its lower bound is not improved any more. Fast marching has a mean error of a few tenths of
// a percent, so a tenth of a percent is lost in it; shortest paths are exact.
constexpr float good_enough_marching = 1.001F;
constexpr float good_enough_paths = 1.0F;

/** \brief Distance of p from a source that lies at distance ta from a and tb from b, by unfolding into the plane of
 * (a, b, p); infinity if the straight line from the source does not pass between a and b. */
float two_point_distance(
    const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& p, float ta, float tb)
{
  // The frame: a at the origin, b on the positive x axis at c, p above it.
  const Eigen::Vector3f ab = b - a;
  const Eigen::Vector3f ap = p - a;
  const float c2 = ab.squaredNorm();
  if (c2 <= 0) return infinity;
  const float c = std::sqrt(c2);
  const float px = ap.dot(ab) / c;
  const float py2 = ap.squaredNorm() - px * px;
  const float sx = (ta * ta - tb * tb + c2) / (2 * c);
  const float sy2 = ta * ta - sx * sx;  // the source is below the axis
  if (py2 <= 0 || sy2 <= 0) return infinity;
  const float py = std::sqrt(py2);
  const float sy = std::sqrt(sy2);
  const float crossing = (sx * py + px * sy) / (py + sy);  // where the line from the source to p meets the axis
  if (crossing < 0 || crossing > c) return infinity;
  const float dx = px - sx;
  const float dy = py + sy;
  return std::sqrt(dx * dx + dy * dy);
}

}  // namespace

GeodesicDisk::GeodesicDisk(const OrderedPoints& points,
                           const NeighborGraph& graph,
                           const SurfaceEstimate& surface,
                           const EdgeWeights& weights,
                           GeodesicSolver solver,
                           PatchMarks& marks)
    : points_(points),
      graph_(graph),
      surface_(surface),
      weights_(weights),
      solver_(solver),
      good_enough_(solver == GeodesicSolver::fast_marching ? good_enough_marching : good_enough_paths),
      marks_(marks),
      instruction_set_(best_instruction_set()),
      columns_(std::make_unique<SurfaceColumns>())
{
}

GeodesicDisk::~GeodesicDisk() { leave(); }

void GeodesicDisk::leave()
{
  for (std::size_t node = 1; node < patch_.size(); ++node) marks_[patch_[node]].store(none, std::memory_order_relaxed);
  patch_.clear();
}

void GeodesicDisk::enter(const std::vector<RankRange>& patch)
{
  leave();
  std::size_t count = 0;
  for (const RankRange& range : patch) count += range.end - range.begin;
  columns_->resize(count + 1);
  settled_.resize(columns_->x.size());
  march_.resize(count + 1);
  patch_.resize(count + 1);
  patch_[none] = no_rank;
  columns_->set(none, Eigen::Vector3f::Constant(infinity), Eigen::Vector3f::Zero(), 1.0F);
  std::uint32_t node = none;
  for (const RankRange& range : patch) {
    columns_->copy(node + 1, points_.position.data() + range.begin, surface_.normal.data() + range.begin,
                   range.end - range.begin);
    for (std::uint32_t point = range.begin; point < range.end; ++point) {
      patch_[++node] = point;
      marks_[point].store(node, std::memory_order_relaxed);
    }
  }
  if (!weights_.uniform())
    for (node = 1; node <= count; ++node) columns_->weight[node] = weights_.at(patch_[node]);
}

Eigen::Vector3f GeodesicDisk::position(std::uint32_t node) const
{
  return {columns_->x[node], columns_->y[node], columns_->z[node]};
}

const std::vector<GeodesicDisk::Reached>& GeodesicDisk::grow(std::uint32_t source, float limit)
{
  const std::uint32_t center = node_of(source);
  measure(center, limit);
  if (!all_arcs_supported(center)) {
    reject_unsupported_arcs(center);
    march(center, limit);
  }
  reached_.clear();
  for (const std::uint32_t node : within_)
    if (settled_[node] < no_arc) reached_.push_back({patch_[node], settled_[node]});
  return reached_;
}

/** \brief Lengths of all arcs from the source. */
void GeodesicDisk::measure(std::uint32_t source, float limit)
{
  const ArcQuery query{position(source),
                       surface_.normal[patch_[source]],
                       weights_.at(patch_[source]),
                       weights_.least(),
                       limit,
                       solver_ == GeodesicSolver::fast_marching};
  within_.resize(columns_->x.size() + 1);
  within_.resize(measure_arcs(instruction_set_, *columns_, query, settled_.data(), within_.data()));
  settled_[source] = 0;
}

/** \brief True if all points within the limit are on arcs that the graph supports.
 *
 * A point with neighbours all around has one that is nearer to the source, wherever that is: it needs no look at its
 * row. A gap shows at the points on its rim.
 */
bool GeodesicDisk::all_arcs_supported(std::uint32_t source) const
{
  return std::all_of(within_.begin(), within_.end(), [this, source](std::uint32_t node) {
    if (settled_[node] == no_arc) return false;
    return surface_.inside[patch_[node]] != 0 || node == source || is_supported(node);
  });
}

/** \brief Leaves to marching what is no arc, and arcs that the graph does not support. An arc loses its support with
 * the arcs that supported it; what remains is the same in whatever order they go, for support leads inwards. */
void GeodesicDisk::reject_unsupported_arcs(std::uint32_t source)
{
  constexpr std::size_t ahead = 16;  // rows that can be read in the time one takes to come from memory
  for (bool again = true; again;) {
    again = false;
    for (std::size_t i = 0; i < within_.size(); ++i) {
      const std::uint32_t node = within_[i];
      if (i + ahead < within_.size()) fetch_row(within_[i + ahead]);
      if (settled_[node] == no_arc || node == source || is_supported(node)) continue;
      settled_[node] = no_arc;
      again = true;
    }
  }
  marched_.clear();
  for (const std::uint32_t node : within_)
    if (settled_[node] == no_arc) marched_.push_back(node);
}

/** \brief Asks for the nearest neighbours of a point, which take two cache lines, to be brought from memory. */
void GeodesicDisk::fetch_row(std::uint32_t node) const
{
  const NeighborSpan row = graph_.nearest(patch_[node]);
  __builtin_prefetch(row.begin());
  if (row.size() > 0) __builtin_prefetch(row.end() - 1);
}

/** \brief True if an edge leads to a point with a shorter arc. */
bool GeodesicDisk::is_supported(std::uint32_t node) const
{
  const float arc = settled_[node];
  const auto leads_inwards = [this, arc](std::uint32_t neighbor) { return settled_[node_of(neighbor)] < arc; };
  const NeighborSpan nearest = graph_.nearest(patch_[node]);
  // One of the first few nearly always does: all are looked at, for a branch that goes one way costs nothing.
  constexpr std::size_t few = 4;
  if (nearest.size() >= few) {
    unsigned inwards = 0;
    for (std::size_t i = 0; i < few; ++i) inwards += leads_inwards(nearest.begin()[i]) ? 1U : 0U;
    if (inwards != 0) return true;
  }
  const NeighborRange all = neighbors(node);
  return std::any_of(all.begin(), all.end(), leads_inwards);
}

/** \brief Fast marching from the points settled so far to those that are left. */
void GeodesicDisk::march(std::uint32_t source, float limit)
{
  front_.clear();
  for (const std::uint32_t node : marched_) {
    const float straight = weights_.least() * (position(node) - position(source)).norm();
    march_[node] = {straight, infinity, infinity, none};
    start_from_settled(node);
    offer(node, limit);
  }
  while (!front_.empty()) {
    std::pop_heap(front_.begin(), front_.end());
    const Front next = front_.back();
    front_.pop_back();
    if (settled_[next.node] != no_arc) continue;
    settled_[next.node] = next.distance;
    for (const std::uint32_t neighbor : neighbors(next.node)) {
      const std::uint32_t node = node_of(neighbor);
      if (settled_[node] != no_arc || is_good_enough(node)) continue;
      const float before = march_[node].distance;
      relax_two_point(next.node, node);
      relax_path(next.node, node);
      if (march_[node].distance < before) offer(node, limit);
    }
  }
}

/** \brief The distance of a point as its neighbours on arcs have it. */
void GeodesicDisk::start_from_settled(std::uint32_t node)
{
  const auto is_settled = [this](std::uint32_t other) { return settled_[other] < no_arc; };
  for (const std::uint32_t neighbor : neighbors(node))
    if (is_settled(node_of(neighbor))) relax_path(node_of(neighbor), node);
  for (const std::uint32_t neighbor : neighbors(node)) {
    if (is_good_enough(node)) break;
    if (is_settled(node_of(neighbor))) relax_two_point(node_of(neighbor), node);
  }
}

/** \brief Close to the lower bound there is nothing left to gain. */
bool GeodesicDisk::is_good_enough(std::uint32_t node) const
{
  return march_[node].distance <= good_enough_ * march_[node].straight;
}

void GeodesicDisk::offer(std::uint32_t node, float limit)
{
  if (march_[node].distance > limit) return;
  front_.push_back({march_[node].distance, node});
  std::push_heap(front_.begin(), front_.end());
}

void GeodesicDisk::relax_path(std::uint32_t from, std::uint32_t node)
{
  March& march = march_[node];
  const float edge_weight = 0.5F * (columns_->weight[from] + columns_->weight[node]);
  const float path = settled_[from] + edge_weight * (position(node) - position(from)).norm();
  if (path >= march.path) return;
  march.path = path;
  march.nearest = from;
  march.distance = std::min(march.distance, std::max(path, march.straight));
}

void GeodesicDisk::relax_two_point(std::uint32_t from, std::uint32_t node)
{
  March& march = march_[node];
  if (solver_ != GeodesicSolver::fast_marching || march.nearest == none || march.nearest == from) return;
  const std::uint32_t other = march.nearest;
  const float least = std::max({march.straight, settled_[from], settled_[other]});
  if (least >= march.distance) return;
  const float weight = (columns_->weight[from] + columns_->weight[other] + columns_->weight[node]) / 3.0F;
  const float distance = weight * two_point_distance(position(from), position(other), position(node),
                                                     settled_[from] / weight, settled_[other] / weight);
  // Neither below the Euclidean distance nor before the points that it comes by.
  march.distance = std::min(march.distance, std::max(distance, least));
}

}  // namespace pds
