#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Reconstructs noisy scans and clouds with known noise and outliers, and prints a table of what came out.

Needs python3-numpy and python3-open3d (bench/peers/install.sh) to sample meshes. docs/quality.md has the columns.
"""
import argparse
import json
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy
import open3d

REPOSITORY = Path(__file__).resolve().parents[2]
SAMPLES = 500_000  # of Nefertiti, for noise and outliers
SEED = 3
BOX_MARGIN = 0.1  # outliers lie anywhere in the box of the mesh, enlarged by this share on each side
ABSOLUTE_NORMAL_MEAN = (2 / numpy.pi) ** 0.5  # mean of |x| of a standard normal deviate


@dataclass(frozen=True)
class Case:
    key: str
    cloud: str  # file among the scans, or the mesh that is sampled
    reference: str
    options: tuple = ()
    noise: float = 0  # standard deviation along the normal, in diagonals
    outliers: float = 0  # share of the points
    sampled: bool = False


def nefertiti(key, *options, **wishes):
    return Case(key, "nefertiti.ply", "nefertiti.ply", options, sampled=True, **wishes)


QUADRIC = ("--placement", "quadric")
CASES = [
    Case("dragon_raw", "dragon_stand_rawscans.ply", "dragon_vrip.ply"),
    Case("dragon_raw_quadric", "dragon_stand_rawscans.ply", "dragon_vrip.ply", QUADRIC),
    Case("bunny_raw", "bunny_rawscans.ply", "bun_zipper.ply"),
    Case("bunny_raw_quadric", "bunny_rawscans.ply", "bun_zipper.ply", QUADRIC),
    nefertiti("clean"),
    nefertiti("noise_0.1%", noise=0.001),
    nefertiti("noise_0.1%_quadric", *QUADRIC, noise=0.001),
    nefertiti("noise_0.2%", noise=0.002),
    nefertiti("noise_0.2%_quadric", *QUADRIC, noise=0.002),
    nefertiti("outliers_5%", outliers=0.05),
]


def sample(case, mesh_file, cloud_file):
    """Random points, evenly over the area, and what is wrong with them."""
    mesh = open3d.io.read_triangle_mesh(str(mesh_file))
    corners = numpy.asarray(mesh.vertices)[numpy.asarray(mesh.triangles)]
    normals = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    areas = numpy.linalg.norm(normals, axis=1)
    random = numpy.random.default_rng(SEED)
    scattered = round(case.outliers * SAMPLES)
    face = random.choice(len(areas), SAMPLES - scattered, p=areas / areas.sum())
    s, t = numpy.sqrt(random.random(len(face)))[:, None], random.random(len(face))[:, None]
    a, b, c = (corners[face, i] for i in range(3))
    points = a * (1 - s) + b * (s * (1 - t)) + c * (s * t)
    low, high = corners.min(axis=(0, 1)), corners.max(axis=(0, 1))
    sigma = case.noise * numpy.linalg.norm(high - low)
    points += normals[face] / areas[face][:, None] * random.normal(0, 1, len(face))[:, None] * sigma
    margin = BOX_MARGIN * (high - low)
    box = random.uniform(low - margin, high + margin, (scattered, 3))
    cloud = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(numpy.concatenate([points, box])))
    open3d.io.write_point_cloud(str(cloud_file), cloud)


def check_output(command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"run.py: {' '.join(map(str, command))}: {done.stderr.strip() or done.stdout.strip()}")
    return done.stdout


def measure(case, given, work):
    cloud = given.scans / case.cloud
    if case.sampled:
        cloud = work / f"{case.key}.ply"
        sample(case, given.scans / case.cloud, cloud)
    mesh, report_file = work / f"{case.key}_mesh.ply", work / f"{case.key}.json"
    tools = given.build / "tools"
    check_output([tools / "pcl_pds_recon", "-q", "--report", report_file, *case.options, cloud, mesh])
    compared = [tools / "compare" / "pcl_pds_compare", "--json", mesh, given.scans / case.reference]
    return json.loads(report_file.read_text(encoding="utf-8")), json.loads(check_output(compared))


def row(case, report, judged):
    certificate, relative = judged["certificate"], judged["relative"]
    there, back = relative["mesh_to_reference"], relative["reference_to_mesh"]
    defects = [certificate[key] for key in ("nonmanifold_edges", "nonmanifold_vertices", "inconsistent_edges")]
    noise = ""
    if case.noise:
        mean = (there["mean"] + back["mean"]) / 2
        noise = f"{mean / (case.noise * ABSOLUTE_NORMAL_MEAN):.2f}"
    cells = [case.key, report["vertices"], " / ".join(map(str, defects)), certificate["components"],
             certificate["boundary_loops"], certificate["genus"], f"{there['mean'] * 1e5:.1f} / {back['mean'] * 1e5:.1f}",
             f"{there['p95'] * 1e5:.1f}", noise, report["outliers"], f"{report['seconds']['total']:.2f}"]
    return "| " + " | ".join(map(str, cells)) + " |"


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scans", type=Path, default=REPOSITORY.parent / "shared" / "data", metavar="DIR",
                        help="where the scans and meshes are (../shared/data)")
    parser.add_argument("--build", type=Path, default=REPOSITORY / "build" / "release", metavar="DIR",
                        help="a build with the tools (build/release)")
    parser.add_argument("--cases", nargs="+", metavar="NAME", default=[""], help="only cases whose names begin so")
    parser.add_argument("--meshes", type=Path, metavar="DIR", help="keep clouds, meshes and reports here")
    return parser.parse_args()


def main():
    given = arguments()
    chosen = [case for case in CASES if case.key.startswith(tuple(given.cases))]
    with tempfile.TemporaryDirectory(prefix="quality.") as scratch:
        work = given.meshes or Path(scratch)
        work.mkdir(parents=True, exist_ok=True)
        print("| case | vertices | defects | components | loops | genus | mean to / from reference | p95 | of noise "
              "| outliers | seconds |\n| --- " + "| --- " * 10 + "|")
        for case in chosen:
            missing = [name for name in (case.cloud, case.reference) if not (given.scans / name).exists()]
            if missing:
                print(f"{case.key}: skipped, {given.scans / missing[0]} is not there (--scans)", file=sys.stderr)
                continue
            print(row(case, *measure(case, given, work)), flush=True)


main()
