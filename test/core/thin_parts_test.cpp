// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include "core_testing.h"
#include "scan.h"

/** \brief Thin parts of real objects: are they in the mesh, whole? */
namespace pds_test
{
namespace
{

using Eigen::Vector3d;

double distance_to_segment(const Vector3d& p, const Vector3d& a, const Vector3d& b)
{
  const double share = (p - a).dot(b - a) / (b - a).squaredNorm();
  return (p - a - std::clamp(share, 0.0, 1.0) * (b - a)).norm();
}

double distance_to_face(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c)
{
  const Vector3d normal = (b - a).cross(c - a).normalized();
  const auto is_left = [&](const Vector3d& from, const Vector3d& to) {
    return (to - from).cross(p - from).dot(normal) >= 0;
  };
  if (is_left(a, b) && is_left(b, c) && is_left(c, a)) return std::abs((p - a).dot(normal));
  return std::min({distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
}

/** \brief A part of an object that is narrower than anything else of it. */
struct ThinPart
{
  const char* name;
  const char* reference;  ///< a finer mesh of the object
  Eigen::AlignedBox3d box;

  friend void PrintTo(const ThinPart& part, std::ostream* stream) { *stream << part.name; }
};

const ThinPart horns{"horns", "dragon_vrip.ply", {Vector3d(-0.11, 0.183, -0.05), Vector3d(0.0, 0.2, 0.02)}};
const ThinPart ears{"ears", "bun_zipper.ply", {Vector3d(-0.1, 0.15, -0.07), Vector3d(0.0, 0.19, 0.05)}};

using ScanOfPart = std::tuple<ThinPart, const char*, bool>;  // part, scan, with its normals if it has some

class ThinParts : public testing::TestWithParam<ScanOfPart>
{
};

INSTANTIATE_TEST_SUITE_P(Scans,
                         ThinParts,
                         testing::Values(ScanOfPart{horns, "dragon_stand_rawscans.ply", true},
                                         ScanOfPart{horns, "dragon_stand_rawscans.ply", false},
                                         ScanOfPart{horns, "dragon_vrip.ply", false},
                                         ScanOfPart{ears, "bunny_rawscans.ply", true},
                                         ScanOfPart{ears, "bunny_rawscans.ply", false},
                                         ScanOfPart{ears, "bun_zipper.ply", false}),
                         [](const auto& test) {
                           const std::string file = std::get<1>(test.param);
                           return file.substr(0, file.find('.')) + (std::get<2>(test.param) ? "WithNormals" : "");
                         });

TEST_P(ThinParts, AreWhole)
{
  const auto& [part, file, normals] = GetParam();
  SKIP_IF_ABSENT(file);
  SKIP_IF_ABSENT(part.reference);
  const Scan scan(file);
  const pds::Reconstruction mesh = pds::reconstruct(normals ? scan.table.view() : view_of(scan.points), pds::Options());
  const Points position = vertex_positions(mesh, scan.points);
  const double radius = mesh.report.radius;

  for (const auto& loop : mesh.boundary_loops)
    EXPECT_TRUE(std::none_of(loop.begin(), loop.end(), [&, &box = part.box](std::uint32_t v) {
      return box.contains(position[v]);
    })) << "there is a hole";

  // Faces that may be the nearest ones to a point within the box, unless all are farther than two radii.
  Eigen::AlignedBox3d around = part.box;
  around.extend(part.box.min() - Vector3d::Constant(4 * radius));
  around.extend(part.box.max() + Vector3d::Constant(4 * radius));
  Triangles near;
  for (const auto& t : mesh.triangles)
    if (std::any_of(t.begin(), t.end(), [&](std::uint32_t v) { return around.contains(position[v]); }))
      near.push_back(t);

  std::vector<double> distances;  // in radii
  for (const Vector3d& p : Scan(part.reference).points) {
    if (!part.box.contains(p)) continue;
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& [a, b, c] : near)
      nearest = std::min(nearest, distance_to_face(p, position[a], position[b], position[c]));
    distances.push_back(nearest / radius);
  }
  ASSERT_GT(distances.size(), 1000U);
  std::sort(distances.begin(), distances.end());
  const double p99 = distances[distances.size() * 99 / 100];
  std::cout << part.name << ": 99 % of the reference's points are within " << p99 << " radii, all within "
            << distances.back() << "\n";
  EXPECT_LE(p99, 0.6);
  EXPECT_LE(distances.back(), 1.0);
}

}  // namespace
}  // namespace pds_test
