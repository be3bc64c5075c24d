// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "program.h"

#include <pcl_pds_recon/options.h>

#include <cstdint>
#include <string>
#include <vector>

namespace boost::program_options
{
class variables_map;
}

namespace pds
{

enum class Verbosity
{
  quiet,    ///< errors only
  normal,   ///< a progress bar on a terminal, otherwise a line per stage; a summary
  detailed  ///< the options and the seconds of each stage besides
};

/** \brief What the user asked for. */
struct CommandLine
{
  std::vector<std::string> inputs;  ///< one or more; "-": standard input
  std::string output;               ///< "-": standard output, as PLY
  Options options;
  unsigned levels = 1;  ///< meshes of ever fewer vertices
  bool ascii = false;
  bool normals = false;               ///< give the vertices the normals of the mesh
  std::vector<std::uint8_t> classes;  ///< of points to be used; empty: all
  std::string report_file;            ///< empty: none
  std::string html_file;              ///< page with the report; empty: none
  std::string voronoi_file;           ///< empty: none
  std::string config_to_save;         ///< empty: none
  Verbosity verbosity = Verbosity::normal;
  std::string information;  ///< of --help or --version; if not empty, printing it is all there is to do
};

/** \brief The extension that says in which format the mesh is written. */
[[nodiscard]] std::string output_extension(const CommandLine& command_line);

/** \brief Where a level of detail is written: OUTPUT, then OUTPUT with _1, _2, ... before its extension. */
[[nodiscard]] std::string level_path(const std::string& output, unsigned level);

/** \brief Understands the command line and the configuration file that it names; the command line wins.
 * \throws UsageError
 */
[[nodiscard]] CommandLine parse_command_line(int argc, const char* const* argv);

/** \brief Takes over the options of option_table() from these arguments and the configuration file that they name.
 * \throws UsageError
 */
void take_options(const boost::program_options::variables_map& arguments, CommandLine& command_line);

/** \brief A configuration file that makes the same run of any input: every option with its value.
 * \throws UsageError if a file name cannot stand in a configuration file
 */
[[nodiscard]] std::string to_config(const CommandLine& command_line);

}  // namespace pds
