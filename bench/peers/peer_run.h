// SPDX-License-Identifier: BSD-3-Clause
// What the runners of all peers share: they load the same cloud, measure only the work in memory, and print one line.
#pragma once

#include <pcl/PolygonMesh.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace peers
{

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

/** \brief The words of a runner's command line. */
struct Arguments
{
  std::string method;
  std::string cloud;     ///< file
  std::string mesh;      ///< file, or "-" for none
  double parameter = 0;  ///< what sets the number of vertices; its meaning is the method's
  unsigned threads = 1;
};

/** \brief Triangles on points, of which not all need to have a face. */
struct Mesh
{
  std::vector<std::array<float, 3>> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  double radius = 0;  ///< Poisson-disk radius, if the method has one
};

/** \brief Seconds of the clock and of all processors together, and bytes of memory above those that were in use at the
 * start. */
class Measurement
{
 public:
  void start();
  void stop();
  [[nodiscard]] double seconds() const { return seconds_; }
  [[nodiscard]] double processor_seconds() const { return processor_seconds_; }
  [[nodiscard]] std::int64_t peak_bytes() const { return peak_bytes_; }

 private:
  std::chrono::steady_clock::time_point begin_;
  std::int64_t bytes_before_ = 0;
  double processor_begin_ = 0;
  double seconds_ = 0;
  double processor_seconds_ = 0;
  std::int64_t peak_bytes_ = 0;
};

/** \brief Reconstructs the cloud between Measurement::start and stop; what it converts before and after is free. */
using Work = std::function<Mesh(const Cloud::Ptr& cloud, const Arguments& arguments, Measurement& measurement)>;

/** \brief The finite points of a PLY file, without faces and other fields. */
[[nodiscard]] Cloud::Ptr load(const std::string& file);

/** \brief The triangles of a PCL mesh; polygons of other sizes are an error. */
[[nodiscard]] Mesh from_pcl(const pcl::PolygonMesh& mesh);

/** \brief The main function of a runner: METHOD CLOUD MESH PARAMETER THREADS.
 *
 * Prints {"seconds", "processor_seconds", "peak_bytes", "points", "vertices", "faces", "radius"} and writes the mesh.
 * Vertices without a face are left out of both. \return exit status
 */
int run(int argc, char** argv, const Work& work);

}  // namespace peers
