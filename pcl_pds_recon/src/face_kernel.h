// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "face_plane.h"
#include "instruction_set.h"

namespace pds
{

constexpr std::size_t face_lanes = 8;  // points that are measured together: doubles in the widest register

/** \brief Points in columns, and for each the face that it is nearest to. */
struct FacedPoints
{
  double x[face_lanes], y[face_lanes], z[face_lanes];
  double distance2[face_lanes];       ///< from the nearest face, in squared radii
  std::uint64_t nearest[face_lanes];  ///< its place among the faces asked for; as wide as what it is chosen by
};

/** \brief Finds the nearest of some faces for each point: the first of several at equal distance. Every instruction set
 * gives the same bits.
 * \param begin numbers of the faces, up to \a end
 * \param plane by number
 * \param limit squared distance from which on a face is too far away: the place is that of \a end then */
void find_nearest_faces(InstructionSet set,
                        const std::uint32_t* begin,
                        const std::uint32_t* end,
                        const std::vector<FacePlane>& plane,
                        double limit,
                        FacedPoints& points);

}  // namespace pds
