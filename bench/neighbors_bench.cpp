// SPDX-License-Identifier: BSD-3-Clause
// The neighbour search beside PCL's, FLANN's batch search and nanoflann, tree and all queries, over the same sorted
// points: those of a file, or random points of a torus.
//   pcl_pds_recon_neighbors_bench [--benchmark_...] [CLOUD]
#include <benchmark/benchmark.h>
#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl_pds_recon/nearest_neighbors.h>
#include <pcl_pds_recon/ordered_points.h>
#include <flann/flann.hpp>
#include <iostream>
#include <string>

#include "torus.h"

#if defined(HAVE_NANOFLANN)
#include <nanoflann.hpp>
#endif
#if defined(HAVE_READERS)
#include "io/read_points.h"
#endif

namespace pds
{
namespace
{

constexpr std::size_t k = 15;          // the library's default
constexpr std::size_t block = 4096;    // points; a few milliseconds of work
constexpr std::size_t leaf_size = 15;  // points per leaf of all the trees compared, as in pcl::KdTreeFLANN

using Positions = pds::PointArray<Eigen::Vector3f>;

/** \brief The points as each of the searches wants them. */
struct SortedCloud
{
  explicit SortedCloud(const PointCloudView& cloud) : points(order_points(cloud, Parallel()).position)
  {
    for (const Eigen::Vector3f& p : points) for_pcl->push_back({p.x(), p.y(), p.z()});
  }
  Positions points;
  pcl::PointCloud<pcl::PointXYZ>::Ptr for_pcl = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
};

void search_ours(const SortedCloud& cloud, const Parallel& parallel)
{
  benchmark::DoNotOptimize(nearest_neighbors(cloud.points, k, parallel));
}

void search_pcl(const SortedCloud& cloud, const Parallel& parallel)
{
  pcl::KdTreeFLANN<pcl::PointXYZ> tree;
  tree.setInputCloud(cloud.for_pcl);
  parallel.blocks(cloud.points.size(), block, [&](std::size_t begin, std::size_t end, unsigned) {
    pcl::Indices index;
    std::vector<float> squared_distance;
    for (std::size_t i = begin; i < end; ++i) {
      tree.nearestKSearch((*cloud.for_pcl)[i], static_cast<int>(k + 1), index,
                          squared_distance);  // and the point itself
      benchmark::DoNotOptimize(index.data());
    }
  });
}

void search_flann_batch(const SortedCloud& cloud, const Parallel& parallel)
{
  const Positions& points = cloud.points;
  const flann::Matrix<float> matrix(const_cast<float*>(points.front().data()), points.size(), 3);  // it is only read
  flann::Index<flann::L2_Simple<float>> tree(matrix, flann::KDTreeSingleIndexParams(leaf_size));
  tree.buildIndex();
  std::vector<int> index(points.size() * (k + 1));
  std::vector<float> squared_distance(points.size() * (k + 1));
  flann::Matrix<int> indices(index.data(), points.size(), k + 1);
  flann::Matrix<float> distances(squared_distance.data(), points.size(), k + 1);
  flann::SearchParams exact(flann::FLANN_CHECKS_UNLIMITED);
  exact.cores = static_cast<int>(parallel.threads());
  tree.knnSearch(matrix, indices, distances, k + 1, exact);
  benchmark::DoNotOptimize(index.data());
}

#if defined(HAVE_NANOFLANN)
/** \brief What nanoflann wants to know of a cloud. */
struct NanoflannCloud
{
  const Positions& points;
  [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
  [[nodiscard]] float kdtree_get_pt(std::size_t i, std::size_t axis) const
  {
    return points[i][static_cast<Eigen::Index>(axis)];
  }
  template <typename Box>
  bool kdtree_get_bbox(Box&) const
  {
    return false;
  }
};

void search_nanoflann(const SortedCloud& cloud, const Parallel& parallel)
{
  const Positions& points = cloud.points;
  using Metric = nanoflann::L2_Simple_Adaptor<float, NanoflannCloud, float, std::uint32_t>;
  using Tree = nanoflann::KDTreeSingleIndexAdaptor<Metric, NanoflannCloud, 3, std::uint32_t>;
  const NanoflannCloud adaptor{points};
  const Tree tree(3, adaptor, nanoflann::KDTreeSingleIndexAdaptorParams(leaf_size));
  std::vector<std::uint32_t> index(points.size() * (k + 1));
  parallel.blocks(points.size(), block, [&](std::size_t begin, std::size_t end, unsigned) {
    float squared_distance[k + 1];
    for (std::size_t i = begin; i < end; ++i)
      tree.knnSearch(points[i].data(), k + 1, index.data() + i * (k + 1), squared_distance);
  });
  benchmark::DoNotOptimize(index.data());
}
#endif

template <typename Search>
void add(const std::string& name, const SortedCloud& cloud, const Search& search)
{
  const auto run = [&cloud, search](benchmark::State& state) {
    const Parallel parallel(static_cast<unsigned>(state.range(0)));
    for (auto _ : state) search(cloud, parallel);
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(cloud.points.size()));
  };
  auto* const bench = benchmark::RegisterBenchmark(name.c_str(), run)->UseRealTime()->ArgName("threads");
  bench->Unit(benchmark::kMillisecond)->Arg(1);
  if (const unsigned cores = Parallel().threads(); cores > 1) bench->Arg(static_cast<int>(cores));
}

void add_all(const SortedCloud& cloud)
{
  add("ours", cloud, search_ours);
  add("pcl::KdTreeFLANN", cloud, search_pcl);
  add("flann batch", cloud, search_flann_batch);
#if defined(HAVE_NANOFLANN)
  add("nanoflann", cloud, search_nanoflann);
#endif
}

SortedCloud cloud_of(int argc, char** argv)
{
  constexpr std::size_t torus_points = 500000;
  if (argc < 2) {
    const std::vector<Eigen::Vector3f> points = torus(torus_points);
    PointCloudView view;
    view.size = points.size();
    view.positions = Vector3View(points.front().data(), sizeof(Eigen::Vector3f));
    return SortedCloud(view);
  }
#if defined(HAVE_READERS)
  return SortedCloud(read_points(argv[1], Parallel()).view());
#else
  throw InvalidInput(std::string(argv[1]) + ": this build reads no files, since the command tool was left out");
#endif
}

}  // namespace
}  // namespace pds

int main(int argc, char** argv)
{
  benchmark::Initialize(&argc, argv);
  try {
    const pds::SortedCloud cloud = pds::cloud_of(argc, argv);
    std::cout << cloud.points.size() << " points, " << pds::k << " neighbours\n";
    pds::add_all(cloud);
    benchmark::RunSpecifiedBenchmarks();
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
