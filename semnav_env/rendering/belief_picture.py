"""A picture of a robot's beliefs: its path, its remembered walls and doors, its goals."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from semnav_env.mind.belief import Belief
from semnav_features.writing import replacing


def save_beliefs(
    path: str | Path, beliefs: Sequence[Belief], clauses: int, title: str = ""
) -> None:
    """Draw the path of a robot and its memory at the end, odom frame.

    Args:
        path: file of the picture (.png, .pdf or .svg).
        beliefs: one per scan, in order; at least one.
        clauses: number of clauses of the command.
        title: above the picture.
    """
    from matplotlib.figure import Figure  # takes half a second to import

    figure = Figure(figsize=(9.0, 7.0), layout="constrained")
    axes = figure.subplots()
    scene = beliefs[-1].scene
    for wall in scene.walls:
        axes.plot(*zip(wall.start, wall.end, strict=True), color="0.25", lw=1.6)
    for door in scene.doors:
        axes.plot(*zip(door.start, door.end, strict=True), color="tab:orange", lw=3.0)
    axes.plot(*zip(*(each.pose[:2] for each in beliefs), strict=True), color="tab:blue", lw=1.2)
    for number, goal in _last_goals(beliefs, clauses).items():
        axes.plot(*goal, "o", color="tab:green", ms=16, alpha=0.6)
        axes.annotate(str(number), goal, ha="center", va="center", color="white", weight="bold")
    for colour, name in (
        ("0.25", "remembered wall"),
        ("tab:orange", "remembered door"),
        ("tab:blue", "believed way"),
        ("tab:green", "last goal of the clause of this number"),
    ):
        axes.plot([], [], color=colour, lw=3.0, label=name)
    axes.set_aspect("equal")
    axes.set(xlabel="x, m", ylabel="y, m", title=title)
    axes.legend(loc="best", fontsize=8)
    with replacing(path) as part:
        figure.savefig(part, dpi=110)


def _last_goals(beliefs: Sequence[Belief], clauses: int) -> dict[int, tuple[float, float]]:
    """The last goal of each clause, by its number from 1."""
    return {each.clause + 1: each.goal.pose[:2] for each in beliefs if each.clause < clauses}
