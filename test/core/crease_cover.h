// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "mesh_facts.h"

namespace pds_test
{

/** \brief Straight pieces of creases or rims. */
struct Creases
{
  std::vector<Eigen::Vector3d> from, to;
};

/** \brief The edges of an oriented mesh at which two faces turn by more than so many degrees. */
[[nodiscard]] Creases find_creases(const Triangles& triangles,
                                   const std::vector<Eigen::Vector3d>& position,
                                   double least_turn);

/** \brief The edges of a mesh that have only one face. */
[[nodiscard]] Creases find_rims(const Triangles& triangles, const std::vector<Eigen::Vector3d>& position);

/** \brief Share of the length of some creases that is within a distance of others. O(pieces of both). */
[[nodiscard]] double covered_share(const Creases& creases, const Creases& cover, double distance);

}  // namespace pds_test
