// SPDX-License-Identifier: BSD-3-Clause
// CGAL's grid_simplify_point_set, whose cell is the parameter, and then one of two reconstructions with their defaults.
// Methods: advancing_front; scale_space, with the smoother and the mesher of the manual's second example.
#include <CGAL/Advancing_front_surface_reconstruction.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Scale_space_reconstruction_3/Advancing_front_mesher.h>
#include <CGAL/Scale_space_reconstruction_3/Jet_smoother.h>
#include <CGAL/Scale_space_surface_reconstruction_3.h>
#include <CGAL/grid_simplify_point_set.h>

#include <array>
#include <iterator>
#include <vector>

#include "peer_run.h"

namespace
{

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Points = std::vector<Kernel::Point_3>;
using Facets = std::vector<std::array<std::size_t, 3>>;

constexpr std::size_t smoothing_iterations = 4;  // of the manual's examples

Facets advancing_front(const Points& points)
{
  Facets facets;
  CGAL::advancing_front_surface_reconstruction(points.begin(), points.end(), std::back_inserter(facets));
  return facets;
}

Facets scale_space(const Points& points)
{
  CGAL::Scale_space_surface_reconstruction_3<Kernel> reconstruction(points.begin(), points.end());
  reconstruction.increase_scale(smoothing_iterations, CGAL::Scale_space_reconstruction_3::Jet_smoother<Kernel>());
  reconstruction.reconstruct_surface(CGAL::Scale_space_reconstruction_3::Advancing_front_mesher<Kernel>());
  return Facets(reconstruction.facets_begin(), reconstruction.facets_end());
}

peers::Mesh reconstruct(const peers::Cloud::Ptr& cloud, const peers::Arguments& arguments, peers::Measurement& measured)
{
  Points points;
  for (const auto& point : *cloud) points.emplace_back(point.x, point.y, point.z);
  measured.start();
  points.erase(CGAL::grid_simplify_point_set(points, arguments.parameter), points.end());
  const Facets facets = arguments.method == "scale_space" ? scale_space(points) : advancing_front(points);
  measured.stop();

  peers::Mesh mesh;
  for (const auto& p : points) {
    mesh.vertices.push_back({static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())});
  }
  for (const auto& f : facets) {
    mesh.triangles.push_back(
        {static_cast<std::uint32_t>(f[0]), static_cast<std::uint32_t>(f[1]), static_cast<std::uint32_t>(f[2])});
  }
  return mesh;
}

}  // namespace

int main(int argc, char** argv) { return peers::run(argc, argv, reconstruct); }
