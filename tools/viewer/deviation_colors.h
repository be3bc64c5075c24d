// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <vtkLookupTable.h>
#include <vtkSmartPointer.h>

namespace pds
{

/** \brief Colours of deviations, blue (inside) over white to red (outside), up to \a reach either way. */
[[nodiscard]] vtkSmartPointer<vtkLookupTable> deviation_colors(double reach);

/** \brief The reach of the colours: 99 % of these values are smaller. */
[[nodiscard]] double deviation_reach(const std::vector<double>& deviation);

}  // namespace pds
