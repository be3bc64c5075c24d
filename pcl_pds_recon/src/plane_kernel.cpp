// SPDX-License-Identifier: BSD-3-Clause
#include "plane_kernel.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace pds
{
namespace
{

constexpr std::size_t lanes = 8;  // points that are fitted together: doubles in the widest register

// A point is inside the surface if its neighbours' mean is near it. The square is over their mean square from the mean,
// r^2 / 2 for a disk of radius r: at a straight rim the mean is 0.42 r away, so 0.36; of 15 points spread evenly around
// it is below this bound nine times in ten.
constexpr float inside = 0.18F;

/** \brief Points with their own neighbours, as plain pointers. */
struct Neighborhoods
{
  const float* position;            ///< x y z of all points
  std::size_t stride;               ///< neighbours of a full row
  std::uint32_t point[lanes];       ///< the points in the middle
  const std::uint32_t* row[lanes];  ///< their neighbours
  std::size_t count[lanes];         ///< how many these are
};

/** \brief Symmetric matrices, one a lane. */
template <typename Real>
struct SymmetricMatrices
{
  Real xx[lanes], yy[lanes], zz[lanes], xy[lanes], yz[lanes], zx[lanes];
};

struct Planes
{
  double x[lanes], y[lanes], z[lanes];  ///< unit normal
  double variance[lanes];               ///< along it
  /// 0: the points are on a line, or spread alike in all directions; else 1. No bool: GCC 12 makes no vector code of a
  /// loop that writes values narrower than those it reads
  double certain[lanes];
  float
      off_center[lanes];  ///< squared distance of the point from the mean, over the mean square of the others' from it
};

/** \brief Covariances of each point and its neighbours.
 *
 * In single precision, relative to the point itself and to its farthest neighbour: nothing cancels, overflows or
 * vanishes.
 */
[[gnu::always_inline]] inline void add_up(const Neighborhoods& in,
                                          SymmetricMatrices<float>& covariance,
                                          float* __restrict squared_mean)
{
  const float* __restrict p = in.position;
  float x[lanes], y[lanes], z[lanes], scale[lanes], share[lanes];
  for (std::size_t l = 0; l < lanes; ++l) {
    const float* center = p + std::size_t{3} * in.point[l];
    const float* last = p + std::size_t{3} * (in.count[l] > 0 ? in.row[l][in.count[l] - 1] : in.point[l]);
    x[l] = center[0];
    y[l] = center[1];
    z[l] = center[2];
    const float reach = std::max({std::abs(last[0] - x[l]), std::abs(last[1] - y[l]), std::abs(last[2] - z[l])});
    scale[l] = 1.0F / std::max(reach, std::numeric_limits<float>::min());
    share[l] = 1.0F / static_cast<float>(in.count[l] + 1);
  }
  float sx[lanes] = {}, sy[lanes] = {}, sz[lanes] = {};
  SymmetricMatrices<float> sum = {};
  for (std::size_t k = 0; k < in.stride; ++k) {
    float dx[lanes], dy[lanes], dz[lanes];
    for (std::size_t l = 0; l < lanes; ++l) {
      // The point itself stands for neighbours that it lacks: it adds nothing.
      const float* neighbor = p + std::size_t{3} * (k < in.count[l] ? in.row[l][k] : in.point[l]);
      dx[l] = neighbor[0];
      dy[l] = neighbor[1];
      dz[l] = neighbor[2];
    }
    for (std::size_t l = 0; l < lanes; ++l) {
      dx[l] = (dx[l] - x[l]) * scale[l];
      dy[l] = (dy[l] - y[l]) * scale[l];
      dz[l] = (dz[l] - z[l]) * scale[l];
      sx[l] += dx[l];
      sy[l] += dy[l];
      sz[l] += dz[l];
      sum.xx[l] += dx[l] * dx[l];
      sum.yy[l] += dy[l] * dy[l];
      sum.zz[l] += dz[l] * dz[l];
      sum.xy[l] += dx[l] * dy[l];
      sum.yz[l] += dy[l] * dz[l];
      sum.zx[l] += dz[l] * dx[l];
    }
  }
  for (std::size_t l = 0; l < lanes; ++l) {
    const float mx = sx[l] * share[l], my = sy[l] * share[l], mz = sz[l] * share[l];
    covariance.xx[l] = sum.xx[l] * share[l] - mx * mx;
    covariance.yy[l] = sum.yy[l] * share[l] - my * my;
    covariance.zz[l] = sum.zz[l] * share[l] - mz * mz;
    covariance.xy[l] = sum.xy[l] * share[l] - mx * my;
    covariance.yz[l] = sum.yz[l] * share[l] - my * mz;
    covariance.zx[l] = sum.zx[l] * share[l] - mz * mx;
    squared_mean[l] = mx * mx + my * my + mz * mz;
  }
}

/** \brief cos(2/3 acos(t)) for t in 0 ... 1, to 1e-10.
 *
 * Interpolated at the Chebyshev nodes. The function is analytic there, unlike cos(1/3 acos(t)), so few terms do; and
 * additions and multiplications give the same bits everywhere, unlike the C library's cos and acos.
 */
[[gnu::always_inline]] inline double cosine_of_two_thirds(double t)
{
  constexpr double c[] = {0.500000000081,    0.5773502495,     -0.111110309759,   0.0534454429579,
                          -0.032813031821,   0.0223199112377,  -0.0152799917807,  0.00937813545401,
                          -0.00448529836202, 0.00140248908825, -0.000207596641055};
  double value = c[10];
  for (int i = 9; i >= 0; --i) value = value * t + c[i];
  return value;
}

/** \brief Smallest root of the characteristic polynomial, by Viete's trigonometric formula. */
[[gnu::always_inline]] inline double smallest_eigenvalue(
    double xx, double yy, double zz, double xy, double yz, double zx)
{
  const double mean = (xx + yy + zz) / 3;
  const double dx = xx - mean, dy = yy - mean, dz = zz - mean;
  const double xy2 = xy * xy, yz2 = yz * yz, zx2 = zx * zx;
  const double square = (dx * dx + dy * dy + dz * dz + 2 * (xy2 + yz2 + zx2)) / 6;
  const double spread = std::sqrt(square);
  const double half_determinant = 0.5 * (dx * (dy * dz - yz2) - xy2 * dz - zx2 * dy) + xy * yz * zx;
  // The two greater roots coincide at a cosine of -1, the two smaller ones at 1.
  const double ratio = half_determinant / (square > 0 ? square * spread : 1.0);
  const double cosine = ratio < -1 ? -1 : (ratio > 1 ? 1 : ratio);
  const double root = mean - 2 * spread * cosine_of_two_thirds(std::sqrt(0.5 * (1 - cosine)));
  return root > 0 ? root : 0.0;
}

/** \brief Normals from covariances, of which the least variance is taken off the diagonals. */
[[gnu::always_inline]] inline void find_normals(SymmetricMatrices<double>& a, Planes& planes)
{
  constexpr double half_precision = 1e-8;  // below it rounding turns a cross product out of its plane
  for (std::size_t l = 0; l < lanes; ++l) {
    const double xy = a.xy[l], yz = a.yz[l], zx = a.zx[l];
    const double least = smallest_eigenvalue(a.xx[l], a.yy[l], a.zz[l], xy, yz, zx);
    const double xx = a.xx[l] - least, yy = a.yy[l] - least, zz = a.zz[l] - least;
    // Cross products of two rows are along the normal. They are rows of a symmetric matrix of rank one, so the largest
    // has the largest entry on the diagonal; it has suffered least from cancellation.
    const double cxx = yy * zz - yz * yz, cyy = zz * xx - zx * zx, czz = xx * yy - xy * xy;
    const double cxy = yz * zx - xy * zz, cyz = zx * xy - yz * xx, czx = xy * yz - zx * yy;
    const bool second = std::abs(cyy) > std::abs(cxx);
    const double x = second ? cxy : cxx, y = second ? cyy : cxy, z = second ? cyz : czx;
    const bool third = std::abs(czz) > (second ? std::abs(cyy) : std::abs(cxx));
    const double nx = third ? czx : x, ny = third ? cyz : y, nz = third ? czz : z;
    const double length = std::sqrt(nx * nx + ny * ny + nz * nz);
    const double squares = xx * xx + yy * yy + zz * zz + 2 * (xy * xy + yz * yz + zx * zx);
    const bool certain = length > half_precision * squares;
    const double divisor = certain ? length : 1.0;
    planes.x[l] = nx / divisor;
    planes.y[l] = ny / divisor;
    planes.z[l] = nz / divisor;
    planes.variance[l] = least;
    planes.certain[l] = certain ? 1.0 : 0.0;
    a.xx[l] = xx;
    a.yy[l] = yy;
    a.zz[l] = zz;
  }
}

/** \brief Any direction across the line that is left of a covariance, or any at all. */
Eigen::Vector3d any_direction_across(const SymmetricMatrices<double>& a, std::size_t lane)
{
  const Eigen::Vector3d rows[] = {
      {a.xx[lane], a.xy[lane], a.zx[lane]}, {a.xy[lane], a.yy[lane], a.yz[lane]}, {a.zx[lane], a.yz[lane], a.zz[lane]}};
  const Eigen::Vector3d line =
      *std::max_element(rows, rows + 3, [](const auto& r, const auto& s) { return r.squaredNorm() < s.squaredNorm(); });
  return line.squaredNorm() > 0 ? line.unitOrthogonal() : Eigen::Vector3d::UnitX();
}

[[gnu::always_inline]] inline void fit(const Neighborhoods& in,
                                       SymmetricMatrices<double>& rest,
                                       Planes& planes,
                                       float* __restrict curvature)
{
  SymmetricMatrices<float> covariance;
  add_up(in, covariance, planes.off_center);
  double trace[lanes];
  for (std::size_t l = 0; l < lanes; ++l) {
    rest.xx[l] = static_cast<double>(covariance.xx[l]);
    rest.yy[l] = static_cast<double>(covariance.yy[l]);
    rest.zz[l] = static_cast<double>(covariance.zz[l]);
    rest.xy[l] = static_cast<double>(covariance.xy[l]);
    rest.yz[l] = static_cast<double>(covariance.yz[l]);
    rest.zx[l] = static_cast<double>(covariance.zx[l]);
    trace[l] = rest.xx[l] + rest.yy[l] + rest.zz[l];
  }
  find_normals(rest, planes);
  for (std::size_t l = 0; l < lanes; ++l) {
    const double spread = trace[l] > 0 ? trace[l] : 1.0;
    curvature[l] = static_cast<float>(std::sqrt(planes.variance[l] / spread));
    planes.off_center[l] /= static_cast<float>(spread);
  }
}

using Fit = void (*)(const Neighborhoods&, SymmetricMatrices<double>&, Planes&, float*);

void fit_baseline(const Neighborhoods& n, SymmetricMatrices<double>& r, Planes& p, float* c) { fit(n, r, p, c); }

#if defined(__x86_64__)
[[gnu::target("avx2")]] void fit_avx2(const Neighborhoods& n, SymmetricMatrices<double>& r, Planes& p, float* c)
{
  fit(n, r, p, c);
}

[[gnu::target(PDS_AVX512)]] void fit_avx512(const Neighborhoods& n, SymmetricMatrices<double>& r, Planes& p, float* c)
{
  fit(n, r, p, c);
}
#endif

Fit kernel_for(InstructionSet set)
{
#if defined(__x86_64__)
  if (set == InstructionSet::avx512) return fit_avx512;
  if (set == InstructionSet::avx2) return fit_avx2;
#endif
  static_cast<void>(set);
  return fit_baseline;
}

}  // namespace

void fit_planes(InstructionSet set,
                const OrderedPoints& points,
                const NeighborGraph& graph,
                std::size_t begin,
                std::size_t end,
                SurfaceEstimate& surface)
{
  const Fit fit_lanes = kernel_for(set);
  Neighborhoods in{points.position.data()->data(), graph.stride, {}, {}, {}};
  SymmetricMatrices<double> rest;
  Planes planes;
  float curvature[lanes];
  for (std::size_t first = begin; first < end; first += lanes) {
    for (std::size_t l = 0; l < lanes; ++l) {
      const std::size_t i = std::min(first + l, end - 1);
      in.point[l] = static_cast<std::uint32_t>(i);
      in.row[l] = graph.nearest(i).begin();
      in.count[l] = graph.nearest(i).size();
    }
    fit_lanes(in, rest, planes, curvature);
    for (std::size_t l = 0; l < lanes && first + l < end; ++l) {
      Eigen::Vector3d normal(planes.x[l], planes.y[l], planes.z[l]);
      if (planes.certain[l] == 0) normal = any_direction_across(rest, l);
      const bool surface_here = in.count[l] >= 2;
      surface.normal[first + l] = surface_here ? normal.cast<float>() : Eigen::Vector3f(0, 0, 0);
      surface.curvature[first + l] = surface_here ? curvature[l] : 0.0F;
      surface.inside[first + l] = surface_here && planes.off_center[l] <= inside ? 1 : 0;
    }
  }
}

}  // namespace pds
