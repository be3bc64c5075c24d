// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/hole_filling.h>
#include <pcl_pds_recon/mesh_cleaning.h>
#include <pcl_pds_recon/rim_joining.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include "polygon_triangulation.h"
#include "refilling.h"

namespace pds
{
namespace
{

using Eigen::Vector3d;

constexpr std::size_t most_corners = 48;  // bounds the cubic cost; a perimeter of 15 radii has about 12
constexpr int rounds = 2;                 // of cleaning and filling
constexpr double widening = 1.5;          // how much longer a hole may get by mending
constexpr int most_cut_rims = 32;         // of tears or gaps: each takes a copy of the mesh, and there may be thousands

// A part may be thinner than the radius. There the surface tears, for edges are sharper than faces may be elsewhere.
constexpr double torn_share = 0.4;   // of the cells along a tear border on others along it; along true rims below 0.15
constexpr double thin_angle = 0.53;  // radians that faces may enclose there: 30 degrees, those on a plate R / 2 thick

// Noisy scans tear and leave gaps, whose frayed rims are longer than those of a cut hole of their size.
constexpr double gap_perimeter = 1.5;      // of a circle as large as the gap, in limits of the perimeter ...
constexpr double gap_share = 1.0 / 500.0;  // ... and this share of its component's area: beyond it may be an opening
constexpr double gap_facing = 0.0;         // cosine: faces of the filling are not beyond the crease

constexpr double infinity = std::numeric_limits<double>::infinity();

/** \brief The two polygons on either side of the chord between the corners i and j, i < j. */
std::array<Polygon, 2> divide(const Polygon& polygon, std::size_t i, std::size_t j)
{
  const auto at = [&](std::size_t corner) { return polygon.begin() + static_cast<std::ptrdiff_t>(corner); };
  Polygon inner(at(i), at(j + 1));
  Polygon outer(at(j), polygon.end());
  outer.insert(outer.end(), polygon.begin(), at(i + 1));
  return {inner, outer};
}

/** \brief Fills a polygon beyond the perimeter limit in two parts that are within it, if there is surface between
 * them: the chord that divides it joins bordering cells. The most even division that works. */
std::vector<Triangle> fill_in_parts(const TriangleComplex& complex,
                                    const BorderingCells& bordering,
                                    const Polygon& polygon,
                                    const FillLimits& limits)
{
  std::vector<std::tuple<double, std::size_t, std::size_t>> chords;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    for (std::size_t j = i + 2; j < polygon.size(); ++j) {
      if (!bordering(polygon[i], polygon[j]) || complex.has_edge(polygon[i], polygon[j])) continue;
      const auto parts = divide(polygon, i, j);
      const double longer = std::max(perimeter(complex, parts[0], limits), perimeter(complex, parts[1], limits));
      if (longer <= limits.perimeter) chords.emplace_back(longer, i, j);
    }
  std::sort(chords.begin(), chords.end());
  for (const auto& [longer, i, j] : chords) {
    const auto parts = divide(polygon, i, j);
    std::vector<Triangle> filling = triangulate(complex, nullptr, parts[0], limits);
    const std::vector<Triangle> rest = triangulate(complex, nullptr, parts[1], limits);
    if (filling.empty() || rest.empty()) continue;
    filling.insert(filling.end(), rest.begin(), rest.end());
    return filling;
  }
  return {};
}

/** \brief The triangles that fill_polygon() adds; empty if there are none. */
std::vector<Triangle> find_filling(const TriangleComplex& complex,
                                   const BorderingCells& bordering,
                                   const Polygon& polygon,
                                   const FillLimits& limits)
{
  if (perimeter(complex, polygon, limits) <= limits.perimeter) return triangulate(complex, nullptr, polygon, limits);
  std::vector<Triangle> proven = triangulate(complex, &bordering, polygon, limits);
  return proven.empty() ? fill_in_parts(complex, bordering, polygon, limits) : proven;
}

std::size_t fill_loops(TriangleComplex& complex, const BorderingCells& bordering, const FillLimits& limits)
{
  const std::vector<Polygon> loops = boundary_loops(complex);
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < loops.size(); ++i) order.emplace_back(perimeter(complex, loops[i], limits), i);
  std::sort(order.begin(), order.end());
  std::size_t filled = 0;
  for (const auto& [length, i] : order)
    if (fill_polygon(complex, bordering, loops[i], limits) && loops[i].size() > 3) ++filled;
  return filled;
}

/** \brief Fills a hole after taking some faces beside it away; puts them back if that does not help. */
bool refill_without(TriangleComplex& complex,
                    const BorderingCells& bordering,
                    const Polygon& loop,
                    const std::vector<std::uint32_t>& faces,
                    const FillLimits& limits)
{
  std::vector<Triangle> taken;
  for (const std::uint32_t f : faces) {
    taken.push_back(complex.oriented(f));
    complex.remove(f);
  }
  for (const std::uint32_t v : loop) {
    if (complex.faces_at(v).empty()) continue;
    const Polygon wider = loop_through(complex, v);
    if (!wider.empty() && fill_polygon(complex, bordering, wider, limits)) return true;
    break;
  }
  for (const Triangle& t : taken) complex.add(t, 0.0);
  return false;
}

/** \brief The faces that have all corners on the loop, ascending: fins, which stand in the way of a filling. */
std::vector<std::uint32_t> fins_at(const TriangleComplex& complex, const Polygon& loop)
{
  std::vector<std::uint32_t> fins;
  for (const std::uint32_t v : loop)
    for (const std::uint32_t f : complex.faces_at(v)) {
      const Triangle t = complex.oriented(f);
      if (std::all_of(t.begin(), t.end(),
                      [&](std::uint32_t w) { return std::find(loop.begin(), loop.end(), w) != loop.end(); }))
        fins.push_back(f);
    }
  std::sort(fins.begin(), fins.end());
  fins.erase(std::unique(fins.begin(), fins.end()), fins.end());
  return fins;
}

/** \brief A hole that has no filling often has one without one of the faces, or one of the vertices, at its rim, or
 * without all fins there. */
bool mend_hole(TriangleComplex& complex, const BorderingCells& bordering, const Polygon& loop, const FillLimits& limits)
{
  FillLimits wider = limits;
  if (perimeter(complex, loop, limits) <= limits.perimeter) wider.perimeter *= widening;
  for (std::size_t i = 0; i < loop.size(); ++i)
    for (const std::uint32_t f : complex.faces_at(loop[i])) {
      const Triangle t = complex.oriented(f);
      if (std::find(t.begin(), t.end(), loop[(i + 1) % loop.size()]) == t.end()) continue;
      if (refill_without(complex, bordering, loop, {f}, wider)) return true;
      break;
    }
  for (const std::uint32_t v : loop) {
    std::vector<std::uint32_t> around;  // a copy: the faces are about to go
    for (const std::uint32_t f : complex.faces_at(v)) around.push_back(f);
    std::sort(around.begin(), around.end());
    if (refill_without(complex, bordering, loop, around, wider)) return true;
  }
  return refill_without(complex, bordering, loop, fins_at(complex, loop), wider);
}

std::size_t mend_holes(TriangleComplex& complex, const BorderingCells& bordering, const FillLimits& limits)
{
  std::size_t mended = 0;
  for (const Polygon& loop : boundary_loops(complex)) {
    if (loop.size() > most_corners) continue;
    // An earlier loop's mending may have changed this one.
    if (loop_through(complex, loop.front()) != loop) continue;
    if (mend_hole(complex, bordering, loop, limits)) ++mended;
  }
  return mended;
}

/** \brief True if the surface goes on beyond the loop: many cells along it border on others along it, and no edge shows
 * that. At a true rim the points end, and cells border only on those that edges lead to. */
bool is_tear(const TriangleComplex& complex, const BorderingCells& bordering, const Polygon& loop)
{
  if (loop.size() > most_corners) return false;
  const auto is_torn_off = [&](std::uint32_t v) {
    return std::any_of(loop.begin(), loop.end(),
                       [&](std::uint32_t w) { return w != v && bordering(v, w) && !complex.has_edge(v, w); });
  };
  return static_cast<double>(std::count_if(loop.begin(), loop.end(), is_torn_off)) >
         torn_share * static_cast<double>(loop.size());
}

/** \brief A rim with fins that fold onto each other has a filling once it is cut back by one row of faces.
 * \param cut_rims that have been tried */
bool fill_frayed(TriangleComplex& complex,
                 const BorderingCells& bordering,
                 const Polygon& loop,
                 const FillLimits& limits,
                 int& cut_rims)
{
  if (++cut_rims > most_cut_rims) return false;
  TriangleComplex trial = complex;
  return refill_around(trial, loop, bordering, limits) && refill_around(complex, loop, bordering, limits);
}

/** \brief Fills tears of any perimeter. */
std::size_t close_tears(TriangleComplex& complex, const BorderingCells& bordering, FillLimits limits)
{
  limits.perimeter = infinity;
  limits.smallest_angle = thin_angle;
  std::size_t closed = 0;
  int cut_rims = 0;
  for (const Polygon& loop : boundary_loops(complex)) {
    // An earlier loop's filling may have changed this one.
    if (!is_tear(complex, bordering, loop) || loop_through(complex, loop.front()) != loop) continue;
    if (fill_polygon(complex, bordering, loop, limits) || mend_hole(complex, bordering, loop, limits) ||
        fill_frayed(complex, bordering, loop, limits, cut_rims))
      ++closed;
  }
  return closed;
}

/** \brief By vertex: area of the component that it is in. Every vertex must have a single fan. */
std::vector<double> component_areas(const TriangleComplex& complex)
{
  std::vector<double> areas(complex.vertex_count());
  for (const std::vector<std::uint32_t>& component : complex.components()) {
    std::vector<Triangle> triangles;
    triangles.reserve(component.size());
    for (const std::uint32_t f : component) triangles.push_back(complex.oriented(f));
    const double area = area_of(triangles, complex.position());
    for (const Triangle& t : triangles)
      for (const std::uint32_t v : t) areas[v] = area;
  }
  return areas;
}

}  // namespace

std::vector<Polygon> boundary_loops(const TriangleComplex& complex)
{
  constexpr std::uint32_t none = TriangleComplex::no_face;
  std::vector<std::uint32_t> next(complex.vertex_count(), none);
  for (const std::uint32_t f : complex.faces()) {
    const Triangle t = complex.oriented(f);
    for (std::size_t e = 0; e < 3; ++e)
      if (complex.other_face(f, t[e], t[(e + 1) % 3]) == none) next[t[(e + 1) % 3]] = t[e];
  }
  std::vector<Polygon> loops;
  for (std::uint32_t start = 0; start < next.size(); ++start) {
    if (next[start] == none) continue;
    Polygon loop;
    for (std::uint32_t v = start; next[v] != none;) {
      loop.push_back(v);
      const std::uint32_t to = next[v];
      next[v] = none;
      v = to;
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

Polygon loop_through(const TriangleComplex& complex, std::uint32_t start)
{
  Polygon loop;
  std::uint32_t at = start;
  do {
    std::uint32_t next = TriangleComplex::no_face;
    for (const std::uint32_t f : complex.faces_at(at)) {
      const Triangle t = complex.oriented(f);
      const std::size_t corner = t[0] == at ? 0 : t[1] == at ? 1 : 2;
      const std::uint32_t before = t[(corner + 2) % 3];
      if (complex.other_face(f, before, at) != TriangleComplex::no_face) continue;
      if (next != TriangleComplex::no_face) return {};
      next = before;
    }
    if (next == TriangleComplex::no_face || loop.size() == most_corners) return {};
    loop.push_back(at);
    at = next;
  } while (at != start);
  return loop;
}

bool BorderingCells::operator()(std::uint32_t s, std::uint32_t t) const
{
  const auto wanted = std::minmax(s, t);
  const auto place = std::lower_bound(pairs_.begin(), pairs_.end(), wanted, [](const SeedPair& p, const auto& w) {
    return std::tie(p.a, p.b) < std::tie(w.first, w.second);
  });
  return place != pairs_.end() && place->a == wanted.first && place->b == wanted.second;
}

bool fill_polygon(TriangleComplex& complex,
                  const BorderingCells& bordering,
                  const Polygon& polygon,
                  const FillLimits& limits)
{
  if (polygon.size() < 3 || polygon.size() > most_corners) return false;
  const std::vector<Triangle> filling = find_filling(complex, bordering, polygon, limits);
  if (filling.empty() || area_of(filling, complex.position()) > limits.area) return false;
  complex.begin_trial();
  for (const Triangle& t : filling)
    if (complex.facing(t) < limits.facing || complex.add(t, limits.smallest_angle) != TriangleComplex::Verdict::legal) {
      complex.undo_trial();
      return false;
    }
  return true;
}

std::size_t fill_holes(TriangleComplex& complex,
                       const SeedGeometry& seeds,
                       const BorderingCells& bordering,
                       const std::vector<Polygon>& faces,
                       const FillLimits& limits)
{
  if (limits.perimeter <= 0) {
    clean_mesh(complex, seeds);
    return 0;
  }
  auto filled = static_cast<std::size_t>(std::count_if(faces.begin(), faces.end(), [&](const Polygon& p) {
    return p.size() > 3 && fill_polygon(complex, bordering, p, limits);
  }));
  if (limits.join_rims) {  // before specks go: an island in a gap may be what its shores hang together by
    complex.remove_pinches();
    complex.rebuild_orientation();
    filled += fill_loops(complex, bordering, limits) + join_rims(complex, seeds, bordering, limits);
  }
  for (int round = 0; round < rounds; ++round) {
    clean_mesh(complex, seeds);
    filled += fill_loops(complex, bordering, limits);
  }
  filled += close_tears(complex, bordering, limits);  // before mending, which may cut through what is torn
  filled += mend_holes(complex, bordering, limits) + close_tears(complex, bordering, limits);
  clean_mesh(complex, seeds);
  return filled;
}

std::size_t fill_gaps(TriangleComplex& complex,
                      const SeedGeometry& seeds,
                      const BorderingCells& bordering,
                      const FillLimits& limits)
{
  constexpr double pi = 3.14159265358979323846;
  const double radius = gap_perimeter * limits.perimeter / (2 * pi);
  const std::vector<double> component_area = component_areas(complex);
  FillLimits of_gaps = limits;
  of_gaps.perimeter = infinity;
  of_gaps.chord = gap_chord;
  of_gaps.facing = gap_facing;
  std::size_t filled = 0;
  int cut_rims = 0;
  for (const Polygon& loop : boundary_loops(complex)) {
    if (loop.size() > most_corners || loop_through(complex, loop.front()) != loop) continue;
    of_gaps.area = std::min(pi * radius * radius, gap_share * component_area[loop.front()]);
    if (fill_polygon(complex, bordering, loop, of_gaps) || mend_hole(complex, bordering, loop, of_gaps) ||
        fill_frayed(complex, bordering, loop, of_gaps, cut_rims))
      ++filled;
  }
  clean_mesh(complex, seeds);
  return filled;
}

}  // namespace pds
