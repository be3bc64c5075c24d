#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs pcl_pds_recon and other tools side by side on one cloud and prints a table. See README.md in this folder."""
import argparse
import dataclasses
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import peers
import process
import table

REPOSITORY = Path(__file__).resolve().parents[2]
KD_TREE_NEIGHBORS = 15  # the default number of neighbours of pcl_pds_recon
DEFAULT_FACTOR = 3.0
SEARCH_GOAL = 0.02  # of the number of vertices; the search ends here ...
SEARCH_LIMIT = 0.05  # ... and a tool that does not come this near is left out
SEARCH_RUNS = 10


def say(text):
    print(text, file=sys.stderr, flush=True)


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    cloud = parser.add_mutually_exclusive_group(required=True)
    cloud.add_argument("cloud", nargs="?", type=Path, metavar="CLOUD", help="PLY file; only x y z are used")
    cloud.add_argument("--generate", nargs=2, metavar=("torus", "POINTS"), help="a closed torus with bumps")
    parser.add_argument("--reference", type=Path, metavar="MESH", help="PLY mesh that accuracy is measured against")
    parser.add_argument("--vertices", type=int, metavar="N", help="vertices that all shall have, by an absolute radius;"
                        " else as many as pcl_pds_recon has at radius factor 3")
    parser.add_argument("--repeat", type=int, default=5, metavar="N", help="rounds (5)")
    parser.add_argument("--threads", type=int, default=len(os.sched_getaffinity(0)), metavar="N", help="(all cores)")
    parser.add_argument("--timeout", type=float, default=600, metavar="S", help="seconds for one run of one tool (600)")
    keys = ["kdtree", "gp3"] + [peer.key for peer in peers.THINNING]
    parser.add_argument("--peers", nargs="+", choices=keys, default=keys, help="which tools (all)", metavar="KEY")
    parser.add_argument("--build", type=Path, default=REPOSITORY / "build" / "release", metavar="DIR",
                        help="where to build (build/release)")
    parser.add_argument("--output", type=Path, metavar="FILE.md", help="also write the table here")
    parser.add_argument("--meshes", type=Path, metavar="DIR", help="keep the meshes here")
    given = parser.parse_args()
    if given.generate and (given.generate[0] != "torus" or not given.generate[1].isdigit()):
        parser.error("--generate takes: torus POINTS")
    for file in (given.cloud, given.reference):
        if file and not file.exists():
            parser.error(f"{file}: no such file")
    for value, option in ((given.repeat, "--repeat"), (given.threads, "--threads"), (given.timeout, "--timeout")):
        if value <= 0:
            parser.error(f"{option} must be positive")
    return given


def build(folder):
    """Builds the runners; those whose libraries are missing are left out by CMake."""
    configure = ["cmake", "-S", REPOSITORY, "-B", folder, "-DCMAKE_BUILD_TYPE=Release"]
    make = ["cmake", "--build", folder, "--target", "pcl_pds_recon_peers", "--parallel", str(os.cpu_count())]
    for command in (configure, make):
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(f"{done.stdout}{done.stderr}run.py: cannot build the runners in {folder}; see above")
    return folder.resolve() / "bench" / "peers"


def find_parameter(peer, setup, target, parameter):
    """The length that gives the wanted number of vertices: they go down with its square, nearly."""
    too_small, too_large = 0.0, float("inf")
    best = (float("inf"), parameter)
    for _ in range(SEARCH_RUNS):
        vertices = peer.run(setup, parameter, None).vertices
        say(f"  {peer.key}: {parameter:.6g} gives {vertices} vertices")
        off = abs(vertices / target - 1)
        best = min(best, (off, parameter))
        if off <= SEARCH_GOAL:
            break
        if vertices > target:
            too_small = parameter
        else:
            too_large = parameter
        parameter *= max(vertices / target, 0.01) ** 0.5
        if not too_small < parameter < too_large:
            parameter = (too_small + too_large) / 2
    if best[0] > SEARCH_LIMIT:
        raise process.Failure(f"no parameter gives {target} vertices; the nearest is {best[0]:.0%} off")
    return best[1]


def prepare(given, setup):
    """Tools with the parameters that give them equal numbers of vertices, and the reasons why others have none."""
    first = peers.OURS_BY_FACTOR.run(setup, DEFAULT_FACTOR, None)
    setup = dataclasses.replace(setup, extent=first.extent)
    entrants, failures = [], {}

    def enter(peer, find):
        try:
            if peer.missing(setup):
                raise process.Failure(f"not installed: apt-get install {peer.package}")
            entrants.append((peer, find()))
        except process.Failure as failure:
            say(f"  {peer.key}: {failure}")
            failures[peer] = str(failure)

    if "kdtree" in given.peers:
        enter(peers.KD_TREE, lambda: KD_TREE_NEIGHBORS)
    target, radius = first.vertices, first.radius
    if given.vertices:
        target, radius = given.vertices, first.radius * (first.vertices / given.vertices) ** 0.5
        radius = find_parameter(peers.OURS_BY_RADIUS, setup, target, radius)
        enter(peers.OURS_BY_RADIUS, lambda: radius)
    else:
        enter(peers.OURS_BY_FACTOR, lambda: DEFAULT_FACTOR)
    for peer in peers.THINNING:
        if peer.key in given.peers:
            enter(peer, lambda peer=peer: find_parameter(peer, setup, target, radius))
    if "gp3" in given.peers:
        enter(peers.ALL_POINTS_GP3, lambda: first.radius)  # three sampling intervals
    return setup, entrants, failures


def measure(given, setup, entrants, failures):
    """Runs one tool after the other, round by round, so that whatever else the machine does hits all."""
    runs = {peer: [] for peer, _ in entrants}
    for number in range(given.repeat):
        for peer, parameter in entrants:
            if peer in failures:
                continue
            mesh = mesh_file(setup, peer) if number == 0 and peer is not peers.KD_TREE else None
            try:
                runs[peer].append(peer.run(setup, parameter, mesh))
                say(f"round {number + 1}, {peer.key}: {runs[peer][-1].seconds:.2f} s")
            except process.Failure as failure:
                failures[peer] = str(failure)
    return runs


def mesh_file(setup, peer):
    return setup.work / f"{peer.key}.ply"


def judge(setup, mesh, reference):
    command = [setup.programs / "judge", mesh, *([reference] if reference else [])]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise process.Failure(done.stderr.strip())
    return json.loads(done.stdout)


def compare(given, setup, reference):
    setup, entrants, failures = prepare(given, setup)
    load = os.getloadavg()[0]
    runs = measure(given, setup, entrants, failures)
    by_key = {peer.key: results for peer, results in runs.items()}
    if not by_key.get("ours"):
        raise process.Failure(f"pcl_pds_recon {next(why for peer, why in failures.items() if peer.key == 'ours')}")
    rows, truth = [], None
    for peer, results in runs.items():
        verdict = None
        try:
            if peer not in (peers.KD_TREE, *failures) and (setup.programs / "judge").exists():
                verdict = judge(setup, mesh_file(setup, peer), reference)
                truth = verdict if reference else None
        except process.Failure as failure:
            failures[peer] = str(failure)
        if peer not in failures:
            rows.append(table.row(peer, results, by_key.get("kdtree"), by_key["ours"], verdict))
    rows += [table.row_without(peer, reason) for peer, reason in failures.items()]
    name = "Torus with bumps" if given.generate else f"`{given.cloud.name}`"
    return table.page(name, by_key["ours"][0].points, given.threads, given.repeat, load, truth, rows)


def main():
    given = arguments()
    programs = build(given.build)
    with tempfile.TemporaryDirectory(prefix="peers.") as scratch:
        work = given.meshes or Path(scratch)
        work.mkdir(parents=True, exist_ok=True)
        cloud, reference = Path(scratch) / "cloud.ply", given.reference
        setup = peers.Setup(cloud, work.resolve(), programs, given.threads, given.timeout)
        try:
            if given.generate:
                reference = Path(scratch) / "reference.ply"
                command = [programs / "bumpy_torus", given.generate[1], cloud, reference]
            else:
                command = [programs / "peer_cloud", given.cloud, cloud]
            process.run(command, given.threads, given.timeout)
            result = compare(given, setup, reference)
        except process.Failure as failure:
            sys.exit(f"run.py: {failure}")
    print(result, end="")
    if given.output:
        given.output.write_text(result, encoding="utf-8")


main()
