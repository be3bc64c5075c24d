// SPDX-License-Identifier: BSD-3-Clause
#include "io/las_layout.h"

namespace pds
{

namespace
{

constexpr std::size_t flags_at = 14;  // the first of two bytes

/** Formats 0 to 5. */
LasLayout legacy_layout(std::size_t format)
{
  const bool has_time = format == 1 || format >= 3;
  const bool has_color = format == 2 || format == 3 || format == 5;
  constexpr std::size_t time_at = 20;
  LasLayout layout;
  layout.columns = {{"intensity", ScalarType::uint16, 12},
                    {"scan_angle", ScalarType::int8, 16},
                    {"user_data", ScalarType::uint8, 17},
                    {"point_source_id", ScalarType::uint16, 18}};
  layout.bits = {{"return_number", flags_at, 0, 3},       {"number_of_returns", flags_at, 3, 3},
                 {"scan_direction_flag", flags_at, 6, 1}, {"edge_of_flight_line", flags_at, 7, 1},
                 {"classification", flags_at + 1, 0, 5},  {"synthetic", flags_at + 1, 5, 1},
                 {"key_point", flags_at + 1, 6, 1},       {"withheld", flags_at + 1, 7, 1}};
  if (has_time) {
    layout.columns.push_back({"gps_time", ScalarType::float64, time_at});
  }
  if (has_color) {
    layout.color_at = has_time ? time_at + sizeof(double) : time_at;
  }
  return layout;
}

/** Formats 6 to 10. */
LasLayout wide_layout(std::size_t format)
{
  LasLayout layout;
  layout.columns = {{"intensity", ScalarType::uint16, 12},
                    {"classification", ScalarType::uint8, 16},
                    {"user_data", ScalarType::uint8, 17},
                    {"point_source_id", ScalarType::uint16, 20},
                    {"gps_time", ScalarType::float64, 22}};
  layout.bits = {{"return_number", flags_at, 0, 4},          {"number_of_returns", flags_at, 4, 4},
                 {"synthetic", flags_at + 1, 0, 1},          {"key_point", flags_at + 1, 1, 1},
                 {"withheld", flags_at + 1, 2, 1},           {"overlap", flags_at + 1, 3, 1},
                 {"scan_channel", flags_at + 1, 4, 2},       {"scan_direction_flag", flags_at + 1, 6, 1},
                 {"edge_of_flight_line", flags_at + 1, 7, 1}};
  layout.scan_angle_at = 18;
  if (format == 7 || format == 8 || format == 10) {
    layout.color_at = 30;
  }
  if (format == 8 || format == 10) {
    layout.columns.push_back({"infrared", ScalarType::uint16, 36});
  }
  return layout;
}

}  // namespace

LasLayout las_layout(std::size_t point_format)
{
  constexpr std::size_t first_wide_format = 6;
  return point_format < first_wide_format ? legacy_layout(point_format) : wide_layout(point_format);
}

}  // namespace pds
