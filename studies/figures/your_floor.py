"""Draws docs/images/your_floor.png: what the tutorial "Your floor in ten minutes" makes."""

from __future__ import annotations

import contextlib
from pathlib import Path
from tempfile import TemporaryDirectory

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.image import imread

from semnav_env.world.maps import load_floor_plan
from semnav_env.world.maps.draw import draw_floor_plan, leave_out_overlapping
from studies.figures import IMAGES
from tests.support.running_pages import run_page

PAGE = "docs/tutorials/your_floor.md"


def main() -> None:
    """Draw your_floor.png: the image of a map, its walls, and the plan with doors and rooms."""
    figure = Figure(figsize=(15, 4.2), layout="constrained")
    FigureCanvasAgg(figure)
    image, walls, plan = figure.subplots(1, 3)
    with TemporaryDirectory() as folder, contextlib.chdir(folder):
        blocks = run_page(PAGE)
        for _ in range(2):
            next(blocks)
        image.imshow(imread("floor.png"), cmap="gray", vmin=0.0, vmax=1.0)
        draw_floor_plan(load_floor_plan(Path("floor.geojson")), walls, names=False)
        next(blocks)
        draw_floor_plan(load_floor_plan(Path("named.geojson")), plan)
        leave_out_overlapping(plan)
    for ax, title in ((image, "the map"), (walls, "imported"), (plan, "doors and rooms drawn")):
        ax.set_title(title)
        ax.set_axis_off()
    figure.savefig(IMAGES / "your_floor.png", dpi=75)
