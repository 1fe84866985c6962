"""The layout of the observation, declared once.

Name, shape, bounds, unit and meaning of every entry stand here. The spaces, the offsets that the
kernels write at, the reader of the goal and the table of the documentation all come from it.
Every entry is one flat array, as stable-baselines3 likes it.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import accumulate

import numpy as np
from gymnasium.spaces import Box

from semnav_env.belief.bump_limits import MOST_PIECES
from semnav_env.commands import MAX_CLAUSES, token_space
from semnav_env.features.lidar_spec import LidarSpec
from semnav_env.grounding.goal import GoalKind

UNBOUNDED = 1000.0
"""Bound of places and distances that have no natural one, metres."""

FEATURE_BOUND = 50.0
"""Bound of the places of features, metres: beyond the range of indoor lidars."""

WALL_ROWS, DOOR_ROWS, CORNER_ROWS, PROBE_ROWS = 48, 16, 48, 24
"""Rows of each kind of feature of a scan; more are left out, in beam order."""

REMEMBERED_ROWS, BUMP_ROWS = 16, MOST_PIECES
"""Rows of remembered doors and of walls that were bumped into."""

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
        unit: of the values; empty where they have none.
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
        "jambs of the remembered doors that count: as a rule from their second sighting",
    ),
    _table(
        "bumps",
        BUMP_ROWS,
        ENDS,
        UNBOUNDED,
        "ends of walls that the robot has bumped into unseen, such as glass",
    ),
)
"""Features; a row counts where its mask is 1."""

CLAUSE = Entry(
    "clause",
    tuple(f"clause_{i}" for i in range(MAX_CLAUSES)),
    0.0,
    1.0,
    "",
    "one-hot: the clause that the robot believes to be under way",
)
ODOMETRY = Entry(
    "odometry",
    ("x", "y", "cosine", "sine", "forward", "left", "yaw_rate"),
    -UNBOUNDED,
    UNBOUNDED,
    "m, m/s, rad/s",
    "believed pose, seen from the start, and velocity of the robot",
)
GOAL = Entry(
    "goal",
    (*GOAL_KINDS, "x", "y", "cosine", "sine", *(f"door_{end}" for end in ENDS), "has_door"),
    -UNBOUNDED,
    UNBOUNDED,
    "m",
    "one-hot kind of where to drive now, its pose, and the jambs of its door: `Belief.target`, "
    "which is the goal of the clause, or a place on the way while the way to a named room is "
    "long. The pose of a pass goal lies behind its door and heads away from it",
)

ENTRIES = (*(part for table in TABLES for part in (table, table.mask)), CLAUSE, ODOMETRY, GOAL)
"""Everything but the scan and the command's tokens, in the order of the row."""

STARTS = dict(
    zip(
        (entry.name for entry in ENTRIES),
        accumulate((entry.size for entry in ENTRIES), initial=0),
        strict=False,
    )
)
"""Where in the row each entry begins."""

ROW_SIZE = sum(entry.size for entry in ENTRIES)
"""Values of the row before the scan."""

_FEATURES = tuple(part.name for table in TABLES for part in (table, table.mask))
_SEMANTIC = (*_FEATURES, "command", "clause", "odometry", "goal")

MODES = {
    "semantic": _SEMANTIC,
    "raw": ("scan", "command", "clause", "odometry"),
    "truth": _SEMANTIC,
    "all": ("scan", *_SEMANTIC),
}
"""The entries of each `observation=`."""


def column(entry: Entry, name: str) -> int:
    """Where in the row a column of an entry of one row lies."""
    return STARTS[entry.name] + entry.columns.index(name)


def scan_space(lidar: LidarSpec) -> Box[np.float32]:
    """The space of the entry "scan": ranges in metres; no return reads as the lidar's range."""
    return Box(0.0, lidar.range_max, (lidar.beams,), np.float32)


def command_space() -> Box[np.int64]:
    """The space of the entry "command": the tokens of `commands.encode`, flat."""
    tokens = token_space()
    return Box(tokens.low.ravel(), tokens.high.ravel(), dtype=np.int64)
