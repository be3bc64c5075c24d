// SPDX-License-Identifier: BSD-3-Clause
#include "io/read_points.h"

#include "io/atomic_file.h"
#include "io/byte_source.h"
#include "io/e57_file.h"
#include "io/file_extension.h"
#include "io/las_reader.h"
#include "io/obj_reader.h"
#include "io/pcd_reader.h"
#include "io/ply_reader.h"
#include "io/text_reader.h"

#include <pcl_pds_recon/options.h>

#include <algorithm>
#include <array>
#include <string_view>

#ifdef PCL_PDS_RECON_WITH_PDAL
#include "io/pdal_reader.h"
#else
#include "io/laz_check.h"
#endif

namespace pds
{

namespace
{

PointTable read_text_format(const std::string& path, PointTable (*reader)(std::string_view))
{
  return reader(ByteSource::from_file(path).all());
}

/** A pipe has no name to tell the format by, but PLY and PCD files say what they are. */
PointTable read_standard_input(const Parallel& parallel)
{
  const ByteSource source = ByteSource::from_standard_input();
  const auto starts_with = [&source](std::string_view word) { return source.head(word.size()) == word; };
  if (starts_with("ply")) {
    return read_ply(source, parallel);
  }
  constexpr std::array<std::string_view, 4> pcd_starts = {"#", "VERSION", "FIELDS", "COLUMNS"};
  if (std::none_of(pcd_starts.begin(), pcd_starts.end(), starts_with)) {
    throw InvalidInput("is neither a PLY nor a PCD; other formats are not read from a pipe but from files");
  }
  return read_pcd(source, parallel);
}

#ifndef PCL_PDS_RECON_WITH_PDAL
[[noreturn]] void throw_without_pdal()
{
  throw InvalidInput("cannot be read in this build without PDAL; convert it to .las or .ply");
}

PointTable read_laz(const std::string& path, const Parallel& /*parallel*/)
{
  check_laz(ByteSource::from_file(path));
  throw_without_pdal();
}

PointTable read_e57(const std::string& /*path*/) { throw_without_pdal(); }
#endif

PointTable read_by_extension(const std::string& path, const Parallel& parallel)
{
  if (path == standard_stream) {
    return read_standard_input(parallel);
  }
  const std::string extension = file_extension(path);
  if (extension == ".ply") {
    return read_ply(ByteSource::from_file(path), parallel);
  }
  if (extension == ".pcd") {
    return read_pcd(ByteSource::from_file(path), parallel);
  }
  if (extension == ".las") {
    return read_las(ByteSource::from_file(path), parallel);
  }
  if (extension == ".laz") {
    return read_laz(path, parallel);
  }
  if (extension == ".e57") {
    static_cast<void>(E57File(ByteSource::from_file(path)));  // says in our words if it is none
    return read_e57(path);
  }
  if (extension == ".obj") {
    return read_text_format(path, read_obj);
  }
  if (extension == ".xyz" || extension == ".txt" || extension == ".csv") {
    return read_text_format(path, read_text);
  }
  if (extension == ".gz") {
    throw InvalidInput("is compressed; unpack it on the way: gunzip -c scan.ply.gz | pcl_pds_recon - out.ply");
  }
  throw InvalidInput("cannot tell the format by the extension '" + extension +
                     "'; use .pcd, .ply, .las, .laz, .e57, .obj, .xyz, .txt or .csv");
}

/** The formats of surveying, in which z is the height; others do not say. */
bool has_z_up(const std::string& extension)
{
  return extension == ".las" || extension == ".laz" || extension == ".e57";
}

}  // namespace

PointTable read_points(const std::string& path, const Parallel& parallel)
{
  try {
    PointTable table = read_by_extension(path, parallel);
    if (table.size() == 0) {
      throw InvalidInput("holds no points; write the point cloud again");
    }
    table.z_is_up = has_z_up(file_extension(path));
    return table;
  } catch (const InvalidInput& error) {
    throw InvalidInput((path == standard_stream ? "standard input" : path) + ": " + error.what());
  }
}

}  // namespace pds
