// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <vector>

#include <pcl_pds_recon/ordered_points.h>
#include <pcl_pds_recon/parallel.h>

namespace pds
{

/** \brief A point's own nearest neighbours, nearest first. */
struct NeighborSpan
{
  const std::uint32_t* first;  ///< the nearest
  const std::uint32_t* last;   ///< behind the farthest

  ///@{
  /** \brief As of a standard container. */
  [[nodiscard]] const std::uint32_t* begin() const { return first; }
  [[nodiscard]] const std::uint32_t* end() const { return last; }
  [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(last - first); }
  ///@}
};

/** \brief All points joined to one: its own neighbours, then those that count it among theirs. */
class NeighborRange
{
 public:
  /** \brief Forward iterator over both. */
  class Iterator
  {
   public:
    using iterator_category = std::forward_iterator_tag;
    using value_type = std::uint32_t;
    using difference_type = std::ptrdiff_t;
    using pointer = const std::uint32_t*;
    using reference = const std::uint32_t&;

    Iterator(pointer at, pointer own_end, pointer reverse_begin)
        : at_(at == own_end ? reverse_begin : at), own_end_(own_end), reverse_begin_(reverse_begin)
    {
    }
    reference operator*() const { return *at_; }
    Iterator& operator++()
    {
      if (++at_ == own_end_) at_ = reverse_begin_;
      return *this;
    }
    Iterator operator++(int)
    {
      Iterator before = *this;
      ++*this;
      return before;
    }
    bool operator==(const Iterator& other) const { return at_ == other.at_; }
    bool operator!=(const Iterator& other) const { return at_ != other.at_; }

   private:
    pointer at_, own_end_, reverse_begin_;
  };

  /** \brief Joins the two lists of one point. */
  NeighborRange(NeighborSpan own, NeighborSpan reverse) : own_(own), reverse_(reverse) {}

  ///@{
  /** \brief As of a standard container. */
  [[nodiscard]] Iterator begin() const { return {own_.first, own_.last, reverse_.first}; }
  [[nodiscard]] Iterator end() const { return {reverse_.last, own_.last, reverse_.first}; }
  [[nodiscard]] std::size_t size() const { return own_.size() + reverse_.size(); }
  ///@}

 private:
  NeighborSpan own_, reverse_;
};

/** \brief How far a point's own neighbours go. */
struct Reach
{
  float squared;       ///< distance of the last one; 0 if there is none
  std::uint32_t rank;  ///< of the last one

  static constexpr std::uint32_t parted = 0xffffffffU;  ///< in place of the rank: the row is of one sheet
};

/** \brief A point is alone if its reach is so many times that of most of its neighbours; where the density of a scan
 * changes 10:1 it is 3. */
constexpr float lone_reach = 4.0F;

/** \brief Median of the points' squared reach, from every 16th: enough to tell orders of magnitude. 0 for no points. */
[[nodiscard]] float typical_squared_reach(const PointArray<Reach>& reach);

/** \brief A point that reaches so many times as far as the typical one is a stray, unless a tenth of all points
 * do: what is sampled at such intervals is no part of a surface that the typical points make. */
constexpr float stray_reach = 30.0F;

/** \brief Symmetric k-nearest-neighbour graph (paper, flowchart step 1).
 *
 * Equal distances are ordered by rank, so the graph does not depend on the input order.
 */
struct NeighborGraph
{
  std::size_t stride = 0;                   ///< room for own neighbours per point
  PointArray<std::uint32_t> own;            ///< own nearest neighbours, by ascending distance, at rank * stride
  PointArray<std::uint16_t> own_count;      ///< how many these are; empty if all rows are full
  PointArray<std::uint32_t> reverse_begin;  ///< size n + 1: beginnings of rows of reverse, from reverse_base on
  std::vector<std::size_t> reverse_base;    ///< for every 2^base_bits points: where the first one's row begins
  PointArray<std::uint32_t> reverse;        ///< points that list this one without being listed, by ascending rank
  PointArray<Reach> reach;                  ///< by point; may be freed
  double sampling_interval = 0;             ///< mean distance to own neighbours but of strays, units of position
  std::size_t lone_points = 0;              ///< how many reach lone_reach times as far as most of their neighbours

  /** Rows of so few points have fewer than 2^32 entries; offsets of all rows would take 8 bytes a point. */
  static constexpr int base_bits = 16;

  /** \brief Number of points. */
  [[nodiscard]] std::size_t size() const { return reverse_begin.empty() ? 0 : reverse_begin.size() - 1; }
  /** \brief The k nearest neighbours of \a i, nearest first: fewer in a smaller cloud, of its own sheet only where
   * sheets were parted (see sheet_separation.h). */
  [[nodiscard]] NeighborSpan nearest(std::size_t i) const
  {
    const std::uint32_t* row = own.data() + i * stride;
    return {row, row + (own_count.empty() ? stride : own_count[i])};
  }
  /** \brief Points that count \a i among their nearest without being among those of \a i, by ascending rank. */
  [[nodiscard]] NeighborSpan listed_by(std::size_t i) const
  {
    return {reverse.data() + begin_of_reverse(i), reverse.data() + begin_of_reverse(i + 1)};
  }
  /** \brief All points joined to \a i by an edge. */
  [[nodiscard]] NeighborRange neighbors(std::size_t i) const { return {nearest(i), listed_by(i)}; }

 private:
  [[nodiscard]] std::size_t begin_of_reverse(std::size_t i) const
  {
    return reverse_base[i >> base_bits] + reverse_begin[i];
  }
};

/** \brief Builds the graph with the library's own search, or with the one that the cloud brings. O(n k log n).
 * \param k neighbours per point, the point itself not counted
 */
[[nodiscard]] NeighborGraph build_neighbor_graph(const OrderedPoints& points,
                                                 const PointCloudView& cloud,
                                                 int k,
                                                 const Parallel& parallel);

///@{
/** \brief The steps of build_neighbor_graph(), between which sheets may be parted: finds the rows and their reach, and
 * adds the edges that only one end lists to the other end. */
[[nodiscard]] NeighborGraph list_neighbors(const OrderedPoints& points,
                                           const PointCloudView& cloud,
                                           int k,
                                           const Parallel& parallel);
void join_neighbors(const OrderedPoints& points,
                    const PointCloudView& cloud,
                    NeighborGraph& graph,
                    const Parallel& parallel);
///@}

}  // namespace pds
