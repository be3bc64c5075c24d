// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "instruction_set.h"

namespace pds
{

/** \brief Points in columns, padded to whole registers: what arcs are measured from and to. */
struct SurfaceColumns
{
  std::size_t count = 0;
  std::vector<float> x, y, z;
  std::vector<float> normal_x, normal_y, normal_z;
  std::vector<float> weight;

  void resize(std::size_t points);
  void set(std::size_t i, const Eigen::Vector3f& position, const Eigen::Vector3f& normal, float weight_there);
  /** \brief Sets positions and normals from place \a i on; weights stay. */
  void copy(std::size_t i, const Eigen::Vector3f* position, const Eigen::Vector3f* normal, std::size_t points);
};

/** \brief One end of all arcs, and which points are wanted. */
struct ArcQuery
{
  Eigen::Vector3f position;
  Eigen::Vector3f normal;
  float weight;
  float least_weight;  ///< of all points: times the Euclidean distance, a lower bound of every distance
  float limit;         ///< longest distance of interest
  bool arcs_allowed;   ///< false: nothing is an arc
};

/** \brief The length given to a point within reach of which only marching can tell the distance. */
constexpr float no_arc = std::numeric_limits<float>::max();
/** \brief The length given to a point beyond the limit. */
constexpr float beyond_limit = std::numeric_limits<float>::infinity();

/** \brief Lengths of the arcs from one point to all points of the columns.
 *
 * An arc is the cubic between the tangent planes at its two ends; it is longer than its chord by a factor of
 * 1 + (2 a^2 - a b + 2 b^2) / 30 to second order in its slopes a and b at the ends. It counts where both slopes are
 * small and the weight, which is taken to change linearly along it, changes little. Every instruction set gives the
 * same bits.
 * \param length receives a length, no_arc or beyond_limit for each point
 * \param within receives the numbers of the points that are not beyond the limit, ascending
 * \return how many these are
 */
std::size_t measure_arcs(
    InstructionSet set, const SurfaceColumns& columns, const ArcQuery& query, float* length, std::uint32_t* within);

}  // namespace pds
