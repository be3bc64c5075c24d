// SPDX-License-Identifier: BSD-3-Clause
#include <pcl/point_types.h>
#include <pcl/impl/instantiate.hpp>
#include <pcl/surface/impl/poisson_disk_reconstruction.hpp>

PCL_INSTANTIATE(PoissonDiskReconstruction, PCL_XYZ_POINT_TYPES)
