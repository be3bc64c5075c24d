// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/las_header.h"

#include <optional>
#include <string_view>

namespace pds
{

inline constexpr const char* las_user = "LASF_Spec";  ///< who has defined the records of the standard itself
inline constexpr std::uint16_t extra_bytes_record_id = 4;

/** \brief Where the content of a variable-length record lies in a LAS file. */
struct LasRecord
{
  std::size_t begin = 0;
  std::size_t bytes = 0;
};

/** \brief Finds a variable-length record between the header and the points (ASPRS LAS 1.4 R15, section 2.5).
 * \param user who has defined it
 * \throws InvalidInput if the records before it reach into the points
 */
[[nodiscard]] std::optional<LasRecord> find_las_record(const ByteSource& source,
                                                       const LasHeader& header,
                                                       std::string_view user,
                                                       std::uint16_t id);

/** \brief Goes through the extended variable-length records, which lie at the end of a file, to see whether it is
 * whole. \throws InvalidInput if they do not fit */
void check_extended_records(const ByteSource& source, const LasHeader& header);

}  // namespace pds
