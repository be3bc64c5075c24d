// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/surface/impl/poisson_disk_adapter.h>
#include <pcl/surface/reconstruction.h>

#include <cstdint>
#include <string>
#include <vector>

namespace pcl
{

/** \brief Surface reconstruction through Poisson-disk sampling: an oriented, manifold triangle mesh on a subset of a
 * dense point cloud.
 *
 * The points need no normals and may hold NaN rows. Poisson-disk samples (seeds) are thrown on the cloud by growing
 * geodesic disks over the graph of the k nearest neighbours; the geodesic Voronoi diagram of the seeds tells which of
 * them are adjacent, and its dual is the mesh. All vertices are input points, unless setPlacement says otherwise. The
 * mesh never has an edge of more than two triangles, a vertex of more than one fan, or neighbours of opposite winding,
 * whatever the input.
 *
 * \code
 * pcl::PoissonDiskReconstruction<pcl::PointXYZ> reconstruction;
 * reconstruction.setInputCloud(cloud);
 * pcl::PolygonMesh mesh;
 * reconstruction.reconstruct(mesh);
 * \endcode
 *
 * This is not pcl::Poisson, which solves Poisson's equation (Kazhdan et al. 2006) and invents its vertices.
 *
 * Triangles run counter-clockwise seen from outside. A closed surface is oriented outward; an open one along the
 * normals, if PointInT has them and some are set, else towards PointCloud::sensor_origin_, if that is not zero, else up
 * (z, or y, or x), if it looks as if seen from there, as land is from an aircraft.
 * Where the cloud is one-sided, as a Moebius strip, the surface is cut.
 *
 * Cost: O(n log n) time, about 250 bytes per point, on all cores. The mesh depends neither on the number of threads
 * nor on the order of the points. Objects do not share state: several may run at once in different threads, each with
 * a search object of its own.
 *
 * \note If you use this code in any academic work, please cite:
 *   W. Hou, Z. Xu, N. Qin, D. Xiong, M. Ding.
 *   Surface Reconstruction through Poisson Disk Sampling.
 *   PLoS ONE 10(4): e0120151, 2015. Section names below refer to it.
 *
 * \ingroup surface
 */
template <typename PointInT>
class PoissonDiskReconstruction : public MeshConstruction<PointInT>
{
 public:
  using Ptr = shared_ptr<PoissonDiskReconstruction<PointInT>>;             ///< as in all classes of PCL
  using ConstPtr = shared_ptr<const PoissonDiskReconstruction<PointInT>>;  ///< as in all classes of PCL

  /** \brief fast_marching or dijkstra, see setGeodesicSolver(). */
  using GeodesicSolver = pds::GeodesicSolver;
  /** \brief point or quadric, see setPlacement(). */
  using Placement = pds::Placement;
  /** \brief curve, surface or automatic, see setDimension(). */
  using Dimension = pds::Dimension;

  /** \brief Constructor. The options' defaults suit a clean, dense scan. */
  PoissonDiskReconstruction();

  /** \brief Destructor. */
  ~PoissonDiskReconstruction() override = default;

  /** \brief Set the number of neighbours that a point is connected to ("Sampling interval").
   * \param[in] k number of neighbours, the point itself not counted (4 ... 200, default 15). More neighbours bridge
   * larger gaps and noise; time and memory grow with k.
   */
  void setKSearch(int k) { options_.k_neighbors = k; }

  /** \brief Get the number of neighbours that a point is connected to. */
  int getKSearch() const { return options_.k_neighbors; }

  /** \brief Set the radius of the Poisson disks relative to the density of the cloud.
   * \param[in] factor radius in sampling intervals, which are the mean distance of the points to their k neighbours
   * (1.5 ... 1000, default 3). The number of vertices falls with its square. Ignored if a radius is set.
   */
  void setRadiusFactor(double factor) { options_.radius_factor = factor; }

  /** \brief Get the radius of the Poisson disks in sampling intervals. */
  double getRadiusFactor() const { return options_.radius_factor; }

  /** \brief Set the radius of the Poisson disks: no two vertices are nearer to each other along the surface, except
   * a few added to keep its topology, and every point has a vertex within it.
   * \param[in] radius radius in the unit of the cloud; 0 (default) takes it from the radius factor. In adaptive mode
   * this is the radius where the weight is 1.
   */
  void setRadius(double radius) { options_.radius = radius; }

  /** \brief Get the radius of the Poisson disks as it was set; getReport().radius is the one that was used. */
  double getRadius() const { return options_.radius; }

  /** \brief Set the number of vertices of the mesh, from which the radius follows.
   * \param[in] vertices number of vertices, which is kept within 0.5 % or 2; 0 (default) = by the radius
   */
  void setNumberOfVertices(std::uint64_t vertices) { options_.vertices = vertices; }

  /** \brief Get the number of vertices as it was set; 0 = by the radius. */
  std::uint64_t getNumberOfVertices() const { return options_.vertices; }

  /** \brief Set how far the mesh may be from the cloud, from which the radius follows.
   * \param[in] distance 99 % of the points are within this distance of the mesh, which has as few vertices as that
   * takes; in the unit of the cloud, 0 (default) = by the radius
   */
  void setMaximumError(double distance) { options_.max_error = distance; }

  /** \brief Get how far the mesh may be from the cloud; 0 = by the radius. */
  double getMaximumError() const { return options_.max_error; }

  /** \brief Set how often the samples are moved to the middle of their Voronoi cells, which evens out the triangles.
   * \param[in] steps number of steps (0 ... 100, default 0). Samples may then be nearer to each other than the radius.
   */
  void setRelaxationSteps(unsigned steps) { options_.relax = steps; }

  /** \brief Get how often the samples are moved to the middle of their Voronoi cells. */
  unsigned getRelaxationSteps() const { return options_.relax; }

  /** \brief Set how much denser the mesh is where the surface is curved ("Adaptive sampling").
   * \param[in] c coefficient of the weight exp(c x) of distances, x the curvature divided by its mean over the cloud
   * (0 ... 2, default 0 = uniform; the paper uses 0.1, 0.25 and 0.3)
   */
  void setAdaptiveCoefficient(double c) { options_.adaptive = c; }

  /** \brief Get the coefficient of the curvature weight. */
  double getAdaptiveCoefficient() const { return options_.adaptive; }

  /** \brief Set which points witness that two seeds are adjacent: those about equally far from both ("2D manifold
   * case").
   * \param[in] threshold greatest difference of the two distances, in radii (0 ... 1, default 0.1)
   */
  void setVoronoiThreshold(double threshold) { options_.voronoi_threshold = threshold; }

  /** \brief Get the greatest difference of a witness's two distances, in radii. */
  double getVoronoiThreshold() const { return options_.voronoi_threshold; }

  /** \brief Set up to which size holes of the dual are filled.
   * \param[in] perimeter greatest perimeter of a filled hole, in radii (0 ..., default 15); 0 keeps only triangles of
   * the Voronoi dual. Larger holes and the rim of an open surface stay open,
   * but for holes across which Voronoi cells border everywhere: there is surface.
   */
  void setHoleSize(double perimeter) { options_.hole_size = perimeter; }

  /** \brief Get the greatest perimeter of a filled hole, in radii. */
  double getHoleSize() const { return options_.hole_size; }

  /** \brief Set how distances along the surface are computed.
   * \param[in] solver GeodesicSolver::fast_marching (default) or GeodesicSolver::dijkstra, which overestimates and is
   * there for comparison
   */
  void setGeodesicSolver(GeodesicSolver solver) { options_.geodesic_solver = solver; }

  /** \brief Get how distances along the surface are computed. */
  GeodesicSolver getGeodesicSolver() const { return options_.geodesic_solver; }

  /** \brief Set where the vertices of the mesh are.
   * \param[in] placement Placement::point (default): on input points. Placement::quadric: where the mesh fits the
   * points best; that is nearer to the surface, in the middle of noise and on creases. The mesh's cloud then holds
   * means of the fields over the vertices' Voronoi cells (of whole numbers other than colours the sample's value),
   * while seed indices and reconstruct(std::vector<pcl::Vertices>&) refer to the samples as before.
   */
  void setPlacement(Placement placement) { options_.placement = placement; }

  /** \brief Get where the vertices of the mesh are. */
  Placement getPlacement() const { return options_.placement; }

  /** \brief Set what the points are taken for ("1D manifold case").
   * \param[in] dimension Dimension::surface (default): triangles. Dimension::curve: polylines, open or closed, as
   * polygons of two vertices; what looks like a line at no scale is left out. Dimension::automatic: each connected part
   * of the cloud is what it looks like, and polygons of two vertices follow the triangles; getReport().curves tells how
   * many. Unless this is surface, settings that are about triangles must be at their defaults.
   */
  void setDimension(Dimension dimension) { options_.dimension = dimension; }

  /** \brief Get what the points are taken for. */
  Dimension getDimension() const { return options_.dimension; }

  /** \brief Set the number of threads. The mesh does not depend on it.
   * \param[in] threads number of worker threads; 0 (default) = all cores
   */
  void setNumberOfThreads(unsigned threads = 0) { options_.threads = threads; }

  /** \brief Get the number of threads as it was set; 0 = all cores. */
  unsigned getNumberOfThreads() const { return options_.threads; }

  /** \brief Set the seed of the random order in which disks are thrown.
   * \param[in] seed any number (default 0); each gives another, equally valid mesh
   */
  void setSeed(std::uint64_t seed) { options_.seed = seed; }

  /** \brief Get the seed of the random order in which disks are thrown. */
  std::uint64_t getSeed() const { return options_.seed; }

  /** \brief Set a function that is told how far a reconstruction is.
   * \param[in] progress called from the thread that reconstructs, at the start of every stage, with the stage's name
   * and the share of the work done so far (0 ... 1). An exception that it throws ends the run with status failed.
   */
  void setProgressCallback(const pds::Progress& progress) { progress_ = progress; }

  /** \brief Reconstruct the surface of the points given by setInputCloud and setIndices.
   *
   * Nothing is thrown on wrong input or settings: the polygons are empty then and getStatus() tells why.
   *
   * \param[out] output the mesh. Its cloud holds the vertices only, with every field of PointInT and the header of the
   * input; getSeedIndices() tells which input point a vertex is.
   */
  void reconstruct(pcl::PolygonMesh& output) override;

  /** \brief Reconstruct the surface of the points given by setInputCloud and setIndices.
   * \param[out] polygons the same triangles or polylines, in the same order, as of the overload above; they refer to
   * the points of the whole input cloud
   */
  void reconstruct(std::vector<pcl::Vertices>& polygons) override;

  /** \brief Get how the last reconstruction ended. */
  PoissonDiskStatus getStatus() const { return result_.status; }

  /** \brief Get one line that tells what went wrong in the last reconstruction; empty on success. */
  const std::string& getStatusMessage() const { return result_.message; }

  /** \brief Get the index in the input cloud of each vertex of the mesh. */
  const Indices& getSeedIndices() const { return result_.seeds; }

  /** \brief Get the index in the input cloud of each Poisson-disk sample: first the vertices of the mesh, in its
   * order, then the samples that ended without a triangle.
   */
  const Indices& getAllSeedIndices() const { return result_.all_seeds; }

  /** \brief Get the geodesic Voronoi diagram of the samples ("2D manifold case").
   * \return for each point of the input cloud the sample nearest to it along the surface, as a position in
   * getAllSeedIndices(); pcl::UNAVAILABLE (-1) for points that did not take part
   */
  const std::vector<index_t>& getVoronoiLabels() const { return result_.voronoi_labels; }

  /** \brief Get the distances that belong to the Voronoi diagram.
   * \return for each point of the input cloud its distance to the nearest sample along the surface, in the unit of the
   * cloud, weighted in adaptive mode; NaN for points that did not take part
   */
  const std::vector<float>& getVoronoiDistances() const { return result_.voronoi_distances; }

  /** \brief Get the input indices of the points that lie near edges of the Voronoi diagram, ascending. */
  const Indices& getWitnessPoints() const { return result_.witness_points; }

  /** \brief Get the rims of the mesh.
   * \return for each rim its vertices in the direction of the triangles along it, as positions in getSeedIndices()
   */
  const std::vector<Indices>& getBoundaryLoops() const { return result_.boundary_loops; }

  /** \brief Get what the last reconstruction did: counts, radius used, seconds per stage, and the topology of the mesh.
   */
  const pds::Report& getReport() const { return result_.report; }

 protected:
  using MeshConstruction<PointInT>::input_;
  using MeshConstruction<PointInT>::indices_;
  using MeshConstruction<PointInT>::tree_;
  using MeshConstruction<PointInT>::check_tree_;
  using MeshConstruction<PointInT>::initCompute;
  using MeshConstruction<PointInT>::deinitCompute;
  using PCLBase<PointInT>::fake_indices_;

  /** \brief Reconstruct into a mesh whose cloud holds the vertices only. Replaces all of \a output. */
  void performReconstruction(pcl::PolygonMesh& output) override;

  /** \brief Reconstruct into polygons of the input cloud. Replaces all of \a polygons. */
  void performReconstruction(std::vector<pcl::Vertices>& polygons) override;

  /** \brief Class get name method. */
  std::string getClassName() const override { return "PoissonDiskReconstruction"; }

 private:
  /** \brief Prepare the base class for a run; false, with the status set, if there is no input. */
  bool initReconstruction();

  /** \brief The input cloud without its type. */
  detail::PointRecords describeInput() const;

  /** \brief Run the core on the input and keep its result in result_. */
  void compute();

  /** \brief The user's search object behind calls that do not depend on PointInT; empty if there is none. */
  detail::NeighborSearch userSearch();

  pds::Options options_;
  pds::Progress progress_;
  detail::PoissonDiskResult result_;
};

}  // namespace pcl

#ifdef PCL_NO_PRECOMPILE
#include <pcl/surface/impl/poisson_disk_reconstruction.hpp>
#endif
