// SPDX-License-Identifier: BSD-3-Clause
#include "io/write_mesh.h"

#include "io/glb_writer.h"
#include "io/obj_writer.h"
#include "io/sentence_list.h"
#include "io/stl_writer.h"

#include <boost/algorithm/string/join.hpp>
#include <cstring>
#include <limits>

#ifdef PCL_PDS_RECON_WITH_VTK
#include "io/vtk_writer.h"
#endif

namespace pds
{

namespace
{

bool is_held(const std::string& extension, const PointTable& points, const std::string& name)
{
  const bool holds_positions_only = extension == ".stl";
  const bool holds_attributes = extension != ".stl" && extension != ".obj" && extension != ".glb";
  return holds_attributes || is_one_of(name, position_fields) ||
         (!holds_positions_only && points.has_normals() && is_one_of(name, normal_fields)) ||
         (!holds_positions_only && points.color_type() && is_one_of(name, color_fields));
}

/** Whether red, green and blue are there but say not which value is white. */
bool has_odd_colors(const PointTable& points)
{
  return !points.color_type() && points.find("red") && points.find("green") && points.find("blue");
}

bool is_floating(ScalarType type) { return type == ScalarType::float32 || type == ScalarType::float64; }

/** Whether a double takes all values of this field. */
bool fits_double(const PointTable& points, const Field& field)
{
  if (field.type != ScalarType::int64 && field.type != ScalarType::uint64) {
    return true;
  }
  const std::uint64_t exact = std::uint64_t{1} << std::numeric_limits<double>::digits;
  for (std::size_t row = 0; row < points.size(); ++row) {
    std::uint64_t value = 0;
    std::memcpy(&value, points.record(row) + field.offset, sizeof value);
    const bool is_negative = field.type == ScalarType::int64 && value > std::numeric_limits<std::uint64_t>::max() / 2;
    if ((is_negative ? 0 - value : value) > exact) {
      return false;
    }
  }
  return true;
}

std::string list(const std::vector<std::string>& names) { return boost::algorithm::join(names, " "); }

}  // namespace

std::vector<std::string> mesh_extensions()
{
#ifdef PCL_PDS_RECON_WITH_VTK
  return {".ply", ".obj", ".stl", ".glb", ".vtk", ".vtp"};
#else
  return {".ply", ".obj", ".stl", ".glb"};
#endif
}

std::string lost_in_format(const std::string& extension, const PointTable& points, bool ascii)
{
  const bool rounds_decimals = extension == ".vtk" && ascii;  // VTK writes 6 digits of a float, 11 of a double
  std::vector<std::string> lost_fields;
  std::vector<std::string> rounded_fields;
  for (const Field& field : points.fields()) {
    if (!is_held(extension, points, field.name)) {
      lost_fields.push_back(field.name);
    } else if ((rounds_decimals && is_floating(field.type)) || (extension == ".ply" && !fits_double(points, field))) {
      rounded_fields.push_back(field.name);
    }
  }
  const bool is_single_precision = extension == ".stl" || extension == ".glb";
  std::vector<std::string> losses;
  if (!lost_fields.empty()) {
    const bool could_hold_colors = extension != ".stl" && has_odd_colors(points);
    losses.push_back("the fields " + list(lost_fields) +
                     (could_hold_colors ? " (colours only if all are uchar, ushort, or floats of 0 to 1)" : ""));
  }
  if (!rounded_fields.empty()) {
    losses.push_back("the last digits of " + list(rounded_fields));
  }
  const std::optional<ScalarType> color_type = points.color_type();
  if (extension == ".glb" && color_type && color_type != ScalarType::uint8) {
    losses.emplace_back("the last digits of the colours");  // linear ones leave dark shades fewer numbers
  }
  if (extension == ".glb" && points.has_normals() && points.find("nx")->type == ScalarType::float64) {
    losses.emplace_back("the last digits of the normals");
  }
  if (is_single_precision && points.has_double_positions()) {
    losses.emplace_back("the last digits of the coordinates");
  }
  return sentence_list(losses);
}

bool holds_segments(const std::string& extension) { return extension != ".stl"; }

void write_mesh(AtomicFile& file,
                const std::string& extension,
                const PointTable& points,
                const Triangles& triangles,
                bool ascii,
                const Segments& segments)
{
  if (extension == ".ply") {
    write_ply(file, points, triangles, ascii, segments);
  } else if (extension == ".obj") {
    write_obj(file, points, triangles, segments);
  } else if (extension == ".stl") {
    write_stl(file, points, triangles, ascii);
  } else if (extension == ".glb") {
    write_glb(file, points, triangles, segments);
  } else {
#ifdef PCL_PDS_RECON_WITH_VTK
    const std::string bytes = render_with_vtk(extension, points, triangles, segments, ascii);
    file.write(bytes.data(), bytes.size());
#else
    throw OutputError("this build has no VTK and cannot write '" + extension + "'; write .ply");
#endif
  }
}

}  // namespace pds
