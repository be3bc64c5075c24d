// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/ply_reader.h"
#include "reader_testing.h"

#include <algorithm>

namespace pds
{

inline PointTable read_ply(const std::string& file) { return read_ply(ByteSource(file), Parallel(2)); }

inline std::string header(const std::string& format, const std::string& count, const std::string& properties)
{
  return "ply\nformat " + format + " 1.0\ncomment made by hand\nelement vertex " + count + "\n" + properties +
         "end_header\n";
}

inline const std::string xyz_float = "property float x\nproperty float y\nproperty float z\n";
inline const std::string xyz_double = "property double x\nproperty double y\nproperty double z\n";

inline std::string big_endian(std::string bytes)
{
  std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

}  // namespace pds
