"""Draw docs/images/tour.png: one tour of the villa with each correction, driven and believed."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from semnav_env.world.maps import Material
from studies.figures import IMAGES
from studies.tour.tour import TourPeriod, result, tour
from studies.tour.villa import villa

SHOWN = ("none", "walls seen again", "doors, Mes 2021", "doors, lidar, and walls")
FACTOR, SEED = 2.0, 0


def draw_villa(ax: Axes) -> None:
    """Walls, leaves and furniture."""
    for surface in villa().surfaces:
        wall = surface.material is Material.WALL
        ax.plot(*zip(*surface.points, strict=True), color="black" if wall else "0.7", lw=1.2)
    ax.set(aspect="equal", xticks=(), yticks=())
    ax.set_axis_off()


def draw_tour(ax: Axes, correction: str, periods: list[TourPeriod]) -> None:
    """Where the robot truly was, and where it believed to be."""
    true, believed = (
        np.array([pose[:2] for pose in poses])
        for poses in ([p.true for p in periods], [p.believed for p in periods])
    )
    ax.plot(*believed.T, color="tab:orange", lw=2.2, label="believed")
    ax.plot(*true.T, color="tab:blue", lw=1.0, label="driven")
    figures = result(periods)
    end = f"{figures.error:.2f} m off at the end"
    ax.set_title(f"{correction}: {figures.rooms} of 10 rooms, {end}", fontsize=10)


def table_row(found: dict[str, float]) -> str:
    """A row of the table of docs/lab/drift.md."""
    shares = " | ".join(f"{100.0 * found[name]:.0f} %" for name in ("all_rooms", "lost"))
    metres = " | ".join(
        f"{found[name]:.2f} m" if found["corrections"] else ""
        for name in ("usual_worst_correction", "worst_correction")
    )
    errors = f"{found['error']:.3f} m | {found['largest_error']:.2f} m"
    smaller = f"{found['reckoned_error'] / found['error']:.0f}"
    reckoned = f"{found['reckoned_error']:.2f} m | {smaller}"
    name = f"{found['factor']:g} | {found['correction']}"
    return f"| {name} | {shares} | {errors} | {reckoned} | {metres} | {found['contacts']:.1f} s |"


def main(rows: Path = Path("out/tour.jsonl")) -> None:
    """Draw the tours of one seed, and print the table of docs/lab/drift.md.

    Args:
        rows: what `python -m studies tour` wrote.
    """
    figure = Figure(figsize=(10.0, 6.6), layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.subplots(2, 2).ravel()
    for ax, correction in zip(axes, SHOWN, strict=True):
        draw_villa(ax)
        draw_tour(ax, correction, list(tour(correction, FACTOR, SEED)))
    figure.legend(*axes[0].get_legend_handles_labels(), loc="outside lower center", ncols=2)
    figure.savefig(IMAGES / "tour.png", dpi=100)
    for line in rows.read_text(encoding="utf-8").splitlines():
        print(table_row(json.loads(line)))
