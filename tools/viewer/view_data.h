// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/colors.h"

#include <pcl_pds_recon/point_cloud_view.h>
#include <pcl_pds_recon/triangle_mesh.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace pds
{

/** \brief All that a view can show; what is empty is not there. */
struct ViewData
{
  PointCloudView cloud;                  ///< of somebody's points, who must outlive the view
  std::vector<ByteColor> point_color;    ///< of each point of the cloud
  std::vector<std::uint32_t> label;      ///< Voronoi cell of each point of the cloud, or no_label
  std::vector<std::uint32_t> witnesses;  ///< points of the cloud near Voronoi edges
  std::vector<std::uint32_t> seeds;      ///< points of the cloud; the first ones are the mesh's vertices
  std::vector<std::array<std::uint32_t, 2>> seed_edges;  ///< seed graph, numbers into seeds
  double radius = 0;                                     ///< of the Poisson disks
  TriangleMesh mesh;
  std::vector<ByteColor> vertex_color;                     ///< of each vertex of the mesh
  std::vector<std::vector<std::uint32_t>> boundary_loops;  ///< vertices of the mesh
  std::vector<double> deviation;                           ///< signed, of each vertex of the mesh
  std::vector<double> face_deviation;                      ///< signed, of each face's centroid: what the colours show
};

/** \brief What can be switched on and off. */
enum class Layer
{
  cloud,
  seeds,
  disks,  ///< circles of half the Poisson-disk radius, which do not overlap
  cells,  ///< points coloured by their Voronoi cell
  witnesses,
  graph,  ///< seed graph: which cells border each other
  mesh,
  edges,  ///< of the triangles
  loops,  ///< boundary loops
  normals,
  deviation  ///< the mesh in colours, with their bar
};

/** \brief The layers that say most about what is there. */
[[nodiscard]] std::vector<Layer> first_layers(const ViewData& data);

/** \brief A layer, the key that switches it and the name by which --show knows it. */
struct LayerName
{
  Layer layer;
  char key;
  const char* name;
};

constexpr std::array<LayerName, 11> layer_names = {{{Layer::cloud, 'c', "cloud"},
                                                    {Layer::seeds, 's', "seeds"},
                                                    {Layer::disks, 'd', "disks"},
                                                    {Layer::cells, 'l', "cells"},
                                                    {Layer::witnesses, 'w', "witnesses"},
                                                    {Layer::graph, 'g', "graph"},
                                                    {Layer::mesh, 'm', "mesh"},
                                                    {Layer::edges, 'e', "edges"},
                                                    {Layer::loops, 'b', "loops"},
                                                    {Layer::normals, 'n', "normals"},
                                                    {Layer::deviation, 'v', "deviation"}}};

}  // namespace pds
