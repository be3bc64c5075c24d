// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include <pcl_pds_recon/orientation_forest.h>
#include <pcl_pds_recon/parallel.h>

namespace pds
{

using Triangle = std::array<std::uint32_t, 3>;

/** \brief A growing set of triangles that is an orientable 2-manifold at every step.
 *
 * A triangle enters only if afterwards
 * - every edge has at most two faces;
 * - every vertex link is a set of disjoint paths, or one single cycle;
 * - all faces joined by edges can be oriented consistently (union-find with parity);
 * - no two faces at an edge fold onto each other, and
 * - if it is known which side is outside: no face joins an outside to an inside, nor do two faces at an edge.
 * Several paths in one link are several fans pinched together; remove_pinches() ends that. Removing faces never breaks
 * the other conditions. Whatever the order and the geometry of what is offered, the result is manifold.
 */
class TriangleComplex
{
 public:
  static constexpr std::uint32_t no_face = 0xffffffffU;  ///< number of a face that is not there

  /** \brief Why a triangle was refused. */
  enum class Verdict
  {
    legal,
    degenerate,   ///< a corner occurs twice, or the triangle is flat
    edge_full,    ///< one of its edges has two faces already
    link_broken,  ///< a vertex would get a closed fan and something else
    one_sided,    ///< the surface would not be orientable
    folded,       ///< it would fold back on a neighbour
    opposed       ///< it would join an outside to an inside, as the normals tell
  };

  /** \brief The faces at a vertex, in no order that means anything. Ends with the next change of the complex. */
  class FacesAt
  {
   public:
    /** \brief Walks the list of the vertex's faces. */
    class Iterator
    {
     public:
      Iterator(const TriangleComplex& complex, std::uint32_t vertex, std::uint32_t face)
          : complex_(complex), vertex_(vertex), face_(face)
      {
      }
      std::uint32_t operator*() const { return face_; }
      Iterator& operator++()
      {
        face_ = complex_.face_[face_].next_at[complex_.corner_of(face_, vertex_)];
        return *this;
      }
      bool operator!=(const Iterator& other) const { return face_ != other.face_; }

     private:
      const TriangleComplex& complex_;
      std::uint32_t vertex_, face_;
    };

    /** \brief The faces at \a vertex. */
    FacesAt(const TriangleComplex& complex, std::uint32_t vertex) : complex_(complex), vertex_(vertex) {}

    ///@{
    /** \brief As of a standard container. */
    [[nodiscard]] Iterator begin() const { return {complex_, vertex_, complex_.first_at_[vertex_]}; }
    [[nodiscard]] Iterator end() const { return {complex_, vertex_, no_face}; }
    [[nodiscard]] bool empty() const { return complex_.first_at_[vertex_] == no_face; }
    ///@}

   private:
    const TriangleComplex& complex_;
    std::uint32_t vertex_;
  };

  /** \param position of the vertices; must outlive this object
   * \param parallel for what is done to all vertices or faces at once
   * \param outward of each vertex: the direction that leads outside, 0 if unknown; empty if all are */
  explicit TriangleComplex(const std::vector<Eigen::Vector3d>& position,
                           const Parallel& parallel = Parallel(1),
                           std::vector<Eigen::Vector3d> outward = {});

  /** \brief Fills the complex, which must be empty, with all of the triangles that get along with all others.
   * \return the numbers of the rest, ascending: for add() to judge one by one
   */
  [[nodiscard]] std::vector<std::uint32_t> start(const std::vector<Triangle>& triangles, double smallest_angle);

  /** \brief Adds the triangle if that is legal.
   * \param smallest_angle the least angle that two faces may enclose at an edge, radians (pi = flat)
   */
  Verdict add(const Triangle& triangle, double smallest_angle);

  /** \brief What add() would say. */
  [[nodiscard]] Verdict judge(const Triangle& triangle, double smallest_angle) const;

  /** \brief Judges what is added from now on by other normals. What is there already stays.
   * \param outward as for the constructor */
  void believe_normals(std::vector<Eigen::Vector3d> outward) { outward_ = std::move(outward); }

  /** \brief Takes out the faces that are on the other side than the normals at their corners tell, or have corners on
   * both. Sides are those of oriented().
   * \return the number of faces removed */
  std::size_t remove_opposed();

  /** \brief Takes a face out; the others keep their numbers. */
  void remove(std::uint32_t face);

  /** \brief Marks the present state; undo_trial() returns to it if faces were only added since. */
  void begin_trial();
  /** \brief Removes the faces added since begin_trial(). */
  void undo_trial();

  /** \brief Where a vertex has several fans, removes all but the one with most faces; repeats until none is left.
   * \return the number of faces removed */
  std::size_t remove_pinches();

  /** \brief True if the vertex has several fans. */
  [[nodiscard]] bool is_pinched(std::uint32_t vertex) const;

  /** \brief Forgets the orientation constraints of faces that were removed since. */
  void rebuild_orientation();

  /** \brief True if a face has the edge (a, b), in either direction. */
  [[nodiscard]] bool has_edge(std::uint32_t a, std::uint32_t b) const { return find_face(a, b) != no_face; }
  /** \brief Number of faces at the edge (a, b). */
  [[nodiscard]] int face_count(std::uint32_t a, std::uint32_t b) const;
  /** \brief Positions of the vertices. */
  [[nodiscard]] const std::vector<Eigen::Vector3d>& position() const { return position_; }

  /** \brief Numbers of the faces that are present, ascending. */
  [[nodiscard]] std::vector<std::uint32_t> faces() const;
  /** \brief The faces at a vertex, for a range-based loop. */
  [[nodiscard]] FacesAt faces_at(std::uint32_t vertex) const { return {*this, vertex}; }
  /** \brief What was given for work on all vertices or faces at once. */
  [[nodiscard]] const Parallel& parallel() const { return parallel_; }
  /** \brief Number of vertices, with a face or without. */
  [[nodiscard]] std::size_t vertex_count() const { return position_.size(); }

  /** \brief The face's corners, oriented consistently with all faces it is joined to. */
  [[nodiscard]] Triangle oriented(std::uint32_t face) const;

  /** \brief The face next to \a face across the edge (a, b), or no_face. */
  [[nodiscard]] std::uint32_t other_face(std::uint32_t face, std::uint32_t a, std::uint32_t b) const
  {
    return face_[face].across[side_of(face, a, b)];
  }

  /** \brief True if edges join the two faces to each other, if only by others; after rebuild_orientation(). */
  [[nodiscard]] bool joined(std::uint32_t a, std::uint32_t b) const
  {
    return orientation_.root_of(a).face == orientation_.root_of(b).face;
  }

  /** \brief Least cosine between the triangle and what leads outside at its corners, if it is turned to the side that
   * most of them are on; 1 if nothing is known. */
  [[nodiscard]] double facing(const Triangle& triangle) const;

  /** \brief Faces grouped by the edges that join them, each group ascending, groups by their lowest face. */
  [[nodiscard]] std::vector<std::vector<std::uint32_t>> components() const;

  /** \brief Cosine of the angle that triangles (a, b, p) and (a, b, q) enclose: -1 = flat, 1 = back to back. */
  static double fold_cosine(const Eigen::Vector3d& a,
                            const Eigen::Vector3d& b,
                            const Eigen::Vector3d& p,
                            const Eigen::Vector3d& q);

 private:
  using ThreeFaces = std::array<std::uint32_t, 3>;

  /** \brief A triangle and what it touches; the faces at a vertex form a linked list. */
  struct Face
  {
    Triangle corner;
    ThreeFaces across{no_face, no_face, no_face};   ///< beyond the side from corner i to the next
    ThreeFaces next_at{no_face, no_face, no_face};  ///< the face after this one in the list at corner i
    bool present = true;
  };

  [[nodiscard]] std::size_t corner_of(std::uint32_t face, std::uint32_t vertex) const
  {
    const Triangle& t = face_[face].corner;
    return t[0] == vertex ? 0 : t[1] == vertex ? 1 : 2;
  }
  /** \brief The side between two corners of a face. */
  [[nodiscard]] std::size_t side_of(std::uint32_t face, std::uint32_t a, std::uint32_t b) const;
  /** \brief The corner of the face that is neither a nor b. */
  [[nodiscard]] std::uint32_t apex_of(std::uint32_t face, std::uint32_t a, std::uint32_t b) const
  {
    const Triangle& t = face_[face].corner;
    return t[0] + t[1] + t[2] - a - b;
  }
  [[nodiscard]] bool runs_along(std::uint32_t face, std::uint32_t a, std::uint32_t b) const;
  /** \brief A corner occurs twice, or the triangle is flat. */
  [[nodiscard]] bool degenerate(const Triangle& t) const;
  [[nodiscard]] std::uint32_t find_face(std::uint32_t a, std::uint32_t b) const;
  [[nodiscard]] Verdict judge_beside(const Triangle& t, const ThreeFaces& across, double smallest_angle) const;
  [[nodiscard]] bool link_stays_simple(const Triangle& t, std::size_t corner, const ThreeFaces& across) const;
  [[nodiscard]] bool folds(const Triangle& t, const ThreeFaces& across, double smallest_angle) const;
  /** \brief Which side of a triangle is outside. */
  enum class Side
  {
    front,  ///< that from which its corners are counter-clockwise
    back,
    unclear,
    torn  ///< both: its corners are on different sides of the surface
  };
  [[nodiscard]] Side side_by_normals(const Triangle& t) const;
  [[nodiscard]] bool opposed(const Triangle& t, const ThreeFaces& across) const;
  [[nodiscard]] bool orientable_with(const Triangle& t, const ThreeFaces& across) const;
  [[nodiscard]] std::size_t count_faces_at(std::uint32_t vertex) const;
  [[nodiscard]] bool fan_closes(std::uint32_t vertex, std::uint32_t first) const;
  [[nodiscard]] std::vector<std::uint8_t> find_pinched() const;
  void find_neighbors(double smallest_angle);
  void remove_misfits();
  [[nodiscard]] std::vector<std::vector<std::uint32_t>> fans(std::uint32_t vertex) const;
  std::size_t keep_largest_fan(std::uint32_t vertex, std::vector<std::uint32_t>& touched);
  template <typename Visit>
  void walk_component(std::uint32_t start, std::vector<std::uint8_t>& seen, const Visit& visit) const;

  static constexpr std::size_t block = 4096;  // vertices or faces per block

  const std::vector<Eigen::Vector3d>& position_;
  Parallel parallel_;
  std::vector<Eigen::Vector3d> outward_;
  std::vector<Face> face_;
  std::vector<std::uint32_t> first_at_;  ///< by vertex: the first face of its list
  OrientationForest orientation_;
  bool removed_since_rebuild_ = false;
  std::size_t trial_begin_ = 0;  ///< faces before the trial
};

}  // namespace pds
