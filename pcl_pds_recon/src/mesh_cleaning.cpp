// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/mesh_cleaning.h>
#include <algorithm>

namespace pds
{
namespace
{

constexpr std::size_t speck_faces = 20;    // a component smaller than this ...
constexpr std::size_t speck_share = 100;   // ... and than this share of the largest one is no surface
constexpr std::size_t scatter_share = 20;  // components below this share of the largest one may be scatter
constexpr double frayed = 0.5;             // boundary edges per vertex; a disk of 50 vertices has 0.4
constexpr double volume_curvature = 0.2;   // an isotropic cloud has 0.58, a clean surface below 0.1

/** \brief True if the component is what remains of points scattered through a volume (leaves, spray): frayed, and on
 * neighbourhoods as thick as they are wide. */
bool is_scatter(const TriangleComplex& complex, const SeedGeometry& seeds, const std::vector<std::uint32_t>& faces)
{
  std::vector<std::uint32_t> vertices;
  std::size_t boundary_edges = 0;
  for (const std::uint32_t f : faces) {
    const Triangle t = complex.oriented(f);
    vertices.insert(vertices.end(), t.begin(), t.end());
    for (std::size_t e = 0; e < 3; ++e)
      if (complex.other_face(f, t[e], t[(e + 1) % 3]) == TriangleComplex::no_face) ++boundary_edges;
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  double curvature = 0;
  for (const std::uint32_t v : vertices) curvature += seeds.curvature[v];
  const auto count = static_cast<double>(vertices.size());
  return static_cast<double>(boundary_edges) > frayed * count && curvature > volume_curvature * count;
}

/** \brief Removes small components that are no surface.
 * \param seeds null if scatter stays */
void remove_specks(TriangleComplex& complex, const SeedGeometry* seeds)
{
  const auto components = complex.components();
  std::size_t largest = 0;
  for (const auto& c : components) largest = std::max(largest, c.size());
  for (const auto& c : components) {
    if (is_speck(c.size(), largest) ||
        (seeds != nullptr && c.size() * scatter_share < largest && is_scatter(complex, *seeds, c)))
      for (const std::uint32_t f : c) complex.remove(f);
  }
}

}  // namespace

bool is_speck(std::size_t faces, std::size_t largest) { return faces < speck_faces && faces * speck_share < largest; }

void clean_mesh(TriangleComplex& complex, const SeedGeometry& seeds)
{
  complex.remove_pinches();
  remove_specks(complex, &seeds);
  complex.rebuild_orientation();
}

void clean_cuts(TriangleComplex& complex)
{
  complex.remove_pinches();
  remove_specks(complex, nullptr);
  complex.rebuild_orientation();
}

}  // namespace pds
