// SPDX-License-Identifier: BSD-3-Clause
#include "compare/mesh_file.h"

#include "io/write_mesh.h"
#include "meshes.h"
#include "tool/temporary_directory.h"

#include <pcl_pds_recon/options.h>

#include <cmath>
#include <cstring>

namespace pds
{
namespace
{

class MeshFileTest : public TemporaryDirectory
{
 protected:
  void expect_complaint(const std::string& name, const std::string& bytes, const std::string& part)
  {
    try {
      static_cast<void>(read_mesh_file(write(name, bytes), Parallel()));
      ADD_FAILURE() << name << " was taken: " << part;
    } catch (const InvalidInput& error) {
      const std::string message = error.what();
      EXPECT_EQ(message.rfind(path(name) + ": ", 0), 0U) << message;
      EXPECT_NE(message.find(part), std::string::npos) << message;
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
  }
};

const std::string vertex_header = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
const std::string square = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

std::string ascii_ply(const std::string& faces_header, const std::string& faces)
{
  return "ply\nformat ascii 1.0\n" + vertex_header + faces_header + "end_header\n" + square + faces;
}

const Triangles two = {{0, 1, 2}, {0, 2, 3}};

TEST_F(MeshFileTest, ply_polygons_become_fans)
{
  const std::string header = "element face 1\nproperty uchar flag\nproperty list uchar int vertex_indices\n";
  EXPECT_EQ(read_mesh_file(write("m.ply", ascii_ply(header, "7 4 0 1 2 3\n")), Parallel()).triangles, two);
  const std::string other_lists =
      "element face 2\nproperty list uchar float texcoord\nproperty list int uint vertex_index\n";
  EXPECT_EQ(
      read_mesh_file(write("m.ply", ascii_ply(other_lists, "2 0.5 0.5 3 0 1 2\n0 3 0 2 3\n")), Parallel()).triangles,
      two);
  EXPECT_TRUE(read_mesh_file(write("m.ply", ascii_ply("", "")), Parallel()).triangles.empty());
}

TEST_F(MeshFileTest, damaged_ply_faces_are_refused)
{
  const std::string header = "element face 1\nproperty list uchar int vertex_indices\n";
  expect_complaint("short.ply", ascii_ply(header, "3 0 1\n"), "cut short");
  expect_complaint("index.ply", ascii_ply(header, "3 0 1 4\n"), "names vertex 4 of 4");
  expect_complaint("negative.ply", ascii_ply(header, "3 0 1 -1\n"), "impossible number");
  expect_complaint("segment.ply", ascii_ply(header, "2 0 1\n"), "fewer than three corners");
  expect_complaint("list.ply", ascii_ply("element face 1\nproperty list uchar int corners\n", "3 0 1 2\n"),
                   "vertex_indices");
  const std::string lying = "element face 1\nproperty list uint int vertex_indices\n";
  expect_complaint("lying.ply", ascii_ply(lying, "4000000000 0 1 2\n"), "cut short");
  std::string nan = ascii_ply(header, "3 0 1 2\n");
  nan.replace(nan.find("1 1 0"), 1, "nan");
  expect_complaint("nan.ply", nan, "no finite coordinates");
}

TEST_F(MeshFileTest, obj_faces_count_from_one_or_backwards)
{
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  EXPECT_EQ(read_mesh_file(write("m.obj", vertices + "f 1/1/1 2//2 3 4/5\n"), Parallel()).triangles, two);
  EXPECT_EQ(read_mesh_file(write("m.obj", vertices + "f -4 -3 -2\nf -4 -2 -1\n"), Parallel()).triangles, two);
  expect_complaint("zero.obj", vertices + "f 0 1 2\n", "line 5");
  expect_complaint("before.obj", vertices + "f -5 1 2\n", "line 5 names a vertex that is not there");
  expect_complaint("after.obj", vertices + "f 1 2 5\n", "names vertex 4 of 4");
  expect_complaint("word.obj", vertices + "f a b c\n", "line 5");
}

std::string binary_stl(std::uint32_t announced)
{
  std::string bytes(80, ' ');
  bytes.append(reinterpret_cast<const char*>(&announced), 4);
  for (const Triangle& triangle : two) {
    const float corner[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    bytes.append(12, '\0');
    for (const std::uint32_t v : triangle) bytes.append(reinterpret_cast<const char*>(corner[v]), 12);
    bytes.append(2, '\0');
  }
  return bytes;
}

TEST_F(MeshFileTest, stl_corners_are_joined)
{
  const MeshFile mesh = read_mesh_file(write("m.stl", binary_stl(2)), Parallel());
  EXPECT_EQ(mesh.points.size(), 4U);
  EXPECT_EQ(mesh.triangles, two);
  const std::string facet =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nendloop\nendfacet\n";
  EXPECT_EQ(read_mesh_file(write("t.stl", "solid x\n" + facet + "endsolid x\n"), Parallel()).triangles.size(), 1U);
  expect_complaint("cut.stl", "solid x\n" + facet, "cut short");
  expect_complaint("few.stl", "solid x\nouter loop\nvertex 0 0 0\nendloop\nendsolid\n", "three corners");
  expect_complaint("word.stl", "solid x\nouter loop\nvertex 0 0 z\nendloop\nendsolid\n", "line 3");
  expect_complaint("lying.stl", binary_stl(3), "fewer than it announces");
  expect_complaint("empty.stl", "", "the file is empty");
}

TEST_F(MeshFileTest, every_written_format_comes_back)
{
  const MeshFile mesh = read_mesh_file(write("m.stl", binary_stl(2)), Parallel());
  for (const std::string& extension : mesh_extensions()) {
    if (extension == ".glb") {
      continue;  // written only
    }
    for (const bool ascii : {false, true}) {
      AtomicFile file(path("out" + extension));
      write_mesh(file, extension, mesh.points, mesh.triangles, ascii);
      file.finish();
      file.commit();
      const MeshFile back = read_mesh_file(path("out" + extension), Parallel());
      EXPECT_EQ(back.triangles, two) << extension;
      EXPECT_EQ(to_mesh(back).vertices, to_mesh(mesh).vertices) << extension;
    }
  }
}

TEST_F(MeshFileTest, files_without_a_mesh_are_refused)
{
  expect_complaint("empty.ply", "", "empty");
  expect_complaint("a.wrl", "#VRML", "extension");
  expect_complaint("a.las", "LASF", "cut short");
  expect_complaint("broken.vtk", "nothing of the kind", "");
  expect_complaint("broken.vtp", "<VTKFile", "");
  EXPECT_THROW(static_cast<void>(read_mesh_file(path("missing.stl"), Parallel())), InvalidInput);
}

}  // namespace
}  // namespace pds
