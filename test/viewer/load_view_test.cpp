// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/load_view.h"
#include "meshes.h"
#include "viewer/pick.h"
#include "viewer/scene_geometry.h"

#include <gtest/gtest.h>

#include <algorithm>

#include <vtkPointData.h>

namespace pds
{
namespace
{

MeshFile to_file(const TriangleMesh& mesh)
{
  PointTable table({{"x", ScalarType::float64},
                    {"y", ScalarType::float64},
                    {"z", ScalarType::float64},
                    {"quality", ScalarType::float32}},
                   mesh.vertices.size());
  for (std::size_t i = 0; i < table.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k)
      table.set_value(i, table.fields()[k], mesh.vertices[i][static_cast<Eigen::Index>(k)]);
    table.set_value(i, table.fields()[3], static_cast<double>(i));
  }
  return {std::move(table), mesh.faces};
}

ViewSource two_spheres()
{
  ViewSource source;
  source.meshes.push_back(to_file(make_sphere(1, 3)));
  source.meshes.push_back(to_file(make_sphere(2, 2)));
  source.mesh_names = {"small.ply", "large.ply"};
  return source;
}

TEST(LoadView, MeshesLieBesideEachOther)
{
  const ViewData data = make_view_data(two_spheres(), Options());
  const std::size_t first = make_sphere(1, 3).vertices.size();
  ASSERT_EQ(data.mesh.vertices.size(), first + make_sphere(2, 2).vertices.size());
  const auto by_x = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return a.x() < b.x(); };
  const auto& v = data.mesh.vertices;
  const auto middle = v.begin() + static_cast<std::ptrdiff_t>(first);
  EXPECT_GT(std::min_element(middle, v.end(), by_x)->x(), std::max_element(v.begin(), middle, by_x)->x());
  EXPECT_EQ(v.front(), make_sphere(1, 3).vertices.front());
  EXPECT_TRUE(data.boundary_loops.empty());
}

TEST(LoadView, WithACloudMeshesStayWhereTheyAre)
{
  ViewSource source = two_spheres();
  source.cloud = to_file(make_sphere(2, 3)).points;
  const ViewData data = make_view_data(source, Options());
  EXPECT_EQ(data.cloud.size, source.cloud->size());
  EXPECT_TRUE(data.label.empty()) << "not reconstructed";
  const std::size_t first = make_sphere(1, 3).vertices.size();
  EXPECT_EQ(data.mesh.vertices[first], make_sphere(2, 2).vertices.front());
}

TEST(LoadView, DeviationIsMeasuredBeforeMeshesAreMoved)
{
  ViewSource source = two_spheres();
  source.reference = make_sphere(2, 2);
  const ViewData data = make_view_data(source, Options());
  const std::size_t first = make_sphere(1, 3).vertices.size();
  for (std::size_t i = 0; i < data.deviation.size(); ++i)
    EXPECT_NEAR(data.deviation[i], i < first ? -1 : 0, 0.2) << i;  // chords of the coarse sphere
}

TEST(LoadView, APickNamesTheFileAndItsOwnIndex)
{
  const ViewSource source = two_spheres();
  const ViewData data = make_view_data(source, Options());
  const std::size_t first = make_sphere(1, 3).vertices.size();
  const Pick pick = pick_vertex(source, data, data.mesh.vertices[first + 5]);
  EXPECT_EQ(pick.place, data.mesh.vertices[first + 5]);
  EXPECT_EQ(pick.text.rfind("vertex 5 of large.ply", 0), 0U) << pick.text;
  EXPECT_NE(pick.text.find("quality 5"), std::string::npos) << pick.text;
}

TEST(LoadView, MeshesKeepTheirColorsAndThoseWithoutAnyAreGrey)
{
  ViewSource source = two_spheres();
  EXPECT_TRUE(make_view_data(source, Options()).vertex_color.empty());
  PointTable& points = source.meshes[1].points;
  points = points.with_fields(
      {{"red", ScalarType::uint16}, {"green", ScalarType::uint16}, {"blue", ScalarType::uint16}}, Parallel(1));
  points.set_value(3, *points.find("red"), 65535);
  points.set_value(3, *points.find("blue"), 257);
  const ViewData data = make_view_data(source, Options());
  ASSERT_EQ(data.vertex_color.size(), data.mesh.vertices.size());
  const ByteColor grey = data.vertex_color.front();
  EXPECT_NEAR(grey[0], grey[2], 20);
  EXPECT_EQ(data.vertex_color[make_sphere(1, 3).vertices.size() + 3], (ByteColor{255, 0, 1}));
}

TEST(SceneGeometry, ACoarseMeshKeepsItsColors)
{
  const TriangleMesh fine = make_sphere(1, 6);
  const auto data = mesh_data(fine, {}, {0, 0, 0});
  set_colors(data, std::vector<ByteColor>(fine.vertices.size(), ByteColor{10, 200, 30}));
  const auto coarse = coarse_mesh(data, 12.57, 1000);
  vtkDataArray* colors = coarse->GetPointData()->GetScalars();
  ASSERT_NE(colors, nullptr);
  for (vtkIdType i = 0; i < colors->GetNumberOfTuples(); ++i) {
    EXPECT_EQ(colors->GetComponent(i, 0), 10);
    EXPECT_EQ(colors->GetComponent(i, 1), 200);
  }
}

TEST(SceneGeometry, SpreadTakesAboutSoManyAndAlwaysTheSame)
{
  EXPECT_EQ(spread(5, 10), (Indices{0, 1, 2, 3, 4}));
  EXPECT_TRUE(spread(0, 10).empty());
  const Indices some = spread(1000000, 50000);
  EXPECT_NEAR(static_cast<double>(some.size()), 50000, 1500);
  EXPECT_EQ(spread(1000000, 50000), some);
  // In every tenth of the numbers and in every column of a scan of 1000 points a row.
  std::vector<int> of_tenth(10);
  std::vector<int> of_column(1000);
  for (const std::uint32_t i : some) {
    ++of_tenth[i / 100000];
    ++of_column[i % 1000];
  }
  for (const int count : of_tenth) EXPECT_NEAR(count, 5000, 500);
  for (const int count : of_column) EXPECT_NEAR(count, 50, 45);
}

TEST(SceneGeometry, ACoarseMeshHasAboutSoManyFacesOnTheSameSurface)
{
  const TriangleMesh fine = make_sphere(1, 6);
  const auto data = mesh_data(fine, {}, {0, 0, 0});
  ASSERT_EQ(static_cast<std::size_t>(data->GetNumberOfPolys()), fine.faces.size());
  const std::size_t wanted = fine.faces.size() / 10;
  const auto coarse = coarse_mesh(data, 12.57, wanted);
  EXPECT_GT(static_cast<std::size_t>(coarse->GetNumberOfPolys()), wanted / 2);
  EXPECT_LT(static_cast<std::size_t>(coarse->GetNumberOfPolys()), wanted * 2);
  for (vtkIdType i = 0; i < coarse->GetNumberOfPoints(); ++i)
    EXPECT_NEAR(Eigen::Vector3d(coarse->GetPoint(i)).norm(), 1, 0.01);
}

}  // namespace
}  // namespace pds
