# SPDX-License-Identifier: BSD-3-Clause
"""The .glb of a terrain in Chromium: it lies flat with z up if its input was LAS, and has the colours of the points.
usage: glb_test.py TOOL MODEL_VIEWER.js"""
import base64
import pathlib
import struct
import subprocess
import sys
import tempfile

import browser

PAGE = """<!DOCTYPE html><meta charset="utf-8">
<model-viewer id="mesh" style="width: 400px; height: 400px" camera-orbit="0deg 0deg 100%" interaction-prompt="none"
 src="data:model/gltf-binary;base64,{glb}"></model-viewer>
<script>{script}</script>"""

SIDE = 60  # points; the height is a tenth of it
RED, GREEN = (65535, 0, 0), (0, 65535, 0)


def las():
    """A wavy square in UTM, red in the west and green in the east: LAS 1.2, point format 2."""
    records = b"".join(
        struct.pack("<iiiHBBbBHHHH", 100 * i, 100 * j, 30 * (i // 10 + j // 10) % 600, 0, 9, 2, 0, 0, 0,
                    *(RED if i < SIDE // 2 else GREEN)) for i in range(SIDE) for j in range(SIDE))
    header = bytearray(227)
    header[0:4] = b"LASF"
    header[24:26] = 1, 2
    struct.pack_into("<HII", header, 94, len(header), len(header), 0)
    struct.pack_into("<BHI", header, 104, 2, 26, SIDE * SIDE)
    struct.pack_into("<6d", header, 131, 0.01, 0.01, 0.01, 500000, 5000000, 100)
    return bytes(header) + records


def check(glb, script, page):
    page.write_text(PAGE.format(glb=base64.b64encode(glb).decode(), script=script))
    with browser.chromium(600, 600) as driver:
        browser.open_page(driver, page)
        size = driver.execute_script("const size = document.getElementById('mesh').getDimensions();"
                                     "return [size.x, size.y, size.z]")
        assert size[1] < 0.2 * min(size[0], size[2]), f"the terrain lies flat: width, height, depth are {size}"
        picture = browser.settled_picture(driver)  # from above, north at the top
        west = picture.getpixel((picture.width // 3, picture.height // 2))
        east = picture.getpixel((2 * picture.width // 3, picture.height // 2))
        assert west[0] > 2 * west[1] and west[3] == 255, f"red in the west: {west}"
        assert east[1] > 2 * east[0] and east[3] == 255, f"green in the east: {east}"


def main():
    tool, script = sys.argv[1:]
    with tempfile.TemporaryDirectory() as name:
        directory = pathlib.Path(name)
        (directory / "terrain.las").write_bytes(las())
        subprocess.run([tool, "--quiet", directory / "terrain.las", directory / "terrain.glb"], check=True)
        check((directory / "terrain.glb").read_bytes(), pathlib.Path(script).read_text(), directory / "page.html")


main()
