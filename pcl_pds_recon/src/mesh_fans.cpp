// SPDX-License-Identifier: BSD-3-Clause
#include "mesh_fans.h"

#include <algorithm>
#include "bucket_sort.h"

namespace pds
{

MeshFans::MeshFans(const std::vector<Triangle>& triangles,
                   std::size_t vertex_count,
                   const Parallel& parallel,
                   std::size_t spare)
{
  constexpr std::size_t block = 4096;
  BucketSort by_vertex(vertex_count);
  parallel.each(vertex_count, block, [&](std::size_t v) { by_vertex.count(v, static_cast<std::uint32_t>(spare)); });
  parallel.each(triangles.size(), block, [&](std::size_t f) {
    for (const std::uint32_t v : triangles[f]) by_vertex.count(v);
  });
  begin_ = by_vertex.begins();
  end_.resize(vertex_count);
  face_.resize(begin_.back());
  parallel.each(triangles.size(), block, [&](std::size_t f) {
    for (const std::uint32_t v : triangles[f]) face_[by_vertex.place(v)] = static_cast<std::uint32_t>(f);
  });
  parallel.each(vertex_count, block, [&](std::size_t v) {
    end_[v] = begin_[v + 1] - spare;
    std::sort(face_.begin() + static_cast<std::ptrdiff_t>(begin_[v]),
              face_.begin() + static_cast<std::ptrdiff_t>(end_[v]));
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

void MeshFans::flip(const std::array<std::uint32_t, 2>& face,
                    const std::array<std::uint32_t, 4>& corner,
                    std::vector<Triangle>& triangles)
{
  const auto [first, second] = face;
  const auto [a, b, c, d] = corner;
  const auto side_from = [&](std::uint32_t f, std::uint32_t v) { return corner_of(triangles[f], v); };
  const std::uint32_t beyond_bc = across_[first][side_from(first, b)];
  const std::uint32_t beyond_ca = across_[first][side_from(first, c)];
  const std::uint32_t beyond_ad = across_[second][side_from(second, a)];
  const std::uint32_t beyond_db = across_[second][side_from(second, d)];
  // Seen from beyond, a side runs the other way.
  if (beyond_ca != TriangleComplex::no_face) across_[beyond_ca][side_from(beyond_ca, a)] = second;
  if (beyond_db != TriangleComplex::no_face) across_[beyond_db][side_from(beyond_db, b)] = first;
  triangles[first] = {c, d, b};
  triangles[second] = {d, c, a};
  across_[first] = {second, beyond_db, beyond_bc};
  across_[second] = {first, beyond_ca, beyond_ad};
  erase(a, first);
  erase(b, second);
  insert(c, second);
  insert(d, first);
}

void MeshFans::insert(std::uint32_t vertex, std::uint32_t face)
{
  std::uint32_t* const last = face_.data() + end_[vertex]++;
  std::uint32_t* const place = std::lower_bound(face_.data() + begin_[vertex], last, face);
  std::copy_backward(place, last, last + 1);
  *place = face;
}

void MeshFans::erase(std::uint32_t vertex, std::uint32_t face)
{
  std::uint32_t* const last = face_.data() + end_[vertex]--;
  std::uint32_t* const place = std::lower_bound(face_.data() + begin_[vertex], last, face);
  std::copy(place + 1, last, place);
}

}  // namespace pds
