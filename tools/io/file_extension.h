// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/algorithm/string/case_conv.hpp>
#include <filesystem>
#include <string>

namespace pds
{

/** \brief The extension with its dot, in lower case. */
[[nodiscard]] inline std::string file_extension(const std::string& path)
{
  return boost::algorithm::to_lower_copy(std::filesystem::path(path).extension().string());
}

}  // namespace pds
