// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace pds
{

using Triangle = std::array<std::uint32_t, 3>;

/** \brief A growing set of triangles that is an orientable 2-manifold at every step.
 *
 * A triangle enters only if afterwards
 * - every edge has at most two faces;
 * - every vertex link is a set of disjoint paths, or one single cycle;
 * - all faces joined by edges can be oriented consistently (union-find with parity);
 * - no two faces at an edge fold onto each other.
 * Several paths in one link are several fans pinched together; remove_pinches() ends that. Removing faces never breaks
 * the other conditions. Whatever the order and the geometry of what is offered, the result is manifold.
 */
class TriangleComplex
{
 public:
  /** \brief Why a triangle was refused. */
  enum class Verdict
  {
    legal,
    degenerate,   ///< a corner occurs twice, or the triangle is flat
    edge_full,    ///< one of its edges has two faces already
    link_broken,  ///< a vertex would get a closed fan and something else
    one_sided,    ///< the surface would not be orientable
    folded        ///< it would fold back on a neighbour
  };

  /** \param position of the vertices; must outlive this object */
  explicit TriangleComplex(const std::vector<Eigen::Vector3d>& position);

  /** \brief Adds the triangle if that is legal.
   * \param smallest_angle the least angle that two faces may enclose at an edge, radians (pi = flat)
   */
  Verdict add(const Triangle& triangle, double smallest_angle);

  /** \brief What add() would say. */
  [[nodiscard]] Verdict judge(const Triangle& triangle, double smallest_angle) const;

  void remove(std::uint32_t face);

  /** \brief Marks the present state; undo_trial() returns to it if faces were only added since. */
  void begin_trial();
  void undo_trial();

  /** \brief Where a vertex has several fans, removes all but the one with most faces; repeats until none is left.
   * \return the number of faces removed */
  std::size_t remove_pinches();

  /** \brief Removes both faces at every edge where they enclose less than \a smallest_angle. */
  std::size_t remove_folds(double smallest_angle);

  /** \brief Forgets the orientation constraints of faces that were removed since. */
  void rebuild_orientation();

  [[nodiscard]] bool has_edge(std::uint32_t a, std::uint32_t b) const;
  [[nodiscard]] int face_count(std::uint32_t a, std::uint32_t b) const;
  [[nodiscard]] const std::vector<Eigen::Vector3d>& position() const { return position_; }

  /** \brief Numbers of the faces that are present, ascending. */
  [[nodiscard]] std::vector<std::uint32_t> faces() const;
  [[nodiscard]] const std::vector<std::uint32_t>& faces_at(std::uint32_t vertex) const { return faces_at_[vertex]; }
  [[nodiscard]] std::size_t vertex_count() const { return position_.size(); }

  /** \brief The face's corners, oriented consistently with all faces it is joined to. */
  [[nodiscard]] Triangle oriented(std::uint32_t face) const;

  /** \brief The face next to \a face across the edge (a, b), or no_face. */
  [[nodiscard]] std::uint32_t other_face(std::uint32_t face, std::uint32_t a, std::uint32_t b) const;

  /** \brief Faces grouped by the edges that join them, each group ascending, groups by their lowest face. */
  [[nodiscard]] std::vector<std::vector<std::uint32_t>> components() const;

  static constexpr std::uint32_t no_face = 0xffffffffU;

  /** \brief Cosine of the angle that triangles (a, b, p) and (a, b, q) enclose: -1 = flat, 1 = back to back. */
  static double fold_cosine(const Eigen::Vector3d& a,
                            const Eigen::Vector3d& b,
                            const Eigen::Vector3d& p,
                            const Eigen::Vector3d& q);

 private:
  struct Edge
  {
    std::uint32_t from, to, apex;
  };
  struct Link
  {
    std::uint32_t face;         ///< the root that got a parent
    std::uint32_t parent_size;  ///< faces under the new parent before
  };
  struct Root
  {
    std::uint32_t face;
    bool flipped;
  };

  static std::array<Edge, 3> edges_of(const Triangle& t);
  static bool runs_along(const Triangle& t, std::uint32_t a, std::uint32_t b);
  [[nodiscard]] bool flat(const Triangle& t) const;
  [[nodiscard]] std::uint32_t find_face(std::uint32_t a, std::uint32_t b, std::uint32_t except) const;
  [[nodiscard]] bool link_stays_simple(std::uint32_t vertex, std::uint32_t x, std::uint32_t y) const;
  [[nodiscard]] bool orientable_with(const Triangle& t, const std::array<std::uint32_t, 3>& across) const;
  [[nodiscard]] Root root_of(std::uint32_t face) const;
  void join(std::uint32_t face);
  [[nodiscard]] std::vector<std::vector<std::uint32_t>> fans(std::uint32_t vertex) const;

  const std::vector<Eigen::Vector3d>& position_;
  std::vector<Triangle> face_;
  std::vector<std::uint8_t> present_;
  std::vector<std::vector<std::uint32_t>> faces_at_;
  std::vector<std::uint32_t> parent_;  ///< union-find over faces
  std::vector<std::uint8_t> flip_;     ///< orientation relative to the parent
  std::vector<std::uint32_t> size_;    ///< faces under a root
  std::size_t trial_begin_ = 0;        ///< faces before the trial
  std::vector<Link> undo_;             ///< unions made in the trial
};

}  // namespace pds
