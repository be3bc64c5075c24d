// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "random.h"

/** \brief Random points of surfaces whose shape is known, spread evenly by area. */
namespace pds_test
{

using Points = std::vector<Eigen::Vector3d>;

constexpr double pi = 3.14159265358979323846;

inline Points sphere(std::size_t count, std::uint64_t seed = 1)
{
  Random random(seed);
  Points points;
  while (points.size() < count) {
    const double z = random.uniform(-1, 1);
    const double angle = random.uniform(0, 2 * pi);
    const double r = std::sqrt(1 - z * z);
    points.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
  }
  return points;
}

constexpr double torus_tube = 0.4;  // radius of the tube; that of its axis is 1

inline Points torus(std::size_t count, std::uint64_t seed = 1)
{
  Random random(seed);
  Points points;
  while (points.size() < count) {
    const double around = random.uniform(0, 2 * pi);
    const double tube = random.uniform(0, 2 * pi);
    const double r = 1 + torus_tube * std::cos(tube);
    if (random.uniform(0, 1 + torus_tube) > r) continue;
    points.emplace_back(r * std::cos(around), r * std::sin(around), torus_tube * std::sin(tube));
  }
  return points;
}

/** \brief Surface of the cube [-1, 1]^3. */
inline Points cube(std::size_t count, std::uint64_t seed = 1)
{
  Random random(seed);
  Points points;
  while (points.size() < count) {
    Eigen::Vector3d p = random.in_box(1);
    const std::size_t face = random.below(6);
    p[static_cast<Eigen::Index>(face / 2)] = face % 2 == 0 ? -1 : 1;
    points.push_back(p);
  }
  return points;
}

constexpr double cylinder_radius = 0.5;
constexpr double cylinder_height = 2.0;

/** \brief Cylinder about the z axis, closed by flat caps. */
inline Points cylinder(std::size_t count, std::uint64_t seed = 1)
{
  Random random(seed);
  constexpr double side_share = cylinder_height / (cylinder_height + cylinder_radius);
  Points points;
  while (points.size() < count) {
    const double angle = random.uniform(0, 2 * pi);
    const bool side = random.uniform() < side_share;
    const double r = side ? cylinder_radius : cylinder_radius * std::sqrt(random.uniform());
    const double z = side ? random.uniform(0, cylinder_height) : (random.below(2) == 0 ? 0.0 : cylinder_height);
    points.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
  }
  return points;
}

/** \brief Surface of a plate of 5 x 3 x 1 with two square holes through it: genus 2. */
inline Points two_holed_plate(std::size_t count, std::uint64_t seed = 1)
{
  Random random(seed);
  const auto in_hole = [](double x, double y) { return y > 1 && y < 2 && ((x > 1 && x < 2) || (x > 3 && x < 4)); };
  struct Wall
  {
    Eigen::Vector2d from, to;
  };
  std::vector<Wall> walls;
  const auto add_walls = [&walls](double left, double right, double bottom, double top) {
    walls.push_back({{left, bottom}, {right, bottom}});
    walls.push_back({{right, bottom}, {right, top}});
    walls.push_back({{right, top}, {left, top}});
    walls.push_back({{left, top}, {left, bottom}});
  };
  add_walls(0, 5, 0, 3);
  add_walls(1, 2, 1, 2);
  add_walls(3, 4, 1, 2);
  constexpr double wall_length = 24;  // all twelve
  constexpr double flat_area = 26;    // top and bottom
  Points points;
  while (points.size() < count) {
    double place = random.uniform(0, flat_area + wall_length);
    if (place < flat_area) {
      const double x = random.uniform(0, 5);
      const double y = random.uniform(0, 3);
      if (!in_hole(x, y)) points.emplace_back(x, y, random.below(2) == 0 ? 0.0 : 1.0);
      continue;
    }
    // Rejected points above would thin the flat sides: give the walls the same loss (13 of 15 survive).
    if (random.uniform() > 13.0 / 15.0) continue;
    place -= flat_area;
    for (const Wall& wall : walls) {
      const double length = (wall.to - wall.from).norm();
      if (place < length) {
        const Eigen::Vector2d p = wall.from + place / length * (wall.to - wall.from);
        points.emplace_back(p.x(), p.y(), random.uniform());
        break;
      }
      place -= length;
    }
  }
  return points;
}

/** \brief The square [-1, 1]^2 at height z. */
inline Points plane(std::size_t count, double z = 0, std::uint64_t seed = 1)
{
  Random random(seed);
  Points points;
  while (points.size() < count) {
    points.push_back(random.in_box(1));
    points.back().z() = z;
  }
  return points;
}

inline Points saddle(std::size_t count, std::uint64_t seed = 1)
{
  Random random(seed);
  Points points;
  while (points.size() < count) {
    const double x = random.uniform(-1, 1);
    const double y = random.uniform(-1, 1);
    if (random.uniform(0, std::sqrt(3.0)) > std::sqrt(1 + x * x + y * y)) continue;
    points.emplace_back(x, y, 0.5 * (x * x - y * y));
  }
  return points;
}

/** \brief One and a half turns of a spiral of radius 0.5 to 1.5, height 2. */
inline Points swiss_roll(std::size_t count, std::uint64_t seed = 1)
{
  Random random(seed);
  constexpr double growth = 1 / (3 * pi);  // of the radius per radian
  Points points;
  while (points.size() < count) {
    const double angle = random.uniform(0, 3 * pi);
    const double r = 0.5 + growth * angle;
    if (random.uniform(0, std::hypot(1.5, growth)) > std::hypot(r, growth)) continue;
    points.emplace_back(r * std::cos(angle), r * std::sin(angle), random.uniform(0, 2));
  }
  return points;
}

/** \brief Strip of radius 1 and width 0.8 with half a twist. */
inline Points moebius_strip(std::size_t count, std::uint64_t seed = 1)
{
  Random random(seed);
  Points points;
  while (points.size() < count) {
    const double angle = random.uniform(0, 2 * pi);
    const double across = random.uniform(-0.4, 0.4);
    const double r = 1 + across * std::cos(angle / 2);
    if (random.uniform(0, std::hypot(1.4, 0.2)) > std::hypot(r, across / 2)) continue;
    points.emplace_back(r * std::cos(angle), r * std::sin(angle), across * std::sin(angle / 2));
  }
  return points;
}

inline Points joined(Points a, const Points& b)
{
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

}  // namespace pds_test
