// SPDX-License-Identifier: BSD-3-Clause
#include "compare/surface_samples.h"

#include <algorithm>
#include <cmath>

namespace pds
{
namespace
{

constexpr std::size_t block = 4096;  // samples; well over the cost of a thread
// Its multiples fill the circle more evenly than those of any other number; the whole turns do not matter.
constexpr double golden_ratio = 0.61803398874989484820;

/** \brief The \a i-th number in 0 ... 1 of a stream that needs no state (SplitMix64, Steele et al. 2014). */
double uniform(std::uint64_t seed, std::uint64_t i)
{
  std::uint64_t z = seed + (i + 1) * 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  z ^= z >> 31;
  return static_cast<double>(z >> 11) * 0x1p-53;
}

/** \brief A place in a triangle, uniform if \a u and \a v are. */
Eigen::Vector3d place(const TriangleMesh& mesh, const Triangle& face, double u, double v)
{
  const double away = std::sqrt(u);  // from the first corner
  return (1 - away) * mesh.vertices[face[0]] + away * (1 - v) * mesh.vertices[face[1]] +
         away * v * mesh.vertices[face[2]];
}

}  // namespace

std::vector<SurfaceSample> sample_surface(const TriangleMesh& mesh,
                                          std::size_t count,
                                          std::uint64_t seed,
                                          const Parallel& parallel)
{
  std::vector<double> end(mesh.faces.size());  // of each face on the line
  double area = 0;
  for (std::size_t f = 0; f < end.size(); ++f) end[f] = area += area_normal(mesh, mesh.faces[f]).norm();
  const double shift = uniform(seed, count);
  std::vector<SurfaceSample> samples(count);
  parallel.each(count, block, [&](std::size_t i) {
    const double at = (static_cast<double>(i) + uniform(seed, i)) / static_cast<double>(count) * area;
    auto face = std::upper_bound(end.begin(), end.end(), at);
    if (face == end.end()) face = std::lower_bound(end.begin(), end.end(), area);  // rounded up to the very end
    const double begin = face == end.begin() ? 0 : face[-1];
    const double u = std::clamp((at - begin) / (*face - begin), 0.0, 1.0);
    const double turns = static_cast<double>(i) * golden_ratio + shift;
    const auto f = static_cast<std::uint32_t>(face - end.begin());
    samples[i] = {place(mesh, mesh.faces[f], u, turns - std::floor(turns)), f};
  });
  return samples;
}

}  // namespace pds
