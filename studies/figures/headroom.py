"""Writes the table of what is open in docs/benchmark.md, from the kept results in docs/results."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from semnav_agents.evaluation.leaderboard import Standing
from semnav_agents.evaluation.provenance import UNKNOWN
from studies.figures import IMAGES
from studies.figures.leaderboard import kept_standings

PAGE = IMAGES.parent / "benchmark.md"

TABLE = re.compile(r"^\| split \| body .*\n(?:\|.*\n)*", re.MULTILINE)
"""The table in the page."""

SPLITS, ROBOTS = ("val_unseen", "test_long", "test_real"), ("wheelchair", "spot")

CEILING, CHANCE = "oracle", ("blind", "random")
"""The agent that knows the plan, and those that do not hear the command."""

GIVEN, HEARING = ("scripted", "drive"), ("listener", "listener_drives")
"""Agents that are given the grounded goal, and agents that hear the command."""

COLUMNS = (CEILING, *GIVEN, *HEARING, *CHANCE)

OPEN = 0.05
"""A task is open if the best agent stays behind the ceiling by at least so much."""


def newest(rows: Iterable[Standing]) -> dict[tuple[str, str, str], Standing]:
    """By split, body and agent: the newest rules before others, then most episodes."""
    found: dict[tuple[str, str, str], Standing] = {}
    for row in sorted(rows, key=lambda row: (row.rules != UNKNOWN, row.episodes)):
        found[row.split, row.robot, row.agent] = row
    return found


def table(rows: Iterable[Standing]) -> str:
    """The table as Markdown."""
    found = newest(rows)
    heads = ("split", "body", *(f"`{name}`" for name in COLUMNS), "given the goal", "hearing")
    lines = [heads, ["---"] * len(heads)]
    for split in SPLITS:
        for robot in ROBOTS:
            own = {name: found.get((split, robot, name)) for name in COLUMNS}
            gaps = (_gap(own[CEILING], [own[name] for name in part]) for part in (GIVEN, HEARING))
            cells = (_cell(own[name]) for name in COLUMNS)
            lines.append((f"`{split}`", robot, *cells, *gaps))
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def _cell(row: Standing | None) -> str:
    if row is None:
        return ""
    return f"{row.success.mean:.2f} ({row.episodes}{'†' if row.rules == UNKNOWN else ''})"


def _gap(ceiling: Standing | None, others: Sequence[Standing | None]) -> str:
    """What the best of some agents lacks of the ceiling, and whether the task is open."""
    reached = [row.success.mean for row in others if row is not None]
    if ceiling is None or not reached:
        return ""
    gap = ceiling.success.mean - max(reached)
    return f"{gap:.2f}, {'open' if gap >= OPEN else 'nearly solved'}"


def main() -> None:
    """Write the table."""
    PAGE.write_text(page(PAGE.read_text(encoding="utf-8")), encoding="utf-8")


def page(text: str) -> str:
    """The text of the page with the table as it follows from the kept results."""
    return TABLE.sub(lambda _: table(kept_standings()), text, count=1)
