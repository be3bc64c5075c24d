// SPDX-License-Identifier: BSD-3-Clause
#include "face_kernel.h"

namespace pds
{
namespace
{

[[gnu::always_inline]] inline void find(
    const std::uint32_t* begin, const std::uint32_t* end, const FacePlane* plane, double limit, FacedPoints& points)
{
  const std::size_t count = static_cast<std::size_t>(end - begin);
  double distance2[face_lanes];
  std::uint64_t nearest[face_lanes];
  for (std::size_t l = 0; l < face_lanes; ++l) {
    distance2[l] = limit;
    nearest[l] = count;
  }
#pragma GCC unroll 1
  for (std::size_t f = 0; f < count; ++f) {
    const FacePlane face = plane[begin[f]];
    double here[face_lanes];
#pragma GCC unroll 1
    for (std::size_t l = 0; l < face_lanes; ++l) here[l] = face.distance2(points.x[l], points.y[l], points.z[l]);
#pragma GCC unroll 1
    for (std::size_t l = 0; l < face_lanes; ++l) {
      nearest[l] = here[l] < distance2[l] ? f : nearest[l];
      distance2[l] = here[l] < distance2[l] ? here[l] : distance2[l];
    }
  }
  for (std::size_t l = 0; l < face_lanes; ++l) {
    points.distance2[l] = distance2[l];
    points.nearest[l] = nearest[l];
  }
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void find_avx2(
    const std::uint32_t* begin, const std::uint32_t* end, const FacePlane* plane, double limit, FacedPoints& points)
{
  find(begin, end, plane, limit, points);
}

[[gnu::target(PDS_AVX512)]] void find_avx512(
    const std::uint32_t* begin, const std::uint32_t* end, const FacePlane* plane, double limit, FacedPoints& points)
{
  find(begin, end, plane, limit, points);
}
#endif

}  // namespace

void find_nearest_faces(InstructionSet set,
                        const std::uint32_t* begin,
                        const std::uint32_t* end,
                        const std::vector<FacePlane>& plane,
                        double limit,
                        FacedPoints& points)
{
#if defined(__x86_64__)
  if (set == InstructionSet::avx512) return find_avx512(begin, end, plane.data(), limit, points);
  if (set == InstructionSet::avx2) return find_avx2(begin, end, plane.data(), limit, points);
#endif
  static_cast<void>(set);
  find(begin, end, plane.data(), limit, points);
}

}  // namespace pds
