// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/orientation.h>

#include "core_testing.h"

namespace pds_test
{
namespace
{

using pds::OrientationCues;
using pds::TriangleComplex;

const Points square_corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
const Points octahedron_corners{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};

/** \brief Adds the triangles, each turned at random. */
void add_turned(TriangleComplex& complex, const Triangles& triangles, std::uint64_t seed)
{
  Random random(seed);
  for (auto t : triangles) {
    if (random.below(2) == 0) std::swap(t[0], t[1]);
    ASSERT_EQ(complex.add(t, 0.0), TriangleComplex::Verdict::legal);
  }
}

Triangles octahedron()
{
  Triangles faces;
  for (std::uint32_t i = 0; i < 4; ++i) {
    faces.push_back({i, (i + 1) % 4, 4});
    faces.push_back({i, (i + 1) % 4, 5});
  }
  return faces;
}

/** \brief z of the square's area vector: 1 if it faces up, -1 if it faces down. */
double facing(const OrientationCues& cues, std::uint64_t seed)
{
  TriangleComplex complex(square_corners);
  add_turned(complex, {{0, 1, 2}, {0, 2, 3}}, seed);
  double sum = 0;
  for (const pds::Triangle& t : pds::orient_faces(complex, cues)) {
    const Eigen::Vector3d side = square_corners[t[1]] - square_corners[t[0]];
    sum += 0.5 * side.cross(square_corners[t[2]] - square_corners[t[0]]).z();
  }
  return sum;
}

TEST(Orientation, TurnsAClosedSurfaceOutside)
{
  for (std::uint64_t seed = 0; seed < 16; ++seed) {
    TriangleComplex complex(octahedron_corners);
    add_turned(complex, octahedron(), seed);
    const MeshFacts facts = examine(pds::orient_faces(complex, {}), octahedron_corners);
    EXPECT_EQ(facts.inconsistent_edges, 0U);
    EXPECT_NEAR(facts.volume, 4.0 / 3.0, 1e-12);
  }
}

TEST(Orientation, ClosedSurfacesAreOutsideWhateverTheNormalsSay)
{
  OrientationCues cues;
  for (const Eigen::Vector3d& p : octahedron_corners) cues.normal.push_back(-p);
  TriangleComplex complex(octahedron_corners);
  add_turned(complex, octahedron(), 3);
  EXPECT_GT(examine(pds::orient_faces(complex, cues), octahedron_corners).volume, 0.0);
}

TEST(Orientation, TurnsAnOpenPlaneUp)
{
  for (std::uint64_t seed = 0; seed < 4; ++seed) EXPECT_NEAR(facing({}, seed), 1.0, 1e-12);
}

TEST(Orientation, FollowsTheNormals)
{
  for (const double z : {-1.0, 1.0}) {
    OrientationCues cues;
    cues.normal.assign(4, {0, 0, z});
    cues.viewpoint.assign(4, {0, 0, -10 * z});  // normals go first
    for (std::uint64_t seed = 0; seed < 4; ++seed) EXPECT_NEAR(facing(cues, seed), z, 1e-12);
  }
}

TEST(Orientation, IgnoresNormalsThatAreNotFinite)
{
  OrientationCues cues;
  cues.normal.assign(4, {0, 0, -1});
  cues.normal[1].setConstant(std::nan(""));
  EXPECT_NEAR(facing(cues, 0), -1.0, 1e-12);
}

TEST(Orientation, FacesTheSensor)
{
  for (const double z : {-3.0, 3.0}) {
    OrientationCues cues;
    cues.viewpoint.assign(4, {0.5, 0.2, z});
    for (std::uint64_t seed = 0; seed < 4; ++seed) EXPECT_GT(facing(cues, seed) * z, 0.0);
  }
}

TEST(Orientation, FollowsTheViewpointsThatAreKnown)
{
  for (const double z : {-3.0, 3.0}) {
    OrientationCues cues;
    cues.viewpoint.assign(4, Eigen::Vector3d::Constant(std::nan("")));
    cues.viewpoint[2] = {0.5, 0.2, z};
    for (std::uint64_t seed = 0; seed < 4; ++seed) EXPECT_GT(facing(cues, seed) * z, 0.0);
  }
}

TEST(Orientation, TurnsEachComponentByItself)
{
  Points position = octahedron_corners;
  for (const Eigen::Vector3d& p : octahedron_corners) position.push_back(p + Eigen::Vector3d(4, 0, 0));
  Triangles faces = octahedron();
  for (const auto& t : octahedron()) faces.push_back({t[0] + 6, t[1] + 6, t[2] + 6});
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    TriangleComplex complex(position);
    add_turned(complex, faces, seed);
    EXPECT_NEAR(examine(pds::orient_faces(complex, {}), position).volume, 8.0 / 3.0, 1e-12);
  }
}

}  // namespace
}  // namespace pds_test
