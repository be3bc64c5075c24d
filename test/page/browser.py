# SPDX-License-Identifier: BSD-3-Clause
"""A headless Chromium that opens pages from files, without a network and without a graphics card."""
import base64
import contextlib
import io
import pathlib
import sys
import time

SKIPPED = 77  # exit status that tells ctest so
PATIENCE = 200  # seconds for what takes one: the machine may be busy, and draws without a graphics card

try:
    from PIL import Image
    from selenium import webdriver
    from selenium.common.exceptions import WebDriverException
except ImportError as error:
    print(f"skipped: {error}; tools/install_dependencies.sh installs it")
    sys.exit(SKIPPED)


@contextlib.contextmanager
def chromium(width, height):
    options = webdriver.ChromeOptions()
    for argument in ("--headless=new", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
                     "--hide-scrollbars", "--host-resolver-rules=MAP * ~NOTFOUND", f"--window-size={width},{height}"):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    try:
        driver = webdriver.Chrome(service=webdriver.chrome.service.Service("/usr/bin/chromedriver"), options=options)
    except WebDriverException as error:
        print(f"skipped: Chromium does not start: {error.msg}; tools/install_dependencies.sh installs it")
        sys.exit(SKIPPED)
    driver.set_script_timeout(PATIENCE)
    try:
        yield driver
    finally:
        driver.quit()


def open_page(driver, path):
    """Opens a page whose <model-viewer id=mesh> is to load its mesh."""
    driver.get(pathlib.Path(path).resolve().as_uri())
    wait_for_mesh(driver)


def wait_for_mesh(driver):
    wait_until(lambda: driver.execute_script("return document.getElementById('mesh').loaded"), "the mesh is loaded")


def wait_until(is_true, what, seconds=PATIENCE):
    deadline = time.monotonic() + seconds
    while not is_true():
        if time.monotonic() > deadline:
            raise AssertionError(f"not within {seconds} s: {what}")
        time.sleep(0.1)


def picture(driver):
    """What the viewer shows, with nothing behind the mesh."""
    png = driver.execute_async_script(
        "const done = arguments[0];"
        "requestAnimationFrame(() => requestAnimationFrame(() =>"
        "  done(document.getElementById('mesh').toDataURL('image/png'))));")
    return Image.open(io.BytesIO(base64.b64decode(png.split(",")[1]))).convert("RGBA")


def settled_picture(driver, take=picture):
    """The picture when nothing moves any more."""
    pictures = [take(driver)]

    def is_still():
        time.sleep(0.3)
        pictures.append(take(driver))
        return pictures[-1].tobytes() == pictures[-2].tobytes()

    wait_until(is_still, "the picture is still")
    return pictures[-1]


def screenshot(driver):
    return Image.open(io.BytesIO(driver.get_screenshot_as_png())).convert("RGB")
