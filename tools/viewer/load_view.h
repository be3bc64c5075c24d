// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "compare/mesh_file.h"
#include "viewer/viewer_options.h"

#include <pcl_pds_recon/reconstruction.h>

#include <optional>
#include <string>
#include <vector>

namespace pds
{

/** \brief The files that a view is made of. */
struct ViewSource
{
  std::optional<PointTable> cloud;  ///< all clouds, merged
  std::vector<MeshFile> meshes;
  std::vector<std::string> mesh_names;    ///< of their files
  std::optional<TriangleMesh> reference;  ///< the deviation from it is shown
  std::string reference_name;
  std::vector<std::string> warnings;  ///< sentences about what is not used of the files

  /** \brief A cloud alone is reconstructed; one with meshes shows what they were made of. */
  [[nodiscard]] bool is_reconstructed() const { return cloud && meshes.empty(); }
};

/** \brief Reads the files. \throws InvalidInput with one line that names the file */
[[nodiscard]] ViewSource load_source(const ViewerOptions& options);

/** \brief What there is to see before any work. */
[[nodiscard]] ViewData make_cloud_data(const ViewSource& source);

/** \brief All that there is to see: of a cloud alone its reconstruction; several meshes beside each other, or with a
 * cloud where they are; the deviation if there is a reference.
 * \param source must outlive the result
 * \throws InvalidInput if the cloud or the reference cannot be used */
[[nodiscard]] ViewData make_view_data(const ViewSource& source, const Options& options, const Progress& progress = {});

}  // namespace pds
