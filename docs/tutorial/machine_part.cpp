// SPDX-License-Identifier: BSD-3-Clause
// Usage: machine_part SCAN.ply TOLERANCE MESH.ply
#include <pcl/conversions.h>
#include <pcl/io/ply_io.h>
#include <pcl/surface/poisson_disk_reconstruction.h>
#include <pcl_pds_recon/deviation.h>
#include <pcl_pds_recon/mesh_inspection.h>

#include <cstdlib>
#include <iostream>

int main(int argc, char** argv)
{
  if (argc != 4) {
    std::cerr << "usage: machine_part SCAN.ply TOLERANCE MESH.ply\n";
    return 2;
  }
  const double tolerance = std::atof(argv[2]);
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
  if (pcl::io::loadPLYFile(argv[1], *cloud) != 0) return 1;

  pcl::PoissonDiskReconstruction<pcl::PointXYZ> reconstruction;
  reconstruction.setInputCloud(cloud);
  reconstruction.setRadius(2.0);                         // mm: a third of the thickness of the ribs
  reconstruction.setPlacement(pds::Placement::quadric);  // vertices slide onto the edges
  pcl::PolygonMesh output;
  reconstruction.reconstruct(output);

  // The comparison has types of its own, without PCL. A reference without faces is a cloud.
  pds::TriangleMesh mesh, reference;
  for (const pcl::PointXYZ& point : *cloud) reference.vertices.push_back(point.getVector3fMap().cast<double>());
  pcl::PointCloud<pcl::PointXYZ> vertices;
  pcl::fromPCLPointCloud2(output.cloud, vertices);
  for (const pcl::PointXYZ& vertex : vertices) mesh.vertices.push_back(vertex.getVector3fMap().cast<double>());
  for (const pcl::Vertices& polygon : output.polygons) {
    const auto& v = polygon.vertices;
    mesh.faces.push_back({std::uint32_t(v[0]), std::uint32_t(v[1]), std::uint32_t(v[2])});
  }

  // [compare]
  const pds::MeshInspection certificate = pds::inspect_mesh(mesh);
  const pds::Deviation deviation = pds::measure_deviation(mesh, reference);
  const pds::Distribution& distance = deviation.reference_to_mesh;  // of the scan's points from the mesh
  // [compare]

  std::cout << certificate.vertices << " vertices, genus " << certificate.genus.value_or(-1) << '\n'
            << "distance of the points from the mesh: mean " << distance.mean << " mm, 99 % below " << distance.p99
            << " mm\n";
  for (const pcl::Indices& loop : reconstruction.getBoundaryLoops()) {
    Eigen::Vector3d center(0, 0, 0);
    for (const auto vertex : loop) center += mesh.vertices[vertex] / loop.size();
    std::cout << "open near " << center.transpose() << '\n';
  }
  if (pcl::io::savePLYFileBinary(argv[3], output) != 0) return 1;
  return distance.p99 <= tolerance ? 0 : 1;
}
