// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_pds_recon/hole_filling.h>
#include <cstddef>

namespace pds
{

/** \brief Unfolds a mesh of noisy points: a few faces that turn away from all that is beside them, by over 60 degrees
 * everywhere and by over 80 somewhere. Seeds off the surface make such folds, and patches that hang on upside down.
 *
 * At a rim the faces go. Elsewhere they are taken out together with one face beside them, or with all faces at one of
 * their vertices if it has four at most, and has none then; the hole is filled by faces none of which turns by over 80
 * degrees. Without such faces all stays as it was. So do edges and tips of the object: there one side goes on. O(m).
 * \param complex without pinched vertices; it may have new specks afterwards
 * \return the number of folds that are gone
 */
std::size_t remove_folds(TriangleComplex& complex, const BorderingCells& bordering, const FillLimits& limits);

}  // namespace pds
