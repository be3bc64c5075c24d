#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Prints a table of what --relax N makes of the triangles. Needs the same as run.py."""
import argparse
import tempfile
from pathlib import Path

import numpy
import open3d

from trials import add_folders, are_there, compare, defects, reconstruct, sample

SEED = 3
SMALL_ANGLE = 25  # degrees
CLOUDS = {"dragon_vrip.ply": 0, "nefertiti.ply": 500_000, "rocker-arm.ply": 300_000}  # random points; 0: its own


def smallest_angles(mesh_file):
    """Of each face, in degrees."""
    mesh = open3d.io.read_triangle_mesh(str(mesh_file))
    corners = numpy.asarray(mesh.vertices)[numpy.asarray(mesh.triangles)]
    angles = []
    for corner in range(3):
        u, v = (corners[:, (corner + i) % 3] - corners[:, corner] for i in (1, 2))
        angles.append(numpy.arctan2(numpy.linalg.norm(numpy.cross(u, v), axis=1), (u * v).sum(axis=1)))
    return numpy.degrees(numpy.min(angles, axis=0))


def row(given, name, steps, cloud, work):
    mesh = work / f"{Path(name).stem}_relax_{steps}.ply"
    report = reconstruct(given.build, ("--relax", steps), cloud, mesh)
    judged, angles = compare(given.build, mesh, given.scans / name), smallest_angles(mesh)
    certificate, relative = judged["certificate"], judged["relative"]
    cells = [Path(name).stem, steps, certificate["vertices"], defects(certificate), certificate["components"],
             certificate["boundary_loops"], f"{angles.mean():.1f}°", f"{(angles < SMALL_ANGLE).mean():.3%}",
             f"{angles.min():.1f}°", f"{relative['mesh_to_reference']['mean'] * 1e5:.1f} / "
             f"{relative['reference_to_mesh']['mean'] * 1e5:.1f}", f"{report['processor_seconds']:.1f}"]
    return "| " + " | ".join(map(str, cells)) + " |"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    add_folders(parser)
    parser.add_argument("--steps", nargs="+", type=int, default=[0, 1, 5, 20], metavar="N", help="(0 1 5 20)")
    given = parser.parse_args()
    print(f"| cloud | N | vertices | defects | components | loops | smallest angle: mean | below {SMALL_ANGLE}° | least "
          "| mean to / from reference | processor seconds |\n| --- " + "| --- " * 10 + "|")
    with tempfile.TemporaryDirectory(prefix="relax.") as scratch:
        work = given.meshes or Path(scratch)
        work.mkdir(parents=True, exist_ok=True)
        for name, samples in CLOUDS.items():
            if not are_there(name, [given.scans / name]):
                continue
            cloud = work / f"{Path(name).stem}_{samples}.ply" if samples else given.scans / name
            if samples:
                sample(given.scans / name, cloud, samples, SEED)
            for steps in given.steps:
                print(row(given, name, steps, cloud, work), flush=True)


main()
