// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_pds_recon/certificate.h>
#include <pcl_pds_recon/ordered_points.h>
#include <pcl_pds_recon/poisson_disk_sampling.h>
#include <pcl_pds_recon/reconstruction.h>
#include <cstddef>

namespace pds
{

/** \brief Enters what became of the points, and the seeds. */
void report_sampling(const PoissonDiskSampling& sampling,
                     const OrderedPoints& points,
                     Report& report,
                     const Parallel& parallel);

/** \brief Enters the mesh's topology. */
void report_certificate(Certificate certificate, Reconstruction& result);

/** \brief Peak resident memory of the process, 0 if unknown. */
[[nodiscard]] std::size_t peak_resident_bytes();

}  // namespace pds
