// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/point_table.h"

#include <pcl_pds_recon/parallel.h>

#include <cstdint>
#include <string>
#include <vector>

namespace pds
{

/** \brief Reads the points of a LAZ file (COPC is one too) with PDAL: all fields, named as read_las names them.
 * Colours become bytes if that loses nothing.
 *
 * PDAL works in a process of its own, since damaged files make it crash.
 * \throws InvalidInput if the file is damaged or the plugin is not installed
 */
[[nodiscard]] PointTable read_laz(const std::string& path, const Parallel& parallel);

/** \brief Reads an E57 file likewise; the names are PDAL's in snake case, but NormalX is nx. */
[[nodiscard]] PointTable read_e57(const std::string& path);

/** \brief What takes the points that the plugin reads. */
class PointSink
{
 public:
  virtual ~PointSink() = default;

  /** \brief Called once, before the points. \param not_read see PointTable::not_read */
  virtual void start(const std::vector<Field>& fields, std::size_t size, const std::string& not_read) = 0;

  /** \brief Takes the first \a count rows of \a block, which has the fields of start(). */
  virtual void add(const PointTable& block, std::size_t count) = 0;
};

/** \brief What PDAL is to read. */
struct PdalSource
{
  std::string path;
  std::string driver;       ///< PDAL's name of the format's reader
  std::uint64_t first = 0;  ///< the point with which to begin; of LAZ only
};

/** \brief The plugin's function.
 * \param complaint what goes wrong before the sink is started, since no exception may leave a plugin */
extern "C" void pcl_pds_recon_read_with_pdal(const PdalSource& source, PointSink& sink, std::string& complaint);

}  // namespace pds
