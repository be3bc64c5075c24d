#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws docs/glb.png: a coloured terrain as our viewer shows its .ply, and as Chromium shows its .glb.

usage: tools/make_glb_picture.py BUILD_DIR SCAN.las OUTPUT.png

Needs a build with VTK and model-viewer, and what tools/install_dependencies.sh installs."""
import base64
import pathlib
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
project = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(project / "test/page"))
import browser
from PIL import Image

WIDTH, HEIGHT = 560, 420
AZIMUTH, ELEVATION, ZOOM = 25, 40, 1.4

PAGE = """<!DOCTYPE html><meta charset="utf-8">
<style>body {{ margin: 0 }} model-viewer {{ width: {width}px; height: {height}px; background: #fff }}
model-viewer::part(default-progress-bar) {{ display: none }}</style>
<model-viewer id="mesh" orientation="0deg -90deg 0deg" camera-orbit="{azimuth}deg {polar}deg 72%" field-of-view="30deg"
 interaction-prompt="none" tone-mapping="neutral" src="data:model/gltf-binary;base64,{glb}"></model-viewer>
<script>{script}</script>"""


def chromium_picture(glb, script, directory):
    page = directory / "page.html"
    page.write_text(PAGE.format(width=WIDTH, height=HEIGHT, azimuth=AZIMUTH, polar=90 - ELEVATION, script=script,
                                glb=base64.b64encode(glb).decode()))
    with browser.chromium(WIDTH + 100, HEIGHT + 300) as driver:
        browser.open_page(driver, page)
        picture = browser.settled_picture(driver)
    white = Image.new("RGBA", picture.size, "white")
    return Image.alpha_composite(white, picture).convert("RGB")


def viewer_picture(build, mesh, directory):
    picture = directory / "viewer.png"
    subprocess.run([build / "tools/viewer/pcl_pds_viewer", "--camera", f"{AZIMUTH},{ELEVATION},{ZOOM},z", "--size",
                    f"{WIDTH}x{HEIGHT}", "--show", "mesh", "--screenshot", picture, mesh], check=True)
    return Image.open(picture).convert("RGB")


def main():
    if len(sys.argv) != 4:
        sys.exit("make_glb_picture.py: usage: tools/make_glb_picture.py BUILD_DIR SCAN.las OUTPUT.png")
    build, scan, output = map(pathlib.Path, sys.argv[1:])
    script = (build / "model-viewer/package/dist/model-viewer-umd.min.js").read_text()
    with tempfile.TemporaryDirectory() as name:
        directory = pathlib.Path(name)
        for extension in ("ply", "glb"):
            subprocess.run([build / "tools/pcl_pds_recon", "-q", "--normals", scan, directory / f"mesh.{extension}"],
                           check=True)
        left = viewer_picture(build, directory / "mesh.ply", directory)
        right = chromium_picture((directory / "mesh.glb").read_bytes(), script, directory)
    both = Image.new("RGB", (2 * WIDTH, HEIGHT), "white")
    both.paste(left, (0, 0))
    both.paste(right.resize((WIDTH, HEIGHT)), (WIDTH, 0))
    both.quantize(256).save(output, optimize=True)


main()
