// SPDX-License-Identifier: BSD-3-Clause
#include "joined_parts.h"

#include <pcl_pds_recon/mesh_cleaning.h>
#include <algorithm>
#include <cmath>
#include <utility>
#include "surface_integrals.h"

namespace pds
{

JoinedParts::JoinedParts(TriangleComplex& complex) : complex_(complex), part_of_(complex.vertex_count())
{
  for (const std::vector<std::uint32_t>& faces : complex.components()) {
    const auto number = static_cast<std::uint32_t>(parts_.size());
    std::vector<Triangle> triangles;
    triangles.reserve(faces.size());
    for (const std::uint32_t f : faces) triangles.push_back(complex.oriented(f));
    for (const Triangle& t : triangles)
      for (const std::uint32_t v : t) part_of_[v] = number;
    const SurfaceIntegrals integrals = integrate(triangles, complex.position());
    parts_.push_back(
        {faces.size(), faces.front(), triangles.front(), integrals.bulge(), !integrals.faces_one_side(), number, {}});
  }
}

void JoinedParts::hang_together(std::uint32_t a, std::uint32_t b)
{
  parts_[a].joined.push_back(b);
  parts_[b].joined.push_back(a);
  a = largest_with(a);
  b = largest_with(b);
  if (parts_[a].faces < parts_[b].faces) std::swap(a, b);
  parts_[b].larger = a;
}

std::uint32_t JoinedParts::largest_with(std::uint32_t part) const
{
  while (parts_[part].larger != part) part = parts_[part].larger;
  return part;
}

bool JoinedParts::outsides_are_clear(std::uint32_t a, std::uint32_t b) const
{
  constexpr double least_bulge = 0.3;  // of a ball's: as a cap of 17 degrees to all sides has it
  const Part& one = parts_[largest_with(a)];
  const Part& other = parts_[largest_with(b)];
  return &one != &other && (one.nearly_closed || other.nearly_closed) &&
         std::min(std::abs(one.bulge), std::abs(other.bulge)) > least_bulge &&
         !is_speck(std::min(one.faces, other.faces), std::max(one.faces, other.faces));
}

bool JoinedParts::outsides_agree(std::uint32_t a, std::uint32_t b) const
{
  return !outsides_are_clear(a, b) || bulge_now(parts_[largest_with(a)]) * bulge_now(parts_[largest_with(b)]) > 0;
}

double JoinedParts::bulge_now(const Part& part) const
{
  return complex_.oriented(part.first) == part.corners ? part.bulge : -part.bulge;
}

void JoinedParts::drop_specks()
{
  std::size_t largest = 0;
  for (const Part& part : parts_) largest = std::max(largest, part.faces);
  std::vector<std::uint8_t> dropped(parts_.size());
  for (std::uint32_t start = 0; start < parts_.size(); ++start)
    for (std::uint32_t p = start; parts_[p].joined.size() == 1 && is_speck(parts_[p].faces, largest);) {
      dropped[p] = 1;
      const std::uint32_t next = parts_[p].joined.front();
      parts_[p].joined.clear();
      std::vector<std::uint32_t>& others = parts_[next].joined;
      others.erase(std::find(others.begin(), others.end(), p));
      p = next;
    }
  for (const std::uint32_t f : complex_.faces()) {
    const Triangle t = complex_.oriented(f);
    if (std::any_of(t.begin(), t.end(), [&](std::uint32_t v) { return dropped[part_of_[v]] != 0; })) complex_.remove(f);
  }
}

}  // namespace pds
