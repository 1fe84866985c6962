"""Draw docs/images/drift_success.png from the rows that `python -m studies drift` keeps."""

from __future__ import annotations

import json
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from studies.figures import IMAGES

LINES = {
    (True, "success"): ("o-", "tab:green", "success, corrected"),
    (False, "success"): ("o--", "tab:green", "success, odometry alone"),
    (True, "lost"): ("s-", "tab:red", "in another room than believed, corrected"),
    (False, "lost"): ("s--", "tab:red", "in another room than believed, odometry alone"),
}


def draw(ax: Axes, rows: list[dict[str, float]], robot: str) -> None:
    """The shares of one body's episodes over the factor of its errors."""
    for (corrected, name), (style, colour, label) in LINES.items():
        points = [(r["factor"], r[name]) for r in rows if r["corrected"] == corrected]
        ax.plot(*zip(*points, strict=True), style, color=colour, label=label)
    ax.set(title=robot, xlabel="errors of odometry, times the preset", ylim=(-0.03, 1.03))
    ax.grid(alpha=0.3)


def main(rows: Path = Path("out/drift.jsonl")) -> None:
    """Draw what became of the episodes, and print the table of docs/concepts/drift.md.

    Args:
        rows: what `python -m studies drift` wrote.
    """
    found = [json.loads(line) for line in rows.read_text().splitlines()]
    figure = Figure(figsize=(9.0, 3.6), layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.subplots(1, 2, sharey=True)
    for ax, robot in zip(axes, ("wheelchair", "spot"), strict=True):
        draw(ax, [row for row in found if row["robot"] == robot], robot)
    axes[0].set_ylabel("share of the episodes")
    figure.legend(
        *axes[0].get_legend_handles_labels(), loc="outside lower center", ncols=2, fontsize=9
    )
    figure.savefig(IMAGES / "drift_success.png", dpi=100)
    for row in found:
        kind = "walls seen again" if row["corrected"] else "none"
        figures = f"{row['success']:.3f} | {row['wrong_door']:.3f} | {row['lost']:.3f}"
        print(f"| {row['robot']} | {row['factor']:g} | {kind} | {figures} | {row['error']:.2f} m |")
