"""Draw docs/images/page.png: the page of `semnav serve` in Chromium, in the middle of a run."""

from __future__ import annotations

import re
from pathlib import Path

from PIL import Image

from studies.figures import IMAGES
from studies.page.command import serving

CHROMIUM = Path("/usr/bin/chromium")
FLAGS = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-background-networking"]
ASKED = "?plan=heidelberg_hallway&pose=-2.5,-0.6,0.25&say=go through the second door on the right"
SIZE = {"width": 1180, "height": 800}
SHOWN_AT = re.compile(r"^[4-9]\.\d+ s$")
"""Simulated time of the picture: the robot has counted the doors."""


def main() -> None:
    """Serve the page, look at it, and keep what is seen (`make browser` installs Chromium)."""
    from playwright.sync_api import expect, sync_playwright

    with serving(1) as (_, address), sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
        page = browser.new_page(viewport=SIZE, color_scheme="light")
        page.goto(address.replace("ws:", "http:") + ASKED)
        expect(page.locator("#clock")).to_have_text(SHOWN_AT, timeout=120_000)
        page.click("#pause")
        page.wait_for_timeout(500)
        path = IMAGES / "page.png"
        page.screenshot(path=path)
        browser.close()
    Image.open(path).quantize(128, dither=Image.Dither.NONE).save(path, optimize=True)
