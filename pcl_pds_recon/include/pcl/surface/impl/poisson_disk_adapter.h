// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/PCLPointField.h>
#include <pcl/Vertices.h>
#include <pcl/pcl_base.h>
#include <pcl/pcl_macros.h>
#include <pcl/types.h>

#include <pcl_pds_recon/reconstruction.h>
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace pcl
{

/** \brief How the last call of PoissonDiskReconstruction::reconstruct ended.
 * \ingroup surface
 */
enum class PoissonDiskStatus
{
  not_run,          ///< reconstruct was not called yet
  success,          ///< the mesh is valid; it may be empty, if the points span no surface
  no_input,         ///< setInputCloud was not called, or with a null pointer
  invalid_indices,  ///< setIndices named a point that the cloud does not have
  invalid_option,   ///< an option is out of range
  invalid_input,    ///< the points cannot be processed
  failed            ///< memory ran out, or the search object or the progress callback threw
};

namespace detail
{

/** \brief Non-owning description of a cloud's memory, in which the point type is data and not a template parameter. */
struct PointRecords
{
  const std::uint8_t* data = nullptr;                       ///< first byte of the first point
  std::size_t stride = 0;                                   ///< bytes from one point to the next
  std::size_t size = 0;                                     ///< number of points
  std::vector<PCLPointField> fields;                        ///< name, type and place of every field of a point
  Eigen::Vector3d sensor_origin = Eigen::Vector3d::Zero();  ///< zero: unknown
};

/** \brief A user's search object behind two calls, so that its point type stays in the template. */
struct NeighborSearch
{
  /** \brief Hands over the cloud, restricted to \a points (ascending cloud indices), or all of it if null. */
  std::function<void(const IndicesPtr& points)> set_input;

  /** \brief Neighbours of the point at cloud index \a query, in any order; returns how many entries are valid. */
  std::function<int(index_t query, int k, Indices& neighbors)> nearest_k;

  explicit operator bool() const { return static_cast<bool>(nearest_k); }
};

/** \brief What PoissonDiskReconstruction keeps of a run. All point indices refer to the input cloud. */
struct PoissonDiskResult
{
  PoissonDiskStatus status = PoissonDiskStatus::not_run;
  std::string message = "reconstruct was not called yet";  ///< one line; empty on success
  Indices seeds;                                           ///< mesh vertex -> input index
  Indices all_seeds;                                       ///< the same, then the seeds without a face
  std::vector<std::array<std::uint32_t, 3>> triangles;     ///< of mesh vertices
  std::vector<std::array<std::uint32_t, 2>> segments;      ///< of curves, of mesh vertices
  std::vector<index_t> voronoi_labels;                     ///< per input point, into all_seeds; UNAVAILABLE: none
  std::vector<float> voronoi_distances;                    ///< per input point; NaN: no label
  Indices witness_points;                                  ///< ascending
  std::vector<Indices> boundary_loops;                     ///< of mesh vertices
  pds::MovedVertices moved;                                ///< with input indices; empty if vertices are input points
  pds::Report report;
};

/** \brief Runs the core on a PCL cloud and translates its results into PCL's terms.
 *
 * \param[in] records the cloud
 * \param[in] indices the points that take part, in any order and with repetitions, or null for all; not modified
 * \param[in] search the user's neighbour search, or an empty object for the core's own
 * \param[in] options what to do
 * \param[in] progress called at the start of every stage; may be empty
 * \return the result; whatever went wrong, exceptions of the callbacks included, is in its status and message
 */
PCL_EXPORTS PoissonDiskResult reconstructPoissonDisk(const PointRecords& records,
                                                     const Indices* indices,
                                                     const NeighborSearch& search,
                                                     const pds::Options& options,
                                                     const pds::Progress& progress);

/** \brief Puts vertices where \a result has moved them, with means of the fields over their cells.
 *
 * Fractional fields and colours become means; normals are unit vectors again. Other fields stay.
 * \param[in] cloud the input
 * \param[in,out] vertices as many records as there are vertices, of the same kind: copies of the seeds
 */
PCL_EXPORTS void applyMoves(const PoissonDiskResult& result, const PointRecords& cloud, std::uint8_t* vertices);

/** \brief The triangles of \a result, then its segments, as PCL polygons of mesh vertices. */
PCL_EXPORTS std::vector<Vertices> meshPolygons(const PoissonDiskResult& result);

/** \brief The same as PCL polygons of input indices. */
PCL_EXPORTS std::vector<Vertices> inputPolygons(const PoissonDiskResult& result);

}  // namespace detail
}  // namespace pcl
