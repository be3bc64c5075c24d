// SPDX-License-Identifier: BSD-3-Clause
// Feeds arbitrary points and options to reconstruct(): whatever comes out is a manifold, consistently oriented mesh of
// input points, or the input is refused.
#include <pcl_pds_recon/certificate.h>
#include <pcl_pds_recon/reconstruction.h>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <vector>

namespace
{

/** \brief Takes numbers off the front of the input; zeros when it is used up. */
class Bytes
{
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}

  [[nodiscard]] std::size_t left() const { return left_; }
  std::uint8_t byte()
  {
    if (left_ == 0) return 0;
    --left_;
    return *data_++;
  }
  /** \brief On a coarse lattice, so that points coincide and line up, or any bits at all: huge, tiny, not a number. */
  float coordinate(bool lattice)
  {
    if (lattice) return static_cast<float>(byte());
    std::uint32_t bits = 0;
    for (int i = 0; i < 4; ++i) bits = bits << 8 | byte();
    float value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }

 private:
  const std::uint8_t* data_;
  std::size_t left_;
};

pds::Options options_from(Bytes& bytes)
{
  constexpr double steps = 32;
  pds::Options options;
  options.threads = 1;
  options.k_neighbors = 3 + bytes.byte() % 30;
  options.radius_factor = 1 + bytes.byte() / steps;
  options.adaptive = bytes.byte() % 4 * 0.25;
  options.hole_size = bytes.byte() % 64;
  options.relax = bytes.byte() % 8 == 0 ? 1 : 0;
  options.placement = bytes.byte() % 2 == 0 ? pds::Placement::point : pds::Placement::quadric;
  options.dimension = bytes.byte() % 4 == 0 ? pds::Dimension::automatic : pds::Dimension::surface;
  options.seed = bytes.byte();
  return options;
}

void require(bool condition)
{
  if (!condition) std::abort();
}

void check(const pds::Reconstruction& result, std::size_t points)
{
  const pds::Report& report = result.report;
  require(report.nonmanifold_edges == 0 && report.nonmanifold_vertices == 0 && report.inconsistent_edges == 0);
  for (const pds::Triangle& t : result.triangles)
    for (const std::uint32_t v : t) require(v < result.seeds.size());
  for (const auto seed : result.seeds) require(static_cast<std::size_t>(seed) < points);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  Bytes bytes(data, size);
  const pds::Options options = options_from(bytes);
  const bool lattice = bytes.byte() % 4 != 0;
  std::vector<float> coordinates;
  while (bytes.left() > 0)
    for (int axis = 0; axis < 3; ++axis) coordinates.push_back(bytes.coordinate(lattice));
  pds::PointCloudView cloud;
  cloud.size = coordinates.size() / 3;
  cloud.positions = pds::Vector3View(coordinates.data(), 3 * sizeof(float));
  try {
    check(pds::reconstruct(cloud, options), cloud.size);
  } catch (const pds::InvalidInput&) {
    // Too few points, or none that is finite.
  } catch (const pds::InvalidOption&) {
    // The radius factor may be too small.
  }
  return 0;
}
