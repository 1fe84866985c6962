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
from numba import njit
from numpy.typing import NDArray

from semnav_env.commands import MAX_CLAUSES, token_space
from semnav_env.features.frames import FloatArray, Pose, points_to_local
from semnav_env.features.kernels.door_memory import door_counts
from semnav_env.features.kernels.layout import CORNERS, CORRIDORS, DOORS, WALLS
from semnav_env.features.kernels.scratch import Features
from semnav_env.grounding.goal import Goal, GoalKind

FAR = 1000.0
"""Bound of places and distances that have no natural one, metres."""

REACH = 50.0
"""Bound of the places of features, metres."""

N_WALLS, N_DOORS, N_CORNERS, N_CORRIDORS, N_REMEMBERED, N_FELT = 48, 16, 48, 24, 16, 16
"""Rows of each kind of feature; more are left out, in beam order."""

_KINDS = len(GoalKind)
GOAL_SIZE = _KINDS + 4 + 5


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

_STARTS = dict(
    zip(
        (entry.name for entry in ENTRIES),
        accumulate((entry.size for entry in ENTRIES), initial=0),
        strict=False,
    )
)
_WALLS, _DOORS, _CORNERS = _STARTS["walls"], _STARTS["doors"], _STARTS["corners"]
_CORRIDORS, _REMEMBERED = _STARTS["corridors"], _STARTS["remembered_doors"]
_FELT, _REST = _STARTS["felt"], _STARTS["clause"]
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
        if mode not in MODES:
            raise ValueError(f"no observation {mode!r}; there are: {', '.join(MODES)}")
        self.mode = mode
        self.beams = beams
        self.range_max = range_max
        places = {e.name: slice(_STARTS[e.name], _STARTS[e.name] + e.size) for e in ENTRIES}
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


@njit(cache=True, error_model="numpy")
def write_features(
    row: NDArray[np.float32], features: Features, mount: tuple[float, float, float]
) -> None:
    """Write the features of a scan, given in the lidar frame, into the row in the robot frame."""
    c, s = math.cos(mount[2]), math.sin(mount[2])
    row[:_REMEMBERED] = 0.0
    for i in range(min(features.counts[WALLS], N_WALLS)):
        wall = features.walls[i]
        _write_ends(row, _WALLS + 4 * i, wall, mount[0], mount[1], c, s)
        row[_WALLS + 4 * N_WALLS + i] = 1.0
    for i in range(min(features.counts[DOORS], N_DOORS)):
        door = features.doors[i]
        _write_ends(row, _DOORS + 4 * i, door, mount[0], mount[1], c, s)
        row[_DOORS + 4 * N_DOORS + i] = 1.0
    for i in range(min(features.counts[CORNERS], N_CORNERS)):
        corner = features.corners[i]
        row[_CORNERS + 3 * i] = mount[0] + c * corner.x - s * corner.y
        row[_CORNERS + 3 * i + 1] = mount[1] + s * corner.x + c * corner.y
        row[_CORNERS + 3 * i + 2] = corner.kind
        row[_CORNERS + 3 * N_CORNERS + i] = 1.0
    for i in range(min(features.counts[CORRIDORS], N_CORRIDORS)):
        probe = features.corridors[i]
        x, y = 0.5 * (probe.start_x + probe.end_x), 0.5 * (probe.start_y + probe.end_y)
        row[_CORRIDORS + 2 * i] = mount[0] + c * x - s * y
        row[_CORRIDORS + 2 * i + 1] = mount[1] + s * x + c * y
        row[_CORRIDORS + 2 * N_CORRIDORS + i] = 1.0


@njit(cache=True, error_model="numpy")
def write_remembered(
    row: NDArray[np.float32], doors: np.ndarray, used: int, pose: tuple[float, float, float]
) -> None:
    """Write the remembered doors that count, given in the odometry frame, in the robot frame."""
    row[_REMEMBERED:_FELT] = 0.0
    c, s = math.cos(pose[2]), -math.sin(pose[2])
    x, y = -(c * pose[0] - s * pose[1]), -(s * pose[0] + c * pose[1])
    k = 0
    for i in range(used):
        if k < N_REMEMBERED and door_counts(doors[:used], i):
            door = doors[i]
            _write_ends(row, _REMEMBERED + 4 * k, door, x, y, c, s)
            row[_REMEMBERED + 4 * N_REMEMBERED + k] = 1.0
            k += 1


def write_felt(row: NDArray[np.float32], walls: FloatArray, pose: Pose) -> None:
    """Write walls that were felt, given in the odometry frame, in the robot frame, shape (n, 4)."""
    row[_FELT:_REST] = 0.0
    n = min(len(walls), N_FELT)
    row[_FELT : _FELT + 4 * n] = points_to_local(pose, walls[:n].reshape(-1, 2)).ravel()
    row[_FELT + 4 * N_FELT : _FELT + 4 * N_FELT + n] = 1.0


@njit(cache=True, error_model="numpy")
def write_scan(
    row: NDArray[np.float32], ranges: FloatArray, range_min: float, range_max: float
) -> None:
    """Write the ranges, and `range_max` where a beam has no return."""
    for i in range(np.uint64(len(ranges))):  # unsigned, or it is tested for counting from the end
        measured = ranges[i]
        row[i] = measured if (measured >= range_min) & (measured < range_max) else range_max


@njit(cache=True, inline="always")
def _write_ends(
    row: NDArray[np.float32], at: int, item: Any, x: float, y: float, c: float, s: float
) -> None:
    row[at] = x + c * item.start_x - s * item.start_y
    row[at + 1] = y + s * item.start_x + c * item.start_y
    row[at + 2] = x + c * item.end_x - s * item.end_y
    row[at + 3] = y + s * item.end_x + c * item.end_y


@njit(cache=True, error_model="numpy")
def write_state(
    row: NDArray[np.float32],
    active: int,
    odometry: tuple[float, float, float],
    velocity: tuple[float, float, float],
    kind: int,
    goal: tuple[float, float, float],
    door: tuple[float, float, float, float],
    has_door: bool,
) -> None:
    """Write the active clause, the odometry and the goal (given in the odometry frame).

    The odometry is x, y, cosine and sine of the heading, and the velocity forward, left and
    turning. The goal is its kind (one of four), x, y, cosine and sine of its heading, the start
    and end of its door, and whether it has one.
    """
    row[_REST:ROW_SIZE] = 0.0
    if active < MAX_CLAUSES:
        row[_REST + active] = 1.0
    k = _REST + MAX_CLAUSES
    c, s = math.cos(odometry[2]), math.sin(odometry[2])
    row[k], row[k + 1], row[k + 2], row[k + 3] = odometry[0], odometry[1], c, s
    row[k + 4], row[k + 5], row[k + 6] = velocity
    k += 7
    row[k + kind] = 1.0
    k += _KINDS
    row[k], row[k + 1] = _local(goal[0], goal[1], odometry, c, s)
    row[k + 2], row[k + 3] = math.cos(goal[2] - odometry[2]), math.sin(goal[2] - odometry[2])
    if has_door:
        row[k + 4], row[k + 5] = _local(door[0], door[1], odometry, c, s)
        row[k + 6], row[k + 7] = _local(door[2], door[3], odometry, c, s)
        row[k + 8] = 1.0


@njit(cache=True, inline="always")
def _local(
    x: float, y: float, pose: tuple[float, float, float], c: float, s: float
) -> tuple[float, float]:
    dx, dy = x - pose[0], y - pose[1]
    return c * dx + s * dy, c * dy - s * dx


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
        x, y, cosine, sine, *door, has_door = (float(value) for value in values[_KINDS:])
        ends = ((door[0], door[1]), (door[2], door[3])) if has_door > 0.5 else None
        kind = GoalKind(int(np.argmax(values[:_KINDS])))
        return cls(kind, (x, y, math.atan2(sine, cosine)), ends)


_NO_DOOR = (0.0, 0.0, 0.0, 0.0)


def door_ends(goal: Goal) -> tuple[float, float, float, float]:
    """The goal's door as four numbers; zeros if it has none."""
    return _NO_DOOR if goal.door is None else (*goal.door.start, *goal.door.end)
