// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <pcl_pds_recon/triangle_complex.h>

namespace pds
{

/** \brief The components of a complex, its parts, as they were before any were joined, and which have been since. */
class JoinedParts
{
 public:
  explicit JoinedParts(TriangleComplex& complex);

  /** \brief The part that a vertex with a face is in. */
  [[nodiscard]] std::uint32_t part_of(std::uint32_t vertex) const { return part_of_[vertex]; }
  /** \brief Says that two parts that did not hang together do now. */
  void hang_together(std::uint32_t a, std::uint32_t b);

  /** \brief True if it is clear to which side two parts, or the largest ones that they hang together with, bulge, and
   * that this is their outside. */
  [[nodiscard]] bool outsides_are_clear(std::uint32_t a, std::uint32_t b) const;
  /** \brief False if these are clear, but as the complex is now one surface of the outside of one and the inside of
   * the other. */
  [[nodiscard]] bool outsides_agree(std::uint32_t a, std::uint32_t b) const;

  /** \brief Takes the specks out again by which nothing else hangs together, one after another. */
  void drop_specks();

 private:
  struct Part
  {
    std::size_t faces;
    std::uint32_t first;  ///< of its faces ...
    Triangle corners;     ///< ... as they ran at first ...
    double bulge;         ///< ... and how much the part bulges to the side it faces so
    bool nearly_closed;
    std::uint32_t larger;               ///< one that it hangs together with; itself if none is
    std::vector<std::uint32_t> joined;  ///< to these others, which form no ring
  };

  [[nodiscard]] std::uint32_t largest_with(std::uint32_t part) const;
  [[nodiscard]] double bulge_now(const Part& part) const;

  TriangleComplex& complex_;
  std::vector<Part> parts_;
  std::vector<std::uint32_t> part_of_;  ///< by vertex
};

}  // namespace pds
