// SPDX-License-Identifier: BSD-3-Clause
// A simulated flight with a laser scanner: a LAS file of ground, trees, houses and a lake, in metres of a UTM zone,
// with classes, colours and intensities as in real ones.
#include "noise_source.h"

#include <algorithm>
#include <array>
#include <boost/endian/buffers.hpp>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace pds
{
namespace
{

/// Width of the square area, and the coordinates of its south-west corner, metres.
constexpr double width = 240.0;
constexpr double east = 691000.0;
constexpr double north = 5334000.0;
/// Distance of neighbouring pulses, and how far each is moved from its grid point at most, metres.
constexpr double pulse_spacing = 0.6;
constexpr double jitter = 0.25;
/// Standard deviation of a height, metres.
constexpr double height_noise = 0.03;
constexpr double lake_level = 497.0;

/// Classes of the LAS specification.
enum Class : std::uint8_t
{
  ground = 2,
  high_vegetation = 5,
  building = 6,
  water = 9
};

struct Return
{
  double x, y, z;
  Class what;
};

/** \brief A hill, or a hollow, whose height falls with the distance; only + - * /, the same on every machine. */
double hill(double x, double y, double center_x, double center_y, double radius, double height)
{
  const double far = ((x - center_x) * (x - center_x) + (y - center_y) * (y - center_y)) / (radius * radius);
  return height / ((1.0 + far) * (1.0 + far));
}

double ground_height(double x, double y)
{
  return 500.0 + 0.02 * x + hill(x, y, 60, 170, 70, 24) + hill(x, y, 190, 200, 45, 12) + hill(x, y, 150, 60, 50, -14) +
         hill(x, y, 30, 30, 40, 7);
}

struct House
{
  double x, y, length, half_width, eaves, ridge;  ///< heights above the ground at the middle
};
constexpr std::array<House, 3> houses = {
    {{196, 146, 34, 12, 7, 13}, {150, 150, 26, 10, 6, 11}, {205, 96, 30, 12, 7, 13}}};

struct Tree
{
  double x, y, radius, height;
};

std::vector<Tree> plant_trees(NoiseSource& noise)
{
  std::vector<Tree> trees;
  while (trees.size() < 90) {
    const Tree tree = {width * noise.uniform(), width * noise.uniform(), 2.0 + 2.0 * noise.uniform(),
                       6.0 + 8.0 * noise.uniform()};
    const bool is_near_house = std::any_of(houses.begin(), houses.end(), [&tree](const House& house) {
      return std::abs(tree.x - house.x) < house.length && std::abs(tree.y - house.y) < house.length;
    });
    if (!is_near_house && ground_height(tree.x, tree.y) > lake_level + 1.0) {
      trees.push_back(tree);
    }
  }
  return trees;
}

/** \brief Where a pulse that goes straight down is sent back. Half of those that hit a crown go through. */
Return trace_pulse(double x, double y, const std::vector<Tree>& trees, NoiseSource& noise)
{
  for (const House& house : houses) {
    const double across = std::abs(y - house.y);
    if (std::abs(x - house.x) < house.length / 2 && across < house.half_width) {
      const double roof = house.ridge + (house.eaves - house.ridge) * across / house.half_width;
      return {x, y, ground_height(house.x, house.y) + roof, building};
    }
  }
  for (const Tree& tree : trees) {
    const double far = ((x - tree.x) * (x - tree.x) + (y - tree.y) * (y - tree.y)) / (tree.radius * tree.radius);
    if (far < 1.0 && noise.uniform() < 0.5) {
      const double depth = 0.6 * noise.uniform();  // into the crown, which is as high as half the tree
      const double crown = tree.height * (0.5 + 0.5 * std::sqrt(1.0 - far) * (1.0 - depth));
      return {x, y, ground_height(tree.x, tree.y) + crown, high_vegetation};
    }
  }
  const double z = ground_height(x, y);
  return z < lake_level ? Return{x, y, lake_level, water} : Return{x, y, z, ground};
}

std::vector<Return> fly(NoiseSource& noise)
{
  const std::vector<Tree> trees = plant_trees(noise);
  const int lines = static_cast<int>(width / pulse_spacing);
  std::vector<Return> returns;
  for (int row = 0; row < lines; ++row) {
    for (int column = 0; column < lines; ++column) {
      const double x = pulse_spacing * column + jitter * (2.0 * noise.uniform() - 1.0);
      const double y = pulse_spacing * row + jitter * (2.0 * noise.uniform() - 1.0);
      Return echo = trace_pulse(x, y, trees, noise);
      echo.z += height_noise * noise();
      const double water_returns = 0.05;  // most of the light is mirrored away
      if (echo.what != water || noise.uniform() < water_returns) {
        returns.push_back(echo);
      }
    }
  }
  return returns;
}

/** \brief Puts a number into bytes of a LAS file, which are little-endian. */
template <typename Buffer, typename Number>
void put(std::string& bytes, std::size_t place, Number number)
{
  const Buffer buffer(number);
  bytes.replace(place, sizeof buffer, reinterpret_cast<const char*>(buffer.data()), sizeof buffer);
}

constexpr double coordinate_scale = 0.001;  // metres
constexpr std::size_t header_bytes = 227;   // of LAS 1.2
constexpr std::size_t record_bytes = 26;    // of point format 2: with colours, without time

std::string make_header(std::size_t count)
{
  using boost::endian::little_float64_buf_t;
  using boost::endian::little_uint16_buf_t;
  using boost::endian::little_uint32_buf_t;
  std::string bytes(header_bytes, '\0');
  bytes.replace(0, 4, "LASF");
  bytes[24] = 1;  // version 1.2
  bytes[25] = 2;
  bytes.replace(26, 9, "simulated");
  bytes.replace(58, 16, "simulate_terrain");
  put<little_uint16_buf_t>(bytes, 94, std::uint16_t{header_bytes});
  put<little_uint32_buf_t>(bytes, 96, std::uint32_t{header_bytes});
  bytes[104] = 2;  // point format
  put<little_uint16_buf_t>(bytes, 105, std::uint16_t{record_bytes});
  put<little_uint32_buf_t>(bytes, 107, static_cast<std::uint32_t>(count));
  put<little_uint32_buf_t>(bytes, 111, static_cast<std::uint32_t>(count));  // all are first returns
  const std::array<double, 3> offset = {east, north, 0.0};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    put<little_float64_buf_t>(bytes, 131 + 8 * axis, coordinate_scale);
    put<little_float64_buf_t>(bytes, 155 + 8 * axis, offset[axis]);
  }
  // The greatest and least coordinate of each axis in turn, here of the whole area.
  const std::array<double, 6> bounds = {east + width + 1, east - 1, north + width + 1, north - 1, 600, 400};
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    put<little_float64_buf_t>(bytes, 179 + 8 * i, bounds[i]);
  }
  return bytes;
}

std::array<std::uint8_t, 3> color_of(const Return& echo)
{
  switch (echo.what) {
    case high_vegetation:
      return {60, 110, 50};
    case building:
      return {170, 80, 60};
    case water:
      return {50, 80, 120};
    default:
      return echo.z > 512.0 ? std::array<std::uint8_t, 3>{150, 140, 110} : std::array<std::uint8_t, 3>{120, 150, 80};
  }
}

std::string make_record(const Return& echo)
{
  using boost::endian::little_int32_buf_t;
  using boost::endian::little_uint16_buf_t;
  constexpr std::uint8_t only_return = 1 | 1 << 3;
  std::string bytes(record_bytes, '\0');
  const std::array<double, 3> position = {echo.x, echo.y, echo.z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    put<little_int32_buf_t>(bytes, 4 * axis, static_cast<std::int32_t>(std::floor(position[axis] / coordinate_scale)));
  }
  const std::array<std::uint8_t, 3> color = color_of(echo);
  const int brightness = (color[0] + color[1] + color[2]) / 3;
  put<little_uint16_buf_t>(bytes, 12, static_cast<std::uint16_t>(brightness));
  bytes[14] = only_return;
  bytes[15] = static_cast<char>(echo.what);
  for (std::size_t i = 0; i < 3; ++i) {
    put<little_uint16_buf_t>(bytes, 20 + 2 * i, static_cast<std::uint16_t>(color[i] * 257));  // of 16 bits
  }
  return bytes;
}

void write_las(const std::string& path, const std::vector<Return>& returns)
{
  const std::string unfinished = path + ".part";
  std::ofstream file(unfinished, std::ios::binary);
  file << make_header(returns.size());
  for (const Return& echo : returns) {
    file << make_record(echo);
  }
  file.close();
  if (!file || std::rename(unfinished.c_str(), path.c_str()) != 0) {
    std::remove(unfinished.c_str());
    throw std::runtime_error(path + ": cannot be written; is the directory there, writable and not full?");
  }
}

}  // namespace
}  // namespace pds

int main(int argc, char** argv)
{
  if (argc != 2 || argv[1][0] == '-') {
    const bool wants_help = argc == 2 && std::string(argv[1]) == "--help";
    (wants_help ? std::cout : std::cerr)
        << "Usage: simulate_terrain OUTPUT.las\n"
           "Scans 240 m x 240 m of hills, trees, houses and a lake from a simulated aircraft.\n";
    return wants_help ? 0 : 2;
  }
  try {
    pds::NoiseSource noise(0);
    pds::write_las(argv[1], pds::fly(noise));
    return 0;
  } catch (const std::exception& e) {
    std::cerr << "simulate_terrain: " << e.what() << "\n";
    return 1;
  }
}
