// SPDX-License-Identifier: BSD-3-Clause
#include "wrong_joins.h"

#include <pcl_pds_recon/orientation_forest.h>
#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace pds
{
namespace
{

constexpr double flat = -0.866;  // cosine of 150 degrees: two faces that enclose more are of one piece

/** \brief Two faces with a common edge. */
using Hinge = std::pair<std::uint32_t, std::uint32_t>;

/** \brief Pieces of the surface, and how many votes there are for and against putting two of them together as they
 * are. */
class PieceVotes
{
 public:
  /** \param pieces roots are pieces; these are put together by decide() */
  explicit PieceVotes(OrientationForest& pieces) : pieces_(pieces) {}

  /** \brief Votes on the pieces of two faces. */
  void cast(std::uint32_t face, std::uint32_t other, bool opposed)
  {
    const std::uint32_t a = pieces_.root_of(face).face;
    const std::uint32_t b = pieces_.root_of(other).face;
    if (a != b) count(a, b, opposed ? -1 : 1);
  }

  /** \brief Puts all pieces together, those with the clearest vote first. */
  void decide()
  {
    for (const auto& [a, row] : votes_)
      for (const auto& [b, sum] : row)
        if (a < b) queue_.insert(place(a, b, sum));
    while (!queue_.empty()) {
      const auto [clearness, a, b] = *queue_.begin();
      pieces_.join(a, b, votes_[a][b] < 0);
      const std::uint32_t root = pieces_.root_of(a).face;
      take_over(root, root == a ? b : a);
    }
  }

 private:
  using Place = std::tuple<long long, std::uint32_t, std::uint32_t>;

  static Place place(std::uint32_t a, std::uint32_t b, long long sum)
  {
    return {-std::abs(sum), std::min(a, b), std::max(a, b)};
  }

  void count(std::uint32_t a, std::uint32_t b, long long sum)
  {
    votes_[a][b] += sum;
    votes_[b][a] += sum;
  }

  /** \brief Gives the votes on a piece that is no root any more to its root. */
  void take_over(std::uint32_t root, std::uint32_t gone)
  {
    const bool flipped = pieces_.root_of(gone).flipped;
    const std::map<std::uint32_t, long long> row = std::move(votes_[gone]);
    votes_.erase(gone);
    for (const auto& [other, sum] : row) {
      queue_.erase(place(gone, other, sum));
      votes_[other].erase(gone);
      if (other == root) continue;
      if (const auto known = votes_[root].find(other); known != votes_[root].end())
        queue_.erase(place(root, other, known->second));
      count(root, other, flipped ? -sum : sum);
      queue_.insert(place(root, other, votes_[root][other]));
    }
  }

  OrientationForest& pieces_;
  std::map<std::uint32_t, std::map<std::uint32_t, long long>> votes_;  ///< for minus against, by both roots
  std::set<Place> queue_;                                              ///< pairs of roots, the clearest vote first
};

/** \brief All edges between two faces; joins those of a piece. */
std::vector<Hinge> find_pieces(const TriangleComplex& complex,
                               const std::vector<std::uint32_t>& faces,
                               OrientationForest& pieces)
{
  std::vector<Hinge> steep;
  const std::vector<Eigen::Vector3d>& position = complex.position();
  for (const std::uint32_t f : faces) {
    const Triangle t = complex.oriented(f);
    for (std::size_t e = 0; e < 3; ++e) {
      const std::uint32_t a = t[e];
      const std::uint32_t b = t[(e + 1) % 3];
      const std::uint32_t other = complex.other_face(f, a, b);
      if (other == TriangleComplex::no_face || other < f) continue;
      const Triangle o = complex.oriented(other);
      const double cosine = TriangleComplex::fold_cosine(position[a], position[b], position[t[(e + 2) % 3]],
                                                         position[o[0] + o[1] + o[2] - a - b]);
      if (cosine < flat)
        pieces.join(f, other, false);
      else
        steep.emplace_back(f, other);
    }
  }
  return steep;
}

/** \brief Votes of a refused triangle on the faces that it would join. */
void cast_refused(const TriangleComplex& complex, const Triangle& t, PieceVotes& votes)
{
  std::array<std::uint32_t, 3> beside{};
  std::array<bool, 3> along{};  // runs along the common edge as the triangle does
  for (std::size_t e = 0; e < 3; ++e) {
    beside[e] = TriangleComplex::no_face;
    const std::uint32_t a = t[e];
    const std::uint32_t b = t[(e + 1) % 3];
    for (const std::uint32_t f : complex.faces_at(a)) {
      const Triangle o = complex.oriented(f);
      const auto corner = static_cast<std::size_t>(std::find(o.begin(), o.end(), b) - o.begin());
      if (corner == o.size() || complex.other_face(f, a, b) != TriangleComplex::no_face) continue;
      beside[e] = f;
      along[e] = o[(corner + 2) % 3] == a;
    }
    for (std::size_t d = 0; d < e; ++d)
      if (beside[d] != TriangleComplex::no_face && beside[e] != TriangleComplex::no_face)
        votes.cast(beside[d], beside[e], along[d] != along[e]);
  }
}

}  // namespace

std::vector<std::uint32_t> wrong_joins(const TriangleComplex& complex, const std::vector<Triangle>& refused)
{
  const std::vector<std::uint32_t> faces = complex.faces();
  if (faces.empty()) return {};
  OrientationForest pieces;  // relative to oriented()
  pieces.resize(std::size_t{faces.back()} + 1);
  const std::vector<Hinge> steep = find_pieces(complex, faces, pieces);
  PieceVotes votes(pieces);
  for (const auto& [face, other] : steep) votes.cast(face, other, false);
  for (const Triangle& t : refused) cast_refused(complex, t, votes);
  votes.decide();
  std::vector<std::uint32_t> wrong;
  for (const auto& [face, other] : steep)
    if (pieces.root_of(face).flipped != pieces.root_of(other).flipped) wrong.insert(wrong.end(), {face, other});
  std::sort(wrong.begin(), wrong.end());
  wrong.erase(std::unique(wrong.begin(), wrong.end()), wrong.end());
  return wrong;
}

}  // namespace pds
