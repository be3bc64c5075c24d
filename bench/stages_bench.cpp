// SPDX-License-Identifier: BSD-3-Clause
// Points per second of each stage on random points of a torus, with one thread and with all cores.
//   pcl_pds_recon_bench --benchmark_filter=sample_poisson_disks
#include <benchmark/benchmark.h>
#include <pcl_pds_recon/hole_filling.h>
#include <pcl_pds_recon/nearest_neighbors.h>
#include <pcl_pds_recon/reconstruction.h>
#include <optional>
#include "torus.h"

namespace pds
{
namespace
{

constexpr GeodesicSolver solver = GeodesicSolver::fast_marching;

/** \brief What every stage needs from those before it. */
struct Stages
{
  explicit Stages(std::size_t count) : input(torus(count))
  {
    options.adaptive = 0.25;  // a middle one of the paper's coefficients
    cloud.size = input.size();
    cloud.positions = Vector3View(input.front().data(), sizeof(Eigen::Vector3f));
    points = order_points(cloud, all_cores);
    graph = build_neighbor_graph(points, cloud, options.k_neighbors, all_cores);
    surface = estimate_surface(points, graph, all_cores);
    weights = curvature_weights(surface, graph, options.adaptive, {options.radius_factor, true}, all_cores);
    ranks = feature_ranks(points, surface, graph, all_cores);
    const double radius = options.radius_factor * mean_weighted_interval(points, graph, weights, all_cores);
    sampling = sample_poisson_disks(points, graph, surface, weights, ranks, radius, solver, 0, all_cores);
    voronoi = build_geodesic_voronoi(points, graph, weights, sampling, options.voronoi_threshold, all_cores);
    seeds = describe_seeds(cloud, points, surface, sampling, voronoi, all_cores);
    seed_graph = build_seed_graph(seeds, voronoi.pairs, all_cores);
  }

  const Parallel all_cores;
  Options options;
  std::vector<Eigen::Vector3f> input;
  PointCloudView cloud;
  OrderedPoints points;
  NeighborGraph graph;
  SurfaceEstimate surface;
  EdgeWeights weights;
  std::vector<std::uint8_t> ranks;
  PoissonDiskSampling sampling;
  GeodesicVoronoi voronoi;
  SeedGeometry seeds;
  SeedGraph seed_graph;
};

/** \brief The stages of a torus; only the last size asked for is kept, a million points take some hundred megabytes. */
const Stages& stages_of(std::size_t count)
{
  static std::optional<Stages> last;
  if (!last || last->cloud.size != count) last.emplace(count);
  return *last;
}

std::vector<std::uint32_t> faces_and_holes(const Stages& s, const Parallel& parallel)
{
  const SeedFaces faces = trace_faces(s.seed_graph, s.seeds, parallel);
  TriangleComplex complex(s.seeds.position, parallel);
  add_dual_triangles(complex, faces.triangles, s.voronoi.triples);
  fill_holes(complex, s.seeds, BorderingCells(s.voronoi.pairs), faces.polygons, FillLimits{});
  return complex.faces();
}

Reconstruction whole_run(const Stages& s, const Parallel& parallel)
{
  Options options = s.options;
  options.threads = parallel.threads();
  return reconstruct(s.cloud, options);
}

/** \brief Registers one stage for all sizes; a stage that has threads, with one and with all cores. */
template <typename Stage>
void add(const char* name, bool threaded, const Stage& stage)
{
  const auto run = [stage](benchmark::State& state) {
    const Stages& stages = stages_of(static_cast<std::size_t>(state.range(0)));
    const Parallel parallel(static_cast<unsigned>(state.range(1)));
    for (auto _ : state) benchmark::DoNotOptimize(stage(stages, parallel));
    state.SetItemsProcessed(state.iterations() * state.range(0));
  };
  // Wall-clock time: the processor time of the calling thread says nothing about the other workers.
  auto* const bench = benchmark::RegisterBenchmark(name, run)->UseRealTime()->ArgNames({"points", "threads"});
  const unsigned cores = Parallel().threads();
  for (const int points : {1 << 14, 1 << 17, 1 << 20}) {
    bench->Args({points, 1});
    if (threaded && cores > 1) bench->Args({points, static_cast<int>(cores)});
  }
}

void add_stages()
{
  add("order_points", true, [](const Stages& s, const Parallel& p) { return order_points(s.cloud, p); });
  add("nearest_neighbors", true, [](const Stages& s, const Parallel& p) {
    return nearest_neighbors(s.points.position, static_cast<std::size_t>(s.options.k_neighbors), p);
  });
  add("build_neighbor_graph", true, [](const Stages& s, const Parallel& p) {
    return build_neighbor_graph(s.points, s.cloud, s.options.k_neighbors, p);
  });
  add("estimate_surface", true,
      [](const Stages& s, const Parallel& p) { return estimate_surface(s.points, s.graph, p); });
  add("sample_poisson_disks", true, [](const Stages& s, const Parallel& p) {
    return sample_poisson_disks(s.points, s.graph, s.surface, s.weights, s.ranks, s.sampling.radius, solver, 0, p);
  });
  add("build_geodesic_voronoi", true, [](const Stages& s, const Parallel& p) {
    return build_geodesic_voronoi(s.points, s.graph, s.weights, s.sampling, s.options.voronoi_threshold, p);
  });
  add("seed_graph", true, [](const Stages& s, const Parallel& p) {
    return build_seed_graph(describe_seeds(s.cloud, s.points, s.surface, s.sampling, s.voronoi, p), s.voronoi.pairs, p);
  });
  add("faces_and_holes", true, faces_and_holes);
  add("reconstruct", true, whole_run);
}

}  // namespace
}  // namespace pds

int main(int argc, char** argv)
{
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  pds::add_stages();
  benchmark::RunSpecifiedBenchmarks();
}
