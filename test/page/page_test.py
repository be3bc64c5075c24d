# SPDX-License-Identifier: BSD-3-Clause
"""The page of --html in Chromium: it loads from a file without errors, shows the mesh, and dragging turns it.
usage: page_test.py TOOL SCAN"""
import pathlib
import subprocess
import sys
import tempfile

import browser
from PIL import ImageChops
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.support.ui import Select


def share_above(channel, value):
    """How much of the picture is brighter than this."""
    return sum(channel.histogram()[value + 1:]) / (channel.width * channel.height)


def opaque_share(picture):
    return share_above(picture.getchannel("A"), 254)


def changed_share(before, after):
    noticeable = 16
    return max(share_above(channel, noticeable) for channel in ImageChops.difference(before, after).split())


def check(page):
    with browser.chromium(700, 700) as driver:
        browser.open_page(driver, page)
        first = browser.settled_picture(driver)
        assert 0.02 < opaque_share(first) < 0.9, "the mesh is seen, and background around it"
        shades = sum(count > 0 for count in first.getchannel("R").histogram(first.getchannel("A")))
        assert shades > 50, "the mesh is shaded"

        viewer = driver.find_element(By.ID, "mesh")
        assert changed_share(first, browser.settled_picture(driver)) == 0, "nothing turns by itself"
        ActionChains(driver).drag_and_drop_by_offset(viewer, 200, 0).perform()
        turned = browser.settled_picture(driver)
        assert changed_share(first, turned) > 0.02, "dragging turns the mesh"

        up = Select(driver.find_element(By.ID, "up"))
        up.select_by_visible_text("z" if up.first_selected_option.text == "y" else "y")
        browser.wait_for_mesh(driver)
        assert changed_share(turned, browser.settled_picture(driver)) > 0.02, "another axis points up"

        # The viewer library warns of a frame that a busy machine draws late: no fault of the page.
        messages = [entry for entry in driver.get_log("browser") if "rAF timed out" not in entry["message"]]
        assert not messages, messages
        asked = driver.execute_script("return performance.getEntriesByType('resource').map(entry => entry.name)")
        elsewhere = [name for name in asked if not name.startswith(("data:", "blob:"))]
        assert not elsewhere, f"asks for {elsewhere}"


def main():
    tool, scan = sys.argv[1:]
    with tempfile.TemporaryDirectory() as directory:
        page = pathlib.Path(directory, "page of 1 <scan>.html")
        subprocess.run([tool, "--quiet", "--html", page, scan, pathlib.Path(directory, "mesh.ply")], check=True)
        check(page)


main()
