// SPDX-License-Identifier: BSD-3-Clause
#include "io/read_points.h"

#include "io/byte_source.h"
#include "io/file_extension.h"
#include "io/obj_reader.h"
#include "io/pcd_reader.h"
#include "io/ply_reader.h"
#include "io/text_reader.h"

#include <pcl_pds_recon/options.h>

namespace pds
{

namespace
{

PointTable read_text_format(const std::string& path, PointTable (*reader)(std::string_view))
{
  return reader(ByteSource::from_file(path).all());
}

PointTable read_by_extension(const std::string& path, const Parallel& parallel)
{
  const std::string extension = file_extension(path);
  if (extension == ".ply") {
    return read_ply(ByteSource::from_file(path), parallel);
  }
  if (extension == ".pcd") {
    return read_pcd(ByteSource::from_file(path), parallel);
  }
  if (extension == ".obj") {
    return read_text_format(path, read_obj);
  }
  if (extension == ".xyz" || extension == ".txt" || extension == ".csv") {
    return read_text_format(path, read_text);
  }
  throw InvalidInput("cannot tell the format by the extension '" + extension +
                     "'; use .pcd, .ply, .obj, .xyz, .txt or .csv");
}

}  // namespace

PointTable read_points(const std::string& path, const Parallel& parallel)
{
  try {
    PointTable table = read_by_extension(path, parallel);
    if (table.size() == 0) {
      throw InvalidInput("holds no points; write the point cloud again");
    }
    return table;
  } catch (const InvalidInput& error) {
    throw InvalidInput(path + ": " + error.what());
  }
}

}  // namespace pds
