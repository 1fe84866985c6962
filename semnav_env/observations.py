"""What an agent observes: entries of fixed shape, packed into one row per step.

An entry's name, size and bounds stand in one place, so a value and its space cannot drift apart.
Every entry is flat, as stable-baselines3 likes it; `table` gives the rows of a feature. Features
come with masks: row i of `walls` means something where `walls_mask[i]` is 1.
All lengths are in metres; features and the goal are in the robot frame.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import accumulate
from typing import Any

import numpy as np
from gymnasium.spaces import Box, Dict
from numpy.typing import NDArray

from semnav_env.commands import MAX_CLAUSES, token_space
from semnav_env.features.frames import Pose
from semnav_env.grounding.goal import GoalKind
from semnav_env.touch import MOST_PIECES

FAR = 1000.0
"""Bound of places and distances that have no natural one, metres."""

REACH = 50.0
"""Bound of the places of features, metres."""

N_WALLS, N_DOORS, N_CORNERS, N_CORRIDORS, N_REMEMBERED, N_FELT = 48, 16, 48, 24, 16, MOST_PIECES
"""Rows of each kind of feature; more are left out, in beam order."""

KINDS = len(GoalKind)
GOAL_SIZE = KINDS + 4 + 5
"""Of the entry "goal": its kind, its pose, and its door."""


@dataclass(frozen=True)
class Entry:
    """One flat array of the observation; `table` gives its rows.

    Attributes:
        name: its key.
        size: number of values.
        low: smallest value.
        high: largest value.
        columns: values that belong together, as the four of a wall.
    """

    name: str
    size: int
    low: float
    high: float
    columns: int = 1


def _features(name: str, rows: int, columns: int, bound: float) -> tuple[Entry, Entry]:
    table = Entry(name, rows * columns, -bound, bound, columns)
    return table, Entry(f"{name}_mask", rows, 0, 1)


ENTRIES = (
    *_features("walls", N_WALLS, 4, REACH),
    *_features("doors", N_DOORS, 4, REACH),
    *_features("corners", N_CORNERS, 3, REACH),
    *_features("corridors", N_CORRIDORS, 2, REACH),
    *_features("remembered_doors", N_REMEMBERED, 4, FAR),
    *_features("felt", N_FELT, 4, FAR),
    Entry("clause", MAX_CLAUSES, 0, 1),
    Entry("odometry", 7, -FAR, FAR),
    Entry("goal", GOAL_SIZE, -FAR, FAR),
)
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

_FEATURES = tuple(
    entry.name for entry in ENTRIES if entry.name not in ("clause", "odometry", "goal")
)
_SEMANTIC = (*_FEATURES, "command", "clause", "odometry", "goal")
MODES = {
    "semantic": _SEMANTIC,
    "raw": ("scan", "command", "clause", "odometry"),
    "truth": _SEMANTIC,
    "all": ("scan", *_SEMANTIC),
}
"""The entries of each `observation=`."""


class Observer:
    """Packs observations of one mode and knows their space.

    Args:
        mode: "semantic", "raw", "truth" or "all".
        beams: of the lidar.
        range_max: of the lidar, metres; beams without a return read so.

    Raises:
        ValueError: no such mode.
    """

    def __init__(self, mode: str, beams: int, range_max: float) -> None:
        if mode not in tuple(MODES):
            raise ValueError(f"no observation {mode!r:.80}; there are: {', '.join(MODES)}")
        self.mode = mode
        self.beams = beams
        self.range_max = range_max
        places = {e.name: slice(STARTS[e.name], STARTS[e.name] + e.size) for e in ENTRIES}
        places["scan"] = slice(ROW_SIZE, ROW_SIZE + beams)
        self._names = tuple(name for name in MODES[mode] if name != "command")
        self._places = tuple(places[name] for name in self._names)

    @property
    def space(self) -> Dict:
        """The Gymnasium space of what `pack` returns."""
        spaces: dict[str, Box[Any]] = {
            entry.name: Box(entry.low, entry.high, (entry.size,), np.float32) for entry in ENTRIES
        }
        spaces["scan"] = Box(0.0, self.range_max, (self.beams,), np.float32)
        tokens = token_space()
        spaces["command"] = Box(tokens.low.ravel(), tokens.high.ravel(), dtype=np.int64)
        return Dict({name: spaces[name] for name in MODES[self.mode]})

    def pack(self, row: NDArray[np.float32], tokens: NDArray[np.int64]) -> dict[str, NDArray[Any]]:
        """The observation as fresh arrays.

        Args:
            row: `ROW_SIZE` values and, behind them, the scan; shape (ROW_SIZE + beams,).
            tokens: of the command.
        """
        entries = map(row.copy().__getitem__, self._places)
        packed: dict[str, NDArray[Any]] = dict(zip(self._names, entries, strict=True))
        packed["command"] = tokens.ravel().copy()
        return packed


def table(observation: dict[str, NDArray[Any]], name: str) -> NDArray[Any]:
    """The rows of a feature that count, such as walls or doors, shape (n, columns).

    Args:
        observation: of the environment.
        name: "walls", "doors", "corners", "corridors", "remembered_doors" or "felt".

    Raises:
        ValueError: no such feature.
    """
    columns = {entry.name: entry.columns for entry in ENTRIES if entry.columns > 1}
    if name not in columns:
        raise ValueError(f"no feature {name!r}; there are: {', '.join(columns)}")
    rows = observation[name].reshape(-1, columns[name])
    return rows[observation[f"{name}_mask"] > 0.5]


@dataclass(frozen=True)
class SeenGoal:
    """The goal as an observation carries it, robot frame.

    Attributes:
        kind: what reaching it means.
        pose: (x, y, heading), robot frame.
        door: (start, end) of its doorway, robot frame, if it has one.
    """

    kind: GoalKind
    pose: Pose
    door: tuple[tuple[float, float], tuple[float, float]] | None

    @classmethod
    def read(cls, values: NDArray[np.float32]) -> SeenGoal:
        """From the "goal" entry of an observation."""
        x, y, cosine, sine, *door, has_door = (float(value) for value in values[KINDS:])
        ends = ((door[0], door[1]), (door[2], door[3])) if has_door > 0.5 else None
        kind = GoalKind(int(np.argmax(values[:KINDS])))
        return cls(kind, (x, y, math.atan2(sine, cosine)), ends)
