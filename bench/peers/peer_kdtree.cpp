// SPDX-License-Identifier: BSD-3-Clause
// No peer but the yardstick: PCL's k-d tree is built on the cloud and asked for the PARAMETER nearest of every point.
// The points come in Morton order, the best case for the tree; sorting is not measured. There is no mesh.
#include <pcl/kdtree/kdtree_flann.h>
#include <pcl_pds_recon/ordered_points.h>

#include <algorithm>
#include <thread>

#include "peer_run.h"

namespace
{

using Tree = pcl::KdTreeFLANN<pcl::PointXYZ>;

peers::Cloud::Ptr in_morton_order(const peers::Cloud& cloud, unsigned threads)
{
  pds::PointCloudView view;
  view.size = cloud.size();
  view.positions = pds::Vector3View(&cloud.front().x, sizeof(pcl::PointXYZ));
  const pds::OrderedPoints ordered = pds::order_points(view, pds::Parallel(threads));
  const peers::Cloud::Ptr sorted(new peers::Cloud);
  for (const std::uint32_t i : ordered.input_index) sorted->push_back(cloud[i]);
  return sorted;
}

void query(const Tree& tree, const peers::Cloud& cloud, std::size_t begin, std::size_t end, int k)
{
  pcl::Indices indices;
  std::vector<float> squared_distances;
  for (std::size_t i = begin; i < end; ++i) tree.nearestKSearch(cloud[i], k, indices, squared_distances);
}

peers::Mesh search_all(const peers::Cloud::Ptr& cloud, const peers::Arguments& arguments, peers::Measurement& measured)
{
  const peers::Cloud::Ptr sorted = in_morton_order(*cloud, arguments.threads);
  const int k = static_cast<int>(arguments.parameter);
  measured.start();
  Tree tree;
  tree.setInputCloud(sorted);
  std::vector<std::thread> workers;
  for (unsigned t = 0; t < arguments.threads; ++t) {
    const std::size_t begin = sorted->size() * t / arguments.threads;
    const std::size_t end = sorted->size() * (t + 1) / arguments.threads;
    workers.emplace_back(query, std::cref(tree), std::cref(*sorted), begin, end, k);
  }
  for (std::thread& worker : workers) worker.join();
  measured.stop();
  return {};
}

}  // namespace

int main(int argc, char** argv) { return peers::run(argc, argv, search_all); }
