"""Pictures of how drivers pass doorways: every path in the frame of its doorway."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from semnav_features.door_passages import (
    APPROACH_LENGTH,
    EXIT_LENGTH,
    DoorPassage,
    driving_habits,
)
from semnav_features.plot import check_suffix
from semnav_features.writing import replacing

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_PATH, _JAMB = "#1f4fd8", "black"


def save_passages(
    path: str | os.PathLike[str], drivers: Mapping[str, Sequence[DoorPassage]]
) -> None:
    """Write a picture with a panel for each driver; its suffix chooses PNG, PDF or SVG.

    Every passage goes up through a doorway at the origin. The doorway is drawn with the median
    width; its own width is that of its passage.

    Args:
        path: the file to write.
        drivers: the passages of each driver, at least one.

    Raises:
        ValueError: no driver, or a suffix that is not a picture's.
    """
    from matplotlib.figure import Figure

    check_suffix(path)
    if not drivers:
        raise ValueError("there are no passages to draw; give those of one driver or more")
    figure = Figure(figsize=(3.6 * len(drivers), 5.4), layout="constrained")
    panels = figure.subplots(1, len(drivers), squeeze=False)[0]
    for ax, (name, passages) in zip(panels, drivers.items(), strict=True):
        _draw(ax, name, passages)
    with replacing(path) as part:
        figure.savefig(part, dpi=110, format=os.fspath(path).rsplit(".", 1)[-1])


def _draw(ax: Axes, name: str, passages: Sequence[DoorPassage]) -> None:
    for passage in passages:
        forward, left = passage.path.T
        ax.plot(-left, forward, color=_PATH, linewidth=0.8, alpha=0.35)
    widths = sorted(passage.width for passage in passages) or [0.9]
    half = widths[len(widths) // 2] / 2
    for side in (-1.0, 1.0):
        ax.plot((side * half, side * (half + 1.0)), (0.0, 0.0), color=_JAMB, linewidth=3)
    ax.set_xlim(-1.3, 1.3)
    ax.set_ylim(-APPROACH_LENGTH, EXIT_LENGTH)
    ax.set_aspect("equal")
    ax.set_xlabel("right of the middle, m")
    ax.set_ylabel("behind the doorway, m")
    ax.set_title(f"{name}\n{_told(passages)}", fontsize=9)


def _told(passages: Sequence[DoorPassage]) -> str:
    habits = driving_habits(passages)
    if not passages:
        return "no passage"
    return (
        f"{habits.passages} passages, {math.degrees(habits.angle):.0f} degrees, "
        f"{100 * habits.offset:.0f} cm off"
    )
