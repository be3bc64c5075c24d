// SPDX-License-Identifier: BSD-3-Clause
#include "run_report.h"

#include <sys/resource.h>
#include <algorithm>
#include <limits>
#include "parallel_parts.h"

namespace pds
{

void report_sampling(const PoissonDiskSampling& sampling,
                     const OrderedPoints& points,
                     Report& report,
                     const Parallel& parallel)
{
  report.valid_points = points.valid_points;
  report.merged_points = points.merged_points;
  report.outliers = points.outliers;
  report.thinned_points = points.thinned_points;
  report.seeds = sampling.seeds.size();
  if (sampling.seeds.empty()) return;
  double nearest_pair = std::numeric_limits<double>::infinity();
  for (const std::uint32_t s : sampling.seeds)
    nearest_pair = std::min(nearest_pair, static_cast<double>(sampling.nearest[s].distance[1]));
  report.radius = sampling.radius * points.unit;
  // Disks are grown to disk_reach; seeds that are nowhere nearer than that to another are reported at it.
  report.min_seed_distance = std::min(nearest_pair / sampling.radius, disk_reach);
  constexpr std::size_t block = 65536;
  const std::vector<float> farthest_of_block = parallel_parts<float>(
      sampling.nearest.size(), block, parallel, [&](std::size_t begin, std::size_t end, float& farthest) {
        for (std::size_t i = begin; i < end; ++i) farthest = std::max(farthest, sampling.nearest[i].distance[0]);
      });
  const float farthest = *std::max_element(farthest_of_block.begin(), farthest_of_block.end());
  report.coverage_radius = static_cast<double>(farthest) / sampling.radius;
}

void report_certificate(Certificate certificate, Reconstruction& result)
{
  Report& report = result.report;
  report.vertices = certificate.vertices;
  report.faces = certificate.faces;
  report.edges = certificate.edges;
  report.components = certificate.components;
  report.boundary_loops = certificate.boundary_loops.size();
  report.nonmanifold_edges = certificate.nonmanifold_edges;
  report.nonmanifold_vertices = certificate.nonmanifold_vertices;
  report.inconsistent_edges = certificate.inconsistent_edges;
  report.euler = certificate.euler;
  report.closed = certificate.faces > 0 && certificate.boundary_loops.empty();
  result.boundary_loops = std::move(certificate.boundary_loops);
}

std::size_t peak_resident_bytes()
{
  rusage usage{};
  constexpr std::size_t bytes_per_kib = 1024;
  return getrusage(RUSAGE_SELF, &usage) == 0 ? static_cast<std::size_t>(usage.ru_maxrss) * bytes_per_kib : 0;
}

}  // namespace pds
