"""What a small network is given of `observation="command"`: one vector for each robot.

The policy keeps a finger on the clause that it takes to be under way. Its last action value moves
the finger on, and the pose at which that happened is the origin of the clause's frame: there doors
and arms are sorted by side and distance, so that "the second door on the right" is a slot of the
vector. Nothing comes from the environment's grounding.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from semnav_agents.hearing.tokens import CLAUSE_SIZE, describe_clauses
from semnav_env.language.tokens import CLAUSE_FEATURES
from semnav_env.mind.observations.layout import JUNCTION_ROWS, REMEMBERED_ROWS

Array = NDArray[np.float32]
Batch = Mapping[str, NDArray[Any]]

DOORS_A_SIDE, NEAR_DOORS, ARMS_A_SIDE, SECTORS = 5, 4, 3, 54
"""Slots: doors of each side of the clause's frame, nearest doors, arms of each side, and sectors of
the scan."""

ASIDE, BEHIND = 4.0, 1.0
"""Doors and arms farther from the axis of the clause's frame, or farther behind its origin, have no
slot, metres."""

AHEAD = (1, 3)
"""Places of a told way that are given, counted from the one nearest to the robot; and the last."""

WORDS = 3 * CLAUSE_SIZE
"""Numbers that say the clause, the one before and the one after."""

DOOR_SIZE, ARM_SIZE, PLACE_SIZE = 7, 8, 2
STATE_SIZE = 3 + 4 + 4 + 4 + 7 + 2
TOLD_SIZE = PLACE_SIZE * (len(AHEAD) + 1) + 1 + 4 + 1
STATE_START = WORDS + (2 * DOORS_A_SIDE + NEAR_DOORS) * DOOR_SIZE + 2 * ARMS_A_SIDE * ARM_SIZE
"""Where the state begins in the vector: with the velocity, three numbers."""

SIZE = STATE_START + STATE_SIZE + TOLD_SIZE + SECTORS
"""Numbers of the vector."""

LARGEST = 10.0
"""Bound of the values; most are between -1 and 1, and amounts of metres are in tens."""

MOST_SECONDS = 20.0
"""Times are given up to this, seconds."""

STANDING = 0.05
"""A slower robot stands, m/s."""


class HeardVectors:
    """Makes the vectors of many robots, and keeps their fingers.

    Args:
        robots: how many there are.
        period: time between two observations, seconds.

    Attributes:
        clause: index of the clause under each finger, shape (n,).
    """

    def __init__(self, robots: int, period: float) -> None:
        self.clause = np.zeros(robots, np.int64)
        self._period = period
        self._begin = np.zeros((robots, 4))
        self._times = np.zeros((robots, 2))
        self._words = np.zeros((robots, WORDS), np.float32)
        self._new = np.ones(robots, bool)

    def forget(self, begun: NDArray[np.bool_]) -> None:
        """Put the fingers of robots that begin an episode on the first clause."""
        self._new |= begun

    def advance(self, moved: NDArray[np.bool_], observations: Batch) -> None:
        """A decision later: move fingers on, at the poses of the observations that gave it."""
        self._times += self._period
        for k in np.flatnonzero(moved).tolist():
            self._start(k, int(self.clause[k]) + 1, observations)

    def observe(self, observations: Batch) -> Array:
        """The vectors, shape (n, SIZE).

        Args:
            observations: with the entries of `observation="command"`, each of shape (n, size).
        """
        for k in np.flatnonzero(self._new).tolist():
            self._start(k, 0, observations)
        self._new[:] = False
        odometry = observations["odometry"].astype(np.float64)
        self._times[np.hypot(*odometry[:, 4:6].T) > STANDING, 1] = 0.0
        frame = _Frames(odometry[:, :4], self._begin)
        parts: tuple[NDArray[Any], ...] = (
            self._words,
            *_doors(observations, frame),
            *_arms(observations, frame),
            self._state(observations, odometry, frame),
            self._told(observations),
            _sectors(observations["scan"]),
        )
        return np.concatenate(parts, axis=1, dtype=np.float32)

    def _start(self, index: int, clause: int, observations: Batch) -> None:
        """Put a finger on a clause, which begins where the robot is."""
        tokens = observations["command"][index].reshape(-1, CLAUSE_FEATURES).astype(np.int64)
        self.clause[index] = clause = min(clause, len(tokens) - 1)
        self._begin[index], self._times[index] = observations["odometry"][index, :4], 0.0
        after = np.zeros(CLAUSE_SIZE, np.float32)
        if clause + 1 < len(tokens):
            after = describe_clauses(tokens, clause + 1)[:CLAUSE_SIZE]
        self._words[index] = np.concatenate((describe_clauses(tokens, clause), after))

    def _state(
        self, observations: Batch, odometry: NDArray[np.float64], frame: _Frames
    ) -> NDArray[np.float64]:
        """Speed, begin of the clause and of the command, the corridor, and times."""
        n = len(odometry)
        here, there = frame.to_begin(np.zeros((n, 1, 2))), frame.from_begin(np.zeros((n, 1, 2)))
        turned = frame.turned()
        hallway = observations["hallway"].astype(np.float64)
        start = observations["start"].astype(np.float64)
        columns: tuple[NDArray[np.float64], ...] = (
            odometry[:, 4:7],
            _squash(here[:, 0]),
            turned,
            _squash(there[:, 0]),
            turned * np.array((1.0, -1.0)),
            _squash(start[:, :2]),
            start[:, 2:],
            _squash(hallway[:, :2]),
            hallway[:, 2:4],
            _squash(hallway[:, 4:6]),
            hallway[:, 6:],
            np.minimum(self._times, MOST_SECONDS) / MOST_SECONDS,
        )
        return np.concatenate(columns, axis=1)

    def _told(self, observations: Batch) -> NDArray[np.float64]:
        """Places of the told way of the clause, and the door at its end."""
        n = len(self.clause)
        ways = observations["told_ways"].reshape(n, -1, 3)
        doors = observations["told_doors"].reshape(n, -1, 5)
        told = np.zeros((n, TOLD_SIZE))
        counts = observations["told_ways_mask"] * (ways[..., 0] == self.clause[:, None]) > 0
        for k in np.flatnonzero(counts.any(axis=1)).tolist():
            places = ways[k, counts[k], 1:].astype(np.float64)
            nearest = int(np.hypot(*places.T).argmin())
            chosen = [min(nearest + ahead, len(places) - 1) for ahead in AHEAD]
            row = [*_squash(places[[*chosen, -1]]).ravel(), 1.0]
            told[k, : len(row)] = row
        found = observations["told_doors_mask"] * (doors[..., 0] == self.clause[:, None]) > 0
        for k in np.flatnonzero(found.any(axis=1)).tolist():
            told[k, -5:] = [*_squash(doors[k, found[k].argmax(), 1:]), 1.0]
        return told


class _Frames:
    """The robot frames and the frames in which clauses began.

    Args:
        pose: of the robots, odom frame: x, y, cosine, sine; shape (n, 4).
        begin: where their clauses began, the same.
    """

    def __init__(self, pose: NDArray[np.float64], begin: NDArray[np.float64]) -> None:
        self._pose, self._begin = pose, begin

    def to_begin(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Points of the robot frame in the clause's frame, shape (n, m, 2)."""
        return _to_local(self._begin, _to_parent(self._pose, points))

    def from_begin(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """The other way round."""
        return _to_local(self._pose, _to_parent(self._begin, points))

    def turned(self) -> NDArray[np.float64]:
        """Cosine and sine of the robot's heading in the clause's frame, shape (n, 2)."""
        return _to_local(self._begin * (0, 0, 1, 1), self._pose[:, None, 2:])[:, 0]


def _to_parent(frame: NDArray[np.float64], points: NDArray[np.float64]) -> NDArray[np.float64]:
    x, y, c, s = frame.T[..., None]
    moved = (
        x + c * points[..., 0] - s * points[..., 1],
        y + s * points[..., 0] + c * points[..., 1],
    )
    return np.stack(moved, axis=2)


def _to_local(frame: NDArray[np.float64], points: NDArray[np.float64]) -> NDArray[np.float64]:
    x, y, c, s = frame.T[..., None]
    dx, dy = points[..., 0] - x, points[..., 1] - y
    return np.stack((c * dx + s * dy, c * dy - s * dx), axis=2)


def _doors(observations: Batch, frame: _Frames) -> list[NDArray[np.float64]]:
    """Slots of remembered doors: of both sides by distance along the axis, and the nearest."""
    n = len(observations["command"])
    jambs = observations["remembered_doors"].reshape(n, REMEMBERED_ROWS, 4).astype(np.float64)
    middles = (jambs[..., :2] + jambs[..., 2:]) / 2
    placed = frame.to_begin(middles)
    counts = observations["remembered_doors_mask"] > 0
    rows = np.concatenate((_squash(jambs), _squash(placed), counts[..., None]), axis=2)
    slots = [_slots(rows, _along(placed, counts, side), DOORS_A_SIDE) for side in (1, -1)]
    near = np.where(counts, np.hypot(middles[..., 0], middles[..., 1]), np.inf)
    return [*slots, _slots(rows, near, NEAR_DOORS)]


def _arms(observations: Batch, frame: _Frames) -> list[NDArray[np.float64]]:
    """Slots of the arms of both sides."""
    n = len(observations["command"])
    arms = observations["junctions"].reshape(n, JUNCTION_ROWS, 6).astype(np.float64)
    placed = frame.to_begin((arms[..., :2] + arms[..., 2:4]) / 2)
    counts = observations["junctions_mask"] > 0
    rows = (_squash(arms[..., :4]), _squash(placed), arms[..., 5:], counts[..., None])
    joined = np.concatenate(rows, axis=2)
    return [_slots(joined, _along(placed, counts, side), ARMS_A_SIDE) for side in (1, -1)]


def _along(
    placed: NDArray[np.float64], counts: NDArray[np.bool_], side: int
) -> NDArray[np.float64]:
    """Distance along the axis of what has a slot on a side; infinite for the rest."""
    x, y = placed[..., 0], placed[..., 1] * side
    return np.where(counts & (y > 0) & (y < ASIDE) & (x > -BEHIND), x, np.inf)


def _slots(rows: NDArray[np.float64], keys: NDArray[np.float64], count: int) -> NDArray[np.float64]:
    """The rows with the smallest keys; zeros where keys are infinite. Shape (n, count * size)."""
    order = np.argsort(keys, axis=1, kind="stable")[:, :count]
    chosen = np.take_along_axis(rows, order[..., None], axis=1)
    known = np.isfinite(np.take_along_axis(keys, order, axis=1))
    return (chosen * known[..., None]).reshape(len(rows), -1)


def _sectors(scan: NDArray[np.float32]) -> NDArray[np.float64]:
    """The shortest range of each sector."""
    starts = np.linspace(0, scan.shape[1], SECTORS, endpoint=False).astype(int)
    return _squash(np.minimum.reduceat(scan, starts, axis=1).astype(np.float64))


def _squash(values: NDArray[Any]) -> NDArray[Any]:
    """Squashed by x / (1 + x): the direction is kept, and near things are resolved finely."""
    squashed: NDArray[Any] = values / (1.0 + np.abs(values))
    return squashed
