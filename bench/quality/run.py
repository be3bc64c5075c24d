#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Reconstructs noisy scans and clouds with known noise and outliers, beside other tools if asked for, and prints a
table of what came out.

Needs python3-numpy and python3-open3d (bench/peers/install.sh). docs/quality.md has the columns.
"""
import argparse
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy

from trials import add_folders, are_there, check_output, collapse_edges, compare, defects, reconstruct, sample

import peers  # noqa: E402, found by trials
import process  # noqa: E402

SEED = 3
ABSOLUTE_NORMAL_MEAN = (2 / numpy.pi) ** 0.5  # mean of |x| of a standard normal deviate


@dataclass(frozen=True)
class Case:
    key: str
    cloud: str  # file among the scans, or the mesh that is sampled
    reference: str
    options: tuple = ()
    noise: float = 0  # as sample() takes them
    outliers: float = 0
    thinning: float = 0
    samples: int = 0  # random points of the mesh; 0: the cloud's own points
    peers: bool = False  # also with other tools, at as many vertices
    collapsed: int = 0  # no reconstruction: MeshLab's collapse of the reference mesh itself, to so many vertices


def nefertiti(key, *options, **wishes):
    return Case(key, "nefertiti.ply", "nefertiti.ply", ("-n", "16000", *options), samples=500_000, **wishes)


def fandisk(key, *options):
    return Case(key, "fandisk_large.ply", "fandisk_large.ply", options, samples=300_000)


def uneven(key, thinning):
    return Case(key, "nefertiti.ply", "nefertiti.ply", thinning=thinning, samples=1_000_000)


def dragon(key, *options):
    return Case(key, "dragon_vrip.ply", "dragon_vrip.ply", ("-n", "15000", *options))


QUADRIC = ("--placement", "quadric")
PEERS = ("voxel_gp3", "advancing_front", "open3d_bpa", "meshlab_bpa")
CASES = [
    Case("dragon_raw", "dragon_stand_rawscans.ply", "dragon_vrip.ply", peers=True),
    Case("dragon_raw_quadric", "dragon_stand_rawscans.ply", "dragon_vrip.ply", QUADRIC),
    Case("bunny_raw", "bunny_rawscans.ply", "bun_zipper.ply", peers=True),
    Case("bunny_raw_quadric", "bunny_rawscans.ply", "bun_zipper.ply", QUADRIC),
    dragon("dragon_15k"),
    dragon("dragon_15k_quadric", *QUADRIC),
    dragon("dragon_15k_adaptive_quadric", "-a", "0.3", *QUADRIC),
    Case("dragon_15k_meshlab_collapse", "dragon_vrip.ply", "dragon_vrip.ply", collapsed=15_000),
    fandisk("fandisk"),
    fandisk("fandisk_quadric", *QUADRIC),
    Case("fandisk_meshlab_collapse", "fandisk_large.ply", "fandisk_large.ply", collapsed=9_445),
    nefertiti("clean"),
    nefertiti("noise_0.1%", noise=0.001),
    nefertiti("noise_0.1%_quadric", *QUADRIC, noise=0.001),
    nefertiti("noise_0.2%", noise=0.002),
    nefertiti("noise_0.2%_quadric", *QUADRIC, noise=0.002),
    nefertiti("outliers_5%", outliers=0.05),
    uneven("uneven_10:1", 10),
    uneven("uneven_100:1", 100),
]


def row(key, judged, case, report=None):
    certificate, relative = judged["certificate"], judged["relative"]
    there, back = relative["mesh_to_reference"], relative["reference_to_mesh"]
    noise = ""
    if case.noise:
        mean = (there["mean"] + back["mean"]) / 2
        noise = f"{mean / (case.noise * ABSOLUTE_NORMAL_MEAN):.2f}"
    whole = certificate["closed"] and certificate["components"] == 1 and certificate["genus"] == 0
    cells = [key, certificate["vertices"], defects(certificate), certificate["components"],
             f"{judged['largest']:.2%}", certificate["boundary_loops"], certificate["genus"],
             ("yes" if whole else "no") if case.samples else "",
             f"{there['mean'] * 1e5:.1f} / {back['mean'] * 1e5:.1f}", f"{there['p95'] * 1e5:.1f}",
             f"{judged['normal_deviation']:.2f}", noise,
             *((report["outliers"], f"{report['seconds']['total']:.2f}") if report else ("", ""))]
    return "| " + " | ".join("" if cell is None else str(cell) for cell in cells) + " |"


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
            judged = compare(given.build, mesh, given.scans / case.reference)
            yield row(f"{case.key}: {peer.title.rstrip(' †')}", judged, case)
        except process.Failure as failure:
            print(f"{case.key}: {peer.key}: {failure}", file=sys.stderr)


def reconstruct_and_compare(given, case, cloud, work):
    mesh = work / f"{case.key}_mesh.ply"
    report = reconstruct(given.build, case.options, cloud, mesh)
    return row(case.key, compare(given.build, mesh, given.scans / case.reference), case, report), report


def rows(given, case, work):
    mesh_file = given.scans / case.cloud
    if case.collapsed:
        mesh = work / f"{case.key}.ply"
        collapse_edges(mesh_file, 2 * case.collapsed, mesh)
        yield row(case.key, compare(given.build, mesh, given.scans / case.reference), case)
        return
    if not case.samples:
        line, report = reconstruct_and_compare(given, case, mesh_file, work)
        yield line
        if given.runners and case.peers:
            yield from peer_rows(given, case, report, work)
    for seed in range(SEED, SEED + given.samples) if case.samples else ():
        cloud = work / f"{case.key}.ply"
        sample(mesh_file, cloud, case.samples, seed, case.noise, case.outliers, case.thinning)
        yield reconstruct_and_compare(given, case, cloud, work)[0]


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add_folders(parser)
    parser.add_argument("--runners", type=Path, metavar="DIR",
                        help="also run other tools on the raw scans, by the programs that bench/peers/run.py built there")
    parser.add_argument("--samples", type=int, default=1, metavar="N", help="of each mesh that is sampled, a row each (1)")
    parser.add_argument("--cases", nargs="+", metavar="NAME", default=[""], help="only cases whose names begin so")
    return parser.parse_args()


def main():
    given = arguments()
    chosen = [case for case in CASES if case.key.startswith(tuple(given.cases))]
    with tempfile.TemporaryDirectory(prefix="quality.") as scratch:
        work = given.meshes or Path(scratch)
        work.mkdir(parents=True, exist_ok=True)
        print("| case | vertices | defects | components | largest | loops | genus | closed, genus 0 "
              "| mean to / from reference | p95 | normals | of noise | outliers | seconds |\n| --- " + "| --- " * 13 + "|")
        for case in chosen:
            if are_there(case.key, (given.scans / case.cloud, given.scans / case.reference)):
                for line in rows(given, case, work):
                    print(line, flush=True)


main()
