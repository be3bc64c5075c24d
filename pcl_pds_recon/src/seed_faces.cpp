// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/seed_faces.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <utility>
#include "parallel_parts.h"
#include "wrong_joins.h"

namespace pds
{
namespace
{

using Eigen::Vector3d;

constexpr double degree = 3.14159265358979323846 / 180;
constexpr double least_dual_angle = 40 * degree;     // between two faces at an edge; sharper is folded back
constexpr double first_triple_angle = 63 * degree;   // smooth places first: a wrong triple usually stands up
constexpr double second_triple_angle = 40 * degree;  // then sharp creases
constexpr std::size_t seeds_per_block = 512;
constexpr std::size_t longest_face = 64;  // corners; anything longer is a rim, not a face

/** \brief The rotation system of the seed graph. A dart is an edge with a direction, seen with or against the normal of
 * the seed it leaves: 2 x its place in the graph's rows, + 1 if against ("flipped"). */
class RotationSystem
{
 public:
  RotationSystem(const SeedGraph& graph, const SeedGeometry& seeds, const Parallel& parallel)
      : graph_(graph), twin_(graph.neighbor.size()), changes_side_(graph.neighbor.size())
  {
    parallel.each(seeds.position.size(), seeds_per_block, [&](std::size_t s) {
      for (std::size_t place = graph.begin[s]; place < graph.begin[s + 1]; ++place) {
        const std::uint32_t other = graph.neighbor[place];
        const auto row = graph.neighbor.begin() + static_cast<std::ptrdiff_t>(graph.begin[other]);
        twin_[place] = graph.begin[other] + static_cast<std::size_t>(std::find(row, graph.neighbor.end(), s) - row);
        changes_side_[place] = changes_side(seeds, s, other) ? 1 : 0;
      }
    });
  }

  /** \brief The seed that the dart leads to. */
  [[nodiscard]] std::uint32_t head(std::size_t dart) const { return graph_.neighbor[dart / 2]; }

  /** \brief The next edge of the face on the left: from the head, the first one clockwise from where we came. */
  [[nodiscard]] std::size_t next(std::size_t dart) const
  {
    const std::size_t first = graph_.begin[head(dart)];
    const std::size_t last = graph_.begin[head(dart) + 1];
    const std::size_t back = twin_[dart / 2];
    const bool flipped = flips_to(dart);
    const std::size_t place = flipped ? (back + 1 == last ? first : back + 1) : (back == first ? last : back) - 1;
    return 2 * place + (flipped ? 1 : 0);
  }

  /** \brief The same edge walked the other way on the other side: it bounds the same face, mirrored. */
  [[nodiscard]] std::size_t mirrored(std::size_t dart) const { return 2 * twin_[dart / 2] + (flips_to(dart) ? 0 : 1); }

 private:
  /** \brief True if the normals of the edge's ends point to opposite sides: one is mirrored in the edge's
   * perpendicular bisector plane first, which carries it along the surface even across a sharp bend. */
  static bool changes_side(const SeedGeometry& seeds, std::size_t from, std::size_t to)
  {
    const Vector3d along = seeds.position[to] - seeds.position[from];
    const double of_from = seeds.normal[from].dot(along);
    const double of_to = seeds.normal[to].dot(along);
    return seeds.normal[from].dot(seeds.normal[to]) * along.squaredNorm() < 2 * of_from * of_to;
  }

  /** \brief Whether the face is seen against the normal of the dart's head. */
  [[nodiscard]] bool flips_to(std::size_t dart) const { return (dart % 2 != 0) != (changes_side_[dart / 2] != 0); }

  const SeedGraph& graph_;
  std::vector<std::size_t> twin_;  ///< by place in the graph's rows: the place of the same edge, walked back
  std::vector<std::uint8_t> changes_side_;
};

class FaceTracer
{
 public:
  FaceTracer(const RotationSystem& rotation, const SeedGeometry& seeds) : rotation_(rotation), seeds_(seeds) {}

  /** \brief Walks round the face that begins at \a seed with the dart \a start. Every face is found from all its darts,
   * from those of its mirror image too, and counts only from the first of them.
   * \return false if it is no face, or found elsewhere */
  bool trace(std::uint32_t seed, std::size_t start)
  {
    corners.clear();
    Vector3d normal = Vector3d::Zero();
    std::size_t dart = start;
    do {
      if (corners.size() == longest_face || dart < start || rotation_.mirrored(dart) < start) return false;
      if (std::find(corners.begin(), corners.end(), seed) != corners.end()) return false;
      corners.push_back(seed);
      normal += dart % 2 != 0 ? Vector3d(-seeds_.normal[seed]) : seeds_.normal[seed];
      seed = rotation_.head(dart);
      dart = rotation_.next(dart);
    } while (dart != start);
    return corners.size() >= 3 && area_vector().dot(normal) > 0;
  }

  Polygon corners;

 private:
  [[nodiscard]] Vector3d area_vector() const
  {
    const Vector3d& origin = seeds_.position[corners.front()];
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
      sum += (seeds_.position[corners[i]] - origin).cross(seeds_.position[corners[i + 1]] - origin);
    return sum;
  }

  const RotationSystem& rotation_;
  const SeedGeometry& seeds_;
};

/** \brief True if every edge of the triple has room for a face. */
bool all_open(const TriangleComplex& complex, const SeedTriple& t)
{
  return complex.face_count(t.a, t.b) < 2 && complex.face_count(t.b, t.c) < 2 && complex.face_count(t.c, t.a) < 2;
}

/** \brief Adds what fits, smooth places first.
 * \return triangles that would make the surface one-sided */
std::vector<Triangle> add_triples(TriangleComplex& complex, const std::vector<Triangle>& triples)
{
  for (const Triangle& t : triples) complex.add(t, first_triple_angle);
  std::vector<Triangle> one_sided;
  for (const Triangle& t : triples)
    if (complex.add(t, second_triple_angle) == TriangleComplex::Verdict::one_sided) one_sided.push_back(t);
  return one_sided;
}

Triangle with_ascending_corners(Triangle t)
{
  std::sort(t.begin(), t.end());
  return t;
}

/** \brief Offers the triples again without what joined the sides of a thin part the wrong way round; that comes last.
 */
void rejoin(TriangleComplex& complex, std::vector<Triangle> triples, const std::vector<Triangle>& refused)
{
  std::vector<Triangle> wrong;
  for (const std::uint32_t f : wrong_joins(complex, refused)) {
    wrong.push_back(with_ascending_corners(complex.oriented(f)));
    complex.remove(f);
  }
  if (wrong.empty()) return;
  complex.rebuild_orientation();
  std::sort(wrong.begin(), wrong.end());
  triples.erase(std::remove_if(triples.begin(), triples.end(),
                               [&](const Triangle& t) {
                                 return std::binary_search(wrong.begin(), wrong.end(), with_ascending_corners(t));
                               }),
                triples.end());
  add_triples(complex, triples);
  for (const Triangle& t : wrong) complex.add(t, least_dual_angle);
}

}  // namespace

SeedFaces trace_faces(const SeedGraph& graph, const SeedGeometry& seeds, const Parallel& parallel)
{
  const RotationSystem rotation(graph, seeds, parallel);
  SeedFaces faces;
  for (const SeedFaces& part : parallel_parts<SeedFaces>(
           seeds.position.size(), seeds_per_block, parallel, [&](std::size_t begin, std::size_t end, SeedFaces&found) {
             FaceTracer face(rotation, seeds);
             for (std::size_t s = begin; s < end; ++s)
               for (std::size_t dart = 2 * graph.begin[s]; dart < 2 * graph.begin[s + 1]; ++dart) {
                 if (!face.trace(static_cast<std::uint32_t>(s), dart)) continue;
                 if (face.corners.size() == 3)
                   found.triangles.push_back({face.corners[0], face.corners[1], face.corners[2]});
                 else
                   found.polygons.push_back(face.corners);
               }
           })) {
    append(faces.triangles, part.triangles);
    append(faces.polygons, part.polygons);
  }
  return faces;
}

std::vector<Triangle> add_dual_triangles(TriangleComplex& complex,
                                         const std::vector<Triangle>& faces,
                                         const std::vector<SeedTriple>& triples)
{
  std::vector<Triangle> one_sided;
  for (const std::uint32_t f : complex.start(faces, least_dual_angle))
    if (complex.add(faces[f], least_dual_angle) == TriangleComplex::Verdict::one_sided) one_sided.push_back(faces[f]);

  // Most triples are faces already, and an edge that is full stays so.
  using Triples = std::vector<SeedTriple>;
  constexpr std::size_t block = 2048;
  Triples pending;
  for (const Triples& part : parallel_parts<Triples>(triples.size(), block, complex.parallel(),
                                                     [&](std::size_t begin, std::size_t end, Triples&open) {
                                                       for (std::size_t i = begin; i < end; ++i)
                                                         if (all_open(complex, triples[i])) open.push_back(triples[i]);
                                                     }))
    append(pending, part);
  std::stable_sort(pending.begin(), pending.end(),
                   [](const SeedTriple& x, const SeedTriple& y) { return x.votes > y.votes; });
  std::vector<Triangle> offered;
  offered.reserve(pending.size());
  for (const SeedTriple& t : pending) offered.push_back({t.a, t.b, t.c});
  if (const std::vector<Triangle> refused = add_triples(complex, offered); !refused.empty())
    rejoin(complex, std::move(offered), refused);
  return one_sided;
}

}  // namespace pds
