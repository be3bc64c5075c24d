# SPDX-License-Identifier: BSD-3-Clause
"""The tools that are compared. Each reconstructs one cloud into one mesh; a number sets how many vertices it gets."""
import json
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

import meshlab
import process

HERE = Path(__file__).resolve().parent
SYSTEM_PYTHON = "/usr/bin/python3"  # the one that Debian's python3-open3d is for


@dataclass(frozen=True)
class Setup:
    """What is the same for all."""
    cloud: Path
    work: Path  # folder for scratch files and meshes
    programs: Path  # folder of the runners that the build made
    threads: int
    timeout: float
    extent: float = 0  # largest side of the cloud's box


@dataclass(frozen=True)
class Result:
    seconds: float
    processor_seconds: float
    peak_bytes: int  # above what the loaded cloud takes
    vertices: int
    points: int = 0
    radius: float = 0  # of the Poisson disks, if the tool has some
    extent: float = 0


class Runner:
    """A program of this folder."""

    def __init__(self, key, title, program, method, package):
        self.key, self.title, self.package = key, title, package
        self._program, self._method = program, method

    def missing(self, setup):
        return not (setup.programs / self._program).exists()

    def command(self, setup):
        return [str(setup.programs / self._program)]

    def run(self, setup, parameter, mesh):
        command = [*self.command(setup), self._method, str(setup.cloud), str(mesh or "-"), repr(parameter),
                   str(setup.threads)]
        line = process.run(command, setup.threads, setup.timeout).output.strip().splitlines()[-1]
        result = json.loads(line)
        return Result(result["seconds"], result["processor_seconds"], result["peak_bytes"], result["vertices"],
                      result["points"], result.get("radius", 0), result.get("extent", 0))


class Open3D(Runner):
    def __init__(self, key, title, method):
        super().__init__(key, title, "peer_open3d.py", method, "python3-open3d python3-numpy")

    def missing(self, setup):
        return subprocess.run([SYSTEM_PYTHON, "-c", "import open3d"], capture_output=True, check=False).returncode != 0

    def command(self, setup):
        return [SYSTEM_PYTHON, str(HERE / self._program)]


class MeshLab:
    """MeshLab's server tells no times: the whole process is measured, less one that only loads and saves the cloud."""
    package = "meshlab xvfb xauth"

    def __init__(self, key, title, filters):
        self.key, self.title, self._filters = key, title, filters

    def missing(self, _setup):
        return not (shutil.which("meshlabserver") and shutil.which("xvfb-run"))

    def run(self, setup, parameter, mesh):
        output = mesh or setup.work / "scratch.ply"
        idle = self._serve(setup, "", setup.work / "scratch.ply")
        busy = self._serve(setup, self._filters(parameter, setup.extent), output)
        return Result(busy.seconds - idle.seconds, busy.processor_seconds - idle.processor_seconds,
                      busy.peak_bytes - idle.peak_bytes, meshlab.count_vertices(output))

    def _serve(self, setup, filters, mesh):
        script = setup.work / f"{self.key}.mlx"
        script.write_text(meshlab.script(filters), encoding="ascii")
        command = ["xvfb-run", "-a", "meshlabserver", "-i", str(setup.cloud), "-o", str(mesh), "-s", str(script)]
        return process.run(command, setup.threads, setup.timeout)


OURS_BY_FACTOR = Runner("ours", "pcl_pds_recon", "peer_ours", "factor", "libpcl-dev")
OURS_BY_RADIUS = Runner("ours", "pcl_pds_recon", "peer_ours", "radius", "libpcl-dev")
KD_TREE = Runner("kdtree", "`pcl::KdTreeFLANN`, 15 nearest of all points", "peer_kdtree", "nearest", "libpcl-dev")
ALL_POINTS_GP3 = Runner("gp3", "PCL normals, GP3, all points", "peer_pcl", "gp3", "libpcl-dev")

# The parameter of each is a length: doubled, it leaves about a quarter of the vertices.
THINNING = [
    Runner("voxel_gp3", "PCL VoxelGrid, normals, GP3", "peer_pcl", "voxel_gp3", "libpcl-dev"),
    Runner("advancing_front", "CGAL grid, Advancing Front", "peer_cgal", "advancing_front", "libcgal-dev"),
    Runner("scale_space", "CGAL grid, scale space", "peer_cgal", "scale_space", "libcgal-dev"),
    Open3D("open3d_bpa", "Open3D voxels, normals, ball pivoting", "ball_pivoting"),
    MeshLab("meshlab_bpa", "MeshLab Poisson-disk, ball pivoting †", meshlab.ball_pivoting),
    Open3D("open3d_poisson", "Open3D normals, Poisson", "poisson"),
    MeshLab("meshlab_poisson", "MeshLab normals, screened Poisson †", meshlab.screened_poisson),
]
