// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "core_testing.h"
#include "io/read_points.h"

namespace pds_test
{

inline std::string path_of(const std::string& file) { return std::string(SCAN_DIRECTORY) + "/" + file; }

inline bool is_absent(const std::string& file) { return !std::filesystem::exists(path_of(file)); }

#define SKIP_IF_ABSENT(file) \
  if (is_absent(file)) GTEST_SKIP() << path_of(file) << " is not there (CMake option PCL_PDS_RECON_SCAN_DIR)"

/** \brief A scan as its file gives it, with normals and sensor if there are any. */
struct Scan
{
  explicit Scan(const std::string& file) : table(pds::read_points(path_of(file), pds::Parallel()))
  {
    const pds::PointCloudView view = table.view();
    for (std::size_t i = 0; i < view.size; ++i) points.push_back(view.positions[i]);
  }

  pds::PointTable table;
  Points points;
};

}  // namespace pds_test
