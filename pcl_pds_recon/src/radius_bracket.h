// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace pds
{

/** \brief Interval of radii within which the wanted one is, narrowed by what each radius tried has given. */
class RadiusBracket
{
 public:
  void too_small(double radius) { low_ = radius; }
  void too_large(double radius) { high_ = radius; }
  [[nodiscard]] double low() const { return low_; }    ///< the last that was too small, 0 if none
  [[nodiscard]] double high() const { return high_; }  ///< the last that was too large, 0 if none
  [[nodiscard]] bool closed() const { return low_ > 0 && high_ > 0; }
  /** \brief A guess, or what is well inside the bracket if the guess is not. */
  [[nodiscard]] double inside(double guess) const;

 private:
  double low_ = 0, high_ = 0;
};

}  // namespace pds
