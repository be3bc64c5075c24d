// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/mesh_cleaning.h>
#include <pcl_pds_recon/side_parting.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <utility>

#include "surface_integrals.h"

namespace pds
{
namespace
{

using Eigen::Vector3d;

constexpr double least_part = 10.0;  // squared radii that show one side, some 25 faces: less may be noise

/** \brief An edge between two faces. */
struct Hinge
{
  double cosine;  ///< of the angle that they enclose: -1 if flat
  std::uint32_t face, other;

  bool operator<(const Hinge& h) const { return std::tie(cosine, face, other) < std::tie(h.cosine, h.face, h.other); }
};

/** \brief Pieces of a component, which grow together. */
class Pieces
{
 public:
  /** \param shown by face: area that shows its outside, negative if its inside */
  explicit Pieces(std::vector<double> shown) : shown_(std::move(shown)), size_(shown_.size(), 1), above_(shown_.size())
  {
    std::iota(above_.begin(), above_.end(), 0U);
  }

  /** \brief Makes one of the pieces of two faces, unless they show different sides. */
  void join(std::uint32_t a, std::uint32_t b)
  {
    a = piece_of(a);
    b = piece_of(b);
    if (a == b) return;
    if (shown_[a] * shown_[b] < 0 && std::min(std::abs(shown_[a]), std::abs(shown_[b])) >= least_part) return;
    if (size_[a] < size_[b]) std::swap(a, b);
    above_[b] = a;
    size_[a] += size_[b];
    shown_[a] += shown_[b];
  }

  [[nodiscard]] std::uint32_t piece_of(std::uint32_t face)
  {
    while (above_[face] != face) face = above_[face] = above_[above_[face]];
    return face;
  }
  [[nodiscard]] std::size_t size_of(std::uint32_t face) { return size_[piece_of(face)]; }

 private:
  std::vector<double> shown_;
  std::vector<std::size_t> size_;
  std::vector<std::uint32_t> above_;
};

/** \brief Area of a face that shows its outside, as far as that is known; negative if it shows its inside. */
double shown_area(const Triangle& t, const TriangleComplex& complex, const std::vector<Vector3d>& outward)
{
  return area_vector(t, complex.position()).dot(outward[t[0]] + outward[t[1]] + outward[t[2]]) / 3;
}

/** \brief True if both sides are shown by faces that could be a part. */
bool shows_both_sides(const std::vector<double>& shown)
{
  double outside = 0;
  double inside = 0;
  for (const double area : shown) (area < 0 ? inside : outside) += std::abs(area);
  return std::min(outside, inside) >= least_part;
}

std::vector<Hinge> hinges_between(const TriangleComplex& complex, const std::vector<std::uint32_t>& faces)
{
  std::vector<Hinge> hinges;
  for (std::uint32_t i = 0; i < faces.size(); ++i) {
    const Triangle t = complex.oriented(faces[i]);
    for (std::size_t e = 0; e < 3; ++e) {
      const std::uint32_t a = t[e];
      const std::uint32_t b = t[(e + 1) % 3];
      const std::uint32_t other = complex.other_face(faces[i], a, b);
      if (other == TriangleComplex::no_face || other < faces[i]) continue;
      const Triangle o = complex.oriented(other);
      const auto place = std::lower_bound(faces.begin(), faces.end(), other) - faces.begin();
      const double cosine =
          TriangleComplex::fold_cosine(complex.position()[a], complex.position()[b], complex.position()[t[(e + 2) % 3]],
                                       complex.position()[o[0] + o[1] + o[2] - a - b]);
      hinges.push_back({cosine, i, static_cast<std::uint32_t>(place)});
    }
  }
  return hinges;
}

/** \brief Faces along the borders of the pieces of a component, on the side of the smaller one.
 * \param faces of the component, ascending */
std::vector<std::uint32_t> seams(const TriangleComplex& complex,
                                 const std::vector<std::uint32_t>& faces,
                                 const std::vector<Vector3d>& outward)
{
  std::vector<double> shown;
  shown.reserve(faces.size());
  for (const std::uint32_t f : faces) shown.push_back(shown_area(complex.oriented(f), complex, outward));
  if (!shows_both_sides(shown)) return {};
  std::vector<Hinge> hinges = hinges_between(complex, faces);
  std::sort(hinges.begin(), hinges.end());
  Pieces pieces(std::move(shown));
  for (const Hinge& h : hinges) pieces.join(h.face, h.other);
  std::vector<std::uint32_t> seam;
  for (const Hinge& h : hinges)
    if (pieces.piece_of(h.face) != pieces.piece_of(h.other))
      seam.push_back(faces[pieces.size_of(h.face) < pieces.size_of(h.other) ? h.face : h.other]);
  std::sort(seam.begin(), seam.end());
  seam.erase(std::unique(seam.begin(), seam.end()), seam.end());
  return seam;
}

}  // namespace

std::size_t part_sides(TriangleComplex& complex, const std::vector<Vector3d>& outward)
{
  if (outward.empty()) return 0;
  std::size_t taken = 0;
  for (const std::vector<std::uint32_t>& faces : complex.components())
    for (const std::uint32_t f : seams(complex, faces, outward)) {
      complex.remove(f);
      ++taken;
    }
  if (taken > 0) clean_cuts(complex);
  return taken;
}

}  // namespace pds
