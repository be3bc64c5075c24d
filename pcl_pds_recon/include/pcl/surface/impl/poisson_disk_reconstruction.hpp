// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/common/io.h>
#include <pcl/console/print.h>
#include <pcl/conversions.h>
#include <pcl/surface/poisson_disk_reconstruction.h>

#include <cstddef>
#include <cstdint>
#include <vector>

template <typename PointInT>
pcl::PoissonDiskReconstruction<PointInT>::PoissonDiskReconstruction()
{
  // The base would choose a tree by the first cloud and keep it for the next; the core has a search of its own.
  check_tree_ = false;
}

template <typename PointInT>
void pcl::PoissonDiskReconstruction<PointInT>::reconstruct(pcl::PolygonMesh& output)
{
  if (!initReconstruction()) {
    output = pcl::PolygonMesh();
    return;
  }
  // Not through the base: it converts the whole input, and aborts where width times height is not the size.
  performReconstruction(output);
  deinitCompute();
}

template <typename PointInT>
void pcl::PoissonDiskReconstruction<PointInT>::reconstruct(std::vector<pcl::Vertices>& polygons)
{
  if (!initReconstruction()) {
    polygons.clear();
    return;
  }
  performReconstruction(polygons);
  deinitCompute();
}

template <typename PointInT>
void pcl::PoissonDiskReconstruction<PointInT>::performReconstruction(pcl::PolygonMesh& output)
{
  compute();
  // Not by pcl::copyPointCloud: it ignores the order of the indices if there are as many as points.
  pcl::PointCloud<PointInT> vertices(*input_, result_.seeds);
  detail::applyMoves(result_, describeInput(), reinterpret_cast<std::uint8_t*>(vertices.points.data()));
  vertices.is_dense = true;
  pcl::toPCLPointCloud2(vertices, output.cloud);
  output.header = input_->header;
  output.polygons = detail::meshPolygons(result_);
}

template <typename PointInT>
void pcl::PoissonDiskReconstruction<PointInT>::performReconstruction(std::vector<pcl::Vertices>& polygons)
{
  compute();
  polygons = detail::inputPolygons(result_);
}

template <typename PointInT>
bool pcl::PoissonDiskReconstruction<PointInT>::initReconstruction()
{
  result_ = detail::PoissonDiskResult();
  if (!input_) {
    result_.status = PoissonDiskStatus::no_input;
    result_.message = "no input cloud; call setInputCloud first";
    PCL_ERROR("[pcl::%s::reconstruct] %s\n", getClassName().c_str(), result_.message.c_str());
    return false;
  }
  // A copy of this object shares the indices that the base makes up, and the base resizes them in place.
  if (fake_indices_) indices_.reset();
  return initCompute();
}

template <typename PointInT>
pcl::detail::PointRecords pcl::PoissonDiskReconstruction<PointInT>::describeInput() const
{
  detail::PointRecords records;
  records.data = reinterpret_cast<const std::uint8_t*>(input_->points.data());
  records.stride = sizeof(PointInT);
  records.size = input_->points.size();
  records.fields = pcl::getFields<PointInT>();
  records.sensor_origin = input_->sensor_origin_.template head<3>().template cast<double>();
  return records;
}

template <typename PointInT>
void pcl::PoissonDiskReconstruction<PointInT>::compute()
{
  const Indices* chosen_points = fake_indices_ ? nullptr : indices_.get();
  result_ = detail::reconstructPoissonDisk(describeInput(), chosen_points, userSearch(), options_, progress_);
  if (result_.status != PoissonDiskStatus::success) {
    PCL_ERROR("[pcl::%s::performReconstruction] %s\n", getClassName().c_str(), result_.message.c_str());
  }
}

template <typename PointInT>
pcl::detail::NeighborSearch pcl::PoissonDiskReconstruction<PointInT>::userSearch()
{
  if (!tree_) return {};
  detail::NeighborSearch search;
  search.set_input = [this](const IndicesPtr& points) { tree_->setInputCloud(input_, points ? points : indices_); };
  // By point: the overload that takes a number counts in the tree's indices, not in the cloud.
  search.nearest_k = [this](index_t query, int k, Indices& neighbors) {
    std::vector<float> squared_distances;
    return tree_->nearestKSearch((*input_)[static_cast<std::size_t>(query)], k, neighbors, squared_distances);
  };
  return search;
}

#define PCL_INSTANTIATE_PoissonDiskReconstruction(T) template class PCL_EXPORTS pcl::PoissonDiskReconstruction<T>;
