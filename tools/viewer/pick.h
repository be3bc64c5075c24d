// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "viewer/load_view.h"

namespace pds
{

/** \brief What was found at a place. */
struct Pick
{
  Eigen::Vector3d place;
  std::string text;  ///< its index, Voronoi cell, deviation and the fields that it has in its file
};

/** \brief The vertex of the mesh nearest to a place. There must be one. */
[[nodiscard]] Pick pick_vertex(const ViewSource& source, const ViewData& data, const Eigen::Vector3d& place);

/** \brief Likewise the point of the cloud. */
[[nodiscard]] Pick pick_point(const ViewSource& source, const ViewData& data, const Eigen::Vector3d& place);

}  // namespace pds
