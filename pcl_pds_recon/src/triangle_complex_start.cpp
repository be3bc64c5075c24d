// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/triangle_complex.h>
#include <algorithm>
#include "bucket_sort.h"

namespace pds
{

/** Whatever is offered, what stays keeps the rules: every edge with a third face loses all of them, every vertex with a
 * closed fan and something else loses the closed fan, and a component that is one-sided goes; taking faces away breaks
 * no rule. Nearly all triangles stay, and all but the walk that orients them is done in parallel. */
std::vector<std::uint32_t> TriangleComplex::start(const std::vector<Triangle>& triangles, double smallest_angle)
{
  face_.resize(triangles.size());
  orientation_.resize(triangles.size());
  parallel_.each(face_.size(), block, [&](std::size_t f) { face_[f].corner = triangles[f]; });
  find_neighbors(smallest_angle);
  removed_since_rebuild_ = true;
  rebuild_orientation();
  remove_misfits();
  rebuild_orientation();

  std::vector<std::uint32_t> left_out;
  for (std::uint32_t f = 0; f < face_.size(); ++f)
    if (!face_[f].present) left_out.push_back(f);
  return left_out;
}

/** Only faces that have at most one other at each side, and are not folded onto it, stay present. */
void TriangleComplex::find_neighbors(double smallest_angle)
{
  BucketSort by_vertex(vertex_count());
  parallel_.each(face_.size(), block, [&](std::size_t f) {
    for (const std::uint32_t v : face_[f].corner) by_vertex.count(v);
  });
  const std::vector<std::size_t> begin = by_vertex.begins();
  std::vector<std::uint32_t> around(begin.back());
  parallel_.each(face_.size(), block, [&](std::size_t f) {
    for (const std::uint32_t v : face_[f].corner) around[by_vertex.place(v)] = static_cast<std::uint32_t>(f);
  });

  std::vector<std::uint8_t> fits(face_.size());
  parallel_.each(face_.size(), block, [&](std::size_t f) {
    Face& face = face_[f];
    const Triangle& t = face.corner;
    bool full = false;
    for (std::size_t e = 0; e < 3; ++e)
      for (std::size_t i = begin[t[e]]; i < begin[t[e] + 1]; ++i) {
        const std::uint32_t other = around[i];
        if (other == f || face_[other].corner[corner_of(other, t[(e + 1) % 3])] != t[(e + 1) % 3]) continue;
        full |= face.across[e] != no_face;
        face.across[e] = other;
      }
    fits[f] = !full && !degenerate(t) && !folds(t, face.across, smallest_angle) && !opposed(t, face.across) ? 1 : 0;
  });
  parallel_.each(face_.size(), block, [&](std::size_t f) {
    face_[f].present = fits[f] != 0;
    for (std::uint32_t& other : face_[f].across)
      if (other != no_face && (fits[f] == 0 || fits[other] == 0)) other = no_face;
  });
  parallel_.each(vertex_count(), block, [&](std::size_t v) {
    std::sort(around.begin() + static_cast<std::ptrdiff_t>(begin[v]),
              around.begin() + static_cast<std::ptrdiff_t>(begin[v + 1]));
    for (std::size_t i = begin[v]; i < begin[v + 1]; ++i) {
      const std::uint32_t f = around[i];
      if (fits[f] == 0) continue;
      face_[f].next_at[corner_of(f, static_cast<std::uint32_t>(v))] = first_at_[v];
      first_at_[v] = f;
    }
  });
}

/** Removes closed fans at vertices that have another fan, and components that are one-sided. */
void TriangleComplex::remove_misfits()
{
  const std::vector<std::uint8_t> pinched = find_pinched();
  std::vector<std::uint8_t> misfit(face_.size());
  std::vector<std::uint8_t> contradicts(face_.size());
  parallel_.each(face_.size(), block, [&](std::size_t number) {
    const auto f = static_cast<std::uint32_t>(number);
    if (!face_[f].present) return;
    const Triangle& t = face_[f].corner;
    const bool flipped = orientation_.root_of(f).flipped;
    for (std::size_t e = 0; e < 3; ++e) {
      if (pinched[t[e]] != 0 && fan_closes(t[e], f)) misfit[f] = 1;
      const std::uint32_t other = face_[f].across[e];
      if (other != no_face &&
          (flipped != orientation_.root_of(other).flipped) != runs_along(other, t[e], t[(e + 1) % 3]))
        contradicts[f] = 1;
    }
  });
  std::vector<std::uint8_t> one_sided(face_.size());
  for (std::uint32_t f = 0; f < face_.size(); ++f)
    if (contradicts[f] != 0) one_sided[orientation_.root_of(f).face] = 1;
  for (std::uint32_t f = 0; f < face_.size(); ++f)
    if (face_[f].present && (misfit[f] != 0 || one_sided[orientation_.root_of(f).face] != 0)) remove(f);
}

}  // namespace pds
