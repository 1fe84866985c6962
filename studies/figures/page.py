"""Draw docs/images/page.png and board.png: the page of `semnav serve` in Chromium."""

from __future__ import annotations

import re
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import yaml
from PIL import Image

from semnav_env.world.maps import load_floor_plan
from semnav_env.world.maps.importers import import_map
from semnav_env.world.maps.occupancy_export import export_map
from semnav_features.frames import Point
from studies.figures import IMAGES
from studies.page.command import serving

CHROMIUM = Path("/usr/bin/chromium")
FLAGS = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-background-networking"]
ASKED = "?plan=heidelberg_hallway&pose=-2.5,-0.6,0.25&say=go through the second door on the right"
SIZE = {"width": 1180, "height": 800}
SHOWN_AT = re.compile(r"^[4-9]\.\d+ s$")
"""Simulated time of the picture: the robot has counted the doors."""

ADDED = (
    ("box", (5.5, 1.6), "A box is put down."),
    ("person", (7.8, 1.9), "A person walks about now."),
)
"""What is put into the run, where, metres, and what is told."""

SEEN_AFTER = 8
"""Control periods from then to the picture."""

DRAWN = "office_cross"
"""The floor plan whose map is drawn on."""

MARGIN = 16
"""Pixels around a plan on the canvas."""


def main() -> None:
    """Serve the page, look at it, and keep what is seen (`make browser` installs Chromium)."""
    from playwright.sync_api import sync_playwright

    with serving(1) as (_, address), sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
        page = browser.new_page(viewport=SIZE, color_scheme="light")
        page.goto(address.replace("ws:", "http:") + ASKED)
        _look_at_a_run(page)
        keep(page, "page.png")
        with tempfile.TemporaryDirectory() as folder:
            _draw(page, Path(folder))
        keep(page, "board.png")
        browser.close()


def _look_at_a_run(page: Any) -> None:
    """Pause, put a box and a person into the run, and let the robot see them."""
    from playwright.sync_api import expect

    expect(page.locator("#clock")).to_have_text(SHOWN_AT, timeout=120_000)
    page.click("#pause")
    bounds = load_floor_plan("heidelberg_hallway").boundary.bounds
    for what, place, told in ADDED:
        page.check(f"input[value={what}]")
        page.locator("#canvas").scroll_into_view_if_needed()
        page.mouse.click(*_pixels(page, bounds, (0.0, 0.0))(place))
        expect(page.locator("#verdict")).to_have_text(told, timeout=60_000)
    for _ in range(SEEN_AFTER):
        page.click("#step")
    page.wait_for_timeout(500)
    page.evaluate("scrollTo(0, 0)")


def _draw(page: Any, folder: Path) -> None:
    """Drop a map without any labels, and draw half of its doors and rooms, as a person would."""
    true = load_floor_plan(DRAWN)
    export_map(true, folder / "map.yaml", 0.05)
    image = folder / "map.pgm"
    found = import_map(image, 0.05).plan
    page.set_input_files("#plan-file", image)
    page.wait_for_selector("#draw", state="visible")
    west, south, _ = yaml.safe_load((folder / "map.yaml").read_text())["origin"]
    pixel = _pixels(page, found.boundary.bounds, (-west, -south))
    for door in true.doors:
        _gesture(page, "door", door.name, pixel(door.start), pixel(door.end))
    for room in true.rooms[::2]:
        at = room.polygon.representative_point()
        _gesture(page, "room", room.name, pixel((at.x, at.y)))
    page.check("input[value=corridor]")


def _pixels(
    page: Any, bounds: tuple[float, ...], shift: Point
) -> Callable[[Point], tuple[float, float]]:
    """Where a place of the true plan lies on the screen while the whole imported plan is shown."""
    west, south, east, north = bounds
    box = page.locator("#canvas").bounding_box()
    scale = min(
        (box["width"] - 2 * MARGIN) / (east - west), (box["height"] - 2 * MARGIN) / (north - south)
    )
    middle = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2

    def pixel(place: Point) -> tuple[float, float]:
        x, y = place[0] + shift[0] - (west + east) / 2, place[1] + shift[1] - (south + north) / 2
        return middle[0] + x * scale, middle[1] - y * scale

    return pixel


def _gesture(page: Any, tool: str, name: str, *places: tuple[float, float]) -> None:
    """Draw with a tool from place to place, and wait until the board has it."""
    from playwright.sync_api import expect

    page.check(f"input[value={tool}]")
    page.fill("#part-name", name)
    page.mouse.move(*places[0])
    page.mouse.down()
    page.mouse.move(*places[-1])
    page.mouse.up()
    expect(page.locator("#part-name")).to_have_value("", timeout=60_000)


def keep(page: Any, name: str) -> None:
    """Write what a browser shows as a picture of few colours, the seldom ones among them."""
    path = IMAGES / name
    page.screenshot(path=path)
    seen = Image.open(path).convert("RGB")
    method = Image.Quantize.FASTOCTREE
    seen.quantize(128, method, dither=Image.Dither.NONE).save(path, optimize=True)
