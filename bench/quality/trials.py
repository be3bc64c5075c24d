# SPDX-License-Identifier: BSD-3-Clause
"""Clouds with a known truth, meshes of them, and how far these are from it."""
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy
import open3d

REPOSITORY = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(REPOSITORY / "bench" / "peers"))
import meshlab  # noqa: E402

BOX_MARGIN = 0.1  # outliers lie anywhere in the box of the mesh, enlarged by this share on each side


def add_folders(parser):
    parser.add_argument("--scans", type=Path, default=REPOSITORY.parent / "shared" / "data", metavar="DIR",
                        help="where the scans and meshes are (../shared/data)")
    parser.add_argument("--build", type=Path, default=REPOSITORY / "build" / "release", metavar="DIR",
                        help="a build with the tools (build/release)")
    parser.add_argument("--meshes", type=Path, metavar="DIR", help="keep clouds, meshes and reports here")


def sample(mesh_file, cloud_file, count, seed, noise=0, outliers=0, thinning=0):
    """Random points, evenly over the area, and what is wrong with them.

    noise: standard deviation along the normal, in diagonals; outliers: share of the points; thinning: of the points in
    half of the box, one in so many is left.
    """
    mesh = open3d.io.read_triangle_mesh(str(mesh_file))
    corners = numpy.asarray(mesh.vertices)[numpy.asarray(mesh.triangles)]
    normals = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    areas = numpy.linalg.norm(normals, axis=1)
    random = numpy.random.default_rng(seed)
    scattered = round(outliers * count)
    face = random.choice(len(areas), count - scattered, p=areas / areas.sum())
    s, t = numpy.sqrt(random.random(len(face)))[:, None], random.random(len(face))[:, None]
    a, b, c = (corners[face, i] for i in range(3))
    points = a * (1 - s) + b * (s * (1 - t)) + c * (s * t)
    low, high = corners.min(axis=(0, 1)), corners.max(axis=(0, 1))
    sigma = noise * numpy.linalg.norm(high - low)
    points += normals[face] / areas[face][:, None] * random.normal(0, 1, len(face))[:, None] * sigma
    if thinning:
        longest = numpy.argmax(high - low)
        points = points[(points[:, longest] < (low + high)[longest] / 2) | (random.random(len(points)) < 1 / thinning)]
    margin = BOX_MARGIN * (high - low)
    box = random.uniform(low - margin, high + margin, (scattered, 3))
    cloud = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(numpy.concatenate([points, box])))
    open3d.io.write_point_cloud(str(cloud_file), cloud)


def check_output(command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"run.py: {' '.join(map(str, command))}: {done.stderr.strip() or done.stdout.strip()}")
    return done.stdout


def reconstruct(build, options, cloud, mesh):
    """The report of pcl_pds_recon, of which a copy stays beside the mesh, and the processor seconds of all cores."""
    report_file, before = mesh.with_suffix(".json"), os.times()
    check_output([build / "tools" / "pcl_pds_recon", "-q", "--report", report_file, *options, cloud, mesh])
    after, report = os.times(), json.loads(report_file.read_text(encoding="utf-8"))
    report["processor_seconds"] = sum(after[2:4]) - sum(before[2:4])  # of the processes that have ended
    return report


def collapse_edges(mesh_file, faces, mesh):
    """A finer mesh, made coarser by MeshLab."""
    script, copy = mesh.with_suffix(".mlx"), mesh.with_name(f"finer_{mesh_file.name}")
    script.write_text(meshlab.script(meshlab.edge_collapse(faces)), encoding="ascii")
    shutil.copy(mesh_file, copy)  # MeshLab may write beside its input
    check_output(["xvfb-run", "-a", "meshlabserver", "-i", copy, "-o", mesh, "-s", script])


def compare(build, mesh, reference):
    """What pcl_pds_compare says of the mesh; "largest" is the share of its faces in one component."""
    judged = json.loads(check_output([build / "tools" / "compare" / "pcl_pds_compare", "--json", mesh, reference]))
    faces = numpy.asarray(open3d.io.read_triangle_mesh(str(mesh)).cluster_connected_triangles()[1])
    judged["largest"] = faces.max() / faces.sum()
    return judged


def defects(certificate):
    """Edges of more than two faces / vertices of more than one fan / edges run along twice in the same direction."""
    names = ("nonmanifold_edges", "nonmanifold_vertices", "inconsistent_edges")
    return " / ".join(str(certificate[name]) for name in names)


def are_there(key, files):
    """Says which file is missing, if one is."""
    missing = [file for file in files if not file.exists()]
    if missing:
        print(f"{key}: skipped, {missing[0]} is not there (--scans)", file=sys.stderr)
    return not missing
