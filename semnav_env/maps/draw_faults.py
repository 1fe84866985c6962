"""What is wrong with a plan, in its picture: numbered circles, and a list of what they mean."""

from __future__ import annotations

from collections.abc import Sequence
from textwrap import wrap

from matplotlib.axes import Axes
from matplotlib.figure import FigureBase
from matplotlib.transforms import offset_copy

from semnav_env.maps.plan_fault import PlanFault

MOST_LINES = 12
"""Of findings below a picture before they are set in columns."""
COLUMN_WIDTH, LINE_HEIGHT, LETTER_WIDTH = 5.5, 0.155, 0.078
"""Of the list of findings, inches; that of letters is a little more than their mean."""
MARK_ROOM = 0.35
"""Around a picture with marks, inches."""
PLATE = {"facecolor": "white", "edgecolor": "none", "alpha": 0.7, "pad": 0.5}
"""Behind the numbers of marks."""


def mark(findings: Sequence[PlanFault], ax: Axes) -> None:
    """A numbered circle at each finding that has a place."""
    beside = offset_copy(ax.transData, ax.get_figure(root=True), 6.0, 6.0, units="points")
    for number, finding in enumerate(findings, 1):
        if finding.where is not None:
            x, y = finding.where
            ax.plot(x, y, "o", mec="red", mfc="none", markersize=14, mew=1.8, zorder=8)
            ax.text(
                x,
                y,
                str(number),
                transform=beside,
                color="red",
                weight="bold",
                zorder=9,
                bbox=PLATE,
            )


def leave_room(ax: Axes, metres: float) -> None:
    """Around all that is drawn, so that no mark at the edge is cut off."""
    drawn = ax.dataLim
    ax.set_xlim(drawn.x0 - metres, drawn.x1 + metres)
    ax.set_ylim(drawn.y0 - metres, drawn.y1 + metres)


def columns_of(findings: Sequence[PlanFault], width: float) -> list[list[str]]:
    """The list of findings, numbered, in lines that are short enough; many in columns.

    Args:
        findings: what is wrong with a plan.
        width: of the picture, inches.
    """
    if not findings:
        return []
    beside = max(1, int(width / COLUMN_WIDTH)) if len(findings) > MOST_LINES else 1
    letters = int(width / beside / LETTER_WIDTH)
    rows = -(-len(findings) // beside)
    written = [f"{number}  {finding}" for number, finding in enumerate(findings, 1)]
    return [
        [
            line
            for text in written[k : k + rows]
            for line in wrap(text, letters, subsequent_indent="     ")
        ]
        for k in range(0, len(written), rows)
    ]


def write_columns(columns: Sequence[Sequence[str]], figure: FigureBase) -> None:
    """The lines of `columns_of`, side by side."""
    for k, lines in enumerate(columns):
        x = 0.02 + 0.98 * k / len(columns)
        figure.text(x, 1.0, "\n".join(lines), va="top", size=9, color="red", linespacing=1.2)
