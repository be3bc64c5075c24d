// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/rim_joining.h>

#include <algorithm>

#include "core_testing.h"

/** \brief Gaps of noisy scans are joined where the surface goes on behind them, and only there. */
namespace pds_test
{
namespace
{

constexpr double radius = 0.06;        // of the samples; 20,000 points on a square of 2 x 2 are 0.02 apart
constexpr double noise = 0.25 * 0.02;  // a quarter of that
constexpr std::size_t count = small_cloud;

/** \brief Points that a test leaves of a noisy square of 2 x 2 in the plane z = 0. */
template <typename Keep>
Points noisy_square(const Keep& keep, std::uint64_t seed = 1)
{
  Random random(seed + 7);
  Points points = plane(count, 0, seed);
  for (Eigen::Vector3d& p : points) p.z() += noise * random.normal();
  points.erase(std::remove_if(points.begin(), points.end(), [&](const Eigen::Vector3d& p) { return !keep(p); }),
               points.end());
  return points;
}

/** \brief The same, moved by a rotation about the x axis and then a shift. */
Points moved(Points points, double angle, const Eigen::Vector3d& shift)
{
  const Eigen::AngleAxisd turn(angle, Eigen::Vector3d::UnitX());
  for (Eigen::Vector3d& p : points) p = turn * p + shift;
  return points;
}

MeshFacts facts_of(const Points& points, double hole_size = 15)
{
  pds::Options options;
  options.radius = radius;
  options.hole_size = hole_size;
  const pds::Reconstruction mesh = reconstruct(points, options);
  EXPECT_TRUE(mesh.report.smoothed);
  return expect_sound(mesh, points);
}

auto beside_slit(double width)
{
  return [width](const Eigen::Vector3d& p) { return std::abs(p.y()) > width * radius / 2; };
}

bool everywhere(const Eigen::Vector3d& /*p*/) { return true; }

TEST(RimJoining, JoinsTheTwoSidesOfANarrowSlit)
{
  for (const double width : {1.5, 1.6, 1.7, 1.8, 1.9, 2.0, 2.1, 2.2}) {
    const auto number = static_cast<std::uint64_t>(100 * width);
    const MeshFacts facts = facts_of(noisy_square(beside_slit(width), number));
    EXPECT_EQ(facts.components, 1U) << width;
    EXPECT_EQ(facts.boundary_loops, 1U) << width;
    // The slit has 4 % to 7 % of the area.
    EXPECT_GT(facts.area, 0.99 * facts_of(noisy_square(everywhere, number)).area) << width;
  }
}

TEST(RimJoining, ClosesANarrowSlitThatIsLongerThanAHoleMayBe)
{
  for (const double width : {1.5, 2.0}) {
    const auto beside = beside_slit(width);
    const Points points = noisy_square([&](const Eigen::Vector3d& p) { return std::abs(p.x()) > 0.8 || beside(p); });
    EXPECT_EQ(facts_of(points).boundary_loops, 1U) << width;  // a perimeter of 57 radii
  }
}

TEST(RimJoining, LeavesAWiderGap)
{
  for (const double width : {2.5, 3.0}) EXPECT_EQ(facts_of(noisy_square(beside_slit(width))).components, 2U) << width;
}

TEST(RimJoining, DoesNothingIfNoHoleIsToBeFilled)
{
  EXPECT_GE(facts_of(noisy_square(beside_slit(2)), 0).components, 2U);
}

TEST(RimJoining, LeavesParallelSheets)
{
  for (const double distance : {1.2, 2.0}) {
    const Points sheets =
        joined(noisy_square(everywhere), moved(noisy_square(everywhere, 2), 0, {0, 0, distance * radius}));
    EXPECT_EQ(facts_of(sheets).components, 2U) << distance;
  }
}

TEST(RimJoining, JoinsSheetsAtAnAngleOnlyIfItIsNearlyFlat)
{
  const auto half = [](const Eigen::Vector3d& p) { return p.y() > 0; };
  for (const double degrees : {60, 90, 160, 170}) {
    const double angle = degrees * pi / 180;
    const Points sheets = joined(noisy_square(half), moved(noisy_square(half, 2), angle, {0, -2 * radius, 0}));
    EXPECT_EQ(facts_of(sheets).components, degrees > 135 ? 1U : 2U) << degrees;
  }
}

TEST(RimJoining, LeavesTheSidesOfASlitThatAWallGoesThrough)
{
  const Points sheets = joined(noisy_square(beside_slit(2.2)), moved(noisy_square(everywhere, 2), pi / 2, {0, 0, 0}));
  EXPECT_EQ(facts_of(sheets).components, 3U);
}

TEST(RimJoining, LeavesABallBesideAPlate)
{
  Points ball = sphere(count, 3);
  Random random(4);
  for (Eigen::Vector3d& p : ball) p = (0.5 + noise * random.normal()) * p + Eigen::Vector3d(1.5 + 1.5 * radius, 0, 0);
  EXPECT_EQ(facts_of(joined(noisy_square(everywhere), ball)).components, 2U);
}

/** An island of a few cells, one and a half radii off the rim of a plate or between two of them. */
TEST(RimJoining, KeepsASpeckOnlyIfSomethingHangsTogetherByIt)
{
  for (const bool bridge : {false, true}) {
    const Points points = noisy_square([bridge](const Eigen::Vector3d& p) {
      const double y = p.y() / radius - 8;
      return y < 0 || (bridge && y > 6) || (y > 1.5 && y < 4.5 && std::abs(p.x()) < 1.2 * radius);
    });
    pds::Options options;
    options.radius = radius;
    const pds::Reconstruction mesh = reconstruct(points, options);
    EXPECT_EQ(expect_sound(mesh, points).components, 1U) << bridge;
    const Points vertices = vertex_positions(mesh, points);
    EXPECT_EQ(bridge, std::any_of(vertices.begin(), vertices.end(), [](const Eigen::Vector3d& p) {
                return p.y() > 9.5 * radius && p.y() < 12.5 * radius;
              }));
  }
}

/** \brief Surfaces of revolution about the z axis; lengths are in radii. */
class Turned
{
 public:
  /** \brief Adds a ball with an opening of 10 degrees to all sides at the top, whose rim is in the plane z = 0. */
  void add_ball()
  {
    const double ball = rim / std::sin(pi / 18);
    std::vector<Ring> rings;
    rings.reserve(17);
    for (int i = 1; i < 18; ++i)
      rings.push_back({ball * std::sin(i * pi / 18), ball * (std::cos(i * pi / 18) - std::cos(pi / 18))});
    add_cap(rings, -ball * (1 + std::cos(pi / 18)), false);
  }

  /** \brief Adds a cup with as large a rim at the height \a z, which is closed above or below it. */
  void add_cup(double z, bool above, bool turned)
  {
    const double height = above ? 2 * rim : -2 * rim;
    std::vector<Ring> rings;
    rings.reserve(3);
    for (int i = 0; i < 3; ++i) rings.push_back({rim * std::cos(i * pi / 6), z + height * std::sin(i * pi / 6)});
    add_cap(rings, z + height, turned);
  }

  /** \brief Adds a square of the cylinder between the rims. */
  void add_island(double low, double high)
  {
    add_ring({rim, low});
    add_ring({rim, high});
    add_square(0, false);
  }

  /** \brief What they are after their rims were joined. */
  [[nodiscard]] MeshFacts joined() const
  {
    const std::vector<pds::SeedPair> pairs;
    pds::TriangleComplex complex(seeds_.position);
    for (const pds::Triangle& t : triangles_) EXPECT_EQ(complex.add(t, 0.7), pds::TriangleComplex::Verdict::legal);
    pds::join_rims(complex, seeds_, pds::BorderingCells(pairs), pds::FillLimits());
    Triangles triangles;
    for (const std::uint32_t f : complex.faces()) triangles.push_back(complex.oriented(f));
    return examine(triangles, complex.position());
  }

 private:
  struct Ring
  {
    double radius, height;
  };
  static constexpr std::uint32_t around = 16;
  static constexpr double rim = around / (2 * pi);

  /** The last cells before the crease reach over it: they lie in the plane of the cup's wall. */
  void add_vertex(double x, double y, double z)
  {
    seeds_.position.emplace_back(x, y, z);
    seeds_.normal.push_back(x == 0 && y == 0 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d(x, y, 0).normalized());
    seeds_.curvature.push_back(0);
  }

  void add_ring(const Ring& ring)
  {
    for (std::uint32_t i = 0; i < around; ++i)
      add_vertex(ring.radius * std::cos(2 * pi * i / around), ring.radius * std::sin(2 * pi * i / around), ring.height);
  }

  /** \brief Two faces between the last two rings. */
  void add_square(std::uint32_t i, bool turned)
  {
    const auto first = static_cast<std::uint32_t>(seeds_.position.size()) - 2 * around;
    const std::uint32_t j = (i + 1) % around;
    add_face({first + i, first + j, first + around + j}, turned);
    add_face({first + i, first + around + j, first + around + i}, turned);
  }

  void add_cap(const std::vector<Ring>& rings, double tip, bool turned)
  {
    add_ring(rings.front());
    for (auto ring = rings.begin() + 1; ring != rings.end(); ++ring) {
      add_ring(*ring);
      for (std::uint32_t i = 0; i < around; ++i) add_square(i, turned);
    }
    const auto top = static_cast<std::uint32_t>(seeds_.position.size());
    add_vertex(0, 0, tip);
    for (std::uint32_t i = 0; i < around; ++i)
      add_face({top - around + i, top - around + (i + 1) % around, top}, turned);
  }

  void add_face(const pds::Triangle& t, bool turned)
  {
    triangles_.push_back(turned ? pds::Triangle{t[0], t[2], t[1]} : t);
  }

  pds::SeedGeometry seeds_;
  std::vector<pds::Triangle> triangles_;
};

/** A cup on the opening of a ball has its outside where the ball has it, whichever way its faces were turned before. */
TEST(RimJoining, JoinsTwoShapesAroundACreaseIfTheirOutsidesAgree)
{
  for (const bool turned : {false, true}) {
    Turned shapes;
    shapes.add_ball();
    shapes.add_cup(1.5, true, turned);
    const MeshFacts facts = shapes.joined();
    EXPECT_EQ(facts.components, 1U) << turned;
    EXPECT_EQ(facts.boundary_loops, 1U) << turned;
    EXPECT_EQ(facts.inconsistent_edges, 0U) << turned;
  }
}

/** One that hangs into the ball would be the ball's own wall, with the cup's inside out. */
TEST(RimJoining, LeavesACupInsideABall)
{
  for (const bool turned : {false, true}) {
    Turned shapes;
    shapes.add_ball();
    shapes.add_cup(-1.5, false, turned);
    EXPECT_EQ(shapes.joined().components, 2U) << turned;
  }
}

/** The square between has no outside of its own, but that of the cup, once it is joined to it. */
TEST(RimJoining, KnowsTheOutsideOfAnIslandByWhatItHangsTogetherWith)
{
  for (const bool above : {false, true}) {
    const double up = above ? 1 : -1;
    Turned shapes;
    shapes.add_ball();
    shapes.add_cup(up * 4, above, false);
    shapes.add_island(up * 1.6, up * 2.6);
    EXPECT_EQ(shapes.joined().components, above ? 1U : 2U);
  }
}

}  // namespace
}  // namespace pds_test
