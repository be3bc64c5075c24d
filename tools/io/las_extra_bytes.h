// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/las_header.h"
#include "io/record_reader.h"

#include <vector>

namespace pds
{

/** \brief A scalar in the bytes that a writer has appended to each record. */
struct ExtraScalar
{
  Column column;
  double scale = 1;   ///< value = scale * number + offset
  double offset = 0;  ///< see scale
  bool is_scaled = false;
};

/** \brief What the bytes beyond the standard ones of a record hold. */
struct ExtraBytes
{
  std::vector<ExtraScalar> scalars;
  bool is_complete = true;  ///< false: some are arrays, or nothing is said about them
};

/** \brief Reads the descriptions of the extra bytes (ASPRS LAS 1.4 R15, section 2.9.3, table 24). Names are in snake
 * case and differ from each other and from \a taken.
 * \throws InvalidInput if the variable-length records are cut short
 */
[[nodiscard]] ExtraBytes read_extra_bytes(const ByteSource& source,
                                          const LasHeader& header,
                                          std::vector<std::string> taken);

}  // namespace pds
