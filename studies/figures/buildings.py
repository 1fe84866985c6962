"""Draw docs/images/buildings.png: a real floor, imported, with doors missed and false ones."""

from itertools import islice
from pathlib import Path

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from semnav_env.world.maps.draw import draw_floor_plan
from semnav_features import ExtractorSettings
from studies.buildings.buildings import find_buildings, look_around
from studies.buildings.failure_pages import Failure, draw_failure
from studies.figures import IMAGES

FLOOR = "gdc_floors/3ne"
FAILURES_SHOWN = 4
"""Failures of each kind that are drawn."""


def main(data: Path) -> None:
    """Draw buildings.png: a real floor, imported, with doors missed and false ones.

    Args:
        data: folder that holds gdc_floors.
    """
    building = find_buildings(data)[FLOOR]()
    limits = ExtractorSettings()
    looks = list(look_around(building, 400, np.random.default_rng(0), limits))
    missed = (Failure(look, door) for look in looks for door in look.missed(limits))
    false = (Failure(look, door) for look in looks for door in look.false())
    figure = Figure(figsize=(14, 10.5), layout="constrained")
    FigureCanvasAgg(figure)
    above, below = figure.subfigures(2, 1, height_ratios=(1.0, 1.35))
    ax = above.subplots()
    draw_floor_plan(building.plan, ax, names=False)
    ax.set_title("an imported floor: places tinted, open doors green, closed ones red")
    axes = below.subplots(2, FAILURES_SHOWN)
    for row, failures in zip(axes, (missed, false), strict=True):
        for panel, failure in zip(row, islice(failures, 2, None, 3), strict=False):
            draw_failure(panel, building.plan, failure)
    below.suptitle("above: doors in good view that were missed; below: false ones")
    figure.savefig(IMAGES / "buildings.png", dpi=60)
