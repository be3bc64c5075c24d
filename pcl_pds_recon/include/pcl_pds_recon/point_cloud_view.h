// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <optional>
#include <vector>

namespace pds
{

/** \brief Non-owning view of n triples of scalars lying at a fixed stride: positions or normals of a cloud.
 *
 * The data may have any alignment; both float and double clouds are read without a copy.
 */
class Vector3View
{
 public:
  Vector3View() = default;

  /** \param data first coordinate of the first triple
   *  \param stride_bytes distance from one triple to the next
   */
  Vector3View(const float* data, std::size_t stride_bytes)
      : data_(reinterpret_cast<const std::uint8_t*>(data)), stride_(stride_bytes), is_double_(false)
  {
  }
  /** \overload */
  Vector3View(const double* data, std::size_t stride_bytes)
      : data_(reinterpret_cast<const std::uint8_t*>(data)), stride_(stride_bytes), is_double_(true)
  {
  }

  /** \brief True if the view refers to data at all. */
  explicit operator bool() const { return data_ != nullptr; }

  /** \brief The i-th triple, exact in double precision. */
  Eigen::Vector3d operator[](std::size_t i) const
  {
    const std::uint8_t* triple = data_ + i * stride_;
    if (is_double_) {
      double d[3];
      std::memcpy(d, triple, sizeof d);
      return {d[0], d[1], d[2]};
    }
    float f[3];
    std::memcpy(f, triple, sizeof f);
    return {f[0], f[1], f[2]};
  }

  /** \brief Asks for a triple that is needed soon to be brought from memory. */
  void prefetch(std::size_t i) const { __builtin_prefetch(data_ + i * stride_); }

 private:
  const std::uint8_t* data_ = nullptr;
  std::size_t stride_ = 0;
  bool is_double_ = false;
};

/** \brief The input of a reconstruction: a non-owning view of somebody's point cloud.
 *
 * Points with a NaN or infinite coordinate are skipped. Indices in every result refer to this view.
 */
struct PointCloudView
{
  std::size_t size = 0;   ///< number of points, below 2^31
  Vector3View positions;  ///< coordinates, in any unit and at any distance from the origin
  Vector3View normals;    ///< optional; they decide the orientation of open surfaces. NaN or zero ones have no say
  /** \brief Optional: where the sensor stood that saw each point, as scans that were merged have different ones. Open
   * surfaces without normals face it. NaN ones have no say. */
  Vector3View viewpoints;
  std::optional<Eigen::Vector3d> sensor_origin;  ///< optional; the viewpoint of points that have none of their own

  /** \brief Optional strict weak order of two points by all their field bytes; of several coincident points the first
   * by this order represents them, then the one of lowest index. It must be safe to call from several threads. */
  std::function<bool(std::uint32_t, std::uint32_t)> record_less;

  /** \brief Optional neighbour search that replaces the built-in one: writes the indices of the \a count points
   * nearest to point \a query, in any order and with or without the query itself, fewer if there are no more.
   * Called from one thread. Indices of points that are not part of the view or not finite are ignored. */
  std::function<void(std::uint32_t query, std::size_t count, std::vector<std::uint32_t>& neighbors)> neighbor_search;
};

}  // namespace pds
