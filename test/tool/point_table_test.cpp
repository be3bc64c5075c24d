// SPDX-License-Identifier: BSD-3-Clause
#include "io/point_table.h"

#include "reader_testing.h"

namespace pds
{
namespace
{

using Values = std::vector<double>;

PointTable make_table()
{
  PointTable table({{"label", ScalarType::int32},
                    {"nz", ScalarType::float32},
                    {"z", ScalarType::float64},
                    {"y", ScalarType::float32},
                    {"x", ScalarType::float64},
                    {"ny", ScalarType::float32},
                    {"nx", ScalarType::float32},
                    {"tag", ScalarType::uint8}});
  table.resize(2);
  for (std::size_t row = 0; row < table.size(); ++row) {
    for (std::size_t i = 0; i < table.fields().size(); ++i) {
      table.set_value(row, table.fields()[i], static_cast<double>(10 * row + i));
    }
  }
  return table;
}

TEST(PointTable, gathers_positions_and_normals_for_the_reconstruction)
{
  const PointTable table = make_table();
  EXPECT_EQ(describe_fields(table), "x:double y:double z:double nx:float ny:float nz:float label:int tag:uchar");
  const PointCloudView view = table.view();
  ASSERT_EQ(view.size, 2U);
  EXPECT_EQ(view.positions[1], Eigen::Vector3d(10, 11, 12));
  EXPECT_EQ(view.normals[1], Eigen::Vector3d(13, 14, 15));
  EXPECT_FALSE(view.sensor_origin);
}

TEST(PointTable, shows_no_normals_if_one_is_missing)
{
  PointTable table({{"x", ScalarType::float32},
                    {"nx", ScalarType::float32},
                    {"y", ScalarType::float32},
                    {"z", ScalarType::float32},
                    {"ny", ScalarType::float32}});
  table.resize(1);
  EXPECT_FALSE(table.has_normals());
  EXPECT_FALSE(table.view().normals);
  EXPECT_EQ(describe_fields(table), "x:float y:float z:float nx:float ny:float");
}

TEST(PointTable, orders_records_by_all_their_bytes)
{
  PointTable table = make_table();
  const Field& tag = *table.find("tag");
  table.resize(1);
  table.resize(3);  // rows 1 and 2 are zero again
  table.set_value(2, tag, 1);
  const PointCloudView view = table.view();
  EXPECT_TRUE(view.record_less(1, 2));
  EXPECT_FALSE(view.record_less(2, 1));
  EXPECT_FALSE(view.record_less(1, 1));
}

TEST(PointTable, selects_rows_and_replaces_fields)
{
  const PointTable table = make_table();
  const PointTable selected = table.select({1, 0, 0}, 2);
  ASSERT_EQ(selected.size(), 2U);
  EXPECT_EQ(row_values(selected, 0), row_values(table, 1));
  EXPECT_EQ(row_values(selected, 1), row_values(table, 0));

  const PointTable extended =
      table.with_fields({{"label", ScalarType::uint8}, {"mark", ScalarType::uint8}}, Parallel(2));
  EXPECT_EQ(describe_fields(extended),
            "x:double y:double z:double nx:float ny:float nz:float tag:uchar label:uchar mark:uchar");
  EXPECT_EQ(row_values(extended, 1), (Values{10, 11, 12, 13, 14, 15, 17, 0, 0}));
}

}  // namespace
}  // namespace pds
