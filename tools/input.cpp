// SPDX-License-Identifier: BSD-3-Clause
#include "input.h"

#include "io/atomic_file.h"
#include "io/classification.h"
#include "io/merge_points.h"
#include "io/read_points.h"

#include <algorithm>
#include <utility>

namespace pds
{

namespace
{

std::string stream_name(const std::string& path) { return path == standard_stream ? "standard input" : path; }

/** Whether merging fills the field of a cloud that does not have it. */
bool is_filled(const PointTable& cloud, const std::string& field)
{
  const bool is_viewpoint =
      std::find(viewpoint_fields.begin(), viewpoint_fields.end(), field) != viewpoint_fields.end();
  return field == scan_field || (is_viewpoint && cloud.sensor_origin);
}

/** What merging does to the fields of the clouds. */
void warn_of_merge(const std::vector<std::string>& names,
                   const std::vector<PointTable>& clouds,
                   std::vector<std::string>& warnings)
{
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    std::string missing;
    for (const PointTable& other : clouds) {
      for (const Field& field : other.fields()) {
        const bool is_listed = (missing + ' ').find(' ' + field.name + ' ') != std::string::npos;
        if (!clouds[i].find(field.name) && !is_listed && !is_filled(clouds[i], field.name)) {
          missing += ' ' + field.name;
        }
      }
    }
    if (!missing.empty()) {
      warnings.push_back(stream_name(names[i]) + ": has no" + missing + "; its points get NaN, or 0 for whole numbers");
    }
    if (clouds[i].find(scan_field)) {
      warnings.push_back(stream_name(names[i]) + ": the field 'scan' is replaced by the number of the input");
    }
  }
}

}  // namespace

PointTable select_points(const std::string& path,
                         PointTable points,
                         const CommandLine& command_line,
                         std::vector<std::string>& warnings)
{
  if (!points.not_read.empty()) {
    warnings.push_back(stream_name(path) + ": " + points.not_read + " are left out");
  }
  if (command_line.classes.empty()) {
    return points;
  }
  try {
    return select_classes(std::move(points), command_line.classes);
  } catch (const InvalidInput& error) {
    throw InvalidInput(stream_name(path) + ": " + error.what());
  }
}

PointTable merge_clouds(const std::vector<std::string>& paths,
                        std::vector<PointTable> clouds,
                        const CommandLine& command_line,
                        std::vector<std::string>& warnings)
{
  if (clouds.size() == 1) {
    return std::move(clouds.front());
  }
  warn_of_merge(paths, clouds, warnings);
  return merge_points(std::move(clouds), Parallel(command_line.options.threads));
}

PointTable load_points(const CommandLine& command_line, std::vector<std::string>& warnings)
{
  std::vector<PointTable> clouds;
  for (const std::string& path : command_line.inputs) {
    PointTable points = read_points(path, Parallel(command_line.options.threads));
    clouds.push_back(select_points(path, std::move(points), command_line, warnings));
  }
  return merge_clouds(command_line.inputs, std::move(clouds), command_line, warnings);
}

std::string input_name(const CommandLine& command_line)
{
  const std::size_t others = command_line.inputs.size() - 1;
  const std::string first = stream_name(command_line.inputs.front());
  return others == 0 ? first : first + " and " + std::to_string(others) + " more";
}

}  // namespace pds
