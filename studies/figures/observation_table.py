"""Writes docs/observations.md: every entry of the observation as the layout declares it."""

from __future__ import annotations

from semnav_env.features.lidar_spec import TIM561
from semnav_env.observations.layout import (
    CLAUSE,
    GOAL,
    MODES,
    ODOMETRY,
    TABLES,
    Entry,
    command_space,
    scan_space,
)
from studies.figures import IMAGES

PAGE = IMAGES.parent / "observations.md"

TITLE = """# Entries of the observation

Each entry is one flat array. Features, bumps and the goal are in the robot frame: x forward, y
left, origin at the centre of the footprint. An entry with a mask has `NAME_mask` beside it,
with 1 for each row that counts; `semnav_env.observations.table(observation, "walls")` gives
these rows. The numbers come from `semnav_env.observations.layout`, which also makes the spaces
and the kernels' offsets.

| entry | size | columns | bounds | unit | meaning |
|---|---|---|---|---|---|
"""


def page() -> str:
    """The page, made of the declared entries."""
    entries = (*TABLES, CLAUSE, ODOMETRY, GOAL)
    scan, tokens = scan_space(TIM561), command_space()
    rows = [
        *map(_row, entries),
        f"| `scan` | beams (TiM561: {scan.shape[0]}) | range | 0 to the lidar's range | m | "
        "one range a beam; no return reads as the lidar's range |",
        f"| `command` | {tokens.shape[0]} | 8 clauses of 5 tokens | "
        f"{tokens.low.min()} to {tokens.high.max()} | | the command, see "
        "[as numbers](language.md#as-numbers) |",
    ]
    modes = [f'- `observation="{mode}"`: {", ".join(_plain(mode))}' for mode in MODES]
    return TITLE + "\n".join([*rows, "", "## What each mode has", "", *modes, ""])


def _row(entry: Entry) -> str:
    size = f"{entry.rows} x {len(entry.columns)}" if entry.masked else str(entry.size)
    columns = entry.columns if entry is not CLAUSE else ("one for each clause",)
    name = f"`{entry.name}`" + (", mask" if entry.masked else "")
    bounds = f"{entry.low:g} to {entry.high:g}"
    return f"| {name} | {size} | {', '.join(columns)} | {bounds} | {entry.unit} | {entry.meaning} |"


def _plain(mode: str) -> list[str]:
    """The entries of a mode without their masks."""
    return [name for name in MODES[mode] if not name.endswith("_mask")]


def main() -> None:
    """Write the page."""
    PAGE.write_text(page(), encoding="utf-8")
