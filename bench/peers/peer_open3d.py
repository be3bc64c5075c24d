#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Open3D, with the same command line and result as the runners in C++: METHOD CLOUD MESH PARAMETER THREADS.

Methods: ball_pivoting, after voxel_down_sample, whose voxel is the parameter; poisson, on all points, whose parameter
is the width of an octree cell. Normals are estimated and oriented, for none are given.
"""
import json
import math
import sys
import time

import numpy
import open3d

NORMAL_NEIGHBORS = 15
BALL_RADII = (1.5, 3.0)  # in mean distances to the nearest point
POISSON_MARGIN = 1.1  # the cube of the octree over the cloud's largest extent, Open3D's default


def memory_status(key):
    """A line of /proc/self/status in bytes."""
    with open("/proc/self/status", encoding="ascii") as status:
        for line in status:
            if line.startswith(key + ":"):
                return int(line.split()[1]) * 1024
    raise RuntimeError(f"/proc/self/status has no {key}")


def with_normals(cloud):
    cloud.estimate_normals(open3d.geometry.KDTreeSearchParamKNN(NORMAL_NEIGHBORS))
    cloud.orient_normals_consistent_tangent_plane(NORMAL_NEIGHBORS)
    return cloud


def ball_pivoting(cloud, voxel):
    thinned = with_normals(cloud.voxel_down_sample(voxel))
    spacing = numpy.mean(thinned.compute_nearest_neighbor_distance())
    radii = open3d.utility.DoubleVector([factor * spacing for factor in BALL_RADII])
    return open3d.geometry.TriangleMesh.create_from_point_cloud_ball_pivoting(thinned, radii)


def poisson(cloud, cell):
    oriented = with_normals(open3d.geometry.PointCloud(cloud))
    extent = max(cloud.get_max_bound() - cloud.get_min_bound())
    # Only powers of two of cells fit into the cube; the margin makes up for it.
    depth = math.ceil(math.log2(POISSON_MARGIN * extent / cell))
    scale = cell * 2**depth / extent
    return open3d.geometry.TriangleMesh.create_from_point_cloud_poisson(oriented, depth=depth, scale=scale)[0]


def main():
    if len(sys.argv) != 6:
        sys.exit("usage: peer_open3d.py METHOD CLOUD.ply MESH.ply|- PARAMETER THREADS")
    method, cloud_file, mesh_file, parameter, _ = sys.argv[1:]  # OMP_NUM_THREADS sets the threads
    cloud = open3d.io.read_point_cloud(cloud_file)
    cloud.remove_non_finite_points()
    cloud.normals = open3d.utility.Vector3dVector()
    work = {"ball_pivoting": ball_pivoting, "poisson": poisson}[method]

    with open("/proc/self/clear_refs", "w", encoding="ascii") as clear_refs:
        clear_refs.write("5")  # sets the peak to what is in use now
    before = memory_status("VmRSS")
    begin, processor_begin = time.monotonic(), time.process_time()
    mesh = work(cloud, float(parameter))
    seconds, processor_seconds = time.monotonic() - begin, time.process_time() - processor_begin
    peak = memory_status("VmHWM") - before

    mesh.remove_unreferenced_vertices()
    if mesh_file != "-":
        open3d.io.write_triangle_mesh(mesh_file, mesh)
    print(json.dumps({"seconds": seconds, "processor_seconds": processor_seconds, "peak_bytes": peak,
                      "points": len(cloud.points), "vertices": len(mesh.vertices), "faces": len(mesh.triangles)}))


main()
