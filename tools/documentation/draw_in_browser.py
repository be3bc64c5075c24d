#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the pictures of docs/parameters.md that a browser shows: meshes with and without normals, a page of --html.

usage: draw_in_browser.py BUILD_DIR OUTPUT_DIR"""
import pathlib
import subprocess
import sys
import tempfile

import chromium
from chromium import browser
from PIL import Image
from selenium.webdriver.common.by import By
from selenium.webdriver.support.ui import Select

PROJECT = pathlib.Path(__file__).resolve().parents[2]
DUCK = PROJECT / "data/duck_scan.ply"

# What no two runs have in common, and the long tables at the end.
SHORTEN = """
const line = document.querySelector('header p');
line.textContent = line.textContent.replace(/ · [-0-9]+ [0-9:]+ UTC/, '');
for (const tile of document.querySelectorAll('.figures div'))
  if (tile.textContent.includes('seconds')) tile.remove();
for (const section of document.querySelectorAll('section'))
  if (/^(Time|Counts|Parameters)/.test(section.textContent.trim())) section.remove();
document.querySelector('footer').remove();
return Math.ceil(document.body.getBoundingClientRect().height);
"""


def draw_normals(build, directory, output):
    for name, options in (("normals_none", []), ("normals", ["--normals"])):
        mesh = directory / "mesh.glb"
        subprocess.run([build / "tools/pcl_pds_recon", "-q", "-f", "5", *options, DUCK, mesh], check=True)
        picture = chromium.glb_picture(build, mesh, (300, 260), azimuth=35, elevation=15, distance=105)
        picture.save(output / f"{name}.png", optimize=True)


def draw_page(build, directory, output):
    page = directory / "report.html"
    subprocess.run([build / "tools/pcl_pds_recon", "-q", "--html", page, DUCK, directory / "duck.ply"], check=True)
    width, height_of_window = 1200, 3000  # all of the page is to be seen at once
    with browser.chromium(width, height_of_window) as driver:
        browser.open_page(driver, page)
        Select(driver.find_element(By.ID, "up")).select_by_visible_text("z")
        height = driver.execute_script(SHORTEN)
        browser.wait_for_mesh(driver)
        browser.settled_picture(driver)
        picture = browser.settled_picture(driver, browser.screenshot)
    picture.crop((0, 0, width, height)).resize((width // 2, height // 2), Image.LANCZOS).save(output / "html.png", optimize=True)


def main():
    if len(sys.argv) != 3:
        sys.exit("draw_in_browser.py: usage: draw_in_browser.py BUILD_DIR OUTPUT_DIR")
    build, output = map(pathlib.Path, sys.argv[1:])
    with tempfile.TemporaryDirectory() as directory:
        draw_normals(build, pathlib.Path(directory), output)
        draw_page(build, pathlib.Path(directory), output)


main()
