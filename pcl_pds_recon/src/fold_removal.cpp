// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/fold_removal.h>
#include <pcl_pds_recon/mesh_cleaning.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace pds
{
namespace
{

using Vertices = std::vector<std::uint32_t>;
using Triangles = std::vector<Triangle>;

constexpr double degree = 3.14159265358979323846 / 180;
constexpr double aside = 120 * degree;   // what faces enclose all around a fold, at most
constexpr double folded = 100 * degree;  // what they enclose at its sharpest edge, and at least when it is mended
constexpr std::size_t spike_faces = 4;   // a vertex with no more may go: one with five is part of the surface
constexpr int rounds = 3;                // a fold gone, the next one may show
constexpr std::uint32_t none = TriangleComplex::no_face;

template <typename T>
void make_unique(std::vector<T>& list)
{
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

class FoldRemover
{
 public:
  FoldRemover(TriangleComplex& complex, const BorderingCells& bordering, const FillLimits& limits)
      : complex_(complex), bordering_(bordering), limits_(limits)
  {
    limits_.perimeter = std::numeric_limits<double>::infinity();  // of a few faces
    limits_.smallest_angle = folded;
  }

  /** \brief \return the number of folds removed */
  std::size_t remove_round()
  {
    changed_.assign(complex_.vertex_count(), 0);
    const std::vector<Triangles> parts = find_parts();
    const auto removed = std::count_if(parts.begin(), parts.end(),
                                       [this](const Triangles& part) { return !is_changed(part) && remove(part); });
    complex_.rebuild_orientation();
    return static_cast<std::size_t>(removed);
  }

 private:
  /** \brief What is at the sides of some faces. */
  struct Surroundings
  {
    Triangles faces;
    double sharpest = -1;   ///< cosine of the least angle that the faces and these enclose
    std::size_t edges = 0;  ///< to these
    bool on_rim = false;    ///< and somewhere there is nothing
  };

  /** \brief What is small enough to be a speck between edges at which faces turn aside. */
  [[nodiscard]] std::vector<Triangles> find_parts() const
  {
    const double largest_cosine = std::cos(aside);
    const Vertices all = complex_.faces();
    std::vector<std::uint8_t> seen(all.empty() ? 0 : all.back() + 1);
    std::vector<Triangles> parts;
    for (const std::uint32_t first : all) {
      if (seen[first] != 0) continue;
      seen[first] = 1;
      Vertices part{first};
      for (std::size_t i = 0; i < part.size(); ++i)
        visit_sides(complex_.oriented(part[i]), part[i], [&](std::uint32_t other, double cosine) {
          if (other == none || cosine > largest_cosine || std::exchange(seen[other], 1) != 0) return;
          part.push_back(other);
        });
      if (!is_speck(part.size(), all.size())) continue;
      parts.emplace_back();
      for (const std::uint32_t f : part) parts.back().push_back(complex_.oriented(f));
    }
    return parts;
  }

  /** \brief Calls visit() for the face beyond each side of a face, or none, and the cosine of the angle between them.
   */
  template <typename Visit>
  void visit_sides(const Triangle& t, std::uint32_t face, const Visit& visit) const
  {
    const std::vector<Eigen::Vector3d>& p = complex_.position();
    for (std::size_t e = 0; e < 3; ++e) {
      const std::uint32_t from = t[e];
      const std::uint32_t to = t[(e + 1) % 3];
      const std::uint32_t other = complex_.other_face(face, from, to);
      if (other == none) {
        visit(none, -1.0);
        continue;
      }
      const Triangle o = complex_.oriented(other);
      const std::uint32_t apex = o[0] + o[1] + o[2] - from - to;
      visit(other, TriangleComplex::fold_cosine(p[from], p[to], p[t[(e + 2) % 3]], p[apex]));
    }
  }

  [[nodiscard]] bool is_changed(const Triangles& part) const
  {
    return std::any_of(part.begin(), part.end(), [this](const Triangle& t) {
      return std::any_of(t.begin(), t.end(), [this](std::uint32_t v) { return changed_[v] != 0; });
    });
  }

  /** \brief A face's number, which is another one after it was taken out and put back. */
  [[nodiscard]] std::uint32_t number_of(const Triangle& t) const
  {
    for (const std::uint32_t f : complex_.faces_at(t[0]))
      if (has_corners(complex_.oriented(f), t)) return f;
    return none;
  }
  static bool has_corners(const Triangle& face, const Triangle& t)
  {
    return std::is_permutation(face.begin(), face.end(), t.begin());
  }
  static bool contains(const Triangles& faces, const Triangle& t)
  {
    return std::any_of(faces.begin(), faces.end(), [&](const Triangle& face) { return has_corners(face, t); });
  }

  [[nodiscard]] Surroundings surroundings(const Triangles& part) const
  {
    Surroundings found;
    for (const Triangle& t : part)
      visit_sides(t, number_of(t), [&](std::uint32_t other, double cosine) {
        if (other == none) {
          found.on_rim = true;
          return;
        }
        const Triangle beside = complex_.oriented(other);
        if (contains(part, beside)) return;
        ++found.edges;
        found.sharpest = std::max(found.sharpest, cosine);
        found.faces.push_back(beside);
      });
    make_unique(found.faces);
    return found;
  }

  bool remove(const Triangles& part)
  {
    const Surroundings beside = surroundings(part);
    // A patch at a rim that only one edge holds is not held by a surface that goes on.
    if (beside.on_rim && beside.edges == 1) return take_out(part, false);
    if (beside.sharpest <= std::cos(folded)) return false;
    if (beside.on_rim) return take_out(part, false);
    const auto replace_with = [&](const Triangles& more) {
      Triangles faces = part;
      faces.insert(faces.end(), more.begin(), more.end());
      return take_out(faces, true);
    };
    if (std::any_of(beside.faces.begin(), beside.faces.end(), [&](const Triangle& t) { return replace_with({t}); }))
      return true;
    const Vertices corners = corners_of(part);
    return std::any_of(corners.begin(), corners.end(),
                       [&](std::uint32_t v) { return is_spike(v) && replace_with(others(v, part)); });
  }

  [[nodiscard]] bool is_spike(std::uint32_t vertex) const
  {
    std::size_t count = 0;
    for (const std::uint32_t f : complex_.faces_at(vertex)) count += f != none ? 1 : 0;
    return count <= spike_faces;
  }

  [[nodiscard]] static Vertices corners_of(const Triangles& faces)
  {
    Vertices corners;
    for (const Triangle& t : faces) corners.insert(corners.end(), t.begin(), t.end());
    make_unique(corners);
    return corners;
  }

  /** \brief The faces at a vertex that are not in the part. */
  [[nodiscard]] Triangles others(std::uint32_t vertex, const Triangles& part) const
  {
    Triangles found;
    for (const std::uint32_t f : complex_.faces_at(vertex))
      if (const Triangle t = complex_.oriented(f); !contains(part, t)) found.push_back(t);
    std::sort(found.begin(), found.end());
    return found;
  }

  /** \brief Takes faces out and fills the hole, if that is wanted; puts them back if there is no way to do so. */
  bool take_out(const Triangles& faces, bool fill)
  {
    for (const Triangle& t : faces) complex_.remove(number_of(t));
    Vertices rim = corners_of(faces);
    rim.erase(std::remove_if(rim.begin(), rim.end(), [this](std::uint32_t v) { return complex_.faces_at(v).empty(); }),
              rim.end());
    const bool pinched =
        std::any_of(rim.begin(), rim.end(), [this](std::uint32_t v) { return complex_.is_pinched(v); });
    if (!pinched && (!fill || fill_hole(rim))) {
      for (const std::uint32_t v : rim) changed_[v] = 1;
      return true;
    }
    for (const Triangle& t : faces) complex_.add(t, 0.0);  // legal, for all else is as it was with them
    return false;
  }

  /** \brief Fills the hole that has these vertices around it; if it has others as well, a rim was near, and it stays.
   */
  bool fill_hole(const Vertices& around)
  {
    if (around.empty()) return false;
    const Polygon hole = loop_through(complex_, around.front());
    return hole.size() == around.size() && std::is_permutation(hole.begin(), hole.end(), around.begin()) &&
           fill_polygon(complex_, bordering_, hole, limits_);
  }

  TriangleComplex& complex_;
  const BorderingCells& bordering_;
  FillLimits limits_;
  std::vector<std::uint8_t> changed_;  ///< by vertex: its faces are others than those that parts were found of
};

}  // namespace

std::size_t remove_folds(TriangleComplex& complex, const BorderingCells& bordering, const FillLimits& limits)
{
  FoldRemover remover(complex, bordering, limits);
  std::size_t removed = 0;
  for (int round = 0; round < rounds; ++round) removed += remover.remove_round();
  return removed;
}

}  // namespace pds
