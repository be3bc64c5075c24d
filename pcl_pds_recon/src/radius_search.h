// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_pds_recon/options.h>
#include <pcl_pds_recon/poisson_disk_sampling.h>
#include <cstddef>
#include <functional>
#include <optional>

#include "count_search.h"
#include "radius_bracket.h"

namespace pds
{

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
  [[nodiscard]] SteadyCount steady() const { return count_ ? count_->steady() : SteadyCount(); }
  /** \brief As VertexCountSearch::sampled(). */
  bool sampled(const PoissonDiskSampling& sampling) { return !count_ || count_->sampled(sampling); }
  /** \brief True if the mesh is the one that is looked for; asks for no more than that takes. */
  bool meshed(const std::function<std::size_t()>& vertices, const std::function<double()>& error);

 private:
  double radius_;
  std::optional<VertexCountSearch> count_;
  std::optional<ErrorSearch> error_;
};

}  // namespace pds
