// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_pds_recon/deviation.h>
#include <pcl_pds_recon/mesh_inspection.h>

#include <nlohmann/json.hpp>

#include <optional>
#include <string>

namespace pds
{

/** \brief What pcl_pds_compare found out. */
struct CompareReport
{
  MeshInspection certificate;
  std::optional<std::size_t> self_intersections;  ///< if asked for
  std::optional<Deviation> deviation;             ///< if there is a reference
};

/** \brief The report as JSON. Keys do not change; what is not known is null. */
[[nodiscard]] nlohmann::ordered_json to_json(const CompareReport& report);

/** \brief The report as a text for people, with a histogram of the signed deviation. */
[[nodiscard]] std::string to_text(const CompareReport& report);

}  // namespace pds
