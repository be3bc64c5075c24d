// SPDX-License-Identifier: BSD-3-Clause
#include "mesh_fans.h"

#include <algorithm>
#include "bucket_sort.h"

namespace pds
{

MeshFans::MeshFans(const std::vector<Triangle>& triangles, std::size_t vertex_count, const Parallel& parallel)
{
  constexpr std::size_t block = 4096;
  BucketSort by_vertex(vertex_count);
  parallel.each(triangles.size(), block, [&](std::size_t f) {
    for (const std::uint32_t v : triangles[f]) by_vertex.count(v);
  });
  begin_ = by_vertex.begins();
  face_.resize(3 * triangles.size());
  parallel.each(triangles.size(), block, [&](std::size_t f) {
    for (const std::uint32_t v : triangles[f]) face_[by_vertex.place(v)] = static_cast<std::uint32_t>(f);
  });
  parallel.each(vertex_count, block, [&](std::size_t v) {
    std::sort(face_.begin() + static_cast<std::ptrdiff_t>(begin_[v]),
              face_.begin() + static_cast<std::ptrdiff_t>(begin_[v + 1]));
  });
  across_.assign(triangles.size(), {TriangleComplex::no_face, TriangleComplex::no_face, TriangleComplex::no_face});
  parallel.each(triangles.size(), block, [&](std::size_t f) {
    for (std::size_t side = 0; side < 3; ++side) {
      const std::uint32_t from = triangles[f][side];
      const std::uint32_t to = triangles[f][(side + 1) % 3];
      for (const std::uint32_t* g = begin(to); g != end(to); ++g)
        if (triangles[*g][(corner_of(triangles[*g], to) + 1) % 3] == from) across_[f][side] = *g;
    }
  });
}

}  // namespace pds
