// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/geodesic_disk.h>
#include <algorithm>
#include <cmath>
#include <limits>

namespace pds
{
namespace
{

// A distance this close to its lower bound is not improved any more. Fast marching has a mean error of a few tenths of
// a percent, so a tenth of a percent is lost in it; shortest paths are exact.
constexpr float good_enough_marching = 1.001F;
constexpr float good_enough_paths = 1.0F;

constexpr std::size_t initial_table_size = 1024;  // a power of two; a disk of 3 intervals touches about 200 points

/** \brief Distance of p from a source that lies at distance ta from a and tb from b, by unfolding into the plane of
 * (a, b, p); infinity if the straight line from the source does not pass between a and b. */
float two_point_distance(
    const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& p, float ta, float tb)
{
  constexpr float inf = std::numeric_limits<float>::infinity();
  // The frame: a at the origin, b on the positive x axis at c, p above it.
  const Eigen::Vector3f ab = b - a;
  const Eigen::Vector3f ap = p - a;
  const float c2 = ab.squaredNorm();
  if (c2 <= 0) return inf;
  const float c = std::sqrt(c2);
  const float px = ap.dot(ab) / c;
  const float py2 = ap.squaredNorm() - px * px;
  const float sx = (ta * ta - tb * tb + c2) / (2 * c);
  const float sy2 = ta * ta - sx * sx;  // the source is below the axis
  if (py2 <= 0 || sy2 <= 0) return inf;
  const float py = std::sqrt(py2);
  const float sy = std::sqrt(sy2);
  const float crossing = (sx * py + px * sy) / (py + sy);  // where the line from the source to p meets the axis
  if (crossing < 0 || crossing > c) return inf;
  const float dx = px - sx;
  const float dy = py + sy;
  return std::sqrt(dx * dx + dy * dy);
}

}  // namespace

GeodesicDisk::GeodesicDisk(const OrderedPoints& points,
                           const NeighborGraph& graph,
                           const EdgeWeights& weights,
                           GeodesicSolver solver)
    : points_(points),
      graph_(graph),
      weights_(weights),
      solver_(solver),
      good_enough_(solver == GeodesicSolver::fast_marching ? good_enough_marching : good_enough_paths),
      table_(initial_table_size, none)
{
}

const std::vector<GeodesicDisk::Reached>& GeodesicDisk::grow(std::uint32_t source, float limit)
{
  std::fill(table_.begin(), table_.end(), none);
  nodes_.clear();
  front_.clear();
  reached_.clear();
  source_position_ = points_.position[source];
  push(find_or_add(source));
  const auto later = [](const Front& x, const Front& y) {
    return x.distance > y.distance || (x.distance == y.distance && x.point > y.point);
  };
  while (!front_.empty()) {
    std::pop_heap(front_.begin(), front_.end(), later);
    const Front next = front_.back();
    front_.pop_back();
    Node& node = nodes_[next.node];
    if (node.settled) continue;
    node.settled = true;
    reached_.push_back({node.point, node.distance});
    relax_neighbors(next.node, limit);
  }
  return reached_;
}

void GeodesicDisk::push(std::uint32_t node)
{
  front_.push_back({nodes_[node].distance, nodes_[node].point, node});
  std::push_heap(front_.begin(), front_.end(), [](const Front& x, const Front& y) {
    return x.distance > y.distance || (x.distance == y.distance && x.point > y.point);
  });
}

void GeodesicDisk::relax_neighbors(std::uint32_t settled_node, float limit)
{
  for (const std::uint32_t neighbor : graph_.neighbors(nodes_[settled_node].point)) {
    const float lower_bound = weights_.least() * (points_.position[neighbor] - source_position_).norm();
    if (lower_bound > limit) continue;
    const std::size_t known = nodes_.size();
    const std::uint32_t node = find_or_add(neighbor);
    if (node == known) {
      nodes_[node].path = nodes_[node].distance = std::numeric_limits<float>::infinity();
      nodes_[node].lower_bound = lower_bound;
    }
    // A settled point is final, and close to the lower bound there is nothing left to gain.
    if (nodes_[node].settled || nodes_[node].distance <= good_enough_ * lower_bound) continue;
    const float before = nodes_[node].distance;
    relax(settled_node, node);
    if (nodes_[node].distance < before && nodes_[node].distance <= limit) push(node);
  }
}

void GeodesicDisk::relax(std::uint32_t settled_node, std::uint32_t node)
{
  const Node& a = nodes_[settled_node];
  Node& p = nodes_[node];
  const Eigen::Vector3f& pa = points_.position[a.point];
  const Eigen::Vector3f& pp = points_.position[p.point];
  const float edge_weight = 0.5F * (weights_.at(a.point) + weights_.at(p.point));
  const float path = a.distance + edge_weight * (pp - pa).norm();
  float distance = path;
  if (solver_ == GeodesicSolver::fast_marching && p.nearest != none) {
    const Node& b = nodes_[p.nearest];
    const float weight = (weights_.at(a.point) + weights_.at(b.point) + weights_.at(p.point)) / 3.0F;
    const float two_point =
        weight * two_point_distance(pa, points_.position[b.point], pp, a.distance / weight, b.distance / weight);
    distance = std::min(distance, two_point);
  }
  if (path < p.path) {
    p.path = path;
    p.nearest = settled_node;
  }
  // Neither below the Euclidean distance nor before a point that is already settled.
  p.distance = std::min(p.distance, std::max({distance, p.lower_bound, a.distance}));
}

std::uint32_t GeodesicDisk::find_or_add(std::uint32_t point)
{
  constexpr std::uint32_t golden = 2654435769U;  // Fibonacci hashing: spreads runs of ranks over the table
  const std::size_t mask = table_.size() - 1;
  std::size_t slot = (static_cast<std::size_t>(point * golden) >> 7) & mask;
  for (; table_[slot] != none; slot = (slot + 1) & mask)
    if (nodes_[table_[slot]].point == point) return table_[slot];
  const auto node = static_cast<std::uint32_t>(nodes_.size());
  table_[slot] = node;
  nodes_.emplace_back();
  nodes_.back().point = point;
  if (2 * nodes_.size() > table_.size()) grow_table();
  return node;
}

void GeodesicDisk::grow_table()
{
  const std::size_t size = 2 * table_.size();
  table_.assign(size, none);
  std::vector<Node> nodes;
  nodes.swap(nodes_);
  nodes_.reserve(2 * nodes.size());
  for (const Node& node : nodes) {
    find_or_add(node.point);
    nodes_.back() = node;
  }
}

}  // namespace pds
