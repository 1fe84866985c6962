"""Faults in the picture of a plan: numbered circles and a list of what they mean."""

from __future__ import annotations

from collections.abc import Sequence
from textwrap import wrap

from matplotlib.axes import Axes
from matplotlib.figure import FigureBase
from matplotlib.transforms import offset_copy

from semnav_env.world.maps.plan_fault import PlanFault

MAX_SINGLE_COLUMN = 12
"""Largest number of faults that are listed in one column below a picture."""
COLUMN_WIDTH = 5.5
"""Least width of a column of the list, inches."""

LINE_HEIGHT = 0.155
"""Height of a line of the list, inches."""

LETTER_WIDTH = 0.078
"""Width that a letter of the list is given, inches: a little more than the mean."""
MARK_MARGIN = 0.35
"""Margin around a picture with marks, inches."""
NUMBER_BACKGROUND = {"facecolor": "white", "edgecolor": "none", "alpha": 0.7, "pad": 0.5}
"""Background of the numbers of marks, as Matplotlib takes it."""


def mark(faults: Sequence[PlanFault], ax: Axes) -> None:
    """Draw a numbered circle at each fault that has a place."""
    beside = offset_copy(ax.transData, ax.get_figure(root=True), 6.0, 6.0, units="points")
    for number, fault in enumerate(faults, 1):
        if fault.where is not None:
            x, y = fault.where
            ax.plot(x, y, "o", mec="red", mfc="none", markersize=14, mew=1.8, zorder=8)
            ax.text(
                x,
                y,
                str(number),
                transform=beside,
                color="red",
                weight="bold",
                zorder=9,
                bbox=NUMBER_BACKGROUND,
            )


def widen(ax: Axes, metres: float) -> None:
    """Widen the limits of the axes, so that no mark at the edge is cut off."""
    drawn = ax.dataLim
    ax.set_xlim(drawn.x0 - metres, drawn.x1 + metres)
    ax.set_ylim(drawn.y0 - metres, drawn.y1 + metres)


def columns_of(faults: Sequence[PlanFault], width: float) -> list[list[str]]:
    """The list of faults, numbered, broken into lines; a long list in several columns.

    Args:
        faults: what is wrong with a plan.
        width: width of the picture, inches.
    """
    if not faults:
        return []
    beside = max(1, int(width / COLUMN_WIDTH)) if len(faults) > MAX_SINGLE_COLUMN else 1
    letters = int(width / beside / LETTER_WIDTH)
    rows = -(-len(faults) // beside)
    written = [f"{number}  {fault}" for number, fault in enumerate(faults, 1)]
    return [
        [
            line
            for text in written[k : k + rows]
            for line in wrap(text, letters, subsequent_indent="     ")
        ]
        for k in range(0, len(written), rows)
    ]


def write_columns(columns: Sequence[Sequence[str]], figure: FigureBase) -> None:
    """Write the columns of `columns_of` side by side."""
    for k, lines in enumerate(columns):
        x = 0.02 + 0.98 * k / len(columns)
        figure.text(x, 1.0, "\n".join(lines), va="top", size=9, color="red", linespacing=1.2)
