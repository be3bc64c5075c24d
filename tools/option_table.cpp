// SPDX-License-Identifier: BSD-3-Clause
#include "option_table.h"

#include "io/text_scanner.h"
#include "io/write_mesh.h"

#include <algorithm>
#include <boost/algorithm/string/classification.hpp>
#include <boost/algorithm/string/split.hpp>
#include <charconv>
#include <cmath>
#include <type_traits>
#include <utility>

namespace pds
{

namespace
{

template <typename Number>
std::string print_number(Number number)
{
  constexpr std::size_t longest_number = 32;
  char digits[longest_number];
  return std::string(digits, std::to_chars(digits, digits + longest_number, number).ptr);
}

template <typename Number>
OptionRow number(std::string name, char letter, std::string argument, std::string help, Number Options::*member)
{
  const auto set = [member](CommandLine& command_line, const std::string& text) {
    Number& value = command_line.options.*member;
    if (!parse_number(text, value)) {
      return false;
    }
    if constexpr (std::is_floating_point_v<Number>) {
      return std::isfinite(value);
    }
    return true;
  };
  const auto get = [member](const CommandLine& command_line) { return print_number(command_line.options.*member); };
  help += " (default " + get(CommandLine()) + ")";
  return {std::move(name), letter, std::move(argument), std::move(help), set, get};
}

OptionRow file(
    std::string name, std::string argument, std::string help, std::string CommandLine::*member, bool is_saved)
{
  const auto set = [member](CommandLine& command_line, const std::string& text) {
    command_line.*member = text;
    return !text.empty();
  };
  std::function<std::string(const CommandLine&)> get;
  if (is_saved) {
    get = [member](const CommandLine& command_line) { return command_line.*member; };
  }
  return {std::move(name), 0, std::move(argument), std::move(help), set, get};
}

bool parse_switch(const std::string& text, bool& value)
{
  value = text == "true";
  return value || text == "false";
}

OptionRow verbosity(std::string name, std::string help, Verbosity level)
{
  const auto set = [level](CommandLine& command_line, const std::string& text) {
    bool is_on = false;
    const bool understood = parse_switch(text, is_on);
    if (is_on) {
      command_line.verbosity = level;
    }
    return understood;
  };
  const auto get = [level](const CommandLine& command_line) {
    return std::string(command_line.verbosity == level ? "true" : "false");
  };
  const char letter = name.front();
  return {std::move(name), letter, "", std::move(help), set, get};
}

OptionRow flag(std::string name, std::string help, bool CommandLine::*member)
{
  const auto set = [member](CommandLine& command_line, const std::string& text) {
    return parse_switch(text, command_line.*member);
  };
  const auto get = [member](const CommandLine& command_line) {
    return std::string(command_line.*member ? "true" : "false");
  };
  return {std::move(name), 0, "", std::move(help), set, get};
}

OptionRow levels_option()
{
  const auto set = [](CommandLine& command_line, const std::string& text) {
    return parse_number(text, command_line.levels);
  };
  const auto get = [](const CommandLine& command_line) { return std::to_string(command_line.levels); };
  return {"levels", 0,  "N", "nested levels of detail, 1 ... 16: also OUTPUT_1, _2, ..., of a quarter each (default 1)",
          set,      get};
}

/** \param words of the values in the order of the enumeration, parted by | */
template <typename Choice>
OptionRow choice(std::string name, const std::string& words, std::string help, Choice Options::*member)
{
  std::vector<std::string> choices;
  boost::algorithm::split(choices, words, boost::algorithm::is_any_of("|"));
  const auto set = [choices, member](CommandLine& command_line, const std::string& text) {
    const auto found = std::find(choices.begin(), choices.end(), text);
    if (found == choices.end()) {
      return false;
    }
    command_line.options.*member = static_cast<Choice>(found - choices.begin());
    return true;
  };
  const auto get = [choices, member](const CommandLine& command_line) {
    return choices[static_cast<std::size_t>(command_line.options.*member)];
  };
  help += " (default " + get(CommandLine()) + ")";
  return {std::move(name), 0, words, std::move(help), set, get};
}

OptionRow classes_option()
{
  const auto set = [](CommandLine& command_line, const std::string& text) {
    std::vector<std::string> words;
    boost::algorithm::split(words, text, boost::algorithm::is_any_of(","));
    command_line.classes.clear();
    return std::all_of(words.begin(), words.end(), [&command_line](const std::string& word) {
      return parse_number(word, command_line.classes.emplace_back());
    });
  };
  const auto get = [](const CommandLine& command_line) {
    std::string text;
    for (const std::uint8_t number : command_line.classes) {
      text += (text.empty() ? "" : ",") + std::to_string(number);
    }
    return text;
  };
  return {"class", 0,  "N,N,...", "use only points of these classes, 0 ... 255, such as 2,6 for ground and buildings",
          set,     get};
}

std::vector<OptionRow> make_table()
{
  return {
      number("k-neighbors", 'k', "N", "neighbours per point, 4 ... 200", &Options::k_neighbors),
      number("radius-factor", 'f', "X", "radius of a disk in sampling intervals, 1.5 ... 1000",
             &Options::radius_factor),
      number("radius", 'r', "R", "radius of a disk in the unit of INPUT, instead of -f; 0: by -f", &Options::radius),
      number("vertices", 'n', "N", "vertices of the mesh, instead of -f; 0: by -f", &Options::vertices),
      number("max-error", 0, "E",
             "fewest vertices with 99 % of the points within E of the mesh, instead of -f; 0: by -f",
             &Options::max_error),
      number("adaptive", 'a', "C", "curvature coefficient, 0 ... 2; 0: uniform", &Options::adaptive),
      number("voronoi-threshold", 0, "X", "witness points: distances to two seeds differ by < X radii, 0 ... 1",
             &Options::voronoi_threshold),
      number("hole-size", 0, "X", "perimeter limit in radii of holes that may be gaps; 0: Voronoi dual triangles only",
             &Options::hole_size),
      choice("placement", "point|quadric", "vertices on input points, or where they fit the points best",
             &Options::placement),
      choice("dimension", "1|2|auto", "curves, surfaces, or each part of INPUT what it looks like",
             &Options::dimension),
      number("relax", 0, "N", "steps that even out the triangles, 0 ... 100", &Options::relax),
      levels_option(),
      number("threads", 'j', "N", "worker threads, 0 ... 1024; 0: all cores. The mesh does not depend on it",
             &Options::threads),
      number("seed", 0, "N", "picks one of the equally valid samplings", &Options::seed),
      classes_option(),
      flag("normals", "give the vertices the normals of the mesh", &CommandLine::normals),
      flag("ascii", "write text where OUTPUT's format has both text and binary", &CommandLine::ascii),
      file("report", "FILE.json", "write counts, topology certificate and times", &CommandLine::report_file, true),
      file("html", "FILE.html", "write a page: the mesh to turn, pictures, counts, times, histograms",
           &CommandLine::html_file, true),
      file("voronoi", "FILE.ply", "write the cloud with label, distance, witness and seed fields",
           &CommandLine::voronoi_file, true),
      file("save-config", "FILE.ini", "write these options for --config", &CommandLine::config_to_save, false),
      verbosity("quiet", "print errors only", Verbosity::quiet),
      verbosity("verbose", "print the options and the seconds of each stage", Verbosity::detailed),
  };
}

std::string help_line(char letter, const std::string& name, const std::string& argument, const std::string& help)
{
  constexpr std::size_t help_column = 32;
  std::string line = letter != 0 ? std::string("  -") + letter + ", --" : "      --";
  line += name + (argument.empty() ? "" : "=" + argument);
  line.resize(std::max(line.size() + 2, help_column), ' ');
  return line + help + "\n";
}

std::string input_extensions()
{
#ifdef PCL_PDS_RECON_WITH_PDAL
  return " .pcd .ply .las .laz .e57 .obj .xyz .txt or .csv";
#else
  return " .pcd .ply .las .obj .xyz .txt or .csv";
#endif
}

}  // namespace

const std::vector<OptionRow>& option_table()
{
  static const std::vector<OptionRow> table = make_table();
  return table;
}

std::string help_text()
{
  std::string formats;
  for (const std::string& extension : mesh_extensions()) {
    formats += " " + extension;
  }
  std::string text =
      "Usage: pcl_pds_recon [OPTION]... INPUT... OUTPUT\n"
      "Turn the point cloud INPUT into an oriented manifold triangle mesh OUTPUT by Poisson-disk sampling.\n\n"
      "INPUT is a" +
      input_extensions() +
      " file; the points of several inputs are\nmerged and numbered by the field scan. OUTPUT ends in one of" +
      formats + ".\nINPUT - is standard input, PCD or PLY; OUTPUT - is standard output, PLY.\n\nOptions:\n";
  for (const OptionRow& row : option_table()) {
    text += help_line(row.letter, row.name, row.argument, row.help);
  }
  text += help_line(0, "config", "FILE.ini", "read options from a file; the command line wins");
  text += help_line('h', "help", "", "print this help and exit");
  text += help_line(0, "version", "", "print the version and exit");
  return text +
         "\nExamples:\n"
         "  pcl_pds_recon scan.ply mesh.ply\n"
         "  pcl_pds_recon scan1.pcd scan2.pcd scan3.pcd mesh.glb\n"
         "  pcl_pds_recon --class 2,9 terrain.las terrain.vtp\n"
         "  pcl_pds_recon -k 30 -a 0.25 --report mesh.json scan.pcd mesh.vtp\n"
         "  pcl_pds_recon --config config/dragon.ini dragon.ply mesh.ply\n"
         "\nExit status:\n"
         "  0  OUTPUT is complete\n"
         "  1  INPUT or a file to be written is at fault; OUTPUT was not written\n"
         "  2  the command line or the configuration file is at fault\n";
}

}  // namespace pds
