// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_pds_recon/options.h>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>

namespace pds
{

/** \brief Interval of radii within which the wanted one is, narrowed by what each radius tried has given. */
class RadiusBracket
{
 public:
  void too_small(double radius) { low_ = radius; }
  void too_large(double radius) { high_ = radius; }
  [[nodiscard]] double low() const { return low_; }    ///< the last that was too small, 0 if none
  [[nodiscard]] double high() const { return high_; }  ///< the last that was too large, 0 if none
  [[nodiscard]] bool closed() const { return low_ > 0 && high_ > 0; }
  /** \brief A guess, or what is well inside the bracket if the guess is not. */
  [[nodiscard]] double inside(double guess) const;

 private:
  double low_ = 0, high_ = 0;
};

/** \brief Finds the radius that gives a mesh of so many vertices.
 *
 * Their count goes like one over the squared radius, with some random scatter. Sampling is repeated until the seeds
 * are as many as wanted; the mesh then tells how many of them have a face, and more or fewer seeds are asked for.
 */
class VertexCountSearch
{
 public:
  /** \param radius to begin with */
  VertexCountSearch(std::uint64_t vertices, double radius);

  [[nodiscard]] double radius() const { return radius_; }  ///< to be tried next
  /** \brief Learns how many seeds the radius gave. \return true if these are to be meshed */
  bool sampled(std::size_t seeds);
  /** \brief Learns how many vertices the mesh of these seeds has. \return true if that is it */
  bool meshed(std::size_t vertices);

 private:
  static constexpr int most_samplings = 30;  // for one count of seeds: the bracket is then at the scatter's scale
  static constexpr int most_meshes = 8;

  double vertices_;
  double seeds_;  ///< wanted
  double radius_;
  double best_radius_;
  double best_miss_;
  double tolerance_;
  int samplings_ = 0;
  int meshes_ = 0;
  std::size_t last_seeds_ = 0;
  RadiusBracket bracket_;
};

/** \brief Finds the largest radius whose mesh is near enough to the points. The distance goes like the squared radius.
 */
class ErrorSearch
{
 public:
  /** \param radius to begin with \param least_radius below which no mesh is possible */
  ErrorSearch(double max_error, double radius, double least_radius);

  [[nodiscard]] double radius() const { return radius_; }  ///< to be tried next
  /** \brief Learns how far the mesh is from the points. \return true if that is it
   * \throws InvalidInput if even the least radius is not near enough */
  bool measured(double error);

 private:
  static constexpr int most_meshes = 12;
  static constexpr double narrow = 1.01;  // ratio of radii: 2 % of the vertices

  double max_error_, radius_, least_radius_;
  int meshes_ = 0;
  RadiusBracket bracket_;
};

/** \brief The radius, or the search for it that the options ask for. */
class RadiusSearch
{
 public:
  /** \param radius to begin with, or the one to be taken, if there are points to be meshed */
  RadiusSearch(const Options& options, double radius, double least_radius);

  [[nodiscard]] bool active() const { return count_.has_value() || error_.has_value(); }
  [[nodiscard]] double radius() const;
  /** \brief As VertexCountSearch::sampled(). */
  bool sampled(std::size_t seeds) { return !count_ || count_->sampled(seeds); }
  /** \brief True if the mesh is the one that is looked for; asks for no more than that takes. */
  bool meshed(const std::function<std::size_t()>& vertices, const std::function<double()>& error);

 private:
  double radius_;
  std::optional<VertexCountSearch> count_;
  std::optional<ErrorSearch> error_;
};

}  // namespace pds
