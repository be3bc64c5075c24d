// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/byte_source.h"

#include <cstdint>
#include <string>

namespace pds
{

/** \brief The content of an E57 file, which is cut into pages with a checksum at the end of each (ASTM E2807, section
 * 6). PDAL compares the checksums.
 */
class E57File
{
 public:
  /** \brief Reads the header. \throws InvalidInput if it is none of an E57 file, or does not fit the file's length */
  explicit E57File(const ByteSource& source);

  /** \brief Copies \a size bytes of the content. \throws InvalidInput if they are not all there */
  void read(std::uint64_t place, void* target, std::size_t size) const;

  /** \brief The place in the content that the file's own references call \a physical. */
  [[nodiscard]] static std::uint64_t logical(std::uint64_t physical);

  /** \brief The description of the scans in XML. \throws InvalidInput if it is not all there */
  [[nodiscard]] std::string description() const;

 private:
  const ByteSource& source_;
  std::uint64_t bytes_ = 0;  ///< of the content
};

}  // namespace pds
