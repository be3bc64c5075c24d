#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws docs/glb.png: a coloured terrain as our viewer shows its .ply, and as Chromium shows its .glb.

usage: tools/make_glb_picture.py BUILD_DIR SCAN.las OUTPUT.png

Needs a build with VTK and model-viewer, and what tools/install_dependencies.sh installs."""
import pathlib
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent / "documentation"))
import chromium
from PIL import Image

WIDTH, HEIGHT = 560, 420
AZIMUTH, ELEVATION, ZOOM = 25, 40, 1.4


def viewer_picture(build, mesh, directory):
    picture = directory / "viewer.png"
    subprocess.run([build / "tools/viewer/pcl_pds_viewer", "--camera", f"{AZIMUTH},{ELEVATION},{ZOOM},z", "--size",
                    f"{WIDTH}x{HEIGHT}", "--show", "mesh", "--screenshot", picture, mesh], check=True)
    return Image.open(picture).convert("RGB")


def main():
    if len(sys.argv) != 4:
        sys.exit("make_glb_picture.py: usage: tools/make_glb_picture.py BUILD_DIR SCAN.las OUTPUT.png")
    build, scan, output = map(pathlib.Path, sys.argv[1:])
    with tempfile.TemporaryDirectory() as name:
        directory = pathlib.Path(name)
        for extension in ("ply", "glb"):
            subprocess.run([build / "tools/pcl_pds_recon", "-q", "--normals", scan, directory / f"mesh.{extension}"],
                           check=True)
        left = viewer_picture(build, directory / "mesh.ply", directory)
        right = chromium.glb_picture(build, directory / "mesh.glb", (WIDTH, HEIGHT), AZIMUTH, ELEVATION, distance=72,
                                     z_is_up=False)
    both = Image.new("RGB", (2 * WIDTH, HEIGHT), "white")
    both.paste(left, (0, 0))
    both.paste(right, (WIDTH, 0))
    both.quantize(256).save(output, optimize=True)


main()
