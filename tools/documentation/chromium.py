# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of the documentation that Chromium draws."""
import base64
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "test/page"))
import browser
from PIL import Image

PAGE = """<!DOCTYPE html><meta charset="utf-8">
<style>body {{ margin: 0 }} model-viewer {{ width: {width}px; height: {height}px; background: #fff }}
model-viewer::part(default-progress-bar) {{ display: none }}</style>
<model-viewer id="mesh" orientation="0deg {pitch}deg 0deg" camera-orbit="{azimuth}deg {polar}deg {distance}%"
 field-of-view="30deg" interaction-prompt="none" tone-mapping="neutral" src="data:model/gltf-binary;base64,{glb}">
</model-viewer>
<script>{script}</script>"""


def glb_picture(build, glb, size, azimuth, elevation, distance, z_is_up=True):
    """How <model-viewer> shows a .glb, in which z is up, or y as glTF has it; distance in per cent of what it takes by
    itself."""
    width, height = size
    script = (build / "model-viewer/package/dist/model-viewer-umd.min.js").read_text()
    with tempfile.TemporaryDirectory() as directory:
        page = pathlib.Path(directory, "page.html")
        page.write_text(PAGE.format(width=width, height=height, azimuth=azimuth, polar=90 - elevation, distance=distance,
                                    pitch=-90 if z_is_up else 0, script=script,
                                    glb=base64.b64encode(glb.read_bytes()).decode()))
        with browser.chromium(width + 100, height + 300) as driver:
            browser.open_page(driver, page)
            picture = browser.settled_picture(driver)
    white = Image.new("RGBA", picture.size, "white")
    return Image.alpha_composite(white, picture).convert("RGB").resize(size)
