#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Reconstructs raw scans with their normals and without, and prints how many faces are on the side that the normals of
the nearest scan points tell, and how many edges join a front to a back. Last of each the reference itself, with as many
faces, where the mesh is.

Needs python3-numpy and python3-open3d (bench/peers/install.sh). docs/quality.md has the columns.
"""
import argparse
import tempfile
from pathlib import Path

import numpy
import open3d

from trials import add_folders, are_there, reconstruct

CASES = (("dragon", "dragon_stand_rawscans.ply", "dragon_vrip.ply"), ("bunny", "bunny_rawscans.ply", "bun_zipper.ply"))
OPPOSED = -0.5  # cosine of 120 degrees
ASIDE = 0.5  # cosine of 60 degrees: a face turned by more is not of the reference's surface there ...
APART = 0.5  # ... nor is one farther off, in radii: the scans' noise, and what a face cuts off where the surface bends


def face_normals(mesh):
    corners = numpy.asarray(mesh.vertices)[numpy.asarray(mesh.triangles)]
    normals = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = numpy.linalg.norm(normals, axis=1)
    normals[lengths > 0] /= lengths[lengths > 0, None]  # the reference has faces without area
    return corners.mean(axis=1), normals


def edges_of_two(triangles):
    """Pairs of faces that an edge joins."""
    faces_at = {}
    for face, corners in enumerate(triangles):
        for edge in range(3):
            faces_at.setdefault(frozenset((corners[edge], corners[(edge + 1) % 3])), []).append(face)
    return numpy.array([faces for faces in faces_at.values() if len(faces) == 2])


class Reference:
    """The faces of a finer mesh, by where they are."""

    def __init__(self, mesh, radius):
        centers, normals = face_normals(mesh)
        has_area = normals.any(axis=1)
        self.centers, self.normals, self.radius = centers[has_area], normals[has_area], radius
        self.cloud = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(self.centers))  # the tree holds no copy
        self.tree = open3d.geometry.KDTreeFlann(self.cloud)

    def has_crease(self, place):
        """Whether it faces front and back within a radius: it has a crease there, or is thin."""
        near = self.normals[self.tree.search_radius_vector_3d(place, self.radius)[1]]
        return len(near) > 1 and (near @ near.T).min() < OPPOSED

    def goes_along(self, center, normal):
        """Whether its surface is at this face, and faces the same side."""
        nearest = self.tree.search_knn_vector_3d(center, 1)[1][0]
        near = numpy.linalg.norm(self.centers[nearest] - center) <= APART * self.radius
        return near and self.normals[nearest] @ normal >= ASIDE


def coarser_reference(reference, mesh_file, radius):
    """The reference with as many faces as a mesh, where that mesh is."""
    mesh = open3d.io.read_triangle_mesh(str(mesh_file))
    coarser = reference.simplify_quadric_decimation(len(mesh.triangles))
    scene = open3d.t.geometry.RaycastingScene()
    scene.add_triangles(open3d.t.geometry.TriangleMesh.from_legacy(mesh))
    centers = open3d.core.Tensor(face_normals(coarser)[0].astype(numpy.float32))
    coarser.remove_triangles_by_mask(scene.compute_distance(centers).numpy() > APART * radius)
    return coarser


def judge(mesh_file, cloud, reference, radius):
    mesh = open3d.io.read_triangle_mesh(str(mesh_file))
    centers, normals = face_normals(mesh)
    tree = open3d.geometry.KDTreeFlann(cloud)
    nearest = [tree.search_knn_vector_3d(center, 1)[1][0] for center in centers]
    scanned = numpy.asarray(cloud.normals)[nearest]
    wrong = numpy.einsum("ij,ij->i", normals, scanned) <= 0
    joined = edges_of_two(numpy.asarray(mesh.triangles))
    opposed = joined[numpy.einsum("ij,ij->i", scanned[joined[:, 0]], scanned[joined[:, 1]]) < OPPOSED]

    finer = Reference(reference, radius)
    left = [pair for pair in opposed if not finer.has_crease(centers[pair].mean(axis=0))]
    off = [pair for pair in left if not all(finer.goes_along(centers[face], normals[face]) for face in pair)]
    return len(normals), int(wrong.sum()), len(opposed), len(left), len(off)


def print_row(names, judged):
    faces, wrong, *edges = judged
    print("| " + " | ".join(map(str, (*names, faces, f"{1 - wrong / faces:.3%}", *edges))) + " |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add_folders(parser)
    parser.add_argument("--seeds", type=int, default=3, metavar="N", help="samplings of each (3)")
    given = parser.parse_args()
    print("| scans | normals | seed | faces | on their side | edges front to back | beyond creases "
          + "| off the reference |\n" + "| --- " * 8 + "|")
    with tempfile.TemporaryDirectory(prefix="sides.") as scratch:
        for key, cloud_name, reference_name in CASES:
            if not are_there(key, (given.scans / cloud_name, given.scans / reference_name)):
                continue
            cloud = open3d.io.read_point_cloud(str(given.scans / cloud_name))
            reference = open3d.io.read_triangle_mesh(str(given.scans / reference_name))
            bare, mesh = Path(scratch) / "bare.ply", Path(scratch) / "mesh.ply"
            open3d.io.write_point_cloud(str(bare), open3d.geometry.PointCloud(cloud.points))
            for kind, scans in (("used", given.scans / cloud_name), ("none", bare)):
                for seed in range(given.seeds):
                    report = reconstruct(given.build, ("--seed", str(seed)), scans, mesh)
                    print_row((key, kind, seed), judge(mesh, cloud, reference, report["radius"]))
            open3d.io.write_triangle_mesh(str(mesh), coarser_reference(reference, mesh, report["radius"]))
            print_row((key, "reference", ""), judge(mesh, cloud, reference, report["radius"]))


main()
