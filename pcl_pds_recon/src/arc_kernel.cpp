// SPDX-License-Identifier: BSD-3-Clause
#include "arc_kernel.h"

#include <cmath>

namespace pds
{
namespace
{

constexpr std::size_t lanes = 16;  // of the widest register

// An arc counts if its chord leaves the tangent planes at its ends by at most this angle (sine squared; 39 degrees). On
// a circle the closed form is then exact to 0.5 percent; on scans it differs from what marching finds by 0.2 percent
// where surfaces are flat and by 3 percent at the largest bend, which is how well marching does there.
constexpr float largest_bend = 0.4F;

// Along an arc the weight is taken to change linearly; where its ends differ by more than this factor, it is no arc.
constexpr float even_weight = 1.25F;

[[gnu::always_inline]] inline std::size_t measure(const SurfaceColumns& columns,
                                                  const ArcQuery& query,
                                                  float* __restrict length,
                                                  std::uint32_t* __restrict within)
{
  const float sx = query.position.x(), sy = query.position.y(), sz = query.position.z();
  const float sa = query.normal.x(), sb = query.normal.y(), sc = query.normal.z();
  const float longest_chord = query.limit / query.least_weight;
  const float squared_reach = longest_chord * longest_chord;
  const float bend = query.arcs_allowed ? largest_bend : -1.0F;
  const float lightest = query.weight / even_weight;
  const float heaviest = query.weight * even_weight;
  std::size_t count = 0;
  for (std::size_t first = 0; first < columns.count; first += lanes) {
    const float* __restrict x = columns.x.data() + first;
    const float* __restrict y = columns.y.data() + first;
    const float* __restrict z = columns.z.data() + first;
    float squared[lanes];
    float nearest = beyond_limit;
#pragma GCC unroll 1
    for (std::size_t i = 0; i < lanes; ++i) {
      const float dx = x[i] - sx, dy = y[i] - sy, dz = z[i] - sz;
      squared[i] = dx * dx + dy * dy + dz * dz;
    }
#pragma GCC unroll 1
    for (std::size_t i = 0; i < lanes; ++i) nearest = squared[i] < nearest ? squared[i] : nearest;
    float* __restrict out = length + first;
    if (nearest > squared_reach) {
      for (std::size_t i = 0; i < lanes; ++i) out[i] = beyond_limit;
      continue;
    }
    const float* __restrict a = columns.normal_x.data() + first;
    const float* __restrict b = columns.normal_y.data() + first;
    const float* __restrict c = columns.normal_z.data() + first;
    const float* __restrict w = columns.weight.data() + first;
#pragma GCC unroll 1
    for (std::size_t i = 0; i < lanes; ++i) {
      const float dx = x[i] - sx, dy = y[i] - sy, dz = z[i] - sz;
      // How far the chord leaves the tangent plane at either end; normals have arbitrary signs.
      const float here = sa * dx + sb * dy + sc * dz;
      const float there = a[i] * dx + b[i] * dy + c[i] * dz;
      const float both = sa * a[i] + sb * b[i] + sc * c[i] < 0 ? -here * there : here * there;
      const float here2 = here * here, there2 = there * there;
      const float chord = std::sqrt(squared[i]);
      // Slopes are angles; to fourth order their squares are the sines' squares times a factor that both ends share.
      const float sine2 = 0.5F * (here2 + there2) / squared[i];
      const float to_angles = 1 + sine2 * (1.0F / 3 + sine2 * (8.0F / 45));
      const float stretch = (2 * here2 - both + 2 * there2) / (30 * squared[i]) * to_angles;
      const float arc = 0.5F * (w[i] + query.weight) * chord * (1 + stretch);
      const bool is_arc = (here2 <= bend * squared[i]) & (there2 <= bend * squared[i]) & (squared[i] > 0) &
                          (w[i] >= lightest) & (w[i] <= heaviest);
      const float within_limit = is_arc ? (arc <= query.limit ? arc : beyond_limit) : no_arc;
      out[i] = squared[i] <= squared_reach ? within_limit : beyond_limit;
    }
    // Without branches: every number is written, and stays if the next place is beyond it.
    for (std::size_t i = 0; i < lanes; ++i) {
      within[count] = static_cast<std::uint32_t>(first + i);
      count += out[i] < beyond_limit ? 1U : 0U;
    }
  }
  return count;
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] std::size_t measure_avx2(const SurfaceColumns& c, const ArcQuery& q, float* l, std::uint32_t* n)
{
  return measure(c, q, l, n);
}

[[gnu::target(PDS_AVX512)]] std::size_t measure_avx512(const SurfaceColumns& c,
                                                       const ArcQuery& q,
                                                       float* l,
                                                       std::uint32_t* n)
{
  return measure(c, q, l, n);
}
#endif

}  // namespace

void SurfaceColumns::resize(std::size_t points)
{
  count = points;
  const std::size_t padded = (points + lanes - 1) / lanes * lanes;
  for (std::vector<float>* column : {&x, &y, &z, &normal_x, &normal_y, &normal_z, &weight})
    if (column->size() < padded) column->resize(padded, 1.0F);
  // What pads the last register is farther away than any point.
  for (std::size_t i = points; i < padded; ++i) x[i] = beyond_limit;
}

void SurfaceColumns::set(std::size_t i, const Eigen::Vector3f& position, const Eigen::Vector3f& normal, float w)
{
  copy(i, &position, &normal, 1);
  weight[i] = w;
}

void SurfaceColumns::copy(std::size_t i,
                          const Eigen::Vector3f* position,
                          const Eigen::Vector3f* normal,
                          std::size_t points)
{
  float* __restrict columns[] = {x.data() + i,        y.data() + i,        z.data() + i,
                                 normal_x.data() + i, normal_y.data() + i, normal_z.data() + i};
  for (std::size_t p = 0; p < points; ++p) {
    columns[0][p] = position[p].x();
    columns[1][p] = position[p].y();
    columns[2][p] = position[p].z();
    columns[3][p] = normal[p].x();
    columns[4][p] = normal[p].y();
    columns[5][p] = normal[p].z();
  }
}

std::size_t measure_arcs(
    InstructionSet set, const SurfaceColumns& columns, const ArcQuery& query, float* length, std::uint32_t* within)
{
#if defined(__x86_64__)
  if (set == InstructionSet::avx512) return measure_avx512(columns, query, length, within);
  if (set == InstructionSet::avx2) return measure_avx2(columns, query, length, within);
#endif
  static_cast<void>(set);
  return measure(columns, query, length, within);
}

}  // namespace pds
