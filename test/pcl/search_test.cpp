// SPDX-License-Identifier: BSD-3-Clause
// A search object that the user set is honoured, whatever it returns.
#include <pcl/search/kdtree.h>

#include <limits>
#include <stdexcept>

#include "test_clouds.h"

namespace pcl_test
{
namespace
{

using pcl::PointXYZ;
using pcl::PoissonDiskStatus;
using Reconstruction = pcl::PoissonDiskReconstruction<PointXYZ>;

/** \brief How a search object departs from what one might take for granted. */
enum class Manner
{
  plain,
  reversed,          ///< farthest neighbour first
  short_of_k,        ///< never more than 10 neighbours
  padded,            ///< the same, filled up with zeros to the number asked for
  out_of_selection,  ///< adds points that do not exist, are invalid, or do not take part
  throwing
};

/** \brief PCL's k-d tree with a manner of its own, counting its calls. */
class RecordingSearch : public pcl::search::KdTree<PointXYZ>
{
 public:
  using Base = pcl::search::KdTree<PointXYZ>;
  using Base::nearestKSearch;

  explicit RecordingSearch(Manner manner = Manner::plain) : manner_(manner) {}

  void setInputCloud(const PointCloudConstPtr& cloud, const pcl::IndicesConstPtr& indices = {}) override
  {
    given_cloud = cloud;
    given_indices = indices;
    Base::setInputCloud(cloud, indices);
  }

  int nearestKSearch(const PointXYZ& point, int k, pcl::Indices& found, std::vector<float>& distances) const override
  {
    ++queries;
    if (manner_ == Manner::throwing) throw std::runtime_error("the search failed");
    const bool is_short = manner_ == Manner::short_of_k || manner_ == Manner::padded;
    const int limit = is_short ? std::min(k, 10) : k;
    const int count = Base::nearestKSearch(point, limit, found, distances);
    if (manner_ == Manner::reversed) {
      std::reverse(found.begin(), found.end());
      std::reverse(distances.begin(), distances.end());
    }
    if (manner_ == Manner::padded) found.resize(static_cast<std::size_t>(k), 0);
    if (manner_ != Manner::out_of_selection) return count;
    found.insert(found.begin(), strangers.begin(), strangers.end());
    return count + static_cast<int>(strangers.size());
  }

  pcl::Indices strangers;
  PointCloudConstPtr given_cloud;
  pcl::IndicesConstPtr given_indices;
  mutable std::size_t queries = 0;

 private:
  Manner manner_;
};
using RecordingSearchPtr = pcl::shared_ptr<RecordingSearch>;

TEST(PoissonDiskReconstructionSearch, IsHonouredAndGivesTheSameMesh)
{
  const auto cloud = makeSphere<PointXYZ>();
  const RecordingSearchPtr search(new RecordingSearch);
  Reconstruction reconstruction;
  reconstruction.setInputCloud(cloud);
  reconstruction.setSearchMethod(search);
  const Outcome outcome = reconstruct(reconstruction);
  EXPECT_GE(search->queries, cloud->size());
  EXPECT_EQ(search->given_cloud, cloud);
  EXPECT_EQ(reconstruction.getSearchMethod(), search);
  ASSERT_FALSE(outcome.mesh.empty());
  EXPECT_TRUE(outcome == reconstructFresh<PointXYZ>(cloud));
}

TEST(PoissonDiskReconstructionSearch, GetsTheCheckedIndices)
{
  const auto cloud = makeSphere<PointXYZ>();
  const pcl::IndicesPtr indices = upperHalfTwice(*cloud);
  const std::set<pcl::index_t> expected_indices(indices->begin(), indices->end());
  Reconstruction reconstruction;
  reconstruction.setInputCloud(cloud);
  reconstruction.setIndices(indices);
  const Outcome expected = reconstruct(reconstruction);
  const RecordingSearchPtr search(new RecordingSearch);
  reconstruction.setSearchMethod(search);
  const Outcome outcome = reconstruct(reconstruction);
  ASSERT_TRUE(search->given_indices);
  EXPECT_EQ(*search->given_indices, pcl::Indices(expected_indices.begin(), expected_indices.end()));
  ASSERT_FALSE(outcome.mesh.empty());
  EXPECT_TRUE(outcome == expected);
}

TEST(PoissonDiskReconstructionSearch, OrderOfNeighboursDoesNotMatter)
{
  const auto cloud = makeSphere<PointXYZ>();
  Reconstruction reconstruction;
  reconstruction.setInputCloud(cloud);
  reconstruction.setSearchMethod(RecordingSearchPtr(new RecordingSearch(Manner::reversed)));
  EXPECT_TRUE(reconstruct(reconstruction) == reconstructFresh<PointXYZ>(cloud));
}

TEST(PoissonDiskReconstructionSearch, FewerNeighboursThanAskedForWillDo)
{
  const RecordingSearchPtr search(new RecordingSearch(Manner::short_of_k));
  Reconstruction reconstruction;
  reconstruction.setInputCloud(makeSphere<PointXYZ>());
  reconstruction.setSearchMethod(search);
  std::vector<pcl::Vertices> polygons;
  reconstruction.reconstruct(polygons);
  EXPECT_EQ(reconstruction.getStatus(), PoissonDiskStatus::success);
  EXPECT_GT(search->queries, 0u);
  expectSurface(polygons);
}

TEST(PoissonDiskReconstructionSearch, EntriesBeyondTheReportedCountAreNotNeighbours)
{
  const auto cloud = makeSphere<PointXYZ>();
  Reconstruction reconstruction;
  reconstruction.setInputCloud(cloud);
  reconstruction.setSearchMethod(RecordingSearchPtr(new RecordingSearch(Manner::short_of_k)));
  const Outcome expected = reconstruct(reconstruction);
  reconstruction.setSearchMethod(RecordingSearchPtr(new RecordingSearch(Manner::padded)));
  EXPECT_TRUE(reconstruct(reconstruction) == expected);
}

TEST(PoissonDiskReconstructionSearch, PointsThatDoNotTakePartAreIgnored)
{
  const auto cloud = makeSphere<PointXYZ>();
  const auto last = static_cast<pcl::index_t>(cloud->size());
  cloud->push_back(PointXYZ(std::nanf(""), 0.0f, 0.0f));
  cloud->push_back(PointXYZ(0.0f, 0.0f, 1.1f));
  const pcl::IndicesPtr indices(new pcl::Indices);
  for (pcl::index_t i = 0; i <= last; ++i) indices->push_back(i);
  Reconstruction reconstruction;
  reconstruction.setInputCloud(cloud);
  reconstruction.setIndices(indices);
  const Outcome expected = reconstruct(reconstruction);

  const RecordingSearchPtr search(new RecordingSearch(Manner::out_of_selection));
  search->strangers = {-1, last, last + 1, last + 2, std::numeric_limits<pcl::index_t>::max()};
  reconstruction.setSearchMethod(search);
  const Outcome outcome = reconstruct(reconstruction);
  ASSERT_FALSE(outcome.mesh.empty());
  EXPECT_TRUE(outcome == expected);
}

TEST(PoissonDiskReconstructionSearch, AnExceptionBecomesAStatus)
{
  Reconstruction reconstruction;
  reconstruction.setInputCloud(makeSphere<PointXYZ>());
  reconstruction.setSearchMethod(RecordingSearchPtr(new RecordingSearch(Manner::throwing)));
  EXPECT_TRUE(reconstruct(reconstruction).mesh.empty());
  EXPECT_EQ(reconstruction.getStatus(), PoissonDiskStatus::failed);
  EXPECT_EQ(reconstruction.getStatusMessage(), "the search failed");
}

TEST(PoissonDiskReconstructionSearch, IsReusedForAnotherCloudAndCanBeTakenBack)
{
  const auto wall = makeOrganizedWall(100, 80);
  const auto sphere = makeSphere<PointXYZ>();
  const RecordingSearchPtr search(new RecordingSearch);
  Reconstruction reconstruction;
  reconstruction.setSearchMethod(search);
  for (const auto& cloud : {wall, sphere}) {
    reconstruction.setInputCloud(cloud);
    const Outcome outcome = reconstruct(reconstruction);
    EXPECT_EQ(search->given_cloud, cloud);
    EXPECT_TRUE(outcome == reconstructFresh<PointXYZ>(cloud));
  }
  const std::size_t queries = search->queries;
  reconstruction.setSearchMethod(nullptr);
  EXPECT_FALSE(reconstruct(reconstruction).mesh.empty());
  EXPECT_EQ(search->queries, queries);
}

}  // namespace
}  // namespace pcl_test
