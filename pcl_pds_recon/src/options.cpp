// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/options.h>
#include <cmath>

namespace pds
{
namespace
{

void require(bool ok, const char* what)
{
  if (!ok) throw InvalidOption(what);
}

/** \brief What is meant for surfaces alone must be at its default if there may be curves. */
void validate_dimension(const Options& options)
{
  if (options.dimension == Dimension::surface) return;
  require(options.vertices == 0, "vertices can be asked for of surfaces only; give a radius, or dimension 2");
  require(options.max_error == 0, "max_error can be asked for of surfaces only; give a radius, or dimension 2");
  require(options.adaptive == 0, "adaptive is for surfaces only; leave it out, or take dimension 2");
  require(options.relax == 0, "relax is for surfaces only; leave it out, or take dimension 2");
  require(options.placement == Placement::point, "placement off the points is for surfaces only; take dimension 2");
}

bool within(double value, double low, double high) { return value >= low && value <= high; }  // false for NaN

}  // namespace

void validate(const Options& options)
{
  require(options.k_neighbors >= 4 && options.k_neighbors <= 200, "k_neighbors must be 4 to 200");
  require(within(options.radius_factor, 1.5, 1000), "radius_factor must be 1.5 to 1000 sampling intervals");
  require(options.radius >= 0 && std::isfinite(options.radius), "radius must be 0 (automatic) or positive and finite");
  require(options.vertices == 0 || (options.vertices >= 4 && options.vertices <= std::uint64_t{1} << 31),
          "vertices must be 0 (by the radius) or 4 to 2^31");
  require(options.max_error >= 0 && std::isfinite(options.max_error),
          "max_error must be 0 (by the radius) or positive and finite");
  require(options.vertices == 0 || options.max_error == 0, "max_error and vertices exclude each other; give one");
  require(options.relax <= 100, "relax must be 0 to 100 steps");
  require(within(options.adaptive, 0, 2), "adaptive must be 0 (uniform) to 2");
  require(within(options.voronoi_threshold, 0, 1), "voronoi_threshold must be 0 to 1 radii");
  require(options.threads <= 1024, "threads must be 0 (all cores) to 1024");
  require(options.hole_size >= 0 && std::isfinite(options.hole_size), "hole_size must be 0 or positive and finite");
  validate_dimension(options);
}

}  // namespace pds
