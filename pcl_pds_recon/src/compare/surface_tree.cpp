// SPDX-License-Identifier: BSD-3-Clause
#include "compare/surface_tree.h"

#include <embree3/rtcore.h>
#include <pcl_pds_recon/options.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace pds
{

struct SurfaceTree::Scene
{
  explicit Scene(const TriangleMesh& mesh) : surface(mesh) {}
  ~Scene()
  {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  void add(std::uint32_t face)
  {
    faces.push_back(face);
    for (const std::uint32_t vertex : corners(face)) box.extend(surface.vertices[vertex]);
  }
  [[nodiscard]] Triangle corners(std::uint32_t face) const
  {
    return surface.faces.empty() ? Triangle{face, face, face} : surface.faces[face];
  }
  [[nodiscard]] Hit hit(const Eigen::Vector3d& p, std::uint32_t face) const
  {
    const Triangle t = corners(face);
    const auto [point, part] =
        closest_on_triangle(p, surface.vertices[t[0]], surface.vertices[t[1]], surface.vertices[t[2]]);
    return {face, point, part, (point - p).squaredNorm()};
  }
  /** \brief Embree works in a frame of its own, so that large coordinates lose nothing and large units fit a float. */
  [[nodiscard]] Eigen::Vector3d to_frame(const Eigen::Vector3d& p) const { return (p - center) * scale; }

  const TriangleMesh& surface;
  std::vector<std::uint32_t> faces;  ///< (or points) in the tree, by Embree's number
  Eigen::AlignedBox3d box;
  Eigen::Vector3d center{0, 0, 0};
  double scale = 1;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
};

namespace
{

// Errors of Embree's single-precision distances, with room to spare: relative to the distance, and to the coordinates.
constexpr double relative_margin = 1e-6;
constexpr double coordinate_margin = 4e-7;

template <typename Scene>
void write_bounds(const RTCBoundsFunctionArguments* arguments)
{
  const Scene& scene = *static_cast<const Scene*>(arguments->geometryUserPtr);
  Eigen::AlignedBox3d box;
  for (const std::uint32_t vertex : scene.corners(scene.faces[arguments->primID]))
    box.extend(scene.to_frame(scene.surface.vertices[vertex]));
  const auto below = [](double x) { return std::nextafter(static_cast<float>(x), -2.0F); };
  const auto above = [](double x) { return std::nextafter(static_cast<float>(x), 2.0F); };
  RTCBounds& bounds = *arguments->bounds_o;
  bounds.lower_x = below(box.min().x());
  bounds.lower_y = below(box.min().y());
  bounds.lower_z = below(box.min().z());
  bounds.upper_x = above(box.max().x());
  bounds.upper_y = above(box.max().y());
  bounds.upper_z = above(box.max().z());
}

/** \brief A search in progress. */
template <typename Scene>
struct Search
{
  const Scene& scene;
  const Eigen::Vector3d& p;
  double margin;
  SurfaceTree::Hit best;

  [[nodiscard]] float radius() const
  {
    return static_cast<float>(std::sqrt(best.squared_distance) * scene.scale * (1 + relative_margin) + margin);
  }
};

template <typename Scene>
bool visit(RTCPointQueryFunctionArguments* arguments)
{
  auto& search = *static_cast<Search<Scene>*>(arguments->userPtr);
  const SurfaceTree::Hit hit = search.scene.hit(search.p, search.scene.faces[arguments->primID]);
  const bool is_nearer =
      std::make_pair(hit.squared_distance, hit.face) < std::make_pair(search.best.squared_distance, search.best.face);
  if (!is_nearer) return false;
  search.best = hit;
  arguments->query->radius = search.radius();
  return true;
}

/** \brief Pairs are found by several threads, some of them twice. */
struct PairSearch
{
  const std::vector<std::uint32_t>& faces;
  const std::function<bool(std::uint32_t, std::uint32_t)>& test;
  std::mutex mutex;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
};

void collect_pairs(void* user, RTCCollision* collisions, unsigned int count)
{
  auto& search = *static_cast<PairSearch*>(user);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
  for (const RTCCollision* pair = collisions; pair != collisions + count; ++pair) {
    const auto [low, high] = std::minmax(search.faces[pair->primID0], search.faces[pair->primID1]);
    if (low != high && search.test(low, high)) found.emplace_back(low, high);
  }
  const std::lock_guard<std::mutex> lock(search.mutex);
  search.found.insert(search.found.end(), found.begin(), found.end());
}

}  // namespace

SurfaceTree::SurfaceTree(const TriangleMesh& surface, unsigned threads) : scene_(std::make_unique<Scene>(surface))
{
  if (surface.faces.empty()) {
    for (std::uint32_t i = 0; i < surface.vertices.size(); ++i)
      if (surface.vertices[i].allFinite()) scene_->add(i);
  } else {
    for (std::uint32_t f = 0; f < surface.faces.size(); ++f)
      if (area_normal(surface, surface.faces[f]).squaredNorm() > 0) scene_->add(f);
  }
  scene_->center = scene_->box.center();
  const double half_width = scene_->box.sizes().maxCoeff() / 2;
  scene_->scale = half_width > 0 ? 1 / half_width : 1;

  scene_->device = rtcNewDevice(("threads=" + std::to_string(threads)).c_str());
  if (scene_->device == nullptr) throw std::runtime_error("Embree cannot be started on this processor");
  scene_->scene = rtcNewScene(scene_->device);
  const RTCGeometry geometry = rtcNewGeometry(scene_->device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(scene_->faces.size()));
  rtcSetGeometryUserData(geometry, scene_.get());
  rtcSetGeometryBoundsFunction(geometry, write_bounds<Scene>, nullptr);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_->scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene_->scene);
  if (rtcGetDeviceError(scene_->device) != RTC_ERROR_NONE) throw std::bad_alloc();
}

SurfaceTree::~SurfaceTree() = default;

SurfaceTree::Hit SurfaceTree::closest(const Eigen::Vector3d& p, std::uint32_t near) const
{
  const Eigen::Vector3d q = scene_->to_frame(p);
  Search<Scene> search{*scene_, p, coordinate_margin * (1 + q.cwiseAbs().maxCoeff()), {}};
  search.best.squared_distance = std::numeric_limits<double>::infinity();
  if (near != none) search.best = scene_->hit(p, near);
  RTCPointQuery query{};
  query.x = static_cast<float>(q.x());
  query.y = static_cast<float>(q.y());
  query.z = static_cast<float>(q.z());
  query.radius = search.radius();
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(scene_->scene, &query, &context, visit<Scene>, &search);
  if (search.best.face == none || !std::isfinite(search.best.squared_distance))
    throw InvalidInput("the mesh and the reference are too far apart to be compared; are they in the same unit?");
  return search.best;
}

std::size_t SurfaceTree::count_pairs(const std::function<bool(std::uint32_t, std::uint32_t)>& test) const
{
  PairSearch search{scene_->faces, test, {}, {}};
  rtcCollide(scene_->scene, scene_->scene, collect_pairs, &search);
  std::sort(search.found.begin(), search.found.end());
  return static_cast<std::size_t>(std::unique(search.found.begin(), search.found.end()) - search.found.begin());
}

double SurfaceTree::diagonal() const { return scene_->box.sizes().norm(); }

}  // namespace pds
