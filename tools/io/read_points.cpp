// SPDX-License-Identifier: BSD-3-Clause
#include "io/read_points.h"

#include "io/file_extension.h"
#include "io/obj_reader.h"
#include "io/pcd_reader.h"
#include "io/ply_reader.h"
#include "io/text_reader.h"

#include <pcl_pds_recon/options.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace pds
{

namespace
{

std::string read_file(const std::string& path)
{
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) {
    throw InvalidInput("there is no such file; check the path");
  }
  if (!std::filesystem::is_regular_file(status)) {
    throw InvalidInput("is not a file but a directory or device; name a file");
  }
  std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    throw InvalidInput(std::string("cannot be opened (") + std::strerror(errno) + "); check its permissions");
  }
  std::string bytes(static_cast<std::size_t>(std::filesystem::file_size(path)), '\0');
  if (!stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()))) {
    throw InvalidInput(std::string("cannot be read to its end (") + std::strerror(errno) + "); check the disk");
  }
  if (bytes.empty()) {
    throw InvalidInput("the file is empty; write the point cloud again");
  }
  return bytes;
}

PointTable read_by_extension(const std::string& path)
{
  const std::string extension = file_extension(path);
  using Reader = PointTable (*)(std::string_view);
  Reader reader = nullptr;
  if (extension == ".ply") {
    reader = read_ply;
  } else if (extension == ".obj") {
    reader = read_obj;
  } else if (extension == ".xyz" || extension == ".txt" || extension == ".csv") {
    reader = read_text;
  } else if (extension != ".pcd") {
    throw InvalidInput("cannot tell the format by the extension '" + extension +
                       "'; use .pcd, .ply, .obj, .xyz, .txt or .csv");
  }
  const std::string bytes = read_file(path);
  return reader ? reader(bytes) : read_pcd(path, bytes);
}

}  // namespace

PointTable read_points(const std::string& path)
{
  try {
    PointTable table = read_by_extension(path);
    if (table.size() == 0) {
      throw InvalidInput("holds no points; write the point cloud again");
    }
    return table;
  } catch (const InvalidInput& error) {
    throw InvalidInput(path + ": " + error.what());
  }
}

}  // namespace pds
