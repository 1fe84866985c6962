"""Draws docs/images/approach.png, and writes the tables of docs/lab/approach.md."""

from __future__ import annotations

import math
import re
from fractions import Fraction

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from semnav_env.approach import THESIS_SETTINGS, ApproachPlan, Surroundings, plan_approach
from semnav_env.approach.draw import draw_ellipse, draw_poses, draw_square
from semnav_env.approach.in_plan import side_towards
from semnav_env.approach.poses import CandidatePose
from semnav_env.world.maps import load_floor_plan
from semnav_env.world.maps.draw import draw_floor_plan
from studies.figures import IMAGES

PAGE = IMAGES.parent / "lab" / "approach.md"
VILLA = load_floor_plan("villa_hall")
DOORS = ("parents", "living", "kitchen", "daughter")
VIEW = (-6.6, 2.8), (-0.5, 5.4)
SHOWN = 10
"""Poses of a door in Table 7.2."""

ELLIPSES = 3
"""Best poses of a door in figure 7.1d."""

MARKS = "<!-- tables: python -m studies.figures approach -->\n", "<!-- end of tables -->"


def plans() -> dict[str, ApproachPlan]:
    """The plan for each door of the hall as Mes has it, by its name."""
    around = Surroundings.of_plan(VILLA)
    sides = {name: side_towards(VILLA, VILLA.door(name)) for name in DOORS}
    return {name: plan_approach(sides[name], around, settings=THESIS_SETTINGS) for name in DOORS}


def tables() -> str:
    """Tables 7.1 and 7.2 of the thesis, as computed here, in Markdown."""
    found = plans()
    counts = [
        f"| {name} | {len(plan.ranked)} | {plan.clear_count} | {len(plan.safe)} |"
        for name, plan in found.items()
    ]
    head = "| door | evaluated | clear of walls | safe |\n|---|---|---|---|"
    return "\n".join([head, *counts, "", *map(_top_ten, found, found.values())])


def page(old: str) -> str:
    """The page with its tables made anew."""
    start, end = map(re.escape, MARKS)
    return re.sub(f"(?<={start}).*(?={end})", lambda _: tables(), old, flags=re.DOTALL)


def main() -> None:
    """Draw figure 7.1 of Mes 2021 anew, and write both tables into docs/lab/approach.md."""
    figure = Figure(figsize=(11.0, 8.0), layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.subplots(2, 2).flat
    titles = (
        "a: the square before each door is cut",
        "b: poses that are clear of walls",
        "c: safe poses",
        "d: the three best of each door",
    )
    for ax, title, step in zip(axes, titles, "abcd", strict=True):
        _draw(ax, step)
        ax.set_title(title, fontsize=10)
    figure.savefig(IMAGES / "approach.png", dpi=90)
    PAGE.write_text(page(PAGE.read_text(encoding="utf-8")), encoding="utf-8")


def _draw(ax: Axes, step: str) -> None:
    draw_floor_plan(VILLA, ax, names=False)
    for plan in plans().values():
        if step == "a":
            draw_square(ax, plan)
        elif step == "b":
            draw_poses(ax, plan.clear_of_walls)
        elif step == "c":
            draw_poses(ax, plan.safe)
        else:
            best = plan.safe[:ELLIPSES]
            draw_poses(ax, best)
            for each in best:
                draw_ellipse(ax, each.pose, THESIS_SETTINGS)
    ax.set(xlim=VIEW[0], ylim=VIEW[1])


def _top_ten(name: str, plan: ApproachPlan) -> str:
    head = f"**Door: hall to {name}**\n\n| rank | x, y, heading | area error | angle error | body |"
    rows = [_row(k + 1, each) for k, each in enumerate(plan.clear_of_walls[:SHOWN])]
    return "\n".join([head, "|---|---|---|---|---|", *rows, ""])


def _row(rank: int, each: CandidatePose) -> str:
    x, y, heading = each.pose
    quarters = Fraction(round(math.remainder(heading - math.pi / 2, math.tau) / math.pi * 4), 4)
    body = "clear" if each.body_clear else "touches"
    pose = f"{x:.4g}, {y:.4g}, {_of_pi(quarters)}"
    return f"| {rank} | {pose} | {each.area_error:.5f} | {each.angle_error:.5f} | {body} |"


def _of_pi(share: Fraction) -> str:
    """A heading from the y axis as a share of pi; -pi is pi."""
    if abs(share) == 1:
        return "π"
    return f"{share} π" if share else "0"
