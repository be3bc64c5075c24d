// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/byte_source.h"
#include "io/las_header.h"

#include <cstdint>
#include <limits>

namespace pds
{

/** \brief The variable-length record that LASzip leaves in the header: how the points are packed. */
struct LaszipRecord
{
  std::uint32_t chunk_size = 0;  ///< points in each chunk but the last
};

/** \brief From this point format on chunks consist of layers, and say how many points they hold. */
inline constexpr std::size_t first_layered_format = 6;

/** \brief A chunk size that says that each chunk has one of its own, in the table of chunks. */
inline constexpr std::uint32_t variable_chunk_size = std::numeric_limits<std::uint32_t>::max();

inline constexpr const char* laszip_user = "laszip encoded";
inline constexpr std::uint16_t laszip_record_id = 22204;

/** \brief Reads the record. \throws InvalidInput if there is none, it is cut short, or describes records of another
 * point format or length than \a header does */
[[nodiscard]] LaszipRecord read_laszip_record(const ByteSource& source, const LasHeader& header);

/** \brief Layers of a chunk, each of which is packed by itself; for the point formats that have them. */
[[nodiscard]] std::size_t laszip_layers(const LasHeader& header);

}  // namespace pds
