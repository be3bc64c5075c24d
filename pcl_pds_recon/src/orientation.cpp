// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/orientation.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include "surface_integrals.h"

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
    }
    integrals_ = integrate(triangles, position_);
  }

  /** \brief Positive if the faces point outside as far as anybody can tell. */
  [[nodiscard]] double outwardness(const OrientationCues& cues) const
  {
    double vote = 0;
    if (closed_) return integrals_.volume;
    if (!cues.normal.empty()) vote = agreement(cues.normal);
    if (vote == 0 && !cues.viewpoint.empty()) vote = facing(cues.viewpoint);
    if (vote == 0 && integrals_.faces_one_side()) vote = upwardness();
    return vote != 0 ? vote : integrals_.volume;
  }

  std::vector<Triangle> triangles;

 private:
  [[nodiscard]] double agreement(const std::vector<Vector3d>& normal) const
  {
    double sum = 0;
    for (const Triangle& t : triangles) {
      const Vector3d mean = normal[t[0]] + normal[t[1]] + normal[t[2]];
      if (mean.allFinite()) sum += area_vector(t, position_).dot(mean);
    }
    return sum;
  }

  [[nodiscard]] double facing(const std::vector<Vector3d>& viewpoint) const
  {
    double sum = 0;
    for (const Triangle& t : triangles)
      for (const std::uint32_t v : t)
        if (viewpoint[v].allFinite()) sum += area_vector(t, position_).dot((viewpoint[v] - position_[v]).normalized());
    return sum;
  }

  /** \brief Sign of the first of z, y, x in which the area vector is not small. */
  [[nodiscard]] double upwardness() const
  {
    const Vector3d& all = integrals_.area_vector;
    constexpr double small = 0.1;  // of the area vector's length
    for (const int axis : {2, 1, 0})
      if (std::abs(all[axis]) > small * all.norm()) return all[axis];
    return 0;
  }

  const std::vector<Vector3d>& position_;
  bool closed_ = true;
  SurfaceIntegrals integrals_;
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
                                 const PoissonDiskSampling& sampling,
                                 const std::vector<Vector3d>& outward)
{
  OrientationCues cues;
  if (cloud.normals)
    for (const std::uint32_t rank : sampling.seeds) cues.normal.push_back(cloud.normals[points.input_index[rank]]);
  if (!cloud.viewpoints && !cloud.sensor_origin) {
    if (!cloud.normals) cues.normal = outward;
    return cues;
  }
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
