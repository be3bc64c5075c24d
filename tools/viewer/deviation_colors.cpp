// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/deviation_colors.h"

#include <algorithm>
#include <cmath>

#include <vtkColorTransferFunction.h>
#include <vtkNew.h>

namespace pds
{

vtkSmartPointer<vtkLookupTable> deviation_colors(double reach)
{
  constexpr int steps = 256;
  vtkNew<vtkColorTransferFunction> colors;
  colors->SetColorSpaceToDiverging();
  colors->AddRGBPoint(-1, 0.23, 0.30, 0.75);
  colors->AddRGBPoint(1, 0.71, 0.02, 0.15);
  auto table = vtkSmartPointer<vtkLookupTable>::New();
  table->SetNumberOfTableValues(steps);
  table->SetTableRange(-reach, reach);
  for (int i = 0; i < steps; ++i) {
    double rgb[3];
    colors->GetColor(2.0 * i / (steps - 1) - 1, rgb);
    table->SetTableValue(i, rgb[0], rgb[1], rgb[2]);
  }
  table->SetNanColor(0.5, 0.5, 0.5, 1);
  return table;
}

double deviation_reach(const std::vector<double>& deviation)
{
  std::vector<double> sizes;
  for (const double value : deviation) {
    if (std::isfinite(value)) {
      sizes.push_back(std::abs(value));
    }
  }
  if (sizes.empty()) {
    return 1;
  }
  const auto at = sizes.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(sizes.size() - 1));
  std::nth_element(sizes.begin(), at, sizes.end());
  return *at > 0 ? *at : 1;
}

}  // namespace pds
