// SPDX-License-Identifier: BSD-3-Clause
// A closed torus with bumps, genus 1: random points, evenly over its area, and a fine mesh of the same surface.
//   bumpy_torus POINTS CLOUD.ply REFERENCE.ply
#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iostream>
#include <random>
#include <stdexcept>
#include <string>

namespace
{

using Eigen::Vector3d;

constexpr double full_turn = 6.283185307179586;
constexpr double tube = 0.4;      // mean radius of the tube; that of the ring is 1
constexpr double bump = 0.04;     // height of the bumps
constexpr double around = 6;      // bumps around the ring
constexpr double across = 3;      // bumps around the tube
constexpr int ring_steps = 2400;  // of the reference: its triangles sag about 1e-6 of the diagonal
constexpr int tube_steps = 960;

Vector3d surface(double u, double v)
{
  const double radius = tube + bump * std::sin(around * u) * std::cos(across * v);
  const double ring = 1 + radius * std::cos(v);
  return {ring * std::cos(u), ring * std::sin(u), radius * std::sin(v)};
}

/** \brief Area of the surface per du dv, by central differences. */
double area_element(double u, double v)
{
  constexpr double h = 1e-5;
  return (surface(u + h, v) - surface(u - h, v)).cross(surface(u, v + h) - surface(u, v - h)).norm() / (4 * h * h);
}

double largest_area_element()
{
  constexpr int steps = 1000;
  double largest = 0;
  for (int i = 0; i < steps; ++i) {
    for (int j = 0; j < steps; ++j) {
      largest = std::max(largest, area_element(full_turn * i / steps, full_turn * j / steps));
    }
  }
  return 1.001 * largest;  // between the steps it may be a little more
}

void put(std::ostream& out, const Vector3d& p)
{
  const Eigen::Vector3f f = p.cast<float>();
  out.write(reinterpret_cast<const char*>(f.data()), 3 * sizeof(float));
}

void header(std::ostream& out, std::size_t vertices, std::size_t faces)
{
  out << "ply\nformat binary_little_endian 1.0\nelement vertex " << vertices
      << "\nproperty float x\nproperty float y\nproperty float z\n";
  if (faces > 0) out << "element face " << faces << "\nproperty list uchar int vertex_indices\n";
  out << "end_header\n";
}

void write_cloud(std::ostream& out, std::size_t points)
{
  header(out, points, 0);
  // Not std::uniform_real_distribution, whose numbers differ between libraries.
  std::mt19937_64 random(1);
  const auto uniform = [&random] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  const double largest = largest_area_element();
  for (std::size_t written = 0; written < points;) {
    const double u = full_turn * uniform();
    const double v = full_turn * uniform();
    if (uniform() * largest > area_element(u, v)) continue;
    put(out, surface(u, v));
    ++written;
  }
}

void write_reference(std::ostream& out)
{
  header(out, std::size_t{ring_steps} * tube_steps, std::size_t{2} * ring_steps * tube_steps);
  for (int i = 0; i < ring_steps; ++i) {
    for (int j = 0; j < tube_steps; ++j) put(out, surface(full_turn * i / ring_steps, full_turn * j / tube_steps));
  }
  const auto number = [](int i, int j) { return (i % ring_steps) * tube_steps + j % tube_steps; };
  const auto triangle = [&out](std::int32_t a, std::int32_t b, std::int32_t c) {
    const std::int32_t corners[] = {a, b, c};
    out.put(3);
    out.write(reinterpret_cast<const char*>(corners), sizeof corners);
  };
  for (int i = 0; i < ring_steps; ++i) {
    for (int j = 0; j < tube_steps; ++j) {
      triangle(number(i, j), number(i + 1, j), number(i + 1, j + 1));
      triangle(number(i, j), number(i + 1, j + 1), number(i, j + 1));
    }
  }
}

template <typename Write>
void to_file(const std::string& name, const Write& write)
{
  std::ofstream out(name, std::ios::binary);
  write(out);
  out.close();
  if (!out) throw std::runtime_error(name + ": cannot be written");
}

}  // namespace

int main(int argc, char** argv)
{
  try {
    if (argc != 4) throw std::invalid_argument("usage: bumpy_torus POINTS CLOUD.ply REFERENCE.ply");
    const std::size_t points = std::stoull(argv[1]);
    to_file(argv[2], [points](std::ostream& out) { write_cloud(out, points); });
    to_file(argv[3], write_reference);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "bumpy_torus: " << error.what() << '\n';
    return 1;
  }
}
