// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/seed_faces.h>
#include <Eigen/Geometry>
#include <algorithm>

namespace pds
{
namespace
{

using Eigen::Vector3d;

constexpr double degree = 3.14159265358979323846 / 180;
constexpr double least_dual_angle = 40 * degree;     // between two faces at an edge; sharper is folded back
constexpr double first_triple_angle = 63 * degree;   // smooth places first: a wrong triple usually stands up
constexpr double second_triple_angle = 40 * degree;  // then sharp creases
constexpr std::size_t longest_face = 64;             // corners; anything longer is a rim, not a face

/** \brief A place in the rotation system: an edge leaving \a from, seen with or against the normal of \a from. */
struct Dart
{
  std::uint32_t from;
  std::uint32_t slot;  ///< which of the seed's neighbours
  bool flipped;        ///< walking on the side opposite to the seed's normal
};

class FaceTracer
{
 public:
  FaceTracer(const SeedGraph& graph, const SeedGeometry& seeds) : graph_(graph), seeds_(seeds)
  {
    begin_.push_back(0);
    for (const auto& row : graph.neighbors) begin_.push_back(begin_.back() + row.size());
    visited_.assign(2 * begin_.back(), 0);
  }

  std::vector<Polygon> all()
  {
    std::vector<Polygon> polygons;
    for (std::uint32_t s = 0; s < graph_.neighbors.size(); ++s)
      for (std::uint32_t slot = 0; slot < graph_.neighbors[s].size(); ++slot)
        for (const bool flipped : {false, true}) {
          const Dart dart{s, slot, flipped};
          if (visited_[number(dart)] != 0) continue;
          Polygon polygon = trace(dart);
          if (!polygon.empty()) polygons.push_back(std::move(polygon));
        }
    return polygons;
  }

 private:
  [[nodiscard]] std::size_t number(const Dart& d) const { return 2 * (begin_[d.from] + d.slot) + (d.flipped ? 1 : 0); }

  [[nodiscard]] std::uint32_t head(const Dart& d) const { return graph_.neighbors[d.from][d.slot]; }

  /** \brief True if the normals of the edge's ends point to opposite sides: one is mirrored in the edge's
   * perpendicular bisector plane first, which carries it along the surface even across a sharp bend. */
  [[nodiscard]] bool changes_side(const Dart& d) const
  {
    const Vector3d along = (seeds_.position[head(d)] - seeds_.position[d.from]).normalized();
    const Vector3d& normal = seeds_.normal[d.from];
    const Vector3d carried = normal - 2 * normal.dot(along) * along;
    return carried.dot(seeds_.normal[head(d)]) < 0;
  }

  /** \brief The next edge of the face on the left: from the head, the first one clockwise from where we came. */
  [[nodiscard]] Dart next(const Dart& d) const
  {
    const std::uint32_t at = head(d);
    const auto& row = graph_.neighbors[at];
    const auto size = static_cast<std::uint32_t>(row.size());
    const auto back = static_cast<std::uint32_t>(std::find(row.begin(), row.end(), d.from) - row.begin());
    const bool flipped = d.flipped != changes_side(d);
    return {at, flipped ? (back + 1) % size : (back + size - 1) % size, flipped};
  }

  /** \brief The same edge walked the other way on the other side: it bounds the same face, mirrored. */
  [[nodiscard]] Dart mirrored(const Dart& d) const
  {
    const auto& row = graph_.neighbors[head(d)];
    const auto back = static_cast<std::uint32_t>(std::find(row.begin(), row.end(), d.from) - row.begin());
    return {head(d), back, d.flipped == changes_side(d)};
  }

  /** \brief Walks round the face; empty if it is none. */
  Polygon trace(const Dart& start)
  {
    Polygon polygon;
    Vector3d normal = Vector3d::Zero();
    bool proper = true;
    Dart dart = start;
    do {
      visited_[number(dart)] = 1;
      visited_[number(mirrored(dart))] = 1;
      if (polygon.size() < longest_face) {
        proper = proper && std::find(polygon.begin(), polygon.end(), dart.from) == polygon.end();
        polygon.push_back(dart.from);
        normal += dart.flipped ? Vector3d(-seeds_.normal[dart.from]) : seeds_.normal[dart.from];
      } else {
        proper = false;
      }
      dart = next(dart);
    } while (number(dart) != number(start));
    proper = proper && polygon.size() >= 3 && area_vector(polygon).dot(normal) > 0;
    if (!proper) polygon.clear();
    return polygon;
  }

  [[nodiscard]] Vector3d area_vector(const Polygon& polygon) const
  {
    const Vector3d& origin = seeds_.position[polygon.front()];
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
      sum += (seeds_.position[polygon[i]] - origin).cross(seeds_.position[polygon[i + 1]] - origin);
    return sum;
  }

  const SeedGraph& graph_;
  const SeedGeometry& seeds_;
  std::vector<std::size_t> begin_;
  std::vector<std::uint8_t> visited_;
};

}  // namespace

std::vector<Polygon> trace_faces(const SeedGraph& graph, const SeedGeometry& seeds)
{
  return FaceTracer(graph, seeds).all();
}

std::vector<Triangle> add_dual_triangles(TriangleComplex& complex,
                                         const std::vector<Polygon>& faces,
                                         const std::vector<SeedTriple>& triples)
{
  std::vector<Triangle> one_sided;
  for (const Polygon& p : faces)
    if (p.size() == 3 && complex.add({p[0], p[1], p[2]}, least_dual_angle) == TriangleComplex::Verdict::one_sided)
      one_sided.push_back({p[0], p[1], p[2]});

  std::vector<SeedTriple> pending = triples;
  std::stable_sort(pending.begin(), pending.end(),
                   [](const SeedTriple& x, const SeedTriple& y) { return x.votes > y.votes; });
  for (const double angle : {first_triple_angle, second_triple_angle})
    for (const SeedTriple& t : pending) complex.add({t.a, t.b, t.c}, angle);
  return one_sided;
}

}  // namespace pds
