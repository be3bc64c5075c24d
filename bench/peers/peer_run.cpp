// SPDX-License-Identifier: BSD-3-Clause
#include "peer_run.h"

#include <malloc.h>
#include <pcl/common/common.h>
#include <pcl/console/print.h>
#include <pcl/conversions.h>
#include <pcl/filters/filter.h>
#include <pcl/io/ply_io.h>

#include <ctime>
#include <fstream>
#include <iostream>
#include <sstream>
#include <stdexcept>

namespace peers
{
namespace
{

/** \brief A line of /proc/self/status, such as "VmHWM:   1234 kB", in bytes. */
std::int64_t memory_status(const std::string& key)
{
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind(key + ":", 0) == 0) return std::stoll(line.substr(key.size() + 1)) * 1024;
  }
  throw std::runtime_error("/proc/self/status has no " + key + "; measuring memory needs Linux");
}

/** \brief Seconds of this process on all processors so far. */
double processor_time() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/** \brief Sets the high-water mark of memory to what is in use now. */
void reset_peak_memory()
{
  std::ofstream clear_refs("/proc/self/clear_refs");
  clear_refs << "5" << std::flush;
  if (!clear_refs) throw std::runtime_error("cannot write /proc/self/clear_refs, which resets the peak of memory");
}

Arguments parse(int argc, char** argv)
{
  if (argc != 6) throw std::invalid_argument("usage: METHOD CLOUD.ply MESH.ply|- PARAMETER THREADS");
  Arguments arguments;
  arguments.method = argv[1];
  arguments.cloud = argv[2];
  arguments.mesh = argv[3];
  arguments.parameter = std::stod(argv[4]);
  arguments.threads = static_cast<unsigned>(std::stoul(argv[5]));
  return arguments;
}

double largest_side(const Cloud& cloud)
{
  pcl::PointXYZ low;
  pcl::PointXYZ high;
  pcl::getMinMax3D(cloud, low, high);
  return (high.getVector3fMap() - low.getVector3fMap()).maxCoeff();
}

/** \brief The mesh without the vertices that have no face, as PCL's writer takes it. */
pcl::PolygonMesh without_unused_vertices(const Mesh& mesh)
{
  constexpr std::uint32_t unused = 0xffffffffU;
  std::vector<std::uint32_t> number(mesh.vertices.size(), unused);
  Cloud used;
  pcl::PolygonMesh result;
  for (const auto& triangle : mesh.triangles) {
    pcl::Vertices polygon;
    for (const std::uint32_t v : triangle) {
      if (number[v] == unused) {
        number[v] = static_cast<std::uint32_t>(used.size());
        used.emplace_back(mesh.vertices[v][0], mesh.vertices[v][1], mesh.vertices[v][2]);
      }
      polygon.vertices.push_back(static_cast<pcl::index_t>(number[v]));
    }
    result.polygons.push_back(polygon);
  }
  pcl::toPCLPointCloud2(used, result.cloud);
  return result;
}

}  // namespace

void Measurement::start()
{
  malloc_trim(0);  // what loading has freed would be used again, and not be seen
  reset_peak_memory();
  bytes_before_ = memory_status("VmRSS");
  processor_begin_ = processor_time();
  begin_ = std::chrono::steady_clock::now();
}

void Measurement::stop()
{
  seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  processor_seconds_ = processor_time() - processor_begin_;
  peak_bytes_ = memory_status("VmHWM") - bytes_before_;
}

Cloud::Ptr load(const std::string& file)
{
  pcl::console::setVerbosityLevel(pcl::console::L_ERROR);  // properties that are not read are no concern here
  const Cloud::Ptr cloud(new Cloud);
  if (pcl::io::loadPLYFile(file, *cloud) < 0) throw std::runtime_error(file + ": not a readable PLY file");
  cloud->is_dense = false;  // the reader does not look
  pcl::Indices finite;
  pcl::removeNaNFromPointCloud(*cloud, *cloud, finite);
  return cloud;
}

Mesh from_pcl(const pcl::PolygonMesh& mesh)
{
  Cloud cloud;
  pcl::fromPCLPointCloud2(mesh.cloud, cloud);
  Mesh result;
  for (const auto& point : cloud) result.vertices.push_back({point.x, point.y, point.z});
  for (const auto& polygon : mesh.polygons) {
    const pcl::Indices& v = polygon.vertices;
    if (v.size() != 3) throw std::runtime_error("a polygon is not a triangle");
    result.triangles.push_back(
        {static_cast<std::uint32_t>(v[0]), static_cast<std::uint32_t>(v[1]), static_cast<std::uint32_t>(v[2])});
  }
  return result;
}

int run(int argc, char** argv, const Work& work)
{
  try {
    const Arguments arguments = parse(argc, argv);
    const Cloud::Ptr cloud = load(arguments.cloud);
    Measurement measurement;
    const Mesh result = work(cloud, arguments, measurement);
    const pcl::PolygonMesh mesh = without_unused_vertices(result);
    if (arguments.mesh != "-" && pcl::io::savePLYFileBinary(arguments.mesh, mesh) < 0) {
      throw std::runtime_error(arguments.mesh + ": cannot be written");
    }
    std::cout << "{\"seconds\": " << measurement.seconds()
              << ", \"processor_seconds\": " << measurement.processor_seconds()
              << ", \"peak_bytes\": " << measurement.peak_bytes() << ", \"points\": " << cloud->size()
              << ", \"vertices\": " << mesh.cloud.width * mesh.cloud.height << ", \"faces\": " << mesh.polygons.size()
              << ", \"radius\": " << result.radius << ", \"extent\": " << largest_side(*cloud) << "}\n";
    return 0;
  } catch (const std::exception& error) {
    std::cerr << argv[0] << ": " << error.what() << '\n';
    return 1;
  }
}

}  // namespace peers
