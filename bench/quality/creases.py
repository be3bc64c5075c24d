#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""How near a mesh's edges are to the creases of a reference mesh, and how much of the mesh's error is how far from them.

Needs python3-numpy and python3-open3d. docs/quality.md has its tables.
"""
import argparse
from pathlib import Path

import numpy
import open3d

SHARP = 30  # degrees by which the reference turns at a crease
LEAST_TURN = 10  # likewise the mesh, whose faces share the turn where they lie beside a crease
SAMPLES = 200_000
SEED = 1
STEP = 1 / 40  # radii between the points that stand for creases and edges
NEAR = 0.25  # radii
BANDS = (0, 0.25, 0.5, 1, 2, numpy.inf)  # radii from the nearest crease


class Surface:
    """A mesh, its lengths in radii."""

    def __init__(self, file, radius):
        mesh = open3d.io.read_triangle_mesh(str(file)).remove_duplicated_vertices()
        self.diagonal = numpy.linalg.norm(mesh.get_max_bound() - mesh.get_min_bound()) / radius
        self.corners = numpy.asarray(mesh.vertices) / radius
        self.faces = numpy.asarray(mesh.triangles)
        a, b, c = (self.corners[self.faces[:, i]] for i in range(3))
        normals = numpy.cross(b - a, c - a)
        self.areas = numpy.linalg.norm(normals, axis=1)
        self.normals = normals / numpy.maximum(self.areas, 1e-300)[:, None]
        self.scene = open3d.t.geometry.RaycastingScene()
        self.scene.add_triangles(tensor(self.corners), open3d.core.Tensor(self.faces.astype(numpy.uint32)))

    def creases(self, least_turn):
        """Points along the edges that turn by so many degrees, and the length that each stands for."""
        sides = numpy.sort(self.faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
        order = numpy.lexsort((sides[:, 1], sides[:, 0]))
        shared = numpy.nonzero((sides[order[1:]] == sides[order[:-1]]).all(axis=1))[0]
        first, second = order[shared], order[shared + 1]
        cosine = (self.normals[first // 3] * self.normals[second // 3]).sum(axis=1)
        start, end = (self.corners[sides[first[cosine <= numpy.cos(numpy.radians(least_turn))], i]] for i in range(2))
        length = numpy.linalg.norm(end - start, axis=1)
        pieces = numpy.maximum(1, numpy.ceil(length / STEP)).astype(int)
        edge = numpy.repeat(numpy.arange(len(pieces)), pieces)
        along = (numpy.arange(len(edge)) - numpy.repeat(numpy.cumsum(pieces) - pieces, pieces) + 0.5) / pieces[edge]
        return start[edge] + along[:, None] * (end - start)[edge], (length / pieces)[edge]

    def sample(self):
        random = numpy.random.default_rng(SEED)
        face = random.choice(len(self.areas), SAMPLES, p=self.areas / self.areas.sum())
        s, t = numpy.sqrt(random.random(SAMPLES))[:, None], random.random(SAMPLES)[:, None]
        a, b, c = (self.corners[self.faces[face, i]] for i in range(3))
        return a * (1 - s) + b * (s * (1 - t)) + c * (s * t), face


def tensor(points):
    return open3d.core.Tensor(points.astype(numpy.float32))


def distance(points, others):
    search = open3d.core.nns.NearestNeighborSearch(tensor(others))
    search.knn_index()
    return numpy.sqrt(search.knn_search(tensor(points), 1)[1].numpy()[:, 0])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh", type=Path)
    parser.add_argument("reference", type=Path)
    parser.add_argument("radius", type=float, help="Poisson-disk radius, of the mesh's report")
    given = parser.parse_args()
    mesh, reference = Surface(given.mesh, given.radius), Surface(given.reference, given.radius)
    creases, lengths = reference.creases(SHARP)
    covered = distance(creases, mesh.creases(LEAST_TURN)[0]) <= NEAR
    print(f"{(lengths * covered).sum() / lengths.sum():.1%} of the creases are within {NEAR} radii of an edge\n")
    points, face = mesh.sample()
    nearest = reference.scene.compute_closest_points(tensor(points))
    off = numpy.linalg.norm(nearest["points"].numpy() - points, axis=1) / reference.diagonal * 1e5
    cosine = (mesh.normals[face] * reference.normals[nearest["primitive_ids"].numpy()]).sum(axis=1)
    turned = numpy.degrees(numpy.arccos(numpy.clip(numpy.abs(cosine), 0, 1)))
    away = distance(points, creases)
    print("| radii from a crease | area | distance | normals |\n| --- | --- | --- | --- |")
    for low, high in (*zip(BANDS, BANDS[1:]), (0, numpy.inf)):
        band = (away >= low) & (away < high)
        print(f"| {low} to {high} | {band.mean():.1%} | {(off * band).mean():.2f} | {(turned * band).mean():.2f} |")


main()
