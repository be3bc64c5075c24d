// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pds
{

/** \brief Candidate neighbours as coordinate columns, ascending by index; room for whole vector registers behind. */
struct CandidateColumns
{
  std::vector<float> x, y, z;
  std::vector<std::uint32_t> index;
  std::size_t count = 0;

  void reserve(std::size_t capacity);
};

/** \brief Working memory of select_nearest(). */
struct SelectionScratch
{
  std::vector<float> squared_distance;  ///< of every candidate
  std::vector<float> kept_distance;     ///< of those within the bound
  std::vector<std::uint32_t> kept_index;
  std::vector<std::uint32_t> rank;
  std::vector<std::uint32_t> place;  ///< 0, 1, 2 ...: the columns' own numbers, to compare with in vector code
};

/** \brief A query point and the squared distance within which its neighbours are looked for. */
struct NeighborQuery
{
  float x, y, z;
  std::uint32_t self;  ///< index of the query among the candidates' indices; never its own neighbour
  float squared_bound;
};

/** \brief Instruction sets for which the selection is compiled; all give the same bits. */
enum class InstructionSet
{
  baseline,
  avx2,
  avx512
};

/** \brief The best set that this processor has. */
[[nodiscard]] InstructionSet best_instruction_set();

/** \brief Writes the k nearest candidates within the bound, nearest first, equal distances by index.
 *
 * Distances to all candidates, then ranks by counting smaller ones: branch-free loops over columns, which compilers
 * turn into vector code. \param nearest room for k indices \return the squared distance of the last one; infinity if
 * fewer than k are within the bound
 */
float select_nearest(InstructionSet set,
                     const CandidateColumns& candidates,
                     const NeighborQuery& query,
                     std::size_t k,
                     SelectionScratch& scratch,
                     std::uint32_t* nearest);

}  // namespace pds
