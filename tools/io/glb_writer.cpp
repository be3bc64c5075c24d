// SPDX-License-Identifier: BSD-3-Clause
#include "io/glb_writer.h"

#include "io/colors.h"

#include <pcl_pds_recon/version.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

namespace pds
{

namespace
{

using Json = nlohmann::json;

// Codes of glTF 2.0, sections 3.6 and 5.1.
constexpr int code_unsigned_short = 5123;
constexpr int code_unsigned_int = 5125;
constexpr int code_float = 5126;
constexpr int code_vertices = 34962;
constexpr int code_indices = 34963;
constexpr int code_lines = 1;
constexpr int code_triangles = 4;
constexpr std::uint32_t code_glb = 0x46546C67;     // "glTF"
constexpr std::uint32_t code_json = 0x4E4F534A;    // "JSON"
constexpr std::uint32_t code_binary = 0x004E4942;  // "BIN"

// Linear red, green, blue and alpha of a mesh without colours: on white no shading would be seen.
constexpr std::array<double, 4> clay = {0.55, 0.52, 0.47, 1};

/** The description of the file and the bytes that it describes. */
class GltfBuilder
{
 public:
  /** \brief Appends an array of vectors. \return its number */
  template <typename Number, std::size_t Size>
  int add(const std::vector<std::array<Number, Size>>& vectors, int number_code, const char* type, int target)
  {
    const std::size_t bytes = vectors.size() * sizeof vectors.front();
    views_.push_back({{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes}, {"target", target}});
    binary_.append(reinterpret_cast<const char*>(vectors.data()), bytes);
    binary_.resize((binary_.size() + 3) / 4 * 4, '\0');
    const int scalars = std::strcmp(type, "SCALAR") == 0 ? static_cast<int>(Size) : 1;
    accessors_.push_back({{"bufferView", views_.size() - 1},
                          {"componentType", number_code},
                          {"count", vectors.size() * static_cast<std::size_t>(scalars)},
                          {"type", type}});
    return static_cast<int>(accessors_.size()) - 1;
  }

  Json& accessor(int number) { return accessors_[static_cast<std::size_t>(number)]; }

  /** \brief The whole file. \param place of the mesh: properties of its node */
  [[nodiscard]] std::string finish(const Json& attributes, const Json& primitives, const Json& place) const
  {
    const bool has_colors = attributes.contains("COLOR_0");
    const std::array<double, 4> color = has_colors ? std::array<double, 4>{1, 1, 1, 1} : clay;
    const Json material = {
        {"doubleSided", true},
        {"pbrMetallicRoughness", {{"baseColorFactor", color}, {"metallicFactor", 0}, {"roughnessFactor", 1}}}};
    Json node = place;
    node["mesh"] = 0;
    const Json description = {{"asset", {{"version", "2.0"}, {"generator", "pcl_pds_recon " PCL_PDS_RECON_VERSION}}},
                              {"scene", 0},
                              {"scenes", {{{"nodes", {0}}}}},
                              {"nodes", {node}},
                              {"meshes", {{{"primitives", primitives}}}},
                              {"materials", {material}},
                              {"accessors", accessors_},
                              {"bufferViews", views_},
                              {"buffers", {{{"byteLength", binary_.size()}}}}};
    std::string text = description.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const auto length = [](std::size_t bytes) { return static_cast<std::uint32_t>(bytes); };
    constexpr std::size_t head_bytes = 12;
    constexpr std::size_t chunk_head_bytes = 8;
    constexpr std::uint32_t version = 2;
    std::string file;
    append(file, {code_glb, version, length(head_bytes + 2 * chunk_head_bytes + text.size() + binary_.size())});
    append(file, {length(text.size()), code_json});
    file += text;
    append(file, {length(binary_.size()), code_binary});
    file += binary_;
    return file;
  }

  [[nodiscard]] std::size_t bytes() const { return binary_.size(); }

 private:
  static void append(std::string& file, std::initializer_list<std::uint32_t> numbers)
  {
    file.append(reinterpret_cast<const char*>(numbers.begin()), numbers.size() * sizeof(std::uint32_t));
  }

  Json views_ = Json::array();
  Json accessors_ = Json::array();
  std::string binary_;
};

/** Positions of a float cloud stay to the last bit. */
Eigen::Vector3d find_origin(const PointTable& points)
{
  Eigen::AlignedBox3d box;
  if (points.has_double_positions()) {
    const Vector3View positions = points.view().positions;
    for (std::size_t row = 0; row < points.size(); ++row) {
      box.extend(positions[row]);
    }
  }
  return box.isEmpty() ? Eigen::Vector3d(0, 0, 0) : Eigen::Vector3d(box.center());
}

/** What the viewer does to the vertices: y is up in glTF, so z is turned there if it is up in the cloud; the origin is
 * put back. */
Json place_mesh(const Eigen::Vector3d& origin, bool z_is_up)
{
  Json place = Json::object();
  Eigen::Vector3d translation = origin;
  if (z_is_up) {
    place["rotation"] = {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)};  // a quarter turn around x, as x y z w
    translation = Eigen::Vector3d(origin.x(), origin.z(), -origin.y());
  }
  if (!translation.isZero(0)) {
    place["translation"] = {translation.x(), translation.y(), translation.z()};
  }
  return place;
}

int add_positions(GltfBuilder& builder, const PointTable& points, const Eigen::Vector3d& origin)
{
  const Vector3View view = points.view().positions;
  std::vector<std::array<float, 3>> positions(points.size());
  Eigen::AlignedBox3f box;
  for (std::size_t row = 0; row < points.size(); ++row) {
    const Eigen::Vector3f position = (view[row] - origin).cast<float>();
    positions[row] = {position.x(), position.y(), position.z()};
    box.extend(position);
  }
  const int number = builder.add(positions, code_float, "VEC3", code_vertices);
  builder.accessor(number)["min"] = {box.min().x(), box.min().y(), box.min().z()};
  builder.accessor(number)["max"] = {box.max().x(), box.max().y(), box.max().z()};
  return number;
}

/** glTF wants unit normals; a point without one gets one that faces up. */
int add_normals(GltfBuilder& builder, const PointTable& points)
{
  const Vector3View view = points.view().normals;
  std::vector<std::array<float, 3>> normals(points.size());
  for (std::size_t row = 0; row < points.size(); ++row) {
    const Eigen::Vector3d unit = view[row].stableNormalized();
    const bool is_normal = unit.allFinite() && !unit.isZero(0);
    const Eigen::Vector3f normal = (is_normal ? unit : Eigen::Vector3d(0, 0, 1)).cast<float>();
    normals[row] = {normal.x(), normal.y(), normal.z()};
  }
  return builder.add(normals, code_float, "VEC3", code_vertices);
}

/** The transfer function of sRGB (IEC 61966-2-1) from 0 ... 1 to 0 ... 1. */
double linear_of_srgb(double value)
{
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

int add_colors(GltfBuilder& builder, const PointTable& points)
{
  constexpr std::uint16_t opaque = std::numeric_limits<std::uint16_t>::max();
  const Colors colors(points);
  std::vector<std::array<std::uint16_t, 4>> linear(points.size(), {0, 0, 0, opaque});
  for (std::size_t row = 0; row < points.size(); ++row) {
    const std::array<double, 3> color = colors[row];
    std::transform(color.begin(), color.end(), linear[row].begin(), [](double channel) {
      return static_cast<std::uint16_t>(std::lround(linear_of_srgb(channel) * opaque));
    });
  }
  const int number = builder.add(linear, code_unsigned_short, "VEC4", code_vertices);
  builder.accessor(number)["normalized"] = true;
  return number;
}

}  // namespace

std::string make_glb(const PointTable& points, const Triangles& triangles, const Segments& segments)
{
  const Eigen::Vector3d origin = find_origin(points);
  GltfBuilder builder;
  Json attributes = {{"POSITION", add_positions(builder, points, origin)}};
  if (points.has_normals()) {
    attributes["NORMAL"] = add_normals(builder, points);
  }
  if (points.color_type()) {
    attributes["COLOR_0"] = add_colors(builder, points);
  }
  Json primitives = Json::array();
  const auto add_primitive = [&](const auto& cells, int mode) {
    if (!cells.empty()) {
      const int indices = builder.add(cells, code_unsigned_int, "SCALAR", code_indices);
      primitives.push_back({{"attributes", attributes}, {"indices", indices}, {"material", 0}, {"mode", mode}});
    }
  };
  add_primitive(triangles, code_triangles);
  add_primitive(segments, code_lines);
  if (builder.bytes() > std::numeric_limits<std::uint32_t>::max() / 2) {
    throw OutputError("the mesh is larger than the 4 GiB that glTF allows; write .ply");
  }
  return builder.finish(attributes, primitives, place_mesh(origin, points.z_is_up));
}

void write_glb(AtomicFile& file, const PointTable& points, const Triangles& triangles, const Segments& segments)
{
  const std::string bytes = make_glb(points, triangles, segments);
  file.write(bytes.data(), bytes.size());
}

}  // namespace pds
