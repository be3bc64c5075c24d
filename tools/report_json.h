// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_pds_recon/report.h>

#include <string>

namespace pds
{

/** \brief The report as JSON; the keys are the names of the fields of Report and do not change. */
[[nodiscard]] std::string to_json(const Report& report);

}  // namespace pds
