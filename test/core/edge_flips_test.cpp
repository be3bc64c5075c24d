// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <pcl_pds_recon/edge_flips.h>

#include <algorithm>
#include <cmath>

#include "shapes.h"

/** \brief Edges that are turned to where the surface is. */
namespace pds_test
{
namespace
{

/** \brief Seeds with the points nearest to them, as the stages before give them. */
struct Cells
{
  /** \param height of the surface above the points of the square that the seeds span */
  template <typename Height>
  Cells(const Points& seeds, double half_side, const Height& height)
  {
    geometry.position = seeds;
    constexpr double step = 0.1;
    for (const Eigen::Vector3d& s : seeds)
      geometry.normal.push_back(Eigen::Vector3d(height(s.x() - step, s.y()) - height(s.x() + step, s.y()),
                                                height(s.x(), s.y() - step) - height(s.x(), s.y() + step), 2 * step)
                                    .normalized());
    constexpr int rows = 40;
    std::vector<std::vector<std::uint32_t>> cells(seeds.size());
    for (int i = 0; i < rows * rows; ++i) {
      const double x = half_side * ((i % rows + 0.5) / rows * 2 - 1);
      const double y = half_side * ((i / rows + 0.5) / rows * 2 - 1);
      const Eigen::Vector3d p(x, y, height(x, y));
      const auto nearest =
          std::min_element(seeds.begin(), seeds.end(), [&](const Eigen::Vector3d& s, const Eigen::Vector3d& t) {
            return (s - p).squaredNorm() < (t - p).squaredNorm();
          });
      cells[static_cast<std::size_t>(nearest - seeds.begin())].push_back(static_cast<std::uint32_t>(points.size()));
      points.push_back(p.cast<float>());
    }
    voronoi.cell_begin.push_back(0);
    for (const std::vector<std::uint32_t>& cell : cells) {
      for (const std::uint32_t point : cell) voronoi.cell_point.push_back(point);
      voronoi.cell_begin.push_back(voronoi.cell_point.size());
    }
    sampling.radius = 1;
  }

  [[nodiscard]] std::vector<pds::Triangle> flipped(std::vector<pds::Triangle> triangles) const
  {
    pds::flip_edges(geometry, points, sampling, voronoi, pds::Parallel(1), triangles);
    return triangles;
  }

  pds::SeedGeometry geometry;
  pds::PointArray<Eigen::Vector3f> points;
  pds::PoissonDiskSampling sampling;
  pds::GeodesicVoronoi voronoi;
};

double roof(double x, double) { return -0.6 * std::abs(x); }

/** \brief A square on its corner, with corners on a roof: 2 and 3 are on its ridge. */
Points square_on_roof() { return {{-0.8, 0, roof(-0.8, 0)}, {0.8, 0, roof(0.8, 0)}, {0, 0.8, 0}, {0, -0.8, 0}}; }

const std::vector<pds::Triangle> across_the_ridge = {{0, 1, 2}, {1, 0, 3}};
const std::vector<pds::Triangle> along_the_ridge = {{2, 3, 1}, {3, 2, 0}};

TEST(EdgeFlips, TurnAnEdgeAlongARidge)
{
  const Cells cells(square_on_roof(), 0.4, roof);
  EXPECT_EQ(cells.flipped(across_the_ridge), along_the_ridge);
  EXPECT_EQ(cells.flipped(along_the_ridge), along_the_ridge);
}

TEST(EdgeFlips, LeaveAnEdgeWhereTheSurfaceIsOnIt)
{
  const Cells valley(square_on_roof(), 0.4, [](double, double y) { return roof(0.8, 0) + 0.6 * std::abs(y); });
  EXPECT_EQ(valley.flipped(across_the_ridge), across_the_ridge);
  Points flat = square_on_roof();
  for (Eigen::Vector3d& p : flat) p.z() = 0;
  const Cells plane(flat, 0.4, [](double, double) { return 0.0; });
  EXPECT_EQ(plane.flipped(across_the_ridge), across_the_ridge);
}

TEST(EdgeFlips, MakeNoEdgeTwice)
{
  const Cells cells(square_on_roof(), 0.4, roof);
  const std::vector<pds::Triangle> tetrahedron = {{0, 1, 2}, {1, 0, 3}, {2, 1, 3}, {0, 2, 3}};
  EXPECT_EQ(cells.flipped(tetrahedron), tetrahedron);
}

TEST(EdgeFlips, MakeNoSliver)
{
  Points seeds = square_on_roof();
  seeds[1] = {0.1, 0, roof(0.1, 0)};
  const Cells cells(seeds, 0.4, roof);
  EXPECT_EQ(cells.flipped(across_the_ridge), across_the_ridge);
}

TEST(EdgeFlips, FoldNothing)
{
  const auto steep = [](double x, double) { return -2.2 * std::abs(x); };
  const Cells cells({{-0.8, 0, steep(-0.8, 0)}, {0.8, 0, steep(0.8, 0)}, {0, 1.6, 0}, {0, -1.6, 0}}, 0.4, steep);
  EXPECT_EQ(cells.flipped(across_the_ridge), across_the_ridge);
}

/** \brief A vertex high over the floor that the points are of: flipped, one face would lie on the floor, and the other
 * one stand against all that is beside it. */
TEST(EdgeFlips, TurnNoFaceOver)
{
  const auto floor = [](double, double) { return 0.0; };
  const Cells cells({{-0.8, 0, 0}, {-0.2, 0, 1.13}, {0, 0.8, 0}, {0, -0.8, 0}}, 0.8, floor);
  EXPECT_EQ(cells.flipped(across_the_ridge), across_the_ridge);
}

}  // namespace
}  // namespace pds_test
