// SPDX-License-Identifier: BSD-3-Clause
// Judges a mesh: topology, angles and, against a reference surface, accuracy. Prints one line of JSON.
//   judge MESH.ply [REFERENCE.ply]
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/IO/PLY.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Simple_cartesian.h>
#include <pcl_pds_recon/certificate.h>

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <map>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Face = Kernel::Triangle_3;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, std::vector<Face>::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

constexpr std::size_t samples_per_surface = 200000;  // the mean's own error is then far below a per cent

/** \brief A triangle mesh as it is in the file, but for faces that name a corner twice. */
struct Mesh
{
  std::vector<Point> points;
  std::vector<pds::Triangle> triangles;
  std::size_t degenerate_faces = 0;
};

/** \param weld merges vertices at the same place first */
Mesh read(const std::string& file, bool weld)
{
  Mesh mesh;
  std::vector<std::vector<std::size_t>> polygons;
  if (!CGAL::IO::read_PLY(file, mesh.points, polygons)) throw std::runtime_error(file + ": not a readable PLY mesh");
  if (weld) CGAL::Polygon_mesh_processing::merge_duplicate_points_in_polygon_soup(mesh.points, polygons);
  for (const auto& p : polygons) {
    if (p.size() != 3) throw std::runtime_error(file + ": has a face that is not a triangle");
    if (p[0] == p[1] || p[1] == p[2] || p[2] == p[0]) {
      ++mesh.degenerate_faces;
    } else {
      mesh.triangles.push_back(
          {static_cast<std::uint32_t>(p[0]), static_cast<std::uint32_t>(p[1]), static_cast<std::uint32_t>(p[2])});
    }
  }
  if (mesh.triangles.empty()) throw std::runtime_error(file + ": has no faces");
  return mesh;
}

/** \brief Handles, summed over the components, as if each boundary loop were closed by a disk. Means
 * nothing on a mesh with defects. */
long long genus(const pds::Certificate& c)
{
  const auto loops = static_cast<long long>(c.boundary_loops.size());
  return static_cast<long long>(c.components) - (c.euler + loops) / 2;
}

using Sets = boost::disjoint_sets_with_storage<>;

struct EdgeFaces
{
  std::uint32_t first;  ///< one of them
  int count;
};
using Edges = std::map<std::pair<std::uint32_t, std::uint32_t>, EdgeFaces>;

Edges edges_of(const std::vector<pds::Triangle>& triangles)
{
  Edges edges;
  for (std::uint32_t f = 0; f < triangles.size(); ++f) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto edge = std::minmax(triangles[f][i], triangles[f][(i + 1) % 3]);
      ++edges.try_emplace(edge, EdgeFaces{f, 0}).first->second.count;
    }
  }
  return edges;
}

/** \brief Share of the faces in the largest component; components are connected by edges. */
double largest_component(const std::vector<pds::Triangle>& triangles, const Edges& edges)
{
  Sets sets(triangles.size());
  for (std::uint32_t f = 0; f < triangles.size(); ++f) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto edge = std::minmax(triangles[f][i], triangles[f][(i + 1) % 3]);
      sets.union_set(f, edges.at(edge).first);
    }
  }
  std::vector<std::size_t> faces(triangles.size());
  for (std::uint32_t f = 0; f < triangles.size(); ++f) ++faces[sets.find_set(f)];
  return static_cast<double>(*std::max_element(faces.begin(), faces.end())) / static_cast<double>(triangles.size());
}

/** \brief Connected sets of boundary edges, whichever way the faces run along them. The certificate follows their
 * direction and would count many short pieces where neighbours disagree, which is another defect and counted as such.
 * Of loops that touch in a vertex, only one is counted. */
std::size_t boundary_loops(const Edges& edges, std::size_t vertices)
{
  Sets sets(vertices);
  for (const auto& [edge, faces] : edges) {
    if (faces.count == 1) sets.union_set(edge.first, edge.second);
  }
  std::set<std::size_t> loops;
  for (const auto& [edge, faces] : edges) {
    if (faces.count == 1) loops.insert(sets.find_set(edge.first));
  }
  return loops.size();
}

std::vector<Face> faces_of(const Mesh& mesh)
{
  std::vector<Face> faces;
  for (const auto& t : mesh.triangles) faces.emplace_back(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
  return faces;
}

/** \brief Smallest angle of a triangle, in degrees; 0 if it has no area. */
double smallest_angle(const Face& face)
{
  double angle = 180;
  for (int i = 0; i < 3; ++i) angle = std::min(angle, CGAL::approximate_angle(face[i + 1], face[i], face[i + 2]));
  return std::isfinite(angle) ? angle : 0;
}

/** \brief Random points, evenly over the area. */
std::vector<Point> sample(const std::vector<Face>& faces)
{
  std::vector<double> area_up_to;
  double area = 0;
  for (const Face& face : faces) area_up_to.push_back(area += std::sqrt(face.squared_area()));
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<Point> points;
  for (std::size_t i = 0; i < samples_per_surface; ++i) {
    const auto at = std::upper_bound(area_up_to.begin(), area_up_to.end() - 1, uniform(random) * area);
    const Face& face = faces[static_cast<std::size_t>(at - area_up_to.begin())];
    const double s = std::sqrt(uniform(random));
    const double t = uniform(random);
    points.push_back(CGAL::barycenter(face[0], 1 - s, face[1], s * (1 - t), face[2], s * t));
  }
  return points;
}

/** \brief Distances from random points of one surface to the other, ascending, in diagonals of the reference. */
std::vector<double> distances(const std::vector<Face>& from, const std::vector<Face>& to, double diagonal)
{
  const Tree tree(to.begin(), to.end());
  std::vector<double> result;
  for (const Point& p : sample(from)) result.push_back(std::sqrt(tree.squared_distance(p)) / diagonal);
  std::sort(result.begin(), result.end());
  return result;
}

double mean(const std::vector<double>& values)
{
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double diagonal_of(const std::vector<Face>& faces)
{
  CGAL::Bbox_3 box;
  for (const Face& face : faces) box += face.bbox();
  return std::hypot(box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin());
}

/** \brief What meshes of the same shape have in common. */
void print_topology(const char* prefix, const pds::Certificate& c, std::size_t loops)
{
  std::cout << '"' << prefix << "components\": " << c.components << ", \"" << prefix << "boundary_loops\": " << loops
            << ", \"" << prefix << "genus\": " << genus(c);
}

void judge(const std::string& mesh_file, const std::string& reference_file)
{
  const Mesh mesh = read(mesh_file, false);
  const std::vector<Face> faces = faces_of(mesh);
  const pds::Certificate certificate = pds::certify(mesh.triangles, mesh.points.size());
  const Edges edges = edges_of(mesh.triangles);
  std::vector<double> angles;
  for (const Face& face : faces) angles.push_back(smallest_angle(face));

  std::cout << "{\"vertices\": " << certificate.vertices << ", \"faces\": " << certificate.faces
            << ", \"degenerate_faces\": " << mesh.degenerate_faces
            << ", \"nonmanifold_edges\": " << certificate.nonmanifold_edges
            << ", \"nonmanifold_vertices\": " << certificate.nonmanifold_vertices
            << ", \"inconsistent_edges\": " << certificate.inconsistent_edges << ", ";
  print_topology("", certificate, boundary_loops(edges, mesh.points.size()));
  std::cout << ", \"largest_component\": " << largest_component(mesh.triangles, edges)
            << ", \"mean_smallest_angle\": " << mean(angles)
            << ", \"smallest_angle\": " << *std::min_element(angles.begin(), angles.end());
  if (!reference_file.empty()) {
    const Mesh reference = read(reference_file, true);
    const std::vector<Face> truth = faces_of(reference);
    const double diagonal = diagonal_of(truth);
    const std::vector<double> to_reference = distances(faces, truth, diagonal);
    const std::vector<double> from_reference = distances(truth, faces, diagonal);
    std::cout << ", \"to_reference_mean\": " << mean(to_reference)
              << ", \"to_reference_p95\": " << to_reference[to_reference.size() * 95 / 100]
              << ", \"from_reference_mean\": " << mean(from_reference)
              << ", \"from_reference_p95\": " << from_reference[from_reference.size() * 95 / 100] << ", ";
    print_topology("reference_", pds::certify(reference.triangles, reference.points.size()),
                   boundary_loops(edges_of(reference.triangles), reference.points.size()));
  }
  std::cout << "}\n";
}

}  // namespace

int main(int argc, char** argv)
{
  try {
    if (argc < 2 || argc > 3) throw std::invalid_argument("usage: judge MESH.ply [REFERENCE.ply]");
    judge(argv[1], argc == 3 ? argv[2] : "");
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "judge: " << error.what() << '\n';
    return 1;
  }
}
