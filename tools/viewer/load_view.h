// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "compare/mesh_file.h"
#include "viewer/viewer_options.h"

#include <pcl_pds_recon/reconstruction.h>

#include <optional>

namespace pds
{

/** \brief The files that a view is made of. */
struct ViewSource
{
  MeshFile input;
  bool is_cloud = false;  ///< the input is to be reconstructed
  std::optional<TriangleMesh> reference;
};

/** \brief Reads the files. \throws InvalidInput with one line that names the file */
[[nodiscard]] ViewSource load_source(const ViewerOptions& options);

/** \brief What there is to see: of a cloud its reconstruction, and the deviation if there is a reference.
 * \throws InvalidInput if the cloud or the reference cannot be used */
[[nodiscard]] ViewData make_view_data(const ViewSource& source, const Options& options, const Progress& progress = {});

}  // namespace pds
