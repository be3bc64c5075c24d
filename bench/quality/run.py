#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Reconstructs noisy scans and clouds with known noise and outliers, beside other tools if asked for, and prints a
table of what came out.

Needs python3-numpy and python3-open3d (bench/peers/install.sh). docs/quality.md has the columns.
"""
import argparse
import json
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy
import open3d

REPOSITORY = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(REPOSITORY / "bench" / "peers"))
import meshlab  # noqa: E402
import peers  # noqa: E402
import process  # noqa: E402

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
    samples: int = 0  # random points of the mesh; 0: the cloud's own points
    peers: bool = False  # also with other tools, at as many vertices


def nefertiti(key, *options, **wishes):
    return Case(key, "nefertiti.ply", "nefertiti.ply", ("-n", "16000", *options), samples=500_000, **wishes)


def fandisk(key, *options):
    return Case(key, "fandisk_large.ply", "fandisk_large.ply", options, samples=300_000)


def dragon(key, *options):
    return Case(key, "dragon_vrip.ply", "dragon_vrip.ply", ("-n", "15000", *options))


QUADRIC = ("--placement", "quadric")
COLLAPSE = "dragon_15k_meshlab_collapse"  # of the reference mesh itself: no reconstruction
PEERS = ("voxel_gp3", "advancing_front", "open3d_bpa", "meshlab_bpa")
CASES = [
    Case("dragon_raw", "dragon_stand_rawscans.ply", "dragon_vrip.ply", peers=True),
    Case("dragon_raw_quadric", "dragon_stand_rawscans.ply", "dragon_vrip.ply", QUADRIC),
    Case("bunny_raw", "bunny_rawscans.ply", "bun_zipper.ply", peers=True),
    Case("bunny_raw_quadric", "bunny_rawscans.ply", "bun_zipper.ply", QUADRIC),
    dragon("dragon_15k"),
    dragon("dragon_15k_quadric", *QUADRIC),
    dragon("dragon_15k_adaptive_quadric", "-a", "0.3", *QUADRIC),
    dragon(COLLAPSE),
    fandisk("fandisk"),
    fandisk("fandisk_quadric", *QUADRIC),
    nefertiti("clean"),
    nefertiti("noise_0.1%", noise=0.001),
    nefertiti("noise_0.1%_quadric", *QUADRIC, noise=0.001),
    nefertiti("noise_0.2%", noise=0.002),
    nefertiti("noise_0.2%_quadric", *QUADRIC, noise=0.002),
    nefertiti("outliers_5%", outliers=0.05),
]


def sample(case, mesh_file, cloud_file, seed):
    """Random points, evenly over the area, and what is wrong with them."""
    mesh = open3d.io.read_triangle_mesh(str(mesh_file))
    corners = numpy.asarray(mesh.vertices)[numpy.asarray(mesh.triangles)]
    normals = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    areas = numpy.linalg.norm(normals, axis=1)
    random = numpy.random.default_rng(seed)
    scattered = round(case.outliers * case.samples)
    face = random.choice(len(areas), case.samples - scattered, p=areas / areas.sum())
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


def compare(given, mesh, reference):
    tool = given.build / "tools" / "compare" / "pcl_pds_compare"
    judged = json.loads(check_output([tool, "--json", mesh, reference]))
    whole = open3d.io.read_triangle_mesh(str(mesh))
    faces = numpy.asarray(whole.cluster_connected_triangles()[1])
    judged["largest"] = faces.max() / faces.sum()
    return judged


def reconstruct(given, case, cloud, work):
    mesh, report_file = work / f"{case.key}_mesh.ply", work / f"{case.key}.json"
    tool = given.build / "tools" / "pcl_pds_recon"
    check_output([tool, "-q", "--report", report_file, *case.options, cloud, mesh])
    return json.loads(report_file.read_text(encoding="utf-8")), compare(given, mesh, given.scans / case.reference)


def row(key, judged, case, report=None):
    certificate, relative = judged["certificate"], judged["relative"]
    there, back = relative["mesh_to_reference"], relative["reference_to_mesh"]
    defects = [certificate[name] for name in ("nonmanifold_edges", "nonmanifold_vertices", "inconsistent_edges")]
    noise = ""
    if case.noise:
        mean = (there["mean"] + back["mean"]) / 2
        noise = f"{mean / (case.noise * ABSOLUTE_NORMAL_MEAN):.2f}"
    whole = certificate["closed"] and certificate["components"] == 1 and certificate["genus"] == 0
    cells = [key, certificate["vertices"], " / ".join(map(str, defects)), certificate["components"],
             f"{judged['largest']:.2%}", certificate["boundary_loops"], certificate["genus"], ("yes" if whole else "no") if case.samples else "",
             f"{there['mean'] * 1e5:.1f} / {back['mean'] * 1e5:.1f}", f"{there['p95'] * 1e5:.1f}", noise,
             *((report["outliers"], f"{report['seconds']['total']:.2f}") if report else ("", ""))]
    return "| " + " | ".join("" if cell is None else str(cell) for cell in cells) + " |"


def collapse_rows(given, case, work):
    """The reference mesh, made coarser by MeshLab."""
    script, mesh = work / f"{case.key}.mlx", work / f"{case.key}.ply"
    script.write_text(meshlab.script(meshlab.edge_collapse(2 * int(case.options[1]))), encoding="ascii")
    copy = work / case.cloud  # MeshLab may write beside its input
    shutil.copy(given.scans / case.cloud, copy)
    check_output(["xvfb-run", "-a", "meshlabserver", "-i", copy, "-o", mesh, "-s", script])
    yield row(case.key, compare(given, mesh, given.scans / case.reference), case)


def parameter_for(peer, setup, vertices, parameter):
    """The length that gives as many vertices within 1 %, or the nearest that was found."""
    tried = []
    for _ in range(12):
        count = peer.run(setup, parameter, None).vertices
        tried.append((abs(count / vertices - 1), parameter))
        if tried[-1][0] <= 0.01:
            break
        parameter *= (max(count, 1) / vertices) ** 0.5
    return min(tried)[1]


def peer_rows(given, case, report, work):
    """What other tools make of the same points at as many vertices."""
    cloud = work / "peer_cloud.ply"
    check_output([given.runners / "peer_cloud", given.scans / case.cloud, cloud])
    setup = peers.Setup(cloud, work, given.runners, 1, 600)
    for peer in peers.THINNING:
        if peer.key not in PEERS:
            continue
        mesh = work / f"{case.key}_{peer.key}.ply"
        try:
            if peer.missing(setup):
                raise process.Failure(f"not installed: {peer.package}")
            peer.run(setup, parameter_for(peer, setup, report["vertices"], report["radius"]), mesh)
            yield row(f"{case.key}: {peer.title.rstrip(' †')}", compare(given, mesh, given.scans / case.reference), case)
        except process.Failure as failure:
            print(f"{case.key}: {peer.key}: {failure}", file=sys.stderr)


def rows(given, case, work):
    if case.key == COLLAPSE:
        yield from collapse_rows(given, case, work)
        return
    if not case.samples:
        report, judged = reconstruct(given, case, given.scans / case.cloud, work)
        yield row(case.key, judged, case, report)
        if given.runners and case.peers:
            yield from peer_rows(given, case, report, work)
    for seed in range(SEED, SEED + given.samples) if case.samples else ():
        cloud = work / f"{case.key}.ply"
        sample(case, given.scans / case.cloud, cloud, seed)
        report, judged = reconstruct(given, case, cloud, work)
        yield row(case.key, judged, case, report)


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scans", type=Path, default=REPOSITORY.parent / "shared" / "data", metavar="DIR",
                        help="where the scans and meshes are (../shared/data)")
    parser.add_argument("--build", type=Path, default=REPOSITORY / "build" / "release", metavar="DIR",
                        help="a build with the tools (build/release)")
    parser.add_argument("--runners", type=Path, metavar="DIR",
                        help="also run other tools on the raw scans, by the programs that bench/peers/run.py built there")
    parser.add_argument("--samples", type=int, default=1, metavar="N", help="of each mesh that is sampled, a row each (1)")
    parser.add_argument("--cases", nargs="+", metavar="NAME", default=[""], help="only cases whose names begin so")
    parser.add_argument("--meshes", type=Path, metavar="DIR", help="keep clouds, meshes and reports here")
    return parser.parse_args()


def main():
    given = arguments()
    chosen = [case for case in CASES if case.key.startswith(tuple(given.cases))]
    with tempfile.TemporaryDirectory(prefix="quality.") as scratch:
        work = given.meshes or Path(scratch)
        work.mkdir(parents=True, exist_ok=True)
        print("| case | vertices | defects | components | largest | loops | genus | closed, genus 0 "
              "| mean to / from reference | p95 | of noise | outliers | seconds |\n| --- " + "| --- " * 12 + "|")
        for case in chosen:
            missing = [name for name in (case.cloud, case.reference) if not (given.scans / name).exists()]
            if missing:
                print(f"{case.key}: skipped, {given.scans / missing[0]} is not there (--scans)", file=sys.stderr)
                continue
            for line in rows(given, case, work):
                print(line, flush=True)


main()
