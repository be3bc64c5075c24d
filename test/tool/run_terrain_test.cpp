// SPDX-License-Identifier: BSD-3-Clause
// A terrain of PDAL's data, meshed with its colours, and judged by the bytes of its file.
#include "glb_testing.h"
#include "io/read_points.h"
#include "run_testing.h"

#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <set>

#ifdef PCL_PDS_RECON_WITH_VTK
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>
#endif

namespace pds
{
namespace
{

const std::string terrain = std::string(SCAN_DIRECTORY) + "/autzen_trim_7.las";

/** Position and colour of a point. */
using Row = std::array<double, 6>;

/** All points of the terrain by the book: ASPRS LAS 1.4 R15, table 3 for the header, table 16 for point format 7. */
std::set<Row> read_terrain()
{
  std::ifstream stream(terrain, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_EQ(number_at<std::uint8_t>(&bytes[104]), 7);
  const std::size_t begin = number_at<std::uint32_t>(&bytes[96]);
  const std::size_t record_bytes = number_at<std::uint16_t>(&bytes[105]);
  const auto scale = number_at<std::array<double, 3>>(&bytes[131]);
  const auto offset = number_at<std::array<double, 3>>(&bytes[155]);
  std::set<Row> rows;
  for (std::size_t i = 0; i < number_at<std::uint64_t>(&bytes[247]); ++i) {
    const char* record = &bytes[begin + i * record_bytes];
    Row row{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      row[axis] = scale[axis] * number_at<std::int32_t>(record + 4 * axis) + offset[axis];
      row[3 + axis] = number_at<std::uint16_t>(record + 30 + 2 * axis);
    }
    rows.insert(row);
  }
  return rows;
}

class RunTerrain : public RunTool
{
 protected:
  void SetUp() override
  {
    if (!std::filesystem::exists(terrain)) {
      GTEST_SKIP() << terrain << " is not there (CMake option PCL_PDS_RECON_SCAN_DIR)";
    }
  }

  /** The vertices of the mesh, as its PLY has them. */
  std::vector<Row> mesh_as_ply()
  {
    EXPECT_EQ(run("-q \"" + terrain + "\" mesh.ply"), 0) << errors();
    const PointTable mesh = read_points(path("mesh.ply"), Parallel(1));
    std::vector<Row> rows(mesh.size());
    for (std::size_t row = 0; row < mesh.size(); ++row) {
      std::size_t i = 0;
      for (const char* name : {"x", "y", "z", "red", "green", "blue"}) {
        rows[row][i++] = mesh.value(row, *mesh.find(name));
      }
    }
    return rows;
  }
};

TEST_F(RunTerrain, has_vertices_that_are_points_of_the_file_with_their_colors)
{
  const std::set<Row> points = read_terrain();
  const std::vector<Row> vertices = mesh_as_ply();
  ASSERT_GT(points.size(), 100000U);
  ASSERT_GT(vertices.size(), 2000U);
  for (const Row& vertex : vertices) {
    ASSERT_EQ(points.count(vertex), 1U) << vertex[0] << ' ' << vertex[1] << ' ' << vertex[2];
  }
}

TEST_F(RunTerrain, is_the_same_in_vtp)
{
#ifdef PCL_PDS_RECON_WITH_VTK
  const std::vector<Row> vertices = mesh_as_ply();
  ASSERT_EQ(run("-q \"" + terrain + "\" mesh.vtp"), 0) << errors();
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(path("mesh.vtp").c_str());
  reader->Update();
  vtkPolyData& mesh = *reader->GetOutput();
  vtkDataArray* colors = mesh.GetPointData()->GetArray("RGB");
  ASSERT_NE(colors, nullptr);
  ASSERT_EQ(static_cast<std::size_t>(mesh.GetNumberOfPoints()), vertices.size());
  for (std::size_t row = 0; row < vertices.size(); ++row) {
    const auto index = static_cast<vtkIdType>(row);
    for (int i = 0; i < 3; ++i) {
      ASSERT_EQ(mesh.GetPoint(index)[i], vertices[row][static_cast<std::size_t>(i)]);
      ASSERT_EQ(colors->GetComponent(index, i), vertices[row][static_cast<std::size_t>(i) + 3]);
    }
  }
  EXPECT_GT(mesh.GetNumberOfPolys(), mesh.GetNumberOfPoints());
#else
  GTEST_SKIP() << "built without VTK";
#endif
}

TEST_F(RunTerrain, lies_with_z_up_in_glb_and_has_linear_colors)
{
  const std::vector<Row> vertices = mesh_as_ply();
  ASSERT_EQ(run("-q \"" + terrain + "\" mesh.glb"), 0) << errors();
  const Glb glb = parse_glb(read("mesh.glb"));
  const Json& node = glb.description["nodes"][0];
  const auto translation = node["translation"].get<std::vector<double>>();
  EXPECT_NEAR(node["rotation"][0].get<double>(), -std::sqrt(0.5), 1e-12) << "a quarter turn around x";
  constexpr double half_foot_in_1000 = 5e-4;  // single precision of an area of some 1000 feet
  for (std::size_t row = 0; row < vertices.size(); ++row) {
    const Row& vertex = vertices[row];
    const std::vector<double> position = glb.vector("POSITION", row);
    ASSERT_NEAR(position[0] + translation[0], vertex[0], half_foot_in_1000);
    ASSERT_NEAR(position[2] + translation[1], vertex[2], half_foot_in_1000);
    ASSERT_NEAR(-position[1] + translation[2], -vertex[1], half_foot_in_1000);
    const std::vector<double> color = glb.vector("COLOR_0", row);
    for (std::size_t i = 0; i < 3; ++i) {
      const double srgb = vertex[3 + i] / 255;  // IEC 61966-2-1
      const double linear = srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
      ASSERT_NEAR(color[i], linear, 0.5 / 65535 + 1e-9);
    }
  }
}

}  // namespace
}  // namespace pds
