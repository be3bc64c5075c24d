// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/orientation.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace pds
{
namespace
{

using Eigen::Vector3d;

/** \brief One component with its integrals. */
class Component
{
 public:
  Component(const TriangleComplex& complex, const std::vector<std::uint32_t>& faces) : position_(complex.position())
  {
    for (const std::uint32_t f : faces) {
      const Triangle t = complex.oriented(f);
      triangles.push_back(t);
      for (std::size_t e = 0; e < 3; ++e)
        if (complex.other_face(f, t[e], t[(e + 1) % 3]) == TriangleComplex::no_face) closed_ = false;
      const Vector3d area = area_vector(t);
      area_vector_ += area;
      area_ += area.norm();
      centroid_ += area.norm() * (position_[t[0]] + position_[t[1]] + position_[t[2]]) / 3.0;
    }
    if (area_ > 0) centroid_ /= area_;
  }

  /** \brief Positive if the faces point outside as far as anybody can tell. */
  [[nodiscard]] double outwardness(const OrientationCues& cues) const
  {
    double vote = 0;
    if (closed_) return volume();
    if (!cues.normal.empty()) vote = agreement(cues.normal);
    if (vote == 0 && !cues.viewpoint.empty()) vote = facing(cues.viewpoint);
    if (vote == 0 && area_vector_.norm() > least_facing * area_) vote = upwardness();
    return vote != 0 ? vote : volume();
  }

  std::vector<Triangle> triangles;

 private:
  // A surface whose area vectors add up to this share of its area faces one side as a whole: terrain with walls and
  // trees has 0.3 and more, a shape that is nearly closed less than 0.1.
  static constexpr double least_facing = 0.15;

  [[nodiscard]] Vector3d area_vector(const Triangle& t) const
  {
    return 0.5 * (position_[t[1]] - position_[t[0]]).cross(position_[t[2]] - position_[t[0]]);
  }

  /** \brief Signed volume of the cone over the faces from their centroid. */
  [[nodiscard]] double volume() const
  {
    double sum = 0;
    for (const Triangle& t : triangles) sum += area_vector(t).dot(position_[t[0]] - centroid_) / 3.0;
    return sum;
  }

  [[nodiscard]] double agreement(const std::vector<Vector3d>& normal) const
  {
    double sum = 0;
    for (const Triangle& t : triangles) {
      const Vector3d mean = normal[t[0]] + normal[t[1]] + normal[t[2]];
      if (mean.allFinite()) sum += area_vector(t).dot(mean);
    }
    return sum;
  }

  [[nodiscard]] double facing(const std::vector<Vector3d>& viewpoint) const
  {
    double sum = 0;
    for (const Triangle& t : triangles)
      for (const std::uint32_t v : t)
        if (viewpoint[v].allFinite()) sum += area_vector(t).dot((viewpoint[v] - position_[v]).normalized());
    return sum;
  }

  /** \brief Sign of the first of z, y, x in which the area vector is not small. */
  [[nodiscard]] double upwardness() const
  {
    constexpr double small = 0.1;  // of the area vector's length
    for (const int axis : {2, 1, 0})
      if (std::abs(area_vector_[axis]) > small * area_vector_.norm()) return area_vector_[axis];
    return 0;
  }

  const std::vector<Vector3d>& position_;
  bool closed_ = true;
  double area_ = 0;
  Vector3d area_vector_ = Vector3d::Zero();
  Vector3d centroid_ = Vector3d::Zero();
};

/** \brief Where the sensor stood that saw a point; NaN if nobody says. */
Eigen::Vector3d viewpoint(const PointCloudView& cloud, std::size_t point)
{
  const Eigen::Vector3d unknown = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  if (cloud.viewpoints)
    if (Eigen::Vector3d own = cloud.viewpoints[point]; own.allFinite()) return own;
  return cloud.sensor_origin.value_or(unknown);
}

}  // namespace

OrientationCues orientation_cues(const PointCloudView& cloud,
                                 const OrderedPoints& points,
                                 const PoissonDiskSampling& sampling)
{
  OrientationCues cues;
  if (cloud.normals)
    for (const std::uint32_t rank : sampling.seeds) cues.normal.push_back(cloud.normals[points.input_index[rank]]);
  if (!cloud.viewpoints && !cloud.sensor_origin) return cues;
  for (const std::uint32_t rank : sampling.seeds)
    cues.viewpoint.emplace_back((viewpoint(cloud, points.input_index[rank]) - points.origin) /
                                (points.unit * sampling.radius));
  return cues;
}

std::vector<Triangle> orient_faces(const TriangleComplex& complex, const OrientationCues& cues)
{
  std::vector<Triangle> triangles;
  for (const std::vector<std::uint32_t>& faces : complex.components()) {
    Component component(complex, faces);
    if (component.outwardness(cues) < 0)
      for (Triangle& t : component.triangles) std::swap(t[1], t[2]);
    triangles.insert(triangles.end(), component.triangles.begin(), component.triangles.end());
  }
  return triangles;
}

}  // namespace pds
