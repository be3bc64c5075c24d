// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_pds_recon/parallel.h>
#include <pcl_pds_recon/point_cloud_view.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pds
{

/** \brief The scalar types of a field: those of a PLY property, and wide integers. */
enum class ScalarType
{
  int8,
  uint8,
  int16,
  uint16,
  int32,
  uint32,
  int64,
  uint64,
  float32,
  float64
};

/** \brief Calls \a visitor with a zero of the C++ type that \a type stands for. */
template <typename Visitor>
decltype(auto) visit_scalar(ScalarType type, Visitor&& visitor)
{
  switch (type) {
    case ScalarType::int8:
      return visitor(std::int8_t{});
    case ScalarType::uint8:
      return visitor(std::uint8_t{});
    case ScalarType::int16:
      return visitor(std::int16_t{});
    case ScalarType::uint16:
      return visitor(std::uint16_t{});
    case ScalarType::int32:
      return visitor(std::int32_t{});
    case ScalarType::uint32:
      return visitor(std::uint32_t{});
    case ScalarType::int64:
      return visitor(std::int64_t{});
    case ScalarType::uint64:
      return visitor(std::uint64_t{});
    case ScalarType::float32:
      return visitor(float{});
    case ScalarType::float64:
      break;
  }
  return visitor(double{});
}

/** \brief Bytes of one scalar. */
[[nodiscard]] std::size_t size_of(ScalarType type);

/** \brief Name of the type in a PLY header: char, uchar, short, ushort, int, uint, float or double; double for wide
 * integers, which PLY does not have. */
[[nodiscard]] const char* ply_name(ScalarType type);

/** \brief One scalar per point: x, y, z, intensity, red, ... */
struct Field
{
  std::string name;
  ScalarType type = ScalarType::float32;
  std::size_t offset = 0;  ///< of the scalar in a record, in bytes; set by PointTable
};

/** \brief Names of fields that belong together. */
using FieldTriple = std::array<const char*, 3>;
inline constexpr FieldTriple position_fields = {"x", "y", "z"};
inline constexpr FieldTriple normal_fields = {"nx", "ny", "nz"};
inline constexpr FieldTriple color_fields = {"red", "green", "blue"};
/** Where the sensor stood that saw a point, as in pcl::PointWithViewpoint. */
inline constexpr FieldTriple viewpoint_fields = {"vp_x", "vp_y", "vp_z"};
[[nodiscard]] bool is_one_of(const std::string& name, const FieldTriple& names);

/** \brief A point cloud as it stood in the file: one packed record of scalar fields per point, each kept to the last
 * bit.
 *
 * A record starts with x y z and, if all three are there, nx ny nz, and likewise vp_x vp_y vp_z, where the sensor stood
 * that saw the point; the other fields follow in the order of the file. Each three are float if the file says so,
 * otherwise double.
 */
class PointTable
{
 public:
  /** \brief A table with these fields and \a size rows of zeros.
   * \throws InvalidInput if x, y or z is missing or a name appears twice
   */
  explicit PointTable(std::vector<Field> fields, std::size_t size = 0);

  /** \brief Keeps the first rows; new ones are zero. \throws std::bad_alloc if there is no memory for them */
  void resize(std::size_t size);
  [[nodiscard]] std::size_t size() const { return size_; }

  [[nodiscard]] const std::vector<Field>& fields() const { return fields_; }
  [[nodiscard]] const Field* find(const std::string& name) const;  ///< nullptr if there is no such field

  [[nodiscard]] std::size_t record_bytes() const { return record_bytes_; }
  [[nodiscard]] std::byte* record(std::size_t i) { return records_.get() + i * record_bytes_; }
  [[nodiscard]] const std::byte* record(std::size_t i) const { return records_.get() + i * record_bytes_; }

  [[nodiscard]] double value(std::size_t i, const Field& field) const;
  void set_value(std::size_t i, const Field& field, double value);  ///< value must fit the field's type

  [[nodiscard]] bool has_double_positions() const { return fields_.front().type == ScalarType::float64; }
  [[nodiscard]] bool has_normals() const { return has_normals_; }
  [[nodiscard]] bool has_viewpoints() const { return has_viewpoints_; }

  /** \brief The type of red, green and blue if they are colours: all uchar, 0 ... 255, or all ushort, 0 ... 65535, or
   * all float or all double and every value in 0 ... 1 or, where a point has none, NaN. */
  [[nodiscard]] std::optional<ScalarType> color_type() const;

  /** \brief Where the sensor stood that saw the points without a viewpoint of their own, if the file says so. */
  std::optional<Eigen::Vector3d> sensor_origin;

  /** \brief Whether the file's format says that z points up, as those of surveying do. */
  bool z_is_up = false;

  std::string not_read;  ///< what the file holds besides, as the end of a sentence; empty if nothing

  /** \brief The rows of the first \a count of these indices, in their order. */
  [[nodiscard]] PointTable select(const std::vector<std::uint32_t>& indices, std::size_t count) const;

  /** \brief The same points with these fields in place of any of the same name; the new scalars are zero. */
  [[nodiscard]] PointTable with_fields(const std::vector<Field>& added, const Parallel& parallel) const;

  /** \brief What the reconstruction reads; valid as long as the table is neither changed nor destroyed. */
  [[nodiscard]] PointCloudView view() const;

 private:
  [[nodiscard]] Vector3View vectors_at(const Field& first) const;

  std::vector<Field> fields_;
  std::size_t record_bytes_ = 0;
  std::size_t size_ = 0;
  bool has_normals_ = false;
  bool has_viewpoints_ = false;
  struct Free
  {
    void operator()(std::byte* memory) const { std::free(memory); }
  };
  std::unique_ptr<std::byte[], Free> records_;  ///< of calloc: memory is touched first by the thread that fills it
};

}  // namespace pds
