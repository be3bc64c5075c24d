// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include <pcl_pds_recon/seed_faces.h>
#include <pcl_pds_recon/triangle_complex.h>

namespace pds
{

/** \brief Longest new edge, in radii, where noisy scans leave gaps: a circle of 1.5 times the perimeter limit is 7
 * wide. */
constexpr double gap_chord = 6.0;

/** \brief What a filling may do. Lengths are in radii, or where the points are farther apart than the radius allows, in
 * those that they would need. */
struct FillLimits
{
  const std::vector<float>* sparsity = nullptr;  ///< by vertex, of GeodesicVoronoi; null: 1 everywhere
  double perimeter = 15.0;                       ///< longest perimeter of a hole
  double chord = longest_dual_edge;              ///< longest new edge
  double smallest_angle = 0.7;                   ///< least angle that two faces may enclose at an edge, radians
  double area = std::numeric_limits<double>::infinity();  ///< most that a filling may have, squared radii
  double facing = -1.0;    ///< least cosine between a new face and what leads outside at its corners
  bool join_rims = false;  ///< across narrow gaps, as noisy scans have them
};

/** \brief Says whether the Voronoi cells of two seeds share a border. */
class BorderingCells
{
 public:
  /** \param pairs ascending by (a, b); must outlive this object */
  explicit BorderingCells(const std::vector<SeedPair>& pairs) : pairs_(pairs) {}
  /** \brief True if the cells of \a s and \a t share one. O(log pairs). */
  [[nodiscard]] bool operator()(std::uint32_t s, std::uint32_t t) const;

 private:
  const std::vector<SeedPair>& pairs_;
};

/** \brief Holes of the complex: closed chains of boundary edges, each run through with the hole on the left.
 * Every vertex must have a single fan. */
[[nodiscard]] std::vector<Polygon> boundary_loops(const TriangleComplex& complex);

/** \brief The loop through \a start, with the hole on its left; empty if \a start is no boundary vertex or pinched, or
 * the loop longer than a polygon that can be filled. */
[[nodiscard]] Polygon loop_through(const TriangleComplex& complex, std::uint32_t start);

/** \brief Triangulates one polygon by the constrained Delaunay rule: of all triangulations whose chords are new and
 * that fold nowhere, the one with the least sum of squared circumradii. O(n^3) for n corners.
 *
 * A polygon beyond the perimeter limit may be a gap in the data. It is filled only where there are points: by
 * triangles of the Voronoi dual, every chord of which joins bordering cells, or else in two parts that are within the
 * limit, on either side of such a chord.
 * \return false if there is no such triangulation; the complex is then as before
 */
bool fill_polygon(TriangleComplex& complex,
                  const BorderingCells& bordering,
                  const Polygon& polygon,
                  const FillLimits& limits);

/** \brief Fills the faces of more than three sides that lie wholly in the open, then all holes of the complex within
 * the limits, shortest first (paper, flowchart step 8), then tears of any perimeter: many cells along them border on
 * others along them. Before, between and after, what cannot stay goes: pinched
 * vertices keep their largest fan, specks are removed.
 * \return the number of polygons of more than three sides filled, and of joints between rims */
std::size_t fill_holes(TriangleComplex& complex,
                       const SeedGeometry& seeds,
                       const BorderingCells& bordering,
                       const std::vector<Polygon>& faces,
                       const FillLimits& limits);

/** \brief Fills what noisy scans leave open beyond the perimeter limit: tears, and gaps in the data that are small
 * beside their component. O(loops) with a cubic cost in the corners of each, 48 at most.
 * \param complex after fill_holes() with the same limits
 * \return the number of loops filled */
std::size_t fill_gaps(TriangleComplex& complex,
                      const SeedGeometry& seeds,
                      const BorderingCells& bordering,
                      const FillLimits& limits);

}  // namespace pds
