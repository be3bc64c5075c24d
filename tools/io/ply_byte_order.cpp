// SPDX-License-Identifier: BSD-3-Clause
#include "io/ply_byte_order.h"

#include <pcl_pds_recon/options.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace pds
{

namespace
{

/** What the numbers of a sample are in the announced byte order and in the other one. */
struct Census
{
  std::size_t announced_sensible = 0;
  std::size_t other_sensible = 0;
  std::size_t other_nan = 0;  ///< points that are missing
  std::size_t total = 0;      ///< without zeros, which are the same in both
};

/** From an atom in kilometres to the solar system in metres. A third of all turned floats is there, a 24th of doubles.
 */
bool is_sensible(double coordinate)
{
  constexpr double least = 0x1p-43;
  constexpr double greatest = 0x1p43;
  const double magnitude = std::abs(coordinate);
  return magnitude > least && magnitude < greatest;  // not NaN
}

template <typename Scalar>
void count(const std::byte* place, Census& census)
{
  std::byte bytes[sizeof(Scalar)];
  std::memcpy(bytes, place, sizeof bytes);
  Scalar announced;
  std::memcpy(&announced, bytes, sizeof announced);
  if (announced == 0) {
    return;
  }
  std::reverse(std::begin(bytes), std::end(bytes));
  Scalar other;
  std::memcpy(&other, bytes, sizeof other);
  ++census.total;
  census.announced_sensible += is_sensible(static_cast<double>(announced)) ? 1 : 0;
  census.other_sensible += is_sensible(static_cast<double>(other)) ? 1 : 0;
  census.other_nan += std::isnan(other) ? 1 : 0;
}

/** Of rows spread evenly. */
Census take_census(const PlyElement& vertex, const PointTable& points)
{
  constexpr std::size_t rows = 4096;  // some ten microseconds, and more than enough to tell a third from all
  const std::size_t step = points.size() / rows + 1;
  Census census;
  for (const PlyProperty& property : vertex.properties) {
    const bool is_position =
        std::find(position_fields.begin(), position_fields.end(), property.name) != position_fields.end();
    if (!is_position || (property.type != ScalarType::float32 && property.type != ScalarType::float64)) {
      continue;
    }
    const std::size_t offset = points.find(property.name)->offset;
    for (std::size_t row = 0; row < points.size(); row += step) {
      const std::byte* place = points.record(row) + offset;
      property.type == ScalarType::float32 ? count<float>(place, census) : count<double>(place, census);
    }
  }
  return census;
}

bool is_of_other_order(const Census& census)
{
  constexpr std::size_t least_total = 12;  // a cube; so many turned floats make sense by chance once in 50 times
  constexpr double most_announced = 0.5;
  constexpr double least_other = 0.6;  // not all: a flat part may have roundings in place of zeros
  const auto total = static_cast<double>(census.total);
  const auto numbers = static_cast<double>(census.total - census.other_nan);
  return numbers >= least_total && static_cast<double>(census.announced_sensible) < most_announced * total &&
         static_cast<double>(census.other_sensible) >= least_other * numbers;
}

}  // namespace

void check_ply_byte_order(const PlyHeader& header, const PlyElement& vertex, const PointTable& points)
{
  if (header.encoding == PlyEncoding::ascii || !is_of_other_order(take_census(vertex, points))) {
    return;
  }
  const bool is_big = header.encoding == PlyEncoding::big_endian;
  throw InvalidInput(std::string("has a header that says ") + (is_big ? "big" : "little") +
                     " endian, but coordinates that make sense only as " + (is_big ? "little" : "big") +
                     " endian: correct the line 'format' of the header");
}

}  // namespace pds
