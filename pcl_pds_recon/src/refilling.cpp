// SPDX-License-Identifier: BSD-3-Clause
#include "refilling.h"

#include <algorithm>
#include <iterator>

namespace pds
{
namespace
{

constexpr int widenings = 3;  // of a cut that leaves pinched vertices

/** \brief A complex from which faces are taken out. */
class Refilling
{
 public:
  explicit Refilling(TriangleComplex& complex) : complex_(complex) {}

  bool around(const Polygon& vertices, const BorderingCells& bordering, const FillLimits& limits)
  {
    std::vector<std::uint32_t> pinched = vertices;
    for (int widening = 0; widening < widenings && !pinched.empty(); ++widening) {
      for (const std::uint32_t v : pinched) take_faces_at(v);
      pinched = pinched_vertices();
    }
    if (!pinched.empty()) return false;
    complex_.rebuild_orientation();
    return std::all_of(rim_.begin(), rim_.end(), [&](std::uint32_t v) {
      return !is_on_rim(v) || fill_polygon(complex_, bordering, loop_through(complex_, v), limits);
    });
  }

 private:
  void take_faces_at(std::uint32_t vertex)
  {
    std::vector<std::uint32_t> around;  // a copy: the faces are about to go
    for (const std::uint32_t f : complex_.faces_at(vertex)) around.push_back(f);
    std::sort(around.begin(), around.end());
    for (const std::uint32_t f : around) {
      const Triangle t = complex_.oriented(f);
      rim_.insert(rim_.end(), t.begin(), t.end());
      complex_.remove(f);
    }
    std::sort(rim_.begin(), rim_.end());
    rim_.erase(std::unique(rim_.begin(), rim_.end()), rim_.end());
  }

  [[nodiscard]] std::vector<std::uint32_t> pinched_vertices() const
  {
    std::vector<std::uint32_t> pinched;
    std::copy_if(rim_.begin(), rim_.end(), std::back_inserter(pinched),
                 [this](std::uint32_t v) { return complex_.is_pinched(v); });
    return pinched;
  }

  [[nodiscard]] bool is_on_rim(std::uint32_t vertex) const
  {
    for (const std::uint32_t f : complex_.faces_at(vertex))
      for (const std::uint32_t other : complex_.oriented(f))
        if (other != vertex && complex_.face_count(vertex, other) == 1) return true;
    return false;
  }

  TriangleComplex& complex_;
  std::vector<std::uint32_t> rim_;  ///< corners of the faces taken out, ascending
};

}  // namespace

bool refill_around(TriangleComplex& complex,
                   const Polygon& vertices,
                   const BorderingCells& bordering,
                   const FillLimits& limits)
{
  return Refilling(complex).around(vertices, bordering, limits);
}

}  // namespace pds
