"""A path for the axle, and its poses for the centre."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numba import njit
from numpy.typing import NDArray

from semnav_env.agents.planning.motion import kind_of, moved
from semnav_env.features.frames import FloatArray, Point, Pose, compose, points_to_local

SPACING = 0.04
"""Metres between the samples of a path."""

MOST_CLEARANCE = 0.35
"""Metres; more makes no difference to how a path is driven."""

TURN_SPACING = 0.05
"""Radians between the samples of a path."""


@dataclass(frozen=True, eq=False)
class Path:
    """Moves one after the other; the robot stops where their kind changes.

    Attributes:
        start: the centre's first pose.
        moves: (forward, left, turn) of the axle, metres and radians, shape (K, 3).
        axle: x of the axle in the robot frame, metres.
        complete: whether it reaches the target; else it comes as near as was found.
        margin: metres that the search kept clear.
        clearance: distance to the nearest obstacle at the samples, metres, at most
            `MOST_CLEARANCE`, shape (M,).
        expansions: how many states the search looked at.
    """

    start: Pose
    moves: FloatArray
    axle: float
    complete: bool
    margin: float
    clearance: FloatArray
    expansions: int = 0

    @cached_property
    def _samples(self) -> tuple[FloatArray, NDArray[np.int64], NDArray[np.int64]]:
        return sample(compose(self.start, (self.axle, 0.0, 0.0)), self.moves)

    @property
    def axle_poses(self) -> FloatArray:
        """Samples, shape (M, 3); headings are continuous, not wrapped."""
        return self._samples[0]

    @cached_property
    def poses(self) -> FloatArray:
        """The centre's poses at the samples, shape (M, 3)."""
        x, y, heading = self.axle_poses.T
        return np.stack(
            (x - self.axle * np.cos(heading), y - self.axle * np.sin(heading), heading), axis=1
        )

    @property
    def kinds(self) -> NDArray[np.int64]:
        """Kind of motion from each sample to the next, shape (M - 1,)."""
        return self._samples[1]

    @property
    def move_of(self) -> NDArray[np.int64]:
        """Which move leads from each sample to the next, shape (M - 1,)."""
        return self._samples[2]

    @property
    def length(self) -> float:
        """Metres that the axle travels."""
        return float(np.hypot(self.moves[:, 0], self.moves[:, 1]).sum())

    def part(self, first: int, last: int, frame: Pose) -> Path:
        """The stretch between two samples, in the parent of `frame`, in which this path lies."""
        shares = np.bincount(self.move_of, minlength=len(self.moves))
        index = self.move_of[first:last]
        x, y, heading = self.poses[first].tolist()
        return replace(
            self,
            start=compose(frame, (x, y, heading)),
            moves=self.moves[index] / shares[index, None],
            complete=False,
            clearance=self.clearance[first : last + 1],
        )

    def crosses(self, a: Point, b: Point) -> bool:
        """Whether the centre crosses the line from point `a` to point `b`."""
        line = (*a, math.atan2(b[1] - a[1], b[0] - a[0]))
        x, y = points_to_local(line, self.poses[:, :2]).T
        k = np.flatnonzero((y[:-1] > 0.0) != (y[1:] > 0.0))
        at = x[k] + (x[k + 1] - x[k]) * y[k] / (y[k] - y[k + 1])
        return bool(((at > 0.0) & (at < math.dist(a, b))).any())

    @property
    def end(self) -> Pose:
        """The centre's last pose."""
        x, y, heading = self.poses[-1].tolist()
        return x, y, heading


@njit(cache=True)
def sample(
    start: Pose, moves: FloatArray
) -> tuple[FloatArray, NDArray[np.int64], NDArray[np.int64]]:
    """Axle poses along the moves, (M, 3), and the kind and index of the move between two."""
    counts = np.empty(len(moves), dtype=np.int64)
    for k in range(len(moves)):
        travel = np.hypot(moves[k, 0], moves[k, 1])
        counts[k] = max(1, np.ceil(max(travel / SPACING, abs(moves[k, 2]) / TURN_SPACING) - 1e-6))
    total = counts.sum()
    poses, kinds = np.empty((total + 1, 3)), np.empty(total, dtype=np.int64)
    index = np.empty(total, dtype=np.int64)
    poses[0] = start
    pose, n = start, 0
    for k in range(len(moves)):
        move = (moves[k, 0], moves[k, 1], moves[k, 2])
        for step in range(1, counts[k] + 1):
            poses[n + 1] = moved(pose[0], pose[1], pose[2], move, step / counts[k])
            kinds[n], index[n] = kind_of(move), k
            n += 1
        pose = moved(pose[0], pose[1], pose[2], move)
    return poses, kinds, index


def joined(first: Path, then: Path) -> Path:
    """One path of two, the second of which starts where the first ends."""
    return replace(
        then,
        start=first.start,
        moves=np.concatenate((first.moves, then.moves)),
        clearance=np.concatenate((first.clearance, then.clearance[1:])),
    )
