// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "compare/expectation.h"

#include <pcl_pds_recon/deviation.h>

#include <string>
#include <vector>

namespace pds
{

/** \brief What pcl_pds_compare was asked to do. */
struct CompareOptions
{
  std::string mesh;
  std::string reference;  ///< empty: only the certificate of the mesh
  DeviationOptions deviation;
  bool weld = false;                ///< coincident vertices count as one
  bool self_intersections = false;  ///< counted in the certificate
  bool json = false;
  std::string output;   ///< mesh with a field 'deviation'; empty: none
  std::string picture;  ///< PNG; empty: none
  std::vector<Expectation> expectations;
  std::string information;  ///< text to print instead of comparing: help or version
};

/** \throws UsageError */
[[nodiscard]] CompareOptions parse_compare_options(int argc, const char* const* argv);

}  // namespace pds
