"""The tables and lines that `semnav evaluate` prints."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from math import isnan
from typing import Any

from rich.table import Table

from semnav_agents.evaluation.results import INTERVAL_MEASURES, Summary
from semnav_env.judge.metrics import WORST_SHARES

SHOWN_MEASURES = {
    "success": "success",
    "contact_free": "no contact",
    "spl": "SPL",
    "ndtw": "nDTW",
    "clauses": "clauses",
    "seconds": "seconds",
}
"""The measures that are shown for each command, and their headings in both tables."""

SHOWN_DIGITS = 12
"""Digits of a commit that are shown."""


def headings(who: Mapping[str, Any], everything: Summary) -> Iterator[str]:
    """Lines above the tables: agent, split, body, version, and the intervals of the shares.

    Args:
        who: what every row of the results has: agent, split, robot, version and so on.
        everything: summary of all episodes.
    """
    seed = "" if who["training_seed"] < 0 else f" (training seed {who['training_seed']})"
    count = f"{everything.episodes} episode{'' if everything.episodes == 1 else 's'}"
    yield f"agent {who['agent']}{seed}, robot {who['robot']}, {who['split']}, {count}"
    commit = f", commit {_short(who['commit'])}" if who["commit"] else ""
    yield f"semnav-env {who['version']}{commit}, rules {who['rules']}"
    if everything.left_out:
        which = "episode was" if everything.left_out == 1 else "episodes were"
        changed = "its command is" if everything.left_out == 1 else "their commands are"
        yield (
            f"{everything.left_out} more {which} left out: {changed} void with the doors and "
            "furniture as they stand there"
        )
    for name in INTERVAL_MEASURES:
        mean, (low, high) = everything.means[name], everything.intervals[name]
        interval = f"{low:.3f} to {high:.3f}"
        yield f"{SHOWN_MEASURES[name]} {mean:.3f} (95 % interval {interval}, Wilson)"


def command_cells(summaries: Sequence[Summary]) -> list[tuple[str, ...]]:
    """The table of commands: a row of headings, then one for each command, which is named last."""
    names = (heading for heading in SHOWN_MEASURES.values())
    rows: list[tuple[str, ...]] = [("n", next(names), "95 %", *names, "command")]
    for row in summaries:
        first, *others = (_written(row.means[name]) for name in SHOWN_MEASURES)
        low, high = row.intervals["success"]
        rows.append((str(row.episodes), first, f"{low:.2f}-{high:.2f}", *others, row.name))
    return rows


def measure_cells(everything: Summary) -> list[tuple[str, ...]]:
    """The table of measures: headings, then for each its mean and that of its worst episodes."""
    shares = (f"worst {share:.0%}" for share in WORST_SHARES)
    rows: list[tuple[str, ...]] = [("all episodes", "mean", *shares)]
    for name, mean in everything.means.items():
        worst = (_written(row[name]) for row in everything.worst)
        heading = SHOWN_MEASURES.get(name, name.replace("_", " "))
        rows.append((heading, _written(mean), *worst))
    return rows


def commands_table(summaries: Sequence[Summary]) -> Table:
    """A row for each command; numbers come first, so that only the words wrap in narrow windows."""
    (count, *measures, command), *rows = command_cells(summaries)
    table = Table(count, box=None, padding=(0, 1, 0, 0))
    for heading in measures:
        is_interval = heading == "95 %"
        table.add_column(
            heading, width=9 if is_interval else 7, justify="left" if is_interval else "right"
        )
    table.add_column(command)
    for row in rows:
        table.add_row(*row)
    return table


def measures_table(everything: Summary) -> Table:
    """Every measure over all episodes: its mean, and its mean over its worst episodes."""
    names, *rows = measure_cells(everything)
    table = Table(*names, box=None, padding=(0, 2, 0, 0))
    for row in rows:
        table.add_row(*row)
    return table


def _short(commit: str) -> str:
    """A commit with fewer digits, and "-dirty" at its end if it has that."""
    digits, dash, changed = commit.partition("-")
    return digits[:SHOWN_DIGITS] + dash + changed


def _written(value: float) -> str:
    return "" if isnan(value) else f"{value:.1f}" if abs(value) >= 10.0 else f"{value:.3f}"
