// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace pds_test
{

/** \brief Random numbers that are the same with every standard library, unlike std::uniform_real_distribution. */
class Random
{
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /** \brief A number in [0, 1). */
  double uniform()
  {
    constexpr int unused_bits = 11;  // 53 of the 64 bits fill a double
    return std::ldexp(static_cast<double>(engine_() >> unused_bits), -53);
  }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }

  /** \brief A number in 0 ... count - 1. */
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(engine_() % count); }

  /** \brief Standard normal deviate by Box and Muller's method. */
  double normal()
  {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(2.0 * 3.14159265358979323846 * uniform());
  }

  Eigen::Vector3d in_box(double half_side)
  {
    const double x = uniform(-half_side, half_side);
    const double y = uniform(-half_side, half_side);
    const double z = uniform(-half_side, half_side);
    return {x, y, z};
  }

  template <typename T>
  void shuffle(std::vector<T>& values)
  {
    for (std::size_t i = values.size(); i > 1; --i) std::swap(values[i - 1], values[below(i)]);
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace pds_test
