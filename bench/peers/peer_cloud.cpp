// SPDX-License-Identifier: BSD-3-Clause
// Writes the finite points of a PLY file, without faces and fields that a tool might make use of: all get the same.
//   peer_cloud INPUT.ply OUTPUT.ply
#include <pcl/io/ply_io.h>

#include <exception>
#include <iostream>
#include <stdexcept>

#include "peer_run.h"

int main(int argc, char** argv)
{
  try {
    if (argc != 3) throw std::invalid_argument("usage: peer_cloud INPUT.ply OUTPUT.ply");
    const peers::Cloud::Ptr cloud = peers::load(argv[1]);
    if (cloud->empty()) throw std::runtime_error(std::string(argv[1]) + ": has no finite points");
    if (pcl::io::savePLYFileBinary(argv[2], *cloud) < 0) {
      throw std::runtime_error(std::string(argv[2]) + ": cannot be written");
    }
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "peer_cloud: " << error.what() << '\n';
    return 1;
  }
}
