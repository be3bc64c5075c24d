// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <random>

namespace pds
{

/** \brief Random numbers that are the same on every platform, unlike those of the standard distributions. */
class NoiseSource
{
 public:
  explicit NoiseSource(std::uint64_t seed) : engine_(seed) {}

  /** \brief Uniform in [0, 1). */
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

  /** \brief Standard normal deviate: twelve uniform ones add up to variance 1 and to nearly a Gaussian within three
   * standard deviations. */
  double operator()()
  {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) {
      sum += uniform();
    }
    return sum;
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace pds
