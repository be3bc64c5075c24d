// SPDX-License-Identifier: BSD-3-Clause
#include "io/merge_points.h"

#include "io/classification.h"
#include "reader_testing.h"

#include <cmath>

namespace pds
{
namespace
{

using Values = std::vector<double>;

PointTable cloud(const std::vector<Field>& more, const std::vector<Values>& rows, ScalarType type = ScalarType::float32)
{
  std::vector<Field> fields = {{"x", type}, {"y", type}, {"z", type}};
  fields.insert(fields.end(), more.begin(), more.end());
  PointTable table(fields, rows.size());
  for (std::size_t row = 0; row < rows.size(); ++row) {
    for (std::size_t i = 0; i < fields.size(); ++i) {
      table.set_value(row, *table.find(fields[i].name), rows[row][i]);
    }
  }
  return table;
}

std::vector<PointTable> clouds_of(PointTable a, PointTable b)
{
  std::vector<PointTable> clouds;
  clouds.push_back(std::move(a));
  clouds.push_back(std::move(b));
  return clouds;
}

TEST(MergePoints, numbers_the_points_and_keeps_every_bit)
{
  const PointTable merged = merge_points(
      clouds_of(cloud({}, {{1, 2, 3}, {4, 5, 6}}), cloud({}, {{500000.001, 0.1, -1}}, ScalarType::float64)),
      Parallel(2));
  EXPECT_EQ(describe_fields(merged), "x:double y:double z:double scan:ushort");
  ASSERT_EQ(merged.size(), 3U);
  EXPECT_EQ(row_values(merged, 1), (Values{4, 5, 6, 1}));
  EXPECT_EQ(row_values(merged, 2), (Values{500000.001, 0.1, -1, 2}));
}

TEST(MergePoints, takes_the_fields_of_all_and_types_that_hold_all_values)
{
  const PointTable merged = merge_points(
      clouds_of(cloud({{"id", ScalarType::uint16}, {"time", ScalarType::float64}, {"scan", ScalarType::int8}},
                      {{0, 0, 0, 65535, 0.1, 7}}),
                cloud({{"id", ScalarType::int8}, {"class", ScalarType::uint8}}, {{1, 1, 1, -1, 6}})),
      Parallel(1));
  EXPECT_EQ(describe_fields(merged), "x:float y:float z:float id:int time:double class:uchar scan:ushort");
  EXPECT_EQ(row_values(merged, 0), (Values{0, 0, 0, 65535, 0.1, 0, 1}));
  const Values second = row_values(merged, 1);
  EXPECT_TRUE(std::isnan(second[4])) << "the second cloud has no time";
  EXPECT_EQ(second[3], -1);
  EXPECT_EQ(second[5], 6);
  EXPECT_EQ(second[6], 2);
}

TEST(MergePoints, spreads_colors_of_eight_bits_among_those_of_sixteen)
{
  const auto colored = [](ScalarType type, const Values& row) {
    return cloud({{"red", type}, {"green", type}, {"blue", type}, {"class", ScalarType::uint8}}, {row});
  };
  const PointTable bytes = colored(ScalarType::uint8, {0, 0, 0, 255, 1, 0, 6});
  const PointTable words = colored(ScalarType::uint16, {1, 1, 1, 65535, 300, 7, 2});
  const auto merge = [](const PointTable& a, const PointTable& b) {
    return merge_points(clouds_of(a.with_fields({}, Parallel(1)), b.with_fields({}, Parallel(1))), Parallel(1));
  };
  const PointTable merged = merge(bytes, words);
  EXPECT_EQ(merged.color_type(), ScalarType::uint16);
  EXPECT_EQ(row_values(merged, 0), (Values{0, 0, 0, 65535, 257, 0, 6, 1}));
  EXPECT_EQ(row_values(merged, 1), (Values{1, 1, 1, 65535, 300, 7, 2, 2}));
  EXPECT_EQ(row_values(merge(words, bytes), 1), (Values{0, 0, 0, 65535, 257, 0, 6, 2}));
  EXPECT_EQ(row_values(merge(bytes, bytes), 1), (Values{0, 0, 0, 255, 1, 0, 6, 2}));
}

TEST(MergePoints, scales_colors_of_integers_among_floats)
{
  const auto colored = [](ScalarType type, const Values& row) {
    return cloud({{"red", type}, {"green", type}, {"blue", type}}, {row});
  };
  const auto merge = [&colored](ScalarType type, const Values& row, double red) {
    const Values floats = {0, 0, 0, red, 0.5, 1};
    return merge_points(clouds_of(colored(ScalarType::float32, floats), colored(type, row)), Parallel(1));
  };
  const PointTable bytes = merge(ScalarType::uint8, {0, 0, 0, 255, 51, 0}, 0.25);
  EXPECT_EQ(bytes.color_type(), ScalarType::float32);
  EXPECT_EQ(row_values(bytes, 0), (Values{0, 0, 0, 0.25, 0.5, 1, 1}));
  EXPECT_EQ(row_values(bytes, 1), (Values{0, 0, 0, 1, 0.2F, 0, 2}));
  const PointTable words = merge(ScalarType::uint16, {0, 0, 0, 65535, 13107, 0}, 0.25);
  EXPECT_EQ(row_values(words, 1), (Values{0, 0, 0, 1, 0.2F, 0, 2}));
  const PointTable doubles = merge(ScalarType::float64, {0, 0, 0, 0.1, 0.2, 0.3}, 0.25);
  EXPECT_EQ(row_values(doubles, 1), (Values{0, 0, 0, 0.1, 0.2, 0.3, 2}));
  const PointTable no_colors = merge(ScalarType::uint8, {0, 0, 0, 255, 51, 0}, 200);
  EXPECT_EQ(row_values(no_colors, 1), (Values{0, 0, 0, 255, 51, 0, 2})) << "200 says nothing of which value is white";
}

TEST(MergePoints, keeps_that_z_is_up)
{
  std::vector<PointTable> clouds = clouds_of(cloud({}, {{1, 2, 3}}), cloud({}, {{1, 2, 3}}));
  clouds[1].z_is_up = true;
  EXPECT_TRUE(merge_points(std::move(clouds), Parallel(1)).z_is_up);
  EXPECT_FALSE(merge_points(clouds_of(cloud({}, {{1, 2, 3}}), cloud({}, {{1, 2, 3}})), Parallel(1)).z_is_up);
}

TEST(MergePoints, keeps_a_sensor_origin_that_all_have)
{
  const auto origin_of = [](double a, double b) {
    std::vector<PointTable> clouds = clouds_of(cloud({}, {{1, 2, 3}}), cloud({}, {{1, 2, 3}}));
    clouds[0].sensor_origin = Eigen::Vector3d(a, 0, 0);
    clouds[1].sensor_origin = Eigen::Vector3d(b, 0, 0);
    return merge_points(std::move(clouds), Parallel(1)).sensor_origin;
  };
  EXPECT_EQ(origin_of(5, 5), Eigen::Vector3d(5, 0, 0));
  EXPECT_FALSE(origin_of(5, 6));
}

TEST(MergePoints, gives_each_point_the_sensor_origin_of_its_cloud)
{
  std::vector<PointTable> clouds = clouds_of(cloud({}, {{1, 2, 3}}), cloud({}, {{4, 5, 6}}));
  clouds.push_back(cloud({{"vp_x", ScalarType::float64}, {"vp_y", ScalarType::float64}, {"vp_z", ScalarType::float64}},
                         {{7, 8, 9, 0.1, 0.2, 0.3}}));
  clouds[0].sensor_origin = Eigen::Vector3d(10, 20, 30);
  const PointTable merged = merge_points(std::move(clouds), Parallel(1));
  EXPECT_EQ(describe_fields(merged), "x:float y:float z:float vp_x:double vp_y:double vp_z:double scan:ushort");
  EXPECT_FALSE(merged.sensor_origin);
  const PointCloudView view = merged.view();
  EXPECT_EQ(view.viewpoints[0], Eigen::Vector3d(10, 20, 30));
  EXPECT_TRUE(view.viewpoints[1].array().isNaN().all()) << "of the second nobody knows";
  EXPECT_EQ(view.viewpoints[2], Eigen::Vector3d(0.1, 0.2, 0.3));
}

TEST(Classification, selects_points_under_any_of_its_names)
{
  for (const char* name : {"classification", "Classification", "class", "scalar_Classification"}) {
    const std::vector<Values> rows = {{1, 0, 0, 2}, {2, 0, 0, 6}, {3, 0, 0, 1}, {4, 0, 0, 2}};
    const PointTable selected = select_classes(cloud({{name, ScalarType::float32}}, rows), {2, 9});
    ASSERT_EQ(selected.size(), 2U) << name;
    EXPECT_EQ(row_values(selected, 1), rows[3]) << name;
  }
}

TEST(Classification, names_the_classes_that_are_there)
{
  const auto select = [](const char* name) {
    return complaint([name] {
      return select_classes(cloud({{name, ScalarType::uint8}}, {{0, 0, 0, 6}, {0, 0, 0, 2}, {0, 0, 0, 6}}), {5});
    });
  };
  EXPECT_NE(select("classification").find("it holds 2, 6"), std::string::npos);
  EXPECT_NE(select("label").find("no field 'classification'"), std::string::npos);
}

}  // namespace
}  // namespace pds
