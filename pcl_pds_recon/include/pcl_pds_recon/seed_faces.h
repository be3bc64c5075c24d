// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <pcl_pds_recon/seed_graph.h>
#include <pcl_pds_recon/triangle_complex.h>

namespace pds
{

/** \brief A face of the seed graph: its corners in order. */
using Polygon = std::vector<std::uint32_t>;

/** \brief Faces of the seed graph. */
struct SeedFaces
{
  std::vector<Triangle> triangles;  ///< of three sides
  std::vector<Polygon> polygons;    ///< of more than three sides
};

/** \brief Traces the faces of the planar seed graph by its rotation system (paper, flowchart step 8).
 *
 * Around each seed its neighbours are ordered by angle; "next edge clockwise" cuts the surface into faces. Neighbouring
 * normals are brought to one side edge by edge, so no global orientation is needed. Faces that run clockwise (the
 * outside of an open patch), change side on the way round, or pass a seed twice are left out. O(edges).
 */
[[nodiscard]] SeedFaces trace_faces(const SeedGraph& graph, const SeedGeometry& seeds, const Parallel& parallel);

/** \brief Adds the triangles of the Voronoi dual to the complex: first the three-sided faces of the seed graph, then
 * the triples of meeting cells by descending votes, which close what has no tangent plane (tips, creases, thin parts).
 * \return triangles that fit in every way but would make the surface one-sided */
std::vector<Triangle> add_dual_triangles(TriangleComplex& complex,
                                         const std::vector<Triangle>& faces,
                                         const std::vector<SeedTriple>& triples);

}  // namespace pds
