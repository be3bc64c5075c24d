// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <pcl_pds_recon/parallel.h>
#include <pcl_pds_recon/point_array.h>

namespace pds
{

/** \brief Axis-aligned box. */
struct Box
{
  float low[3];
  float high[3];
};

/** \brief Boxes of a tree node's children as columns. */
struct BoxColumns
{
  static constexpr std::size_t size = 16;  ///< fills a register of the widest instruction set
  float low[3][size];
  float high[3][size];
};

/** \brief Candidate neighbours as columns, ascending by index.
 *
 * Plain pointers: code for newer instruction sets must not instantiate templates that code for all processors shares.
 */
struct CandidateColumns
{
  float *x, *y, *z;
  std::uint32_t* index;
  std::size_t count;
};

/** \brief A query point, which is among the candidates, and the squared distance within which to look. */
struct NeighborQuery
{
  float x, y, z;
  std::uint32_t self;
  float squared_bound;
};

/** \brief Working memory of a selection: the candidates within the bound, then the same by ascending distance. */
struct SelectionColumns
{
  float* distance;
  std::uint32_t* index;
  std::uint32_t* rank;  ///< number of smaller distances
  float* sorted_distance;
  std::uint32_t* sorted_index;
  std::uint32_t* next_place;  ///< of the next candidate of a rank, while ties are broken
};

/** \brief Floats in a register of the widest instruction set; columns have room for two behind their last entry. */
constexpr std::size_t widest_register = 16;

/** \brief Memory of columns. */
class CandidateBuffer
{
 public:
  explicit CandidateBuffer(std::size_t capacity);
  CandidateColumns columns;

 private:
  std::vector<float> coordinates_;
  std::vector<std::uint32_t> index_;
};

class SelectionBuffer
{
 public:
  explicit SelectionBuffer(std::size_t capacity);
  SelectionColumns columns;

 private:
  std::vector<float> distances_;
  std::vector<std::uint32_t> integers_;
};

/** \brief The inner loops of the neighbour search, compiled for one instruction set; all sets give the same bits. */
struct NeighborKernel
{
  const char* name;

  /** \brief Which boxes are within a distance of a box: one bit each, the first one lowest. */
  std::uint32_t (*boxes_within)(const BoxColumns& boxes, const Box& box, float squared_reach);

  /** \brief Copies the candidates within a distance of a box, in their order. \a to has room for all of \a from. */
  void (*filter)(const CandidateColumns& from, const Box& box, float squared_reach, CandidateColumns& to);

  /** \brief Writes the k nearest candidates within the bound, the query left out, nearest first and equal distances by
   * index. \return the squared distance of the last one; infinity if fewer than k are within the bound
   */
  float (*select)(const CandidateColumns& candidates,
                  const NeighborQuery& query,
                  std::size_t k,
                  const SelectionColumns& scratch,
                  std::uint32_t* nearest);
};

/** \brief The kernels that this processor can run, the fastest one last. */
[[nodiscard]] std::vector<const NeighborKernel*> neighbor_kernels();

/** \brief nearest_neighbors() with a certain kernel, so that tests can compare them. */
[[nodiscard]] PointArray<std::uint32_t> nearest_neighbors(const PointArray<Eigen::Vector3f>& position,
                                                          std::size_t k,
                                                          const NeighborKernel& kernel,
                                                          const Parallel& parallel);

/** \brief Fills the sorted columns from the ranked candidates, the query first and equal distances by index. */
void sort_with_ties(const SelectionColumns& candidates, std::size_t count, std::uint32_t self);

extern const NeighborKernel baseline_kernel;
#if defined(__x86_64__)
extern const NeighborKernel avx2_kernel;
extern const NeighborKernel avx512_kernel;
#endif

}  // namespace pds
