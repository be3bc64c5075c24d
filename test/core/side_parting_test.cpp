// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/side_parting.h>

#include <algorithm>
#include <cmath>

#include "core_testing.h"

/** \brief Land that was seen from above faces up, and is parted where it was joined upside down. */
namespace pds_test
{
namespace
{

constexpr std::size_t count = small_cloud;

/** \brief Random points on a strip of width 1 along y, over a polyline in the x-z plane. */
Points strip(const Points& profile, std::uint64_t seed)
{
  double length = 0;
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) length += (profile[i + 1] - profile[i]).norm();
  Random random(seed);
  Points points;
  for (std::size_t n = 0; n < count; ++n) {
    double at = length * random.uniform();
    std::size_t i = 0;
    for (; i + 2 < profile.size() && at > (profile[i + 1] - profile[i]).norm(); ++i)
      at -= (profile[i + 1] - profile[i]).norm();
    points.emplace_back(profile[i] + at * (profile[i + 1] - profile[i]).normalized());
    points.back().y() = random.uniform();
  }
  return points;
}

/** \brief The land goes on below an overhanging roof, and up behind it to its rim: as scans from the air may show it.
 */
Points land_below_a_roof(std::uint64_t seed)
{
  return strip({{-5, 0, 0}, {0.4, 0, 0}, {0.4, 0, 0.3}, {0, 0, 0.3}}, seed);
}

/** \brief Shares of the area that lies, by the side that it faces. */
struct Lying
{
  double up = 0;
  double down = 0;
};

Lying lying(const pds::Reconstruction& mesh, const Points& points, int axis = 2)
{
  const Points at = vertex_positions(mesh, points);
  Lying area;
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d across = 0.5 * (at[t[1]] - at[t[0]]).cross(at[t[2]] - at[t[0]]);
    if (std::abs(across[axis]) > 0.7 * across.norm()) (across[axis] > 0 ? area.up : area.down) += across.norm();
  }
  return area;
}

TEST(SideParting, TurnsUpBothTheLandAndTheRoofThatItWasJoinedTo)
{
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
    const Points points = land_below_a_roof(seed);
    const pds::Reconstruction mesh = reconstruct(points);
    expect_sound(mesh, points);
    EXPECT_EQ(mesh.report.components, 2U);
    const Lying area = lying(mesh, points);
    EXPECT_GT(area.up, 5.5);
    EXPECT_LT(area.down, 0.05);
  }
}

TEST(SideParting, FindsAboveWhereYGrowsIfNotZ)
{
  Points points = land_below_a_roof(5);
  for (Eigen::Vector3d& p : points) p = Eigen::Vector3d(p.x(), p.z(), -p.y());
  const pds::Reconstruction mesh = reconstruct(points);
  EXPECT_EQ(mesh.report.components, 2U);
  EXPECT_LT(lying(mesh, points, 1).down, 0.05);
}

/** \brief As much of it is hidden as open: nothing tells that it was seen from above. */
TEST(SideParting, LeavesAFoldedSheetWhole)
{
  const Points points = strip({{0, 0, 0}, {1, 0, 0}, {1, 0, 0.25}, {0, 0, 0.25}}, 6);
  const pds::Reconstruction mesh = reconstruct(points);
  expect_sound(mesh, points);
  EXPECT_EQ(mesh.report.components, 1U);
}

TEST(SideParting, BelievesNormalsAndSensorsInstead)
{
  const Points points = land_below_a_roof(7);
  pds::PointCloudView cloud = view_of(points);
  cloud.sensor_origin = Eigen::Vector3d(-2, 0.5, -5);
  const pds::Reconstruction mesh = pds::reconstruct(cloud, {});
  EXPECT_EQ(mesh.report.components, 1U);
  EXPECT_GT(lying(mesh, points).down, 5);
}

/** \brief Ground below a bridge is hidden: its side is not known, and that it hangs together with the rest decides. */
TEST(SideParting, LeavesGroundBelowABridgeJoined)
{
  Points points = strip({{-3, 0, 0}, {3, 0, 0}}, 8);
  Random random(9);
  for (std::size_t n = 0; n < count / 20; ++n)
    points.emplace_back(0.15 * (2 * random.uniform() - 1), random.uniform(), 0.5);
  const pds::Reconstruction mesh = reconstruct(points);
  expect_sound(mesh, points);
  EXPECT_EQ(mesh.report.components, 2U);
  EXPECT_EQ(lying(mesh, points).down, 0);
  EXPECT_NEAR(lying(mesh, points).up, 6.3, 0.2);
}

/** \brief Two rows of squares that meet at a right angle at x = 0; the second stands up. */
class Bent : public testing::Test
{
 protected:
  static constexpr std::uint32_t length = 8;
  static constexpr std::uint32_t width = 6;

  Bent() : position_(corners()), complex_(position_)
  {
    const auto corner = [](std::uint32_t x, std::uint32_t y) { return x * (width + 1) + y; };
    for (std::uint32_t x = 0; x < 2 * length; ++x)
      for (std::uint32_t y = 0; y < width; ++y) {
        complex_.add({corner(x, y), corner(x + 1, y), corner(x + 1, y + 1)}, 0.0);
        complex_.add({corner(x, y), corner(x + 1, y + 1), corner(x, y + 1)}, 0.0);
      }
  }

  static Points corners()
  {
    Points corners;
    for (std::uint32_t x = 0; x <= 2 * length; ++x)
      for (std::uint32_t y = 0; y <= width; ++y)
        corners.emplace_back(x < length ? x : length, y, x < length ? 0 : x - length);
    return corners;
  }

  Points position_;
  pds::TriangleComplex complex_;
};

TEST_F(Bent, StaysWholeIfItsSidesAgreeOrNothingIsKnown)
{
  const std::size_t faces = complex_.faces().size();
  EXPECT_EQ(pds::part_sides(complex_, {}), 0U);
  Points outward(position_.size(), {-1, 0, 1});
  EXPECT_EQ(pds::part_sides(complex_, outward), 0U);
  EXPECT_EQ(complex_.faces().size(), faces);
}

/** \brief The sides change in the midst of the row that stands: it is parted at the bend, where it is sharpest. */
TEST_F(Bent, IsPartedAtTheBend)
{
  Points outward(position_.size(), Eigen::Vector3d::Zero());
  for (std::size_t v = 0; v < position_.size(); ++v) {
    if (position_[v].z() == 0) outward[v] = {0, 0, 1};
    if (position_[v].z() > length / 2.0) outward[v] = {1, 0, 0};
  }
  EXPECT_GT(pds::part_sides(complex_, outward), 0U);
  const auto parts = complex_.components();
  ASSERT_EQ(parts.size(), 2U);
  for (const auto& part : parts) {
    EXPECT_GE(part.size(), 2U * width * (length - 1));
    bool lies = false;
    bool stands = false;
    for (const std::uint32_t f : part)
      for (const std::uint32_t v : complex_.oriented(f)) {
        lies = lies || position_[v].x() < length;
        stands = stands || position_[v].z() > 0;
      }
    EXPECT_NE(lies, stands);
  }
}

/** \brief A few faces on the wrong side are noise. */
TEST_F(Bent, StaysWholeIfOnlyAFewFacesDisagree)
{
  Points outward(position_.size(), {-1, 0, 1});
  for (const std::size_t v : {9U, 10U, 16U, 17U}) outward[v] = {0, 0, -1};
  EXPECT_EQ(pds::part_sides(complex_, outward), 0U);
}

}  // namespace
}  // namespace pds_test
