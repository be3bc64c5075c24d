// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include "core_testing.h"
#include "curve_shapes.h"

/** \brief Curves: polylines without branches, as long and where the curve is. */
namespace pds_test
{
namespace
{

pds::Options options_of(pds::Dimension dimension, unsigned threads = 0)
{
  pds::Options options;
  options.dimension = dimension;
  options.threads = threads;
  return options;
}

pds::Reconstruction reconstruct_curves(const Points& points)
{
  return reconstruct(points, options_of(pds::Dimension::curve));
}

double length(const pds::Reconstruction& result, const Points& vertices)
{
  double sum = 0;
  for (const auto& [a, b] : result.segments) sum += (vertices[a] - vertices[b]).norm();
  return sum;
}

/** \brief Numbers of the vertices by the number of their segments. */
std::array<std::size_t, 3> count_degrees(const pds::Reconstruction& result)
{
  std::vector<std::size_t> degree(result.report.vertices);
  for (const auto& [a, b] : result.segments) {
    ++degree.at(a);
    ++degree.at(b);
  }
  std::array<std::size_t, 3> counts{};
  for (const std::size_t d : degree) ++counts.at(d);  // throws if there is a branch
  return counts;
}

/** \brief Checks what holds for curves from whatever cloud, and that the report says what is there. */
void expect_sound_curves(const pds::Reconstruction& result, const Points& points)
{
  const pds::Report& report = result.report;
  EXPECT_EQ(result.seeds.size(), report.seeds);
  EXPECT_EQ(std::set<std::uint32_t>(result.seeds.begin(), result.seeds.end()).size(), result.seeds.size());
  EXPECT_TRUE(result.triangles.empty());
  EXPECT_EQ(result.segments.size(), report.segments);
  EXPECT_EQ(report.edges, report.segments);
  const auto [lonely, ends, inner] = count_degrees(result);
  EXPECT_EQ(lonely, 0U);
  EXPECT_EQ(ends, 2 * (report.curves - report.closed_curves));
  EXPECT_EQ(report.euler, static_cast<long long>(report.curves - report.closed_curves));
  EXPECT_EQ(report.components, report.curves);
  if (report.seeds > 0) {
    EXPECT_GE(report.min_seed_distance, 1.0 - 1e-5);
  }
  EXPECT_LE(report.coverage_radius, 1.0 + 1e-5);
  ASSERT_EQ(result.voronoi.label.size(), points.size());
  for (const std::uint32_t label : result.voronoi.label)
    ASSERT_TRUE(label < result.seeds.size() || label == pds::no_label);
}

struct Case
{
  const char* name;
  std::vector<ExactCurve> curves;
  std::size_t points;  ///< on each
  double deviation;

  friend void PrintTo(const Case& c, std::ostream* stream) { *stream << c.name; }

  [[nodiscard]] Points cloud() const
  {
    Points all;
    std::uint64_t seed = 1;
    for (const ExactCurve& curve : curves) all = joined(all, curve.sample(points, deviation, seed++));
    return all;
  }
  [[nodiscard]] double length() const
  {
    return std::accumulate(curves.begin(), curves.end(), 0.0,
                           [](double sum, const ExactCurve& curve) { return sum + curve.length(); });
  }
  [[nodiscard]] double distance(const Eigen::Vector3d& p) const
  {
    double least = std::numeric_limits<double>::infinity();
    for (const ExactCurve& curve : curves) least = std::min(least, curve.distance(p));
    return least;
  }
};

std::vector<ExactCurve> linked_rings() { return {circle(), circle({1, 0, 0}, {1, 0, 0}, {0, 0, 1})}; }

const Case cases[] = {
    {"circle", {circle()}, 20000, 0.001},           {"exact_circle", {circle()}, 20000, 0},
    {"sparse_circle", {circle()}, 1000, 0},         {"wide_circle", {circle()}, 20000, 0.02},
    {"trefoil", {trefoil_knot()}, 20000, 0.005},    {"exact_trefoil", {trefoil_knot()}, 20000, 0},
    {"spiral", {spiral()}, 20000, 0.003},           {"exact_spiral", {spiral()}, 20000, 0},
    {"linked_rings", linked_rings(), 10000, 0.002}, {"exact_linked_rings", linked_rings(), 10000, 0},
};

class CurveTest : public testing::TestWithParam<Case>
{
};

INSTANTIATE_TEST_SUITE_P(Shapes, CurveTest, testing::ValuesIn(cases), [](const auto& test) {
  return std::string(test.param.name);
});

TEST_P(CurveTest, IsOnePolylineForEachCurve)
{
  const Points points = GetParam().cloud();
  const pds::Reconstruction result = reconstruct_curves(points);
  expect_sound_curves(result, points);
  EXPECT_EQ(result.report.curves, GetParam().curves.size());
  const auto closed = std::count_if(GetParam().curves.begin(), GetParam().curves.end(),
                                    [](const ExactCurve& curve) { return curve.closed; });
  EXPECT_EQ(static_cast<std::ptrdiff_t>(result.report.closed_curves), closed);
  EXPECT_EQ(result.report.vertices, result.report.seeds);
  EXPECT_EQ(result.report.smoothed, GetParam().deviation > 0);
}

TEST_P(CurveTest, IsWhereTheCurveIs)
{
  const Points points = GetParam().cloud();
  const pds::Reconstruction result = reconstruct_curves(points);
  const Points vertices = vertex_positions(result, points);
  EXPECT_NEAR(length(result, vertices), GetParam().length(), 0.015 * GetParam().length());
  double sum = 0;
  for (const auto& [a, b] : result.segments)
    sum += GetParam().distance(vertices[a]) + GetParam().distance(0.5 * (vertices[a] + vertices[b]));
  // Half of what the points have, and the height of a chord of 2 R over a circle of radius 0.5, the least there is.
  const double radius = result.report.curve_radius;
  EXPECT_LE(sum / static_cast<double>(2 * result.segments.size()), 0.6 * GetParam().deviation + radius * radius);
}

TEST_P(CurveTest, HasNoGapsBetweenTheDisks)
{
  const Points points = GetParam().cloud();
  const pds::Reconstruction result = reconstruct_curves(points);
  const Points vertices = vertex_positions(result, points);
  // Two points that are neighbours on the curve are each within R of a seed. Of n random points on a length L, the
  // widest gap is L (ln n + x) / n with a probability of exp(-x) of more; the radius is 12 L / n.
  const auto n = static_cast<double>(points.size());
  const double widest_gap = GetParam().length() / n * (std::log(n) + 4);
  for (const auto& [a, b] : result.segments)
    EXPECT_LE((vertices[a] - vertices[b]).norm(), 2 * result.report.curve_radius + widest_gap);
}

TEST_P(CurveTest, EndsWhereTheCurveEnds)
{
  for (const ExactCurve& curve : GetParam().curves) {
    if (curve.closed) continue;
    const Points points = GetParam().cloud();
    const pds::Reconstruction result = reconstruct_curves(points);
    const Points vertices = vertex_positions(result, points);
    Points ends{vertices.front(), vertices.back()};
    if ((ends[0] - curve.first()).norm() > (ends[1] - curve.first()).norm()) std::swap(ends[0], ends[1]);
    EXPECT_LE((ends[0] - curve.first()).norm(), 0.2 * result.report.curve_radius);
    EXPECT_LE((ends[1] - curve.last()).norm(), 0.2 * result.report.curve_radius);
  }
}

TEST_P(CurveTest, IsToldFromSurfaces)
{
  const Points points = GetParam().cloud();
  if (GetParam().deviation > 0.01) return;  // as wide as a strip of surface
  const pds::Reconstruction told = reconstruct(points, options_of(pds::Dimension::automatic));
  const pds::Reconstruction known = reconstruct_curves(points);
  EXPECT_EQ(told.seeds, known.seeds);
  EXPECT_EQ(told.segments, known.segments);
}

TEST_P(CurveTest, DoesNotDependOnThreadsOrOrder)
{
  const Points points = GetParam().cloud();
  const pds::Reconstruction one = reconstruct(points, options_of(pds::Dimension::curve, 1));
  for (const unsigned threads : {2U, 5U}) {
    const pds::Reconstruction other = reconstruct(points, options_of(pds::Dimension::curve, threads));
    EXPECT_EQ(other.seeds, one.seeds);
    EXPECT_EQ(other.segments, one.segments);
    EXPECT_EQ(other.voronoi.label, one.voronoi.label);
    EXPECT_EQ(other.witness_points, one.witness_points);
  }
  Points shuffled = points;
  Random(3).shuffle(shuffled);
  const pds::Reconstruction other = reconstruct(shuffled, options_of(pds::Dimension::curve));
  EXPECT_EQ(vertex_positions(other, shuffled), vertex_positions(one, points));
  EXPECT_EQ(other.segments, one.segments);
}

TEST(Curves, KeepTheRadiusTheyAreGiven)
{
  const Points points = circle().sample(20000, 0.001);
  pds::Options options = options_of(pds::Dimension::curve);
  options.radius = 0.1;
  const pds::Reconstruction result = reconstruct(points, options);
  expect_sound_curves(result, points);
  EXPECT_NEAR(result.report.curve_radius, 0.1, 1e-6);
  // Disks thrown at random on a line leave 0.75 of them in each radius (Renyi's parking constant).
  EXPECT_NEAR(static_cast<double>(result.report.vertices), 0.75 * 2 * pi / 0.1, 5);
  EXPECT_EQ(result.report.closed_curves, 1U);
}

TEST(Curves, RingsAsSmallAsThreeDisksAreClosed)
{
  const Points points = circle().sample(5000, 0);
  pds::Options options = options_of(pds::Dimension::curve);
  for (const double radius : {1.0, 1.3, 1.5}) {
    options.radius = radius;
    const pds::Reconstruction result = reconstruct(points, options);
    expect_sound_curves(result, points);
    EXPECT_GE(result.report.vertices, 3U);
    EXPECT_EQ(result.report.closed_curves, 1U);
  }
}

TEST(Curves, StraysAreLeftOut)
{
  for (const double deviation : {0.0, 0.001}) {
    Points points = circle().sample(20000, deviation);
    Random random(5);
    for (int i = 0; i < 1000; ++i) points.push_back(random.in_box(1.2));
    const pds::Reconstruction result = reconstruct_curves(points);
    expect_sound_curves(result, points);
    EXPECT_EQ(result.report.curves, 1U);
    EXPECT_EQ(result.report.closed_curves, 1U);
    EXPECT_GE(result.report.outliers, 990U);
    for (const Eigen::Vector3d& v : vertex_positions(result, points)) EXPECT_LT(circle().distance(v), 0.01);
  }
}

TEST(Curves, RandomGapsDoNotOpenThem)
{
  // Two seeds are up to 2 R apart and the widest gap of points besides.
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    EXPECT_EQ(reconstruct_curves(circle().sample(10000, 0, seed)).report.closed_curves, 1U) << seed;
}

TEST(Curves, PointsThatAreNoCurveAreLeftOut)
{
  Points points = circle().sample(5000, 0);
  for (const Eigen::Vector3d& p : sphere(3000)) points.push_back(0.3 * p + Eigen::Vector3d(5, 0, 0));
  const pds::Reconstruction result = reconstruct_curves(points);
  expect_sound_curves(result, points);
  EXPECT_EQ(result.report.outliers, 3000U);
  EXPECT_EQ(result.report.closed_curves, 1U);
  EXPECT_EQ(result.voronoi.label.back(), pds::no_label);
}

TEST(Curves, DegenerateCloudsGiveNone)
{
  std::vector<Points> clouds;
  for (std::size_t count = 0; count <= 3; ++count) clouds.push_back(spiral().sample(count, 0));
  clouds.emplace_back(100, Eigen::Vector3d(1, 2, 3));
  clouds.emplace_back(10, Eigen::Vector3d::Constant(std::nan("")));
  clouds.push_back(sphere(2000));
  for (const Points& points : clouds)
    for (const pds::Dimension dimension : {pds::Dimension::curve, pds::Dimension::automatic}) {
      SCOPED_TRACE(points.size());
      const pds::Reconstruction result = reconstruct(points, options_of(dimension));
      EXPECT_TRUE(result.segments.empty());
      EXPECT_EQ(result.report.input_points, points.size());
      EXPECT_EQ(result.voronoi.label.size(), points.size());
      EXPECT_TRUE(std::isfinite(result.report.radius));
      if (dimension == pds::Dimension::curve) expect_sound_curves(result, points);
    }
}

TEST(Curves, DuplicatesChangeNothing)
{
  const Points points = spiral().sample(5000, 0);
  const pds::Reconstruction once = reconstruct_curves(points);
  const pds::Reconstruction twice = reconstruct_curves(joined(points, points));
  EXPECT_EQ(twice.seeds, once.seeds);
  EXPECT_EQ(twice.segments, once.segments);
  EXPECT_EQ(twice.report.merged_points, points.size());
}

TEST(Curves, PointsInAStraightRowAreOne)
{
  Points points;
  for (int i = 0; i < 400; ++i) points.emplace_back(0.01 * i, 0.02 * i, -0.01 * i);
  const pds::Reconstruction result = reconstruct_curves(points);
  expect_sound_curves(result, points);
  EXPECT_EQ(result.report.curves, 1U);
  const std::set<std::uint32_t> ends{result.seeds[0], result.seeds[result.report.vertices - 1]};
  EXPECT_EQ(ends, (std::set<std::uint32_t>{0, 399}));
}

}  // namespace
}  // namespace pds_test
