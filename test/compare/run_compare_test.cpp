// SPDX-License-Identifier: BSD-3-Clause
#include "io/write_mesh.h"
#include "meshes.h"
#include "tool/run_testing.h"

#include <nlohmann/json.hpp>

namespace pds
{
namespace
{

using Json = nlohmann::json;

/** \brief Starts pcl_pds_compare as a user does. */
class RunCompare : public RunTool
{
 protected:
  void write_ply(const std::string& name, const TriangleMesh& mesh)
  {
    PointTable points({{"x", ScalarType::float64}, {"y", ScalarType::float64}, {"z", ScalarType::float64}});
    points.resize(mesh.vertices.size());
    for (std::size_t i = 0; i < points.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k)
        points.set_value(i, points.fields()[k], mesh.vertices[i][static_cast<Eigen::Index>(k)]);
    AtomicFile file(path(name));
    write_mesh(file, ".ply", points, mesh.faces, false);
    file.finish();
    file.commit();
  }
};

TEST_F(RunCompare, reports_the_keys_of_the_contract)
{
  write_ply("mesh.ply", make_sphere(1, 4));
  write_ply("reference.ply", make_sphere(1.01, 4));
  ASSERT_EQ(run("--json mesh.ply reference.ply"), 0) << errors();
  EXPECT_EQ(errors(), "");
  const Json report = Json::parse(output());
  for (const char* side : {"mesh_to_reference", "reference_to_mesh"})
    for (const char* figure : {"mean", "rms", "median", "p95", "p99", "max"})
      EXPECT_NEAR(report[side][figure].get<double>(), 0.01, 2e-4) << side << "." << figure;
  EXPECT_NEAR(report["hausdorff"].get<double>(), 0.01, 2e-4);
  EXPECT_NEAR(report["relative"]["hausdorff"].get<double>(), 0.01 / (2.02 * std::sqrt(3.0)), 1e-4);
  EXPECT_NEAR(report["diagonal"].get<double>(), 2.02 * std::sqrt(3.0), 1e-9);
  EXPECT_LT(report["normal_deviation"].get<double>(), 1);
  const Json& certificate = report["certificate"];
  EXPECT_EQ(certificate["components"], 1);
  EXPECT_EQ(certificate["euler"], 2);
  EXPECT_EQ(certificate["genus"], 0);
  EXPECT_EQ(certificate["closed"], true);
  EXPECT_EQ(certificate["orientable"], true);
  EXPECT_TRUE(certificate["self_intersections"].is_null());
  for (const char* key : {"nonmanifold_edges", "nonmanifold_vertices", "inconsistent_edges", "boundary_edges",
                          "boundary_loops", "duplicate_faces", "degenerate_faces", "unreferenced_vertices"})
    EXPECT_EQ(certificate[key], 0) << key;
}

TEST_F(RunCompare, tells_people_in_words)
{
  write_ply("mesh.ply", make_plane(0.5, 3));
  write_ply("reference.ply", make_plane(0, 3));
  ASSERT_EQ(run("mesh.ply reference.ply"), 0) << errors();
  for (const char* part : {"mesh to reference", "reference to mesh", "Hausdorff distance 0.5", "###", "boundary_loops"})
    EXPECT_NE(output().find(part), std::string::npos) << part << "\n" << output();
}

TEST_F(RunCompare, certifies_a_mesh_alone)
{
  TriangleMesh mesh = make_sphere(1, 3);
  TriangleMesh other = mesh;
  for (Eigen::Vector3d& p : other.vertices) p.x() += 0.5;
  append(mesh, other);
  write_ply("mesh.ply", mesh);
  ASSERT_EQ(run("--json --self-intersections mesh.ply"), 0) << errors();
  const Json report = Json::parse(output());
  EXPECT_FALSE(report.contains("hausdorff"));
  EXPECT_EQ(report["certificate"]["components"], 2);
  EXPECT_GT(report["certificate"]["self_intersections"], 0);
}

TEST_F(RunCompare, expectations_set_the_exit_status)
{
  write_ply("mesh.ply", make_plane(0.5, 3));
  write_ply("reference.ply", make_plane(0, 3));
  EXPECT_EQ(run("--json --expect 'mesh_to_reference.mean<=0.51' --expect 'certificate.closed==false' "
                "--expect 'certificate.boundary_loops==1' mesh.ply reference.ply"),
            0)
      << errors();
  EXPECT_EQ(run("--json --expect 'hausdorff<0.4' --expect 'certificate.euler>1' mesh.ply reference.ply"), 3);
  EXPECT_NE(errors().find("hausdorff<0.4 (is 0.5"), std::string::npos) << errors();
  EXPECT_NE(errors().find("certificate.euler>1 (is 1)"), std::string::npos) << errors();
  EXPECT_TRUE(Json::accept(output()));
  EXPECT_EQ(run("--expect 'certificate.self_intersections==0' mesh.ply"), 3);  // was not counted
  EXPECT_EQ(run("--expect 'certificate.wrong==0' mesh.ply"), 2);
  EXPECT_EQ(run("--expect 'certificate>0' mesh.ply"), 2);
  for (const char* wrong : {"hausdorff", "<=1", "hausdorff<=", "hausdorff=1", "hausdorff<=x"})
    EXPECT_EQ(run(std::string("--expect '") + wrong + "' mesh.ply reference.ply"), 2) << wrong;
}

TEST_F(RunCompare, writes_the_signed_deviation_of_every_vertex)
{
  write_ply("mesh.ply", make_plane(-0.5, 3));
  write_ply("reference.ply", make_plane(0, 3));
  ASSERT_EQ(run("--output out.ply mesh.ply reference.ply"), 0) << errors();
  const std::string bytes = read("out.ply");
  EXPECT_NE(bytes.find("property float deviation"), std::string::npos);
  EXPECT_EQ(run("--json out.ply mesh.ply --expect 'hausdorff<=1e-12'"), 0) << errors();
  const float deviation = -0.5F;
  EXPECT_NE(bytes.find(std::string(reinterpret_cast<const char*>(&deviation), sizeof deviation)), std::string::npos);
}

#ifdef PCL_PDS_RECON_WITH_RENDERING
TEST_F(RunCompare, draws_the_deviation_without_a_display)
{
  write_ply("mesh.ply", make_sphere(1, 3));
  write_ply("reference.ply", make_sphere(1.1, 3));
  ASSERT_EQ(run("--picture out.png mesh.ply reference.ply", "env -u DISPLAY"), 0) << errors();
  EXPECT_EQ(read("out.png").substr(1, 3), "PNG");
}
#endif

TEST_F(RunCompare, takes_a_single_triangle_and_a_cloud)
{
  write("one.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  write("cloud.xyz", "0.2 0.2 1\n0.3 0.3 1\n");
  ASSERT_EQ(run("--json one.obj cloud.xyz --expect 'reference_to_mesh.max==1'"), 0) << errors();
  EXPECT_TRUE(Json::parse(output())["normal_deviation"].is_null());
  write("point.xyz", "0.2 0.2 1\n");
  ASSERT_EQ(run("--json one.obj point.xyz --expect 'reference_to_mesh.max==1'"), 0) << errors();
  ASSERT_EQ(run("one.obj point.xyz"), 0) << errors();
}

TEST_F(RunCompare, names_what_is_wrong_in_one_line)
{
  write_ply("mesh.ply", make_plane(0, 3));
  write_ply("cloud.ply", make_lattice_cloud(0, 3));
  write("empty.ply", "");
  write("none.ply",
        "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 0\nproperty list uchar int vertex_indices\nend_header\n");
  write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
  write("nan.xyz", "nan nan nan\n");
  const auto before = files();
  for (const char* bad : {"cloud.ply", "empty.ply", "none.ply", "flat.obj", "missing.ply", "mesh.las"}) {
    EXPECT_EQ(run(std::string("--output out.ply ") + bad + " mesh.ply"), 1) << bad;
    EXPECT_TRUE(complained_of(bad)) << bad;
    EXPECT_TRUE(complained_of(";")) << bad << ": what to do";
  }
  for (const char* bad : {"empty.ply", "none.ply", "flat.obj", "missing.ply", "nan.xyz"}) {
    EXPECT_EQ(run(std::string("--output out.ply mesh.ply ") + bad), 1) << bad;
    EXPECT_TRUE(complained_of(bad)) << bad;
  }
  EXPECT_EQ(run("--output missing/out.ply mesh.ply cloud.ply"), 1);
  EXPECT_TRUE(complained_of("missing"));
  EXPECT_EQ(files(), before);
}

TEST_F(RunCompare, explains_its_usage)
{
  write_ply("mesh.ply", make_plane(0, 3));
  EXPECT_EQ(run("--help"), 0);
  EXPECT_NE(output().find("Usage: pcl_pds_compare"), std::string::npos);
  EXPECT_EQ(run("--version"), 0);
  for (const char* wrong :
       {"", "a b c", "--samples 0 mesh.ply mesh.ply", "--samples x mesh.ply mesh.ply", "-j 5000 mesh.ply mesh.ply",
        "--nonsense mesh.ply", "--output out.obj mesh.ply mesh.ply", "--output out.ply mesh.ply",
        "--output mesh.ply mesh.ply mesh.ply", "--picture a.jpg mesh.ply mesh.ply"}) {
    EXPECT_EQ(run(wrong), 2) << wrong;
    EXPECT_TRUE(complained_of("")) << wrong;
  }
}

}  // namespace
}  // namespace pds
