// SPDX-License-Identifier: BSD-3-Clause
#include <pcl/common/io.h>
#include <pcl/surface/impl/poisson_disk_adapter.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <limits>
#include <new>
#include <stdexcept>
#include <utility>

namespace pcl::detail
{
namespace
{

struct InvalidIndices : std::out_of_range
{
  using std::out_of_range::out_of_range;
};

/** \brief A copy of \a indices, ascending and each once, for a cloud of \a cloud_size points. */
IndicesPtr makeCheckedIndices(const Indices& indices, std::size_t cloud_size)
{
  for (const index_t index : indices) {
    if (index < 0 || static_cast<std::size_t>(index) >= cloud_size) {
      throw InvalidIndices("index " + std::to_string(index) + " given to setIndices is outside the cloud of " +
                           std::to_string(cloud_size) + " points; use the indices of this cloud");
    }
  }
  IndicesPtr checked(new Indices(indices));
  std::sort(checked->begin(), checked->end());
  checked->erase(std::unique(checked->begin(), checked->end()), checked->end());
  return checked;
}

/** \brief The points that take part: all of a cloud or some of it, numbered by rows without gaps as the core wants. */
class PointSelection
{
 public:
  static constexpr std::uint32_t no_row = std::numeric_limits<std::uint32_t>::max();

  PointSelection(const PointRecords& cloud, const Indices* indices) : cloud_size_(cloud.size), rows_(cloud)
  {
    if (indices == nullptr) return;
    points_ = makeCheckedIndices(*indices, cloud.size);
    row_of_point_.assign(cloud.size, no_row);
    compacted_.resize(points_->size() * cloud.stride);
    for (std::size_t row = 0; row < points_->size(); ++row) {
      const std::size_t point = pointOfRow(row);
      row_of_point_[point] = static_cast<std::uint32_t>(row);
      std::memcpy(&compacted_[row * cloud.stride], cloud.data + point * cloud.stride, cloud.stride);
    }
    rows_.data = compacted_.data();
    rows_.size = points_->size();
  }
  PointSelection(const PointSelection&) = delete;  // rows_ points into compacted_
  PointSelection& operator=(const PointSelection&) = delete;

  const PointRecords& rows() const { return rows_; }

  std::size_t cloudSize() const { return cloud_size_; }

  /** \brief The chosen points in ascending order; null for all. */
  const IndicesPtr& points() const { return points_; }

  std::size_t pointOfRow(std::size_t row) const { return points_ ? static_cast<std::size_t>((*points_)[row]) : row; }

  /** \brief The row of a point of the cloud; no_row if it does not take part or there is no such point. */
  std::uint32_t rowOfPoint(index_t point) const
  {
    if (point < 0 || static_cast<std::size_t>(point) >= cloud_size_) return no_row;
    return points_ ? row_of_point_[static_cast<std::size_t>(point)] : static_cast<std::uint32_t>(point);
  }

  /** \brief Input indices of some rows. */
  template <typename Iterator>
  Indices pointsOfRows(Iterator first, Iterator last) const
  {
    Indices result;
    result.reserve(static_cast<std::size_t>(std::distance(first, last)));
    std::transform(first, last, std::back_inserter(result),
                   [this](std::uint32_t row) { return static_cast<index_t>(pointOfRow(row)); });
    return result;
  }

 private:
  std::size_t cloud_size_;
  IndicesPtr points_;
  std::vector<std::uint32_t> row_of_point_;
  std::vector<std::uint8_t> compacted_;  // records of the chosen points
  PointRecords rows_;
};

using FieldNames = std::array<const char*, 3>;

/** \brief View of three fields that lie side by side as an array of float or double; empty if they do not. */
pds::Vector3View viewFields(const PointRecords& records, const FieldNames& names)
{
  std::array<const PCLPointField*, 3> found{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const PCLPointField& field : records.fields) {
      if (field.name == names[axis]) found[axis] = &field;
    }
    if (found[axis] == nullptr || found[axis]->datatype != found[0]->datatype) return {};
  }
  const std::uint8_t datatype = found[0]->datatype;
  const auto scalar_size = static_cast<uindex_t>(getFieldSize(datatype));
  if (found[1]->offset != found[0]->offset + scalar_size || found[2]->offset != found[1]->offset + scalar_size)
    return {};
  const void* first = records.data + found[0]->offset;
  if (datatype == PCLPointField::FLOAT32) return {static_cast<const float*>(first), records.stride};
  if (datatype == PCLPointField::FLOAT64) return {static_cast<const double*>(first), records.stride};
  return {};
}

/** \brief Order of rows by the bytes of their fields. Padding between fields is never initialised, so it is skipped. */
std::function<bool(std::uint32_t, std::uint32_t)> recordOrder(const PointRecords& rows)
{
  struct Span
  {
    std::size_t offset;
    std::size_t size;
  };
  std::vector<Span> spans;
  for (const PCLPointField& field : rows.fields) {
    spans.push_back({field.offset, static_cast<std::size_t>(getFieldSize(field.datatype)) * field.count});
  }
  return [data = rows.data, stride = rows.stride, spans = std::move(spans)](std::uint32_t a, std::uint32_t b) {
    for (const Span& span : spans) {
      const int order = std::memcmp(data + a * stride + span.offset, data + b * stride + span.offset, span.size);
      if (order != 0) return order < 0;
    }
    return false;
  };
}

/** \brief The user's search in terms of rows; points that do not exist or do not take part are left out. */
std::function<void(std::uint32_t, std::size_t, std::vector<std::uint32_t>&)> rowSearch(const NeighborSearch& search,
                                                                                       const PointSelection& selection)
{
  return [&search, &selection, found = Indices()](std::uint32_t query, std::size_t count,
                                                  std::vector<std::uint32_t>& neighbors) mutable {
    const auto point = static_cast<index_t>(selection.pointOfRow(query));
    const auto k = static_cast<int>(std::min(count, selection.rows().size));
    const int reported = search.nearest_k(point, k, found);
    // Older search objects leave the vector at size k and fill it up with zeros.
    const std::size_t valid = std::min(found.size(), static_cast<std::size_t>(std::max(reported, 0)));
    neighbors.clear();
    for (std::size_t i = 0; i < valid; ++i) {
      const std::uint32_t row = selection.rowOfPoint(found[i]);
      if (row != PointSelection::no_row) neighbors.push_back(row);
    }
  };
}

pds::PointCloudView makeView(const PointSelection& selection, const NeighborSearch& search)
{
  const PointRecords& rows = selection.rows();
  pds::PointCloudView view;
  view.size = rows.size;
  if (rows.size == 0) return view;

  view.positions = viewFields(rows, {"x", "y", "z"});
  if (!view.positions) {
    throw pds::InvalidInput("the point type must hold x, y and z side by side, all float or all double");
  }
  view.normals = viewFields(rows, {"normal_x", "normal_y", "normal_z"});
  view.viewpoints = viewFields(rows, {"vp_x", "vp_y", "vp_z"});
  if (rows.sensor_origin.allFinite() && !rows.sensor_origin.isZero(0.0)) view.sensor_origin = rows.sensor_origin;
  view.record_less = recordOrder(rows);
  if (search) {
    search.set_input(selection.points());
    view.neighbor_search = rowSearch(search, selection);
  }
  return view;
}

PoissonDiskResult makeResult(pds::Reconstruction&& reconstruction, const PointSelection& selection)
{
  PoissonDiskResult result;
  result.status = PoissonDiskStatus::success;
  result.message.clear();

  const auto& seeds = reconstruction.seeds;
  result.all_seeds = selection.pointsOfRows(seeds.begin(), seeds.end());
  const auto vertex_count = static_cast<std::ptrdiff_t>(reconstruction.report.vertices);
  result.seeds.assign(result.all_seeds.begin(), result.all_seeds.begin() + vertex_count);
  result.triangles = std::move(reconstruction.triangles);
  result.segments = std::move(reconstruction.segments);

  result.voronoi_labels.assign(selection.cloudSize(), UNAVAILABLE);
  result.voronoi_distances.assign(selection.cloudSize(), std::numeric_limits<float>::quiet_NaN());
  const pds::VoronoiDiagram& voronoi = reconstruction.voronoi;
  for (std::size_t row = 0; row < voronoi.label.size(); ++row) {
    if (voronoi.label[row] == pds::no_label) continue;
    const std::size_t point = selection.pointOfRow(row);
    result.voronoi_labels[point] = static_cast<index_t>(voronoi.label[row]);
    result.voronoi_distances[point] = voronoi.distance[row];
  }

  const auto& witnesses = reconstruction.witness_points;
  result.witness_points = selection.pointsOfRows(witnesses.begin(), witnesses.end());
  for (const auto& loop : reconstruction.boundary_loops) {
    result.boundary_loops.emplace_back(loop.begin(), loop.end());
  }
  result.moved = std::move(reconstruction.moved);
  for (std::uint32_t& row : result.moved.cell_point) row = static_cast<std::uint32_t>(selection.pointOfRow(row));
  result.report = std::move(reconstruction.report);
  return result;
}

PoissonDiskResult makeFailure(PoissonDiskStatus status, const char* message)
{
  PoissonDiskResult result;
  result.status = status;
  result.message = message;
  return result;
}

}  // namespace

PoissonDiskResult reconstructPoissonDisk(const PointRecords& records,
                                         const Indices* indices,
                                         const NeighborSearch& search,
                                         const pds::Options& options,
                                         const pds::Progress& progress)
{
  try {
    pds::validate(options);  // before the user's search builds an index in vain
    const PointSelection selection(records, indices);
    const pds::PointCloudView view = makeView(selection, search);
    return makeResult(pds::reconstruct(view, options, progress), selection);
  } catch (const InvalidIndices& error) {
    return makeFailure(PoissonDiskStatus::invalid_indices, error.what());
  } catch (const pds::InvalidOption& error) {
    return makeFailure(PoissonDiskStatus::invalid_option, error.what());
  } catch (const pds::InvalidInput& error) {
    return makeFailure(PoissonDiskStatus::invalid_input, error.what());
  } catch (const std::bad_alloc&) {
    return makeFailure(PoissonDiskStatus::failed, "out of memory; use fewer points or fewer neighbours");
  } catch (const std::exception& error) {
    return makeFailure(PoissonDiskStatus::failed, error.what());
  } catch (...) {
    return makeFailure(PoissonDiskStatus::failed, "an exception of unknown type was thrown");
  }
}

std::vector<Vertices> meshPolygons(const PoissonDiskResult& result)
{
  std::vector<Vertices> polygons(result.triangles.size() + result.segments.size());
  std::size_t next = 0;
  for (const auto& triangle : result.triangles) polygons[next++].vertices.assign(triangle.begin(), triangle.end());
  for (const auto& segment : result.segments) polygons[next++].vertices.assign(segment.begin(), segment.end());
  return polygons;
}

std::vector<Vertices> inputPolygons(const PoissonDiskResult& result)
{
  std::vector<Vertices> polygons = meshPolygons(result);
  for (Vertices& polygon : polygons) {
    for (index_t& vertex : polygon.vertices) vertex = result.seeds[static_cast<std::size_t>(vertex)];
  }
  return polygons;
}

}  // namespace pcl::detail
