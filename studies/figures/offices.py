"""Draws the sheet of generated offices for floor_plans.md: `python -m studies.figures offices`."""

from __future__ import annotations

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from semnav_env.world.maps import load_floor_plan
from semnav_env.world.maps.draw import draw_floor_plan
from studies.figures import IMAGES

SHEET = (
    ("office:small:5", "office:small:1", "office:small:8"),
    ("office:medium:0", "office:medium:1", "office:medium:2"),
    ("office:hard:1", "office:hard:4", "office:hard:0"),
    ("office:large:0", "office:large:1", "office:large:2"),
)
"""One row for each distribution."""


def main() -> None:
    """Draw offices.png: generated offices of every distribution."""
    figure = Figure(figsize=(16, 21), layout="constrained")
    FigureCanvasAgg(figure)
    for names, axes in zip(SHEET, figure.subplots(4, 3), strict=True):
        for name, ax in zip(names, axes, strict=True):
            draw(name, ax)
    figure.savefig(IMAGES / "offices.png", dpi=75)


def draw(name: str, ax: Axes) -> None:
    """One office, with how many rooms and doors it has."""
    plan = load_floor_plan(name)
    draw_floor_plan(plan, ax, names=False)
    ax.set_title(f"{name}: {len(plan.rooms)} rooms, {len(plan.doors)} doors")
    ax.set_xlabel("")
    ax.set_ylabel("")
    ax.tick_params(labelsize=7)
