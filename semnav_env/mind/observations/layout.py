"""The layout of the observation, declared once.

This module declares name, shape, bounds, unit and meaning of every entry. The spaces, the offsets
at which the kernels write, the reader of the goal and the table of the documentation all come from
it. Every entry is one flat array, as stable-baselines3 needs it.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import accumulate

import numpy as np
from gymnasium.spaces import Box, MultiDiscrete

from semnav_env.language import MAX_CLAUSES, token_space
from semnav_env.mind.belief.bump_limits import MOST_PIECES
from semnav_env.mind.belief.told_ways import TOLD_DOORS, TOLD_PLACES
from semnav_env.mind.grounding.goal import GoalKind
from semnav_features.lidar_spec import LidarSpec

UNBOUNDED = 1000.0
"""Bound of positions and distances without a natural limit, metres."""

FEATURE_BOUND = 50.0
"""Bound of the positions of features, metres: beyond the range of indoor lidars."""

WALL_ROWS, DOOR_ROWS, CORNER_ROWS, PROBE_ROWS = 48, 16, 48, 24
"""Number of rows for each kind of feature of a scan; in beam order, further features are left
out."""

REMEMBERED_ROWS, BUMP_ROWS = 16, MOST_PIECES
"""Number of rows for remembered doors and for walls of the bump map."""

REMEMBERED_WALL_ROWS, JUNCTION_ROWS = 64, 16
"""Number of rows for remembered walls, and for the mouths of arms along a corridor."""

ENDS = ("start_x", "start_y", "end_x", "end_y")
GOAL_KINDS = tuple(kind.name.lower() for kind in GoalKind)


@dataclass(frozen=True)
class Entry:
    """One flat array of the observation.

    Attributes:
        name: its key in the observation.
        columns: names of the values of one row; the columns lie beside each other.
        low: smallest value.
        high: largest value.
        unit: the unit of the values; empty where they have none.
        meaning: what the values are.
        rows: how many rows there are.
        masked: whether `NAME_mask` says which rows count.
    """

    name: str
    columns: tuple[str, ...]
    low: float
    high: float
    unit: str
    meaning: str
    rows: int = 1
    masked: bool = False

    @property
    def size(self) -> int:
        """Number of values."""
        return self.rows * len(self.columns)

    @property
    def mask(self) -> Entry:
        """The entry that says which rows count."""
        meaning = f"1 where a row of {self.name} counts"
        return Entry(f"{self.name}_mask", ("counts",), 0.0, 1.0, "", meaning, self.rows)

    @property
    def space(self) -> Box[np.float32]:
        """The Gymnasium space of the entry."""
        return Box(self.low, self.high, (self.size,), np.float32)


def _table(name: str, rows: int, columns: tuple[str, ...], bound: float, meaning: str) -> Entry:
    return Entry(name, columns, -bound, bound, "m", meaning, rows, masked=True)


TABLES = (
    _table("walls", WALL_ROWS, ENDS, FEATURE_BOUND, "walls of this scan; the robot is to the left"),
    _table("doors", DOOR_ROWS, ENDS, FEATURE_BOUND, "jambs of the open doors of this scan"),
    _table(
        "corners",
        CORNER_ROWS,
        ("x", "y", "kind"),
        FEATURE_BOUND,
        "corners of this scan; kind 0 outer, 1 inner, 2 potential",
    ),
    _table(
        "corridors",
        PROBE_ROWS,
        ("x", "y"),
        FEATURE_BOUND,
        "midpoints of the corridor entrances of this scan",
    ),
    _table(
        "remembered_doors",
        REMEMBERED_ROWS,
        ENDS,
        UNBOUNDED,
        "jambs of the remembered doors that count, as a rule from their second sighting; the "
        "nearest first",
    ),
    _table(
        "bumps",
        BUMP_ROWS,
        ENDS,
        UNBOUNDED,
        "ends of walls that the robot bumped into and that the lidar does not show, such as glass",
    ),
)
"""Features; a row counts where its mask is 1."""

CLAUSE = Entry(
    "clause",
    tuple(f"clause_{i}" for i in range(MAX_CLAUSES)),
    0.0,
    1.0,
    "",
    "one-hot: the clause that the robot believes to be active",
)
ODOMETRY = Entry(
    "odometry",
    ("x", "y", "cosine", "sine", "forward", "left", "yaw_rate"),
    -UNBOUNDED,
    UNBOUNDED,
    "m, m/s, rad/s",
    "believed pose in the odom frame, and velocity of the robot",
)
GOAL = Entry(
    "goal",
    (*GOAL_KINDS, "x", "y", "cosine", "sine", *(f"door_{end}" for end in ENDS), "has_door"),
    -UNBOUNDED,
    UNBOUNDED,
    "m",
    "one-hot kind of `Belief.target`, its pose, and the jambs of its door. The target is the goal "
    "of the clause, or a place on the way to a named room that is still far away. The pose of a "
    "pass goal lies behind its door and heads away from it",
)
"""The entry "goal"; `SeenGoal` reads it."""


MEMORY_TABLES = (
    _table(
        "remembered_walls",
        REMEMBERED_WALL_ROWS,
        ENDS,
        UNBOUNDED,
        "remembered walls that count, as a rule from their second sighting; the nearest first",
    ),
    _table(
        "junctions",
        JUNCTION_ROWS,
        ("near_x", "near_y", "far_x", "far_y", "side", "goes_on"),
        UNBOUNDED,
        "mouths of the arms that leave the corridor: near and far edge; side 1 left, -1 right; "
        "goes_on 1 if the corridor continues behind the mouth",
    ),
    _table(
        "told_ways",
        TOLD_PLACES,
        ("clause", "x", "y"),
        UNBOUNDED,
        "places on the ways to named rooms, 1.5 m apart, as told before driving; clause is the "
        "number, from 0, of the clause that names the room",
    ),
    _table(
        "told_doors",
        TOLD_DOORS,
        ("clause", *ENDS),
        UNBOUNDED,
        "jambs of the doors at the ends of told ways",
    ),
)
"""Entries of the memory and of the told ways; a row counts where its mask is 1."""

HALLWAY = Entry(
    "hallway",
    ("x", "y", "cosine", "sine", "half_width", "end", "ends"),
    -UNBOUNDED,
    UNBOUNDED,
    "m",
    "the corridor ahead of the robot, by its memory: the point of the axis beside the robot, the "
    "direction of the axis, half the width, and the end along the axis; ends is 0 and end 50 while "
    "the end has not been seen",
)
START = Entry(
    "start",
    ("x", "y", "cosine", "sine"),
    -UNBOUNDED,
    UNBOUNDED,
    "m",
    "believed start pose of the command, robot frame: origin and x axis of the odom frame",
)


def _with_masks(tables: tuple[Entry, ...]) -> tuple[Entry, ...]:
    return tuple(part for table in tables for part in (table, table.mask))


def _starts(entries: tuple[Entry, ...]) -> dict[str, int]:
    begins = accumulate((entry.size for entry in entries), initial=0)
    return dict(zip((entry.name for entry in entries), begins, strict=False))


ENTRIES = (*_with_masks(TABLES), CLAUSE, ODOMETRY, GOAL)
"""Entries at the beginning of every row, in their order; the scan follows, if there is one."""

MEMORY_ENTRIES = (*_with_masks(MEMORY_TABLES), HALLWAY, START)
"""Entries after the scan in the row of `observation="command"`, in their order."""

STARTS, MEMORY_STARTS = _starts(ENTRIES), _starts(MEMORY_ENTRIES)
"""Index at which each entry begins: in the row, and for memory entries counted from the scan's
end."""

ROW_SIZE, MEMORY_SIZE = (sum(each.size for each in part) for part in (ENTRIES, MEMORY_ENTRIES))
"""Number of values of the row before the scan, and after it."""

_FEATURES = tuple(entry.name for entry in _with_masks(TABLES))
_SEMANTIC = (*_FEATURES, "command", "clause", "odometry", "goal")
_MEMORY = tuple(entry.name for entry in MEMORY_ENTRIES)

MODES = {
    "semantic": _SEMANTIC,
    "raw": ("scan", "command", "clause", "odometry"),
    "truth": _SEMANTIC,
    "all": ("scan", *_SEMANTIC),
    "command": ("scan", *_FEATURES, *_MEMORY, "command", "odometry"),
}
"""The entries of each `observation=`."""


def column(entry: Entry, name: str) -> int:
    """Index in the row of a column of an entry that has one row."""
    return STARTS[entry.name] + entry.columns.index(name)


def scan_space(lidar: LidarSpec) -> Box[np.float32]:
    """The space of the entry "scan": metres; a missing return reads as the lidar's range."""
    return Box(0.0, lidar.range_max, (lidar.beams,), np.float32)


def command_space() -> MultiDiscrete:
    """The space of the entry "command": the tokens of `commands.encode`, flat.

    Small integers, so that a flattened observation stays float32.
    """
    sizes = token_space().high.ravel().astype(np.int64) + 1
    return MultiDiscrete(sizes, dtype=np.int16)  # type: ignore[arg-type]
