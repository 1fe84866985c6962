"""Draw docs/images/learning.png and write the tables of docs/lab/learning.md from the kept rows."""

from __future__ import annotations

import json
import re
from collections import defaultdict
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from semnav_agents.evaluation.intervals import paired_interval, sign_test
from studies.figures import IMAGES

PAGE = IMAGES.parent / "lab" / "learning.md"

ROWS = IMAGES.parent / "results" / "learning.jsonl"
"""The kept rows: all `METHOD-SEED.jsonl` of `python -m studies learning`, one after the other."""

SHOWN = {
    "ppo": ("C0", "PPO from nothing"),
    "recurrent_ppo": ("C1", "recurrent PPO from nothing"),
    "cloning": ("C2", "cloning"),
    "cloning_ppo": ("C3", "cloning half, then PPO"),
    "dagger": ("C4", "cloning half, then DAgger"),
}
"""Colour and name of each method."""

LINES = {"scripted, 0.98": 0.98, "listener_drives, 0.94": 0.94, "random, 0.14": 0.14}
"""Success of other agents on episodes of the same split, docs/guides/leaderboard.md."""

PAIRS = (
    ("cloning_ppo", "cloning half"),
    ("dagger", "cloning half"),
    ("cloning", "cloning half"),
    ("cloning_ppo", "cloning"),
    ("dagger", "cloning"),
)
"""What is compared, episode by episode."""

HALF = "cloning half"
"""The policy that is cloned from half of the demonstrations, from which others go on."""

Row = dict[str, Any]


def kept_rows() -> list[Row]:
    """The rows of all trainings."""
    return [json.loads(line) for line in ROWS.read_text(encoding="utf-8").splitlines()]


def last_rows(rows: Iterable[Row]) -> dict[str, list[Row]]:
    """By method, the row of each training's last policy; and that of cloning half."""
    rows = list(rows)
    ends: dict[tuple[str, int], Row] = {}
    for row in rows:
        ends[row["method"], row["seed"]] = row
    found: dict[str, list[Row]] = defaultdict(list)
    for (method, _), row in sorted(ends.items()):
        found[method].append(row)
    last = found["cloning"][0]["steps"]
    found[HALF] = [r for r in rows if r["method"] == "cloning" and 2 * r["steps"] == last]
    return found


def results_table(rows: Sequence[Row]) -> str:
    """A row for each method: means over seeds, and the least processor time."""
    lines = [
        "| method | trainings | success | one clause | two | three | no contact | SPL | CPU |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    found = last_rows(rows)
    for method in (*SHOWN, HALF):
        if method not in found:
            continue
        each = found[method]
        by_clauses = [row["success_by_clauses"] for row in each]
        success = [row["success"] for row in each]
        cells = (
            f"`{method}`" if method in SHOWN else method,
            str(len(each)),
            f"{_mean(success):.2f} ({min(success):.2f} to {max(success):.2f})",
            *(f"{_mean(shares.get(k, np.nan) for shares in by_clauses):.2f}" for k in "123"),
            f"{_mean(row['contact_free'] for row in each):.2f}",
            f"{_mean(row['spl'] for row in each):.2f}",
            f"{min(row['cpu_seconds'] for row in each):.0f} s",
        )
        lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(lines) + "\n"


def pairs_table(rows: Sequence[Row]) -> str:
    """A row for each comparison on the same episodes, all seeds together."""
    lines = [
        "| A | B | pairs | A - B (95 %) | only A | only B | p |",
        "|---|---|---|---|---|---|---|",
    ]
    found = last_rows(rows)
    for first, second in PAIRS:
        counts = np.zeros(4, int)
        theirs = {row["seed"]: row for row in found.get(second, ())}
        for row in found.get(first, ()):
            if row["seed"] in theirs:
                counts += _outcomes(row, theirs[row["seed"]])
        if not counts.any():
            continue
        both, only_first, only_second, neither = counts.tolist()
        n = int(counts.sum())
        low, high = paired_interval(both, only_first, only_second, neither)
        cells = (
            f"`{first}`",
            f"`{second}`" if second in SHOWN else second,
            str(n),
            f"{(only_first - only_second) / n:+.3f} ({low:+.3f} to {high:+.3f})",
            str(only_first),
            str(only_second),
            f"{sign_test(only_first, only_second):.2g}",
        )
        lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(lines) + "\n"


def _outcomes(first: Row, second: Row) -> np.ndarray[Any, Any]:
    """How many episodes both, only the first, only the second, and none carried out."""
    ours, theirs = set(first["succeeded"]), set(second["succeeded"])
    both = len(ours & theirs)
    parts = (both, len(ours) - both, len(theirs) - both, first["n"] - len(ours | theirs))
    return np.array(parts)


def _mean(values: Iterable[float]) -> float:
    return float(np.mean(list(values)))


TABLES = {"| method |": results_table, "| A | B |": pairs_table}
"""The tables of the page by how their first line begins."""


def page(text: str) -> str:
    """The text of the page with its tables as they follow from the kept rows."""
    rows = kept_rows()
    for begin, table in TABLES.items():
        pattern = rf"^{re.escape(begin)}.*\n(?:\|.*\n)*"
        text = re.sub(pattern, lambda _, table=table: table(rows), text, flags=re.MULTILINE)
    return text


def draw(ax: Axes, rows: Sequence[Row], measure: str) -> None:
    """A measure over steps: the mean over seeds, and a band from the least to the greatest."""
    halves = last_rows(rows)[HALF]
    for method, (colour, name) in SHOWN.items():
        points: dict[int, list[float]] = defaultdict(list)
        for row in rows:
            if row["method"] == method:
                points[_about(row["steps"])].append(row[measure])
        if method in ("cloning_ppo", "dagger") and points:
            points[_about(halves[0]["steps"])] = [row[measure] for row in halves]
        steps = sorted(points)
        if not steps:
            continue
        values = [points[step] for step in steps]
        thousands = [step / 1000 for step in steps]
        ax.plot(thousands, list(map(np.mean, values)), "o-", color=colour, markersize=3, label=name)
        ax.fill_between(
            thousands, list(map(min, values)), list(map(max, values)), color=colour, alpha=0.2
        )
    ax.set(xlabel="steps of the environment, thousands", ylim=(-0.02, 1.02))
    ax.set_xlim(left=0.0)
    ax.grid(alpha=0.3)


def _about(steps: int) -> int:
    """Steps to the nearest thousand: lessons do not end at round numbers."""
    return round(steps, -3)


def main() -> None:
    """Draw the curves, and write the tables."""
    rows = kept_rows()
    figure = Figure(figsize=(10.0, 4.0), layout="constrained")
    success, contacts = figure.subplots(1, 2)
    draw(success, rows, "success")
    for label, height in LINES.items():
        success.axhline(height, color="black", linewidth=0.8, linestyle=":")
        success.text(2.0, height + 0.01, label, fontsize=7)
    success.set(ylabel="success")
    draw(contacts, rows, "contact_free")
    contacts.set(ylabel="without any contact")
    figure.legend(
        *success.get_legend_handles_labels(), loc="outside lower center", ncols=3, fontsize=8
    )
    n, split = rows[0]["n"], rows[0]["split"]
    figure.suptitle(f"{n} episodes of {split}; mean and range over trainings", fontsize=10)
    FigureCanvasAgg(figure).print_png(IMAGES / "learning.png")
    PAGE.write_text(page(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
    print(f"wrote {IMAGES / 'learning.png'} and {PAGE}")
