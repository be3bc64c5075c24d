// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pds
{

/** \brief Faces that are joined by edges, and which of them must be turned to agree: union-find with parity.
 *
 * Unions are by size and paths are not compressed: a root is never farther than the logarithm of the number of faces,
 * and unions can be taken back, last first.
 */
class OrientationForest
{
 public:
  /** \brief The face that stands for all that are joined to one. */
  struct Root
  {
    std::uint32_t face;  ///< its number
    bool flipped;        ///< whether the one must be turned to agree with it
  };

  /** \brief Adds faces that are joined to none, or forgets the last ones. */
  void resize(std::size_t count);
  /** \brief Takes back the faces from \a count on and all unions since begin_trial(). */
  void undo(std::size_t count);
  /** \brief Marks the state to which undo() returns. */
  void begin_trial() { undo_.clear(); }

  /** \brief The root of a face. O(log faces). */
  [[nodiscard]] Root root_of(std::uint32_t face) const;
  /** \brief Says that the two faces, as given, disagree or agree; their roots must differ or know that already. */
  void join(std::uint32_t a, std::uint32_t b, bool opposed);

  /** \brief Makes \a face a root, alone. */
  void isolate(std::uint32_t face);
  /** \brief Hangs a face that is alone under a root. */
  void hang(std::uint32_t face, std::uint32_t root, bool flipped);

 private:
  struct Union
  {
    std::uint32_t face;         ///< the root that got a parent
    std::uint32_t parent_size;  ///< faces under the new parent before
  };

  std::vector<std::uint32_t> parent_;
  std::vector<std::uint8_t> flip_;   ///< relative to the parent
  std::vector<std::uint32_t> size_;  ///< faces under a root
  std::vector<Union> undo_;
};

}  // namespace pds
