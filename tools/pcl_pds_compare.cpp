// SPDX-License-Identifier: BSD-3-Clause
// Judges a mesh: its deviation from a mesh or cloud, and back, and its topology.
#include "compare/compare_options.h"
#include "compare/compare_report.h"
#include "compare/mesh_file.h"
#include "io/atomic_file.h"
#include "io/file_extension.h"
#include "io/write_mesh.h"
#include "printable.h"
#include "program.h"

#include <iostream>

#ifdef PCL_PDS_RECON_WITH_RENDERING
#include "viewer/deviation_picture.h"
#endif

namespace pds
{

namespace
{

void check_writable_outputs(const CompareOptions& options)
{
  for (const auto& path : {options.output, options.picture}) {
    if (!path.empty()) {
      check_writable(path);
    }
  }
}

CompareReport measure(const CompareOptions& options, const MeshFile& file)
{
  TriangleMesh mesh = to_mesh(file);
  if (mesh.faces.empty()) {
    throw InvalidInput(options.mesh + ": has no faces; give a mesh first, a point cloud only as REFERENCE");
  }
  CompareReport report;
  if (!options.reference.empty()) {
    const TriangleMesh reference = to_mesh(read_mesh_file(options.reference, Parallel(options.deviation.threads)));
    try {
      report.deviation = measure_deviation(mesh, reference, options.deviation);
    } catch (const InvalidInput& error) {
      throw InvalidInput(options.mesh + ", " + options.reference + ": " + error.what());
    }
  }
  if (options.weld) {
    weld(mesh);
  }
  report.certificate = inspect_mesh(mesh);
  if (options.self_intersections) {
    report.self_intersections = count_self_intersections(mesh, options.deviation.threads);
  }
  return report;
}

/** \brief Writes the mesh with the signed deviation as a field of its vertices. */
void write_deviation(const CompareOptions& options, const MeshFile& mesh, const Deviation& deviation)
{
  const std::string& path = options.output;
  const Parallel parallel(options.deviation.threads);
  PointTable points = mesh.points.with_fields({{"deviation", ScalarType::float32}}, parallel);
  const Field& field = *points.find("deviation");
  for (std::size_t i = 0; i < points.size(); ++i) {
    points.set_value(i, field, deviation.vertex_deviation[i]);
  }
  AtomicFile file(path);
  write_mesh(file, file_extension(path), points, mesh.triangles, false);
  file.finish();
  file.commit();
}

/** \return whether all expectations are met */
bool check_expectations(const CompareOptions& options, const nlohmann::ordered_json& report)
{
  std::string failures;
  for (const Expectation& expectation : options.expectations) {
    const std::string failure = unmet(expectation, report);
    if (!failure.empty()) {
      failures += (failures.empty() ? "" : "; ") + failure;
    }
  }
  if (!failures.empty()) {
    std::cerr << printable("pcl_pds_compare: not as expected: " + failures) << std::endl;
  }
  return failures.empty();
}

constexpr int exit_not_as_expected = 3;

int run(const CompareOptions& options)
{
  check_writable_outputs(options);
  const MeshFile mesh = read_mesh_file(options.mesh, Parallel(options.deviation.threads));
  const CompareReport report = measure(options, mesh);
  if (!options.output.empty()) {
    write_deviation(options, mesh, *report.deviation);
  }
#ifdef PCL_PDS_RECON_WITH_RENDERING
  if (!options.picture.empty()) {
    draw_deviation(options.picture, to_mesh(mesh), *report.deviation);
  }
#endif
  const nlohmann::ordered_json json = to_json(report);
  constexpr int indent = 2;
  std::cout << (options.json ? json.dump(indent) + "\n" : to_text(report)) << std::flush;
  return check_expectations(options, json) ? 0 : exit_not_as_expected;
}

}  // namespace

}  // namespace pds

int main(int argc, char** argv)
{
  return pds::run_program("pcl_pds_compare", [argc, argv] {
    const pds::CompareOptions options = pds::parse_compare_options(argc, argv);
    if (options.information.empty()) {
      return pds::run(options);
    }
    std::cout << options.information;
    return 0;
  });
}
