// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <pcl_pds_recon/neighbor_graph.h>
#include <pcl_pds_recon/parallel.h>
#include <pcl_pds_recon/point_array.h>

namespace pds
{

/** \brief What one end of an edge lists and the other does not. */
struct ReverseEdge
{
  std::uint32_t listed;
  std::uint32_t lister;
};

/** \brief Brings the edges that were found with the listing points to the listed ones.
 *
 * Points are cut into tiles of consecutive ranks. Each tile sorts the edges of its points by the tile that they lead
 * to; then each tile collects what leads to it, and sorts that by point. Both fit into a processor's own cache.
 */
class ReverseEdges
{
 public:
  /** \param workers that add edges at the same time */
  ReverseEdges(std::size_t point_count, unsigned workers);

  [[nodiscard]] std::size_t tile_size() const { return std::size_t{1} << tile_bits_; }
  [[nodiscard]] std::size_t tile_count() const { return tiles_.size(); }

  /** \brief Takes the edges of the listing points in one tile, ascending by these. Different workers may do so at the
   * same time. */
  void add(unsigned worker, std::size_t tile, const ReverseEdge* edges, std::size_t count);

  /** \brief Makes all edges rows of the graph.
   * \throws InvalidInput if there are too many for the graph
   */
  void file(NeighborGraph& graph, const Parallel& parallel) const;

 private:
  /** \brief An edge between two known tiles. A tile has 2^16 points at most: with whole ranks, these would be the
   * largest array of a run but the graph itself. */
  struct PackedEdge
  {
    std::uint16_t listed;  ///< within its tile
    std::uint16_t lister;
  };
  struct Tile
  {
    PackedEdge* edges = nullptr;
    std::vector<std::uint32_t> begin;  ///< by tile that they lead to: its first edge, of these; empty if there are none
  };

  /** \brief Memory for the edges of one worker's tiles. */
  class Chunks
  {
   public:
    PackedEdge* take(std::size_t count)
    {
      constexpr std::size_t usual_size = std::size_t{1} << 20;  // edges: two huge pages
      if (chunks_.empty() || chunks_.back().size() - taken_ < count) {
        chunks_.emplace_back(std::max(count, usual_size));
        taken_ = 0;
      }
      return chunks_.back().data() + std::exchange(taken_, taken_ + count);
    }

   private:
    std::vector<PointArray<PackedEdge>> chunks_;
    std::size_t taken_ = 0;  ///< of the last chunk
  };

  [[nodiscard]] std::uint16_t place_in_tile(std::uint32_t point) const
  {
    return static_cast<std::uint16_t>(point & (tile_size() - 1));
  }
  template <typename Visit>
  void visit_edges_to(std::size_t tile, const Visit& visit) const;
  [[nodiscard]] std::vector<std::size_t> row_begin_of_tiles(const Parallel& parallel) const;
  void file_tile(std::size_t tile, std::size_t row_begin, NeighborGraph& graph) const;

  std::size_t point_count_;
  int tile_bits_;
  std::vector<Tile> tiles_;
  std::vector<Chunks> chunks_of_worker_;
};

}  // namespace pds
