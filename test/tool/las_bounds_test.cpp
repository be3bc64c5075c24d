// SPDX-License-Identifier: BSD-3-Clause
#include "io/las_reader.h"
#include "las_testing.h"

#include <random>

namespace pds
{
namespace
{

using Triple = std::array<double, 3>;

constexpr Triple extent = {100000, 200000, 30000};  // in steps of the scale
constexpr Triple true_scale = {0.01, 0.01, 0.001};
constexpr Triple true_offset = {500000, 5000000, 0};
constexpr Triple least = {500000, 5000000, 0};
constexpr Triple greatest = {501000, 5002000, 30};

/** A terrain whose header says the truth. */
LasFile terrain()
{
  LasFile file(2, 0, 20);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform;
  file.add(las_record(0, 0, 0, 2));
  for (int i = 0; i < 1000; ++i) {
    std::array<std::int32_t, 3> numbers{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      numbers[axis] = static_cast<std::int32_t>(extent[axis] * uniform(random));
    }
    file.add(las_record(numbers[0], numbers[1], numbers[2], 2));
  }
  file.add(las_record(100000, 200000, 30000, 2));
  file.set(131, true_scale);
  file.set(155, true_offset);
  file.set_bounds(least, greatest);
  return file;
}

std::string complaint_about(const LasFile& file)
{
  return complaint([&file] { return read_las(ByteSource(file.bytes()), Parallel(2)); });
}

std::string complaint_with(const Triple& scale, const Triple& offset)
{
  LasFile file = terrain();
  file.set(131, scale);
  file.set(155, offset);
  return complaint_about(file);
}

std::string complaint_with_bounds(const Triple& header_least, const Triple& header_greatest)
{
  LasFile file = terrain();
  file.set_bounds(header_least, header_greatest);
  return complaint_about(file);
}

TEST(LasBounds, believe_the_truth) { EXPECT_EQ(complaint_about(terrain()), ""); }

TEST(LasBounds, may_be_left_as_they_were_before_any_point)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double limit = std::numeric_limits<double>::max();
  for (const auto& [low, high] : {std::pair(0.0, 0.0), std::pair(infinity, -infinity), std::pair(-infinity, infinity),
                                  std::pair(limit, -limit), std::pair(-limit, limit), std::pair(nan, nan)}) {
    EXPECT_EQ(complaint_with_bounds({low, low, low}, {high, high, high}), "") << low << ' ' << high;
    EXPECT_EQ(complaint_with_bounds({low, 5000000, 0}, {high, 5002000, 30}), "") << low << ' ' << high;
    EXPECT_EQ(complaint_with_bounds({low, 5000010, 0}, {high, 5002000, 30}).find("has points outside"), 0U)
        << low << ' ' << high;
  }
}

TEST(LasBounds, show_a_wrong_scale_of_any_axis)
{
  for (const double factor : {1e-3, 0.1, 2.0, 10.0, 1000.0}) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Triple scale = true_scale;
      scale[axis] *= factor;
      EXPECT_NE(complaint_with(scale, true_offset).find("scale"), std::string::npos) << factor << ' ' << axis;
    }
  }
}

TEST(LasBounds, show_a_wrong_offset_of_any_axis)
{
  for (const double added : {-5e6, -1.0, 1.0, 7e9}) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Triple offset = true_offset;
      offset[axis] += added;
      EXPECT_NE(complaint_with(true_scale, offset).find("outside the bounds"), std::string::npos)
          << added << ' ' << axis;
    }
  }
  EXPECT_EQ(complaint_with({1, 0.01, 0.001}, true_offset)
                .find("has points outside the bounds in its LAS header (x from "
                      "500000 to 501000, point 2 at "),
            0U);
}

TEST(LasBounds, may_be_rounded)
{
  EXPECT_EQ(complaint_with_bounds({500000.01, 5000000.01, 0.001}, {500999.99, 5001999.99, 29.999}), "") << "to a step";
  EXPECT_EQ(complaint_with_bounds({500000.03, 5000000.3, 0}, {500999.97, 5001999.7, 30}), "") << "to float";
  EXPECT_EQ(complaint_with_bounds({500010, 5000000, 0}, {501000, 5002000, 30}).find("has points outside"), 0U);
}

TEST(LasBounds, may_be_of_more_points_than_the_file_still_holds)
{
  EXPECT_EQ(complaint_with_bounds({400000, 4900000, -100}, {700000, 5900000, 3000}), "");
  EXPECT_EQ(complaint_with_bounds(least, {501234.56, 5007890.12, 43.21}), "") << "cut off on one side";
}

TEST(LasBounds, may_be_round_multiples_of_what_the_points_span)
{
  for (const double ratio : {2.0, 2.5, 5.0, 10.0}) {
    const Triple wide = {500000 + 1000 * ratio, 5000000 + 2000 * ratio, 30};
    EXPECT_EQ(complaint_with_bounds(least, {wide[0], wide[1], 31}), "") << ratio << ": a corner, without the highest";
    if (ratio != 10) {
      EXPECT_EQ(complaint_with_bounds(least, wide), "") << ratio << ": a corner";
      EXPECT_EQ(complaint_with_bounds(least, {wide[0], 5002000, 30}), "") << ratio << ": a strip";
      EXPECT_EQ(complaint_with_bounds(least, {wide[0], wide[1], 30 * ratio}), "") << ratio << ": all three";
    }
  }
}

TEST(LasBounds, are_those_of_another_scale_only_if_all_six_are)
{
  const auto is_refused = [](const Triple& header_greatest) {
    return complaint_with_bounds(least, header_greatest).find("those of another scale") != std::string::npos;
  };
  EXPECT_TRUE(is_refused({510000, 5020000, 300}));
  EXPECT_TRUE(is_refused({510000, 5002000, 30})) << "nobody can tell it from a strip that holds lowest and highest";
  EXPECT_FALSE(is_refused({510000, 5020000.2, 300}));
  EXPECT_FALSE(is_refused({510000, 5020000, 301}));
}

}  // namespace
}  // namespace pds
