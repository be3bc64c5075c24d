// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_pds_recon/poisson_disk_sampling.h>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "radius_bracket.h"

namespace pds
{

/** \brief Finds the radius that gives a mesh of so many vertices.
 *
 * Their count goes like one over the squared radius, with some random scatter. Sampling is repeated until the seeds
 * are as many as wanted; the mesh then tells how many of them have a face, and more or fewer seeds are asked for.
 *
 * On a lattice many pairs of seeds are equally far apart: their count jumps where the radius passes that distance, and
 * elsewhere changes only with the cells of the sampling. So there the count is made steady: the cells stay as they are,
 * points draw radii that differ by as little as distances are rounded, and between two radii that gave too many and too
 * few seeds the next one is found by the share of distances that are below it.
 */
class VertexCountSearch
{
 public:
  /** \param radius to begin with */
  VertexCountSearch(std::uint64_t vertices, double radius);

  [[nodiscard]] double radius() const { return radius_; }              ///< to be tried next
  [[nodiscard]] const SteadyCount& steady() const { return steady_; }  ///< likewise
  /** \brief Learns how many seeds the radius gave. \return true if these are to be meshed */
  bool sampled(const PoissonDiskSampling& sampling);
  /** \brief Learns how many vertices the mesh of these seeds has. \return true if that is it */
  bool meshed(std::size_t vertices);

 private:
  /** \brief A radius, and the seeds it gave. */
  struct Trial
  {
    double radius = 0;
    SteadyCount steady;
    double seeds = 0;
    std::vector<float> distances;  ///< from each seed to its nearest one, ascending
  };

  static constexpr int most_guesses = 20;    // for one count of seeds: it is more uneven than guesses take it to be
  static constexpr int most_samplings = 30;  // likewise: the bracket is then at the scatter's scale
  static constexpr int most_meshes = 8;

  void learn();
  void begin_steady_count();
  [[nodiscard]] bool is_steady() const { return steady_.radius_of_cells > 0; }
  [[nodiscard]] double next_radius() const;
  [[nodiscard]] double radius_by_distances() const;

  double vertices_;
  double seeds_;  ///< wanted
  double radius_;
  SteadyCount steady_;
  double best_miss_;
  double tolerance_;
  int samplings_ = 0;
  int meshes_ = 0;
  Trial last_, best_;
  Trial low_, high_;  ///< at the ends of the bracket
  RadiusBracket bracket_;
  Trial first_low_, first_high_;  ///< when the count became steady
  int too_few_ = 0;               ///< trials since the lower end was tried, if that was with other cells
};

}  // namespace pds
