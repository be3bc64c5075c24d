// SPDX-License-Identifier: BSD-3-Clause
// Simulated range scans: virtual scanners around a known shape cast a ray per pixel, measure the depth with noise, and
// their points are merged in one frame, as a registered set of real range images is.
#include "implicit_shape.h"
#include "noise_source.h"

#include <Eigen/Geometry>
#include <boost/endian/buffers.hpp>
#include <boost/program_options.hpp>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace pds
{
namespace
{

using Eigen::Vector3d;

/** \brief What is scanned. */
struct Shape
{
  const char* name;
  double (*distance_bound)(const Vector3d& point);
  double unit;  ///< length in the output of 1 in the shape's own coordinates
};

constexpr Shape duck = {"a rubber duck", duck_distance_bound, 1.0};
constexpr Shape part = {"a machine part", part_distance_bound, 50.0};  // mm

struct ScanSettings
{
  Shape shape = duck;
  double pixel_spacing = 0.0115;  ///< distance of neighbouring rays at the shape's centre, in units of the shape
  double noise = 0.1;             ///< standard deviation of a depth, in pixel spacings
  std::uint64_t seed = 0;         ///< of the noise
};

/// Distance of a scanner from the centre of the shape, whose radius is 1.25: near enough for a marked perspective.
constexpr double scanner_distance = 5.0;
constexpr double shape_radius = 1.25;
/// A depth is final when the surface is nearer than this; far below the noise.
constexpr double depth_tolerance = 1e-6;
/// Scanners lose the return of a surface seen at a flatter angle (here 73 degrees from its normal).
constexpr double min_cosine = 0.3;

/** \brief Directions of the twelve corners of an icosahedron: every part of a surface faces several of them. */
std::vector<Vector3d> scanner_directions()
{
  const double golden_ratio = (1.0 + std::sqrt(5.0)) / 2.0;
  std::vector<Vector3d> directions;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-golden_ratio, golden_ratio}) {
      directions.push_back(Vector3d(0, a, b).normalized());
      directions.push_back(Vector3d(a, b, 0).normalized());
      directions.push_back(Vector3d(b, 0, a).normalized());
    }
  }
  return directions;
}

/** \brief Depth along a ray by sphere tracing, if it meets the shape. */
std::optional<double> cast_ray(const Shape& shape, const Vector3d& origin, const Vector3d& direction)
{
  double depth = scanner_distance - 1.1 * shape_radius;
  while (depth < scanner_distance + 1.1 * shape_radius) {
    const double step = shape.distance_bound(origin + depth * direction);
    if (step < depth_tolerance) {
      return depth;
    }
    depth += step;
  }
  return std::nullopt;
}

Vector3d surface_normal(const Shape& shape, const Vector3d& p)
{
  constexpr double h = 1e-5;
  Vector3d gradient;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d offset = h * Vector3d::Unit(axis);
    gradient[axis] = shape.distance_bound(p + offset) - shape.distance_bound(p - offset);
  }
  return gradient.normalized();
}

/** \brief The points that one scanner sees, row by row of its pixel grid. */
std::vector<Vector3d> scan_from(const Vector3d& scanner_direction, const ScanSettings& settings, NoiseSource& noise)
{
  std::vector<Vector3d> points;
  const Vector3d origin = scanner_distance * scanner_direction;
  const Vector3d right = scanner_direction.unitOrthogonal();
  const Vector3d up = scanner_direction.cross(right);
  const int half_width = static_cast<int>(shape_radius * 1.1 / settings.pixel_spacing);

  for (int row = -half_width; row <= half_width; ++row) {
    for (int column = -half_width; column <= half_width; ++column) {
      const Vector3d target = settings.pixel_spacing * (column * right + row * up);
      const Vector3d ray = (target - origin).normalized();
      const std::optional<double> depth = cast_ray(settings.shape, origin, ray);
      if (!depth || -ray.dot(surface_normal(settings.shape, origin + *depth * ray)) < min_cosine) {
        continue;
      }
      points.push_back(settings.shape.unit *
                       (origin + (*depth + settings.noise * settings.pixel_spacing * noise()) * ray));
    }
  }
  return points;
}

/** \brief Writes a binary little-endian PLY, under another name until it is complete. */
void write_ply(const std::string& path, const Shape& shape, const std::vector<Vector3d>& points)
{
  const std::string unfinished = path + ".part";
  std::ofstream file(unfinished, std::ios::binary);
  file << "ply\nformat binary_little_endian 1.0\ncomment simulated range scans of " << shape.name << "\nelement vertex "
       << points.size() << "\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  for (const Vector3d& p : points) {
    for (int axis = 0; axis < 3; ++axis) {
      const boost::endian::little_float32_buf_t coordinate(static_cast<float>(p[axis]));
      file.write(reinterpret_cast<const char*>(coordinate.data()), sizeof coordinate);
    }
  }
  file.close();
  if (!file || std::rename(unfinished.c_str(), path.c_str()) != 0) {
    std::remove(unfinished.c_str());
    throw std::runtime_error(path + ": cannot be written; is the directory there, writable and not full?");
  }
}

/** \brief scan.ply as scan_01.ply. */
std::string numbered(const std::string& path, std::size_t number)
{
  const std::filesystem::path whole(path);
  const std::string digits = (number < 10 ? "_0" : "_") + std::to_string(number);
  return (whole.parent_path() / (whole.stem().string() + digits + whole.extension().string())).string();
}

void write_scans(const ScanSettings& settings, bool separate, const std::string& output)
{
  NoiseSource noise(settings.seed);
  std::vector<Vector3d> merged;
  std::size_t number = 0;
  for (const Vector3d& direction : scanner_directions()) {
    const std::vector<Vector3d> points = scan_from(direction, settings, noise);
    if (separate) {
      write_ply(numbered(output, ++number), settings.shape, points);
    } else {
      merged.insert(merged.end(), points.begin(), points.end());
    }
  }
  if (!separate) {
    write_ply(output, settings.shape, merged);
  }
}

Shape find_shape(const std::string& name)
{
  if (name != "duck" && name != "part") {
    throw std::invalid_argument("--shape: there is no '" + name + "'; give duck or part");
  }
  return name == "duck" ? duck : part;
}

void check_settings(const ScanSettings& settings)
{
  // Below the least spacing a run takes hours and the file gigabytes; above the greatest the shape falls between rays.
  if (!(settings.pixel_spacing >= 1e-3 && settings.pixel_spacing <= 0.1)) {
    throw std::invalid_argument("--pixel-spacing: give a number from 0.001 to 0.1");
  }
  if (!(settings.noise >= 0.0 && settings.noise <= 10.0)) {
    throw std::invalid_argument("--noise: give a number from 0 to 10 pixel spacings");
  }
}

int run(int argc, char** argv)
{
  namespace po = boost::program_options;
  ScanSettings settings;
  std::string shape = "duck";
  std::string output;
  po::options_description options("Options");
  auto add = options.add_options();
  add("shape", po::value(&shape)->default_value(shape), "duck, 2 units long, or part, 100 mm long");
  add("separate", po::bool_switch(), "write the points of each scanner to a file of its own: OUTPUT_01.ply ...");
  add("pixel-spacing,p", po::value(&settings.pixel_spacing)->default_value(settings.pixel_spacing, "0.0115"),
      "distance of neighbouring rays at the shape's centre; the shape's length is 2");
  add("noise,n", po::value(&settings.noise)->default_value(settings.noise, "0.1"),
      "standard deviation of a depth, in pixel spacings");
  add("seed,s", po::value(&settings.seed)->default_value(settings.seed), "of the noise");
  add("help,h", "print this help");
  po::options_description all;
  all.add(options);
  all.add_options()("output", po::value(&output)->required());
  po::positional_options_description files;
  files.add("output", 1);

  po::variables_map values;
  po::store(po::command_line_parser(argc, argv).options(all).positional(files).run(), values);
  if (values.count("help") != 0) {
    std::cout << "Usage: simulate_scan [options] OUTPUT.ply\n"
              << "Scans a shape with twelve virtual range scanners and merges the points.\n\n"
              << options;
    return 0;
  }
  po::notify(values);
  settings.shape = find_shape(shape);
  check_settings(settings);
  write_scans(settings, values["separate"].as<bool>(), output);
  return 0;
}

}  // namespace
}  // namespace pds

int main(int argc, char** argv)
{
  try {
    return pds::run(argc, argv);
  } catch (const boost::program_options::error& e) {
    std::cerr << "simulate_scan: " << e.what() << "; see --help\n";
    return 2;
  } catch (const std::invalid_argument& e) {
    std::cerr << "simulate_scan: " << e.what() << "\n";
    return 2;
  } catch (const std::exception& e) {
    std::cerr << "simulate_scan: " << e.what() << "\n";
    return 1;
  }
}
