// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace pds
{

/** \brief A rubber duck: closed, genus 0, about 2 units long, around the origin.
 *
 * \return a value that is 0 on the surface, negative inside, and nowhere greater than the distance to the surface, so
 * that a ray may always advance by it. Only + - * / and square roots are used: correctly rounded on every machine.
 */
double duck_distance_bound(const Eigen::Vector3d& point);

/** \brief A bearing block: a plate with four bolt holes, a boss with a bore, and two ribs; 2 units long, z up, closed,
 * genus 5, with sharp edges.
 * \return as above
 */
double part_distance_bound(const Eigen::Vector3d& point);

}  // namespace pds
