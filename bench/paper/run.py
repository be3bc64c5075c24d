#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Repeats the experiments of the paper (Hou et al. 2015) on other shapes of as many points, and prints its figures
beside what comes out.

Needs python3-numpy, python3-open3d and, for Fig. 10 and 11, MeshLab (bench/peers/install.sh). docs/paper.md explains.
"""
import argparse
import shlex
import shutil
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(REPOSITORY / "bench" / "quality"))
from trials import add_folders, are_there, collapse_edges, compare, defects, reconstruct, sample  # noqa: E402

import table  # noqa: E402, found by trials

SEED = 1  # of the samples
PAPER_STANDARD_ERROR = 0.027  # Fig. 11, of its own mesh; no unit is given
PAPER_MESHLAB_ERROR = 0.011  # likewise, of MeshLab's


@dataclass(frozen=True)
class Experiment:
    key: str
    figure: str
    mesh: str  # file among the scans that is sampled, and the truth
    samples: int  # random points of it; 0: its own vertices
    config: str  # file in config/
    options: tuple = ()
    paper: str = ""  # vertices / faces
    paper_error: str = ""


def dragon(key, vertices, paper):
    return Experiment(key, "8", "dragon_vrip.ply", 2_000_000, "dragon.ini", ("-n", vertices), paper)


DENSE = "dense_model"
EXPERIMENTS = [
    Experiment("hand_uniform", "5 a", "nefertiti.ply", 3_000_000, "hand_uniform.ini", (), "55,000 / 111,400"),
    Experiment("hand_adaptive", "5 b", "nefertiti.ply", 3_000_000, "hand_adaptive.ini", (), "55,000 / 111,400"),
    Experiment("wheel", "6 b", "rocker-arm.ply", 2_000_000, "wheel.ini", (), "35,000 / 71,000"),
    Experiment("dem", "7 b", "jacksboro_dem.ply", 2_000_000, "dem.ini", (), "22,000 / 44,000"),
    dragon("dragon_4800", "4800", "4,800"),
    dragon("dragon_8500", "8500", "8,500"),
    dragon("dragon_18000", "18000", "18,000"),
    dragon("dragon_64000", "64000", "64,000"),
    Experiment("accuracy_a", "9 a", "dragon_vrip.ply", 536_000, "dragon.ini", ("-n", "40000"), "40,000", "1/500"),
    Experiment("accuracy_b", "9 b", "nefertiti.ply", 2_243_000, "dragon.ini", ("-n", "80000"), "80,000", "1/900"),
    Experiment(DENSE, "10 b", "dragon_vrip.ply", 0, "dense_model.ini", (), "212,524"),
    Experiment(f"{DENSE}_quadric", "", "dragon_vrip.ply", 0, "dense_model.ini", ("--placement", "quadric")),
]
COLUMNS = ["experiment", "figure", "points", "paper: vertices / faces", "vertices / faces", "defects", "components",
           "loops", "genus", "paper: error", "error to / from reference", "processor seconds"]


def fraction(relative):
    return f"1/{1 / relative:,.0f}"


def row(experiment, judged, report=None):
    certificate, relative = judged["certificate"], judged["relative"]
    errors = [fraction(relative[way]["mean"]) for way in ("mesh_to_reference", "reference_to_mesh")]
    points, seconds = (f"{report['input_points']:,}", f"{report['processor_seconds']:.2f}") if report else ("", "")
    genus = certificate["genus"]
    return [experiment.key, experiment.figure, points, experiment.paper,
            f"{certificate['vertices']:,} / {certificate['faces']:,}", defects(certificate), certificate["components"],
            certificate["boundary_loops"], "" if genus is None else genus, experiment.paper_error, " / ".join(errors),
            seconds]


def print_row(cells):
    print("| " + " | ".join(map(str, cells)) + " |", flush=True)


def run(given, experiment, work):
    """Prints a row. Returns its judgement, or None if there is no mesh to sample."""
    mesh_file = given.scans / experiment.mesh
    if not are_there(experiment.key, [mesh_file]):
        return None
    cloud, mesh = mesh_file, work / f"{experiment.key}.ply"
    if experiment.samples:
        cloud = work / f"{mesh_file.stem}_{experiment.samples}.ply"
        if not cloud.exists():
            sample(mesh_file, cloud, experiment.samples, SEED)
    options = ("--config", REPOSITORY / "config" / experiment.config, *experiment.options)
    report = reconstruct(given.build, options, cloud, mesh)
    judged = compare(given.build, mesh, mesh_file)
    print_row(row(experiment, judged, report))
    return judged


def collapse(given, vertices, work):
    """MeshLab's row: the reference itself, made coarser to as many vertices."""
    if not (shutil.which("meshlabserver") and shutil.which("xvfb-run")):
        print("meshlab: skipped, it is not installed (bench/peers/install.sh)", file=sys.stderr)
        return None
    experiment = Experiment("meshlab", "10 c", "dragon_vrip.ply", 0, "", (), "212,524")
    mesh, reference = work / "meshlab.ply", given.scans / experiment.mesh
    collapse_edges(reference, 2 * vertices, mesh)
    judged = compare(given.build, mesh, reference)
    print_row(row(experiment, judged))
    return judged


def compare_with_meshlab(judgements, meshlab):
    """Fig. 11: root mean square distances from the mesh to the reference, which is what Geomagic calls standard."""
    print("\nRoot mean square distance from the mesh to the full mesh, over MeshLab's (Fig. 11): paper "
          f"{PAPER_STANDARD_ERROR / PAPER_MESHLAB_ERROR:.2f}", end="")
    theirs = meshlab["mesh_to_reference"]
    for key, judged in judgements.items():
        ours = judged["mesh_to_reference"]
        print(f"; {key} {ours['rms'] / theirs['rms']:.2f} (mean distance {ours['mean'] / theirs['mean']:.2f})", end="")
    print(".")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add_folders(parser)
    parser.add_argument("--cases", nargs="+", metavar="NAME", default=[""],
                        help=f"only experiments whose names begin so; MeshLab's is part of {DENSE}")
    return parser.parse_args()


def main():
    given = arguments()
    chosen = [experiment for experiment in EXPERIMENTS if experiment.key.startswith(tuple(given.cases))]
    print(f"`{shlex.join(['bench/paper/run.py', *sys.argv[1:]])}`\n\n{table.machine()}. {table.versions()}.\n")
    print_row(COLUMNS)
    print_row(["---"] * len(COLUMNS))
    with tempfile.TemporaryDirectory(prefix="paper.") as scratch:
        work = given.meshes or Path(scratch)
        work.mkdir(parents=True, exist_ok=True)
        dense = {}
        for experiment in chosen:
            judged = run(given, experiment, work)
            if judged and experiment.key.startswith(DENSE):
                dense[experiment.key] = judged
        if DENSE in dense:
            meshlab = collapse(given, dense[DENSE]["certificate"]["vertices"], work)
            if meshlab:
                compare_with_meshlab(dense, meshlab)


main()
