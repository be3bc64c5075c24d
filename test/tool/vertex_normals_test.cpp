// SPDX-License-Identifier: BSD-3-Clause
#include "io/vertex_normals.h"

#include "reader_testing.h"

#include <cmath>

namespace pds
{
namespace
{

TEST(VertexNormals, of_a_cube_point_along_its_diagonals_however_its_sides_are_cut)
{
  PointTable cube = table_with({{"x y z", ScalarType::float64}}, 8);
  for (std::size_t corner = 0; corner < cube.size(); ++corner) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double side = (corner >> axis & 1U) != 0 ? 1 : -1;
      cube.set_value(corner, cube.fields()[axis], 5000000 + side);
    }
  }
  const Triangles sides = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                           {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  const PointTable table = with_vertex_normals(cube, sides);
  EXPECT_EQ(describe_fields(table), "x:double y:double z:double nx:float ny:float nz:float");
  for (std::size_t corner = 0; corner < table.size(); ++corner) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double side = (corner >> axis & 1U) != 0 ? 1 : -1;
      EXPECT_NEAR(table.value(corner, table.fields()[3 + axis]), side / std::sqrt(3.0), 1e-6);
    }
  }
}

TEST(VertexNormals, replace_those_of_the_input)
{
  PointTable points = table_with({{"x y z", ScalarType::float32}, {"nx ny nz", ScalarType::float64}}, 3);
  points.set_value(1, points.fields()[0], 1);
  points.set_value(2, points.fields()[1], 1);
  points.set_value(0, points.fields()[3], 1);
  const PointTable table = with_vertex_normals(points, {{0, 1, 2}});
  EXPECT_EQ(row_values(table, 0), (std::vector<double>{0, 0, 0, 0, 0, 1}));
  EXPECT_EQ(row_values(with_vertex_normals(points, {}), 0), (std::vector<double>{0, 0, 0, 0, 0, 0})) << "no faces";
}

}  // namespace
}  // namespace pds
