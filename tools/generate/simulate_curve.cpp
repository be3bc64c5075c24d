// SPDX-License-Identifier: BSD-3-Clause
// Simulated points of curves whose shape is known, spread at random along them, with noise in all directions.
#include "noise_source.h"

#include <Eigen/Core>
#include <algorithm>
#include <boost/program_options.hpp>
#include <cmath>
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

using Eigen::Vector3d;

constexpr double turn = 2 * 3.14159265358979323846;

/** \brief Places on a curve, by a parameter from 0 to 1. */
using Place = Vector3d (*)(double);

Vector3d circle(double t) { return {std::cos(turn * t), std::sin(turn * t), 0}; }
Vector3d linked_circle(double t) { return {1 + std::cos(turn * t), 0, std::sin(turn * t)}; }
Vector3d trefoil(double t)
{
  const double a = turn * t;
  return {std::sin(a) + 2 * std::sin(2 * a), std::cos(a) - 2 * std::cos(2 * a), -std::sin(3 * a)};
}
Vector3d spiral(double t)
{
  constexpr double turns = 3;
  const double r = 0.5 + 1.5 * t;
  return {r * std::cos(turns * turn * t), r * std::sin(turns * turn * t), 0};
}

struct Shape
{
  const char* name;
  std::vector<Place> curves;
};

const std::vector<Shape>& shapes()
{
  static const std::vector<Shape> all = {
      {"circle", {circle}}, {"trefoil", {trefoil}}, {"spiral", {spiral}}, {"rings", {circle, linked_circle}}};
  return all;
}

const std::vector<Place>& curves_of(const std::string& name)
{
  for (const Shape& shape : shapes()) {
    if (name == shape.name) {
      return shape.curves;
    }
  }
  throw std::invalid_argument("there is no shape '" + name + "'; use circle, trefoil, spiral or rings");
}

/** \brief Points evenly spread by length: of those spread evenly by the parameter, slow pieces keep fewer. */
void append_points(Place at, std::size_t count, double deviation, NoiseSource& random, std::vector<Vector3d>& points)
{
  constexpr double step = 1e-5;
  const auto speed = [at](double t) { return (at(t + step) - at(t - step)).norm() / (2 * step); };
  double fastest = 0;
  for (double t = 0; t < 1; t += 1e-3) {
    fastest = std::max(fastest, speed(t));
  }
  for (const std::size_t end = points.size() + count; points.size() < end;) {
    const double t = random.uniform();
    if (random.uniform() * 1.01 * fastest > speed(t)) {
      continue;
    }
    Vector3d p = at(t);
    for (int axis = 0; axis < 3; ++axis) {
      p[axis] += deviation * random();
    }
    points.push_back(p);
  }
}

void write_xyz(const std::string& path, const std::vector<Vector3d>& points)
{
  std::ofstream file(path);
  for (const Vector3d& p : points) {
    char line[96];
    std::snprintf(line, sizeof line, "%.6f %.6f %.6f\n", p.x(), p.y(), p.z());
    file << line;
  }
  file.flush();
  if (!file) {
    throw std::runtime_error(path + ": cannot be written; check the path and the space left");
  }
}

int run(int argc, char** argv)
{
  namespace po = boost::program_options;
  std::string shape = "circle";
  std::string output;
  std::size_t count = 20000;
  double noise = 0;
  std::uint64_t seed = 1;
  po::options_description options("Options");
  auto add = options.add_options();
  add("shape", po::value(&shape)->default_value(shape), "circle, trefoil, spiral or rings");
  add("points", po::value(&count)->default_value(count), "on each curve");
  add("noise", po::value(&noise)->default_value(noise), "standard deviation; circles have radius 1");
  add("seed", po::value(&seed)->default_value(seed), "of the random numbers");
  add("output", po::value(&output), "");
  add("help", "print this help and exit");
  po::positional_options_description positional;
  positional.add("output", 1);
  po::variables_map values;
  po::store(po::command_line_parser(argc, argv).options(options).positional(positional).run(), values);
  po::notify(values);
  if (values.count("help") != 0 || output.empty()) {
    std::cout << "Usage: simulate_curve [options] OUTPUT.xyz\n" << options;
    return values.count("help") != 0 ? 0 : 2;
  }
  NoiseSource random(seed);
  std::vector<Vector3d> points;
  for (const Place at : curves_of(shape)) {
    append_points(at, count, noise, random, points);
  }
  write_xyz(output, points);
  return 0;
}

}  // namespace
}  // namespace pds

int main(int argc, char** argv)
{
  try {
    return pds::run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "simulate_curve: " << error.what() << "; see --help\n";
    return 2;
  }
}
