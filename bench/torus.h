// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace pds
{

/** \brief Random points of a torus of radii 1 and 0.4, evenly over its area: the outside gets more than the inside. */
inline std::vector<Eigen::Vector3f> torus(std::size_t count)
{
  constexpr float tube = 0.4F;
  constexpr float full_turn = 6.2831853F;
  std::mt19937 random(1);
  std::uniform_real_distribution<float> angle(0.0F, full_turn);
  std::uniform_real_distribution<float> lot(0.0F, 1.0F + tube);
  std::vector<Eigen::Vector3f> points;
  points.reserve(count);
  while (points.size() < count) {
    const float u = angle(random);
    const float v = angle(random);
    const float ring = 1.0F + tube * std::cos(v);
    if (lot(random) <= ring) points.emplace_back(ring * std::cos(u), ring * std::sin(u), tube * std::sin(v));
  }
  return points;
}

}  // namespace pds
