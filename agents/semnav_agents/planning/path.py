"""A planned path: moves of the axle, and the poses of the centre along them."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from semnav_agents.planning.motion import REVERSE, kind_of, move_at, moved
from semnav_features.frames import FloatArray, Point, Pose, compose, points_to_local
from semnav_features.kernels.compiling import kernel

SAMPLE_DISTANCE = 0.04
"""Largest distance between samples of a path, metres."""

MAX_CLEARANCE = 0.35
"""Largest clearance that is measured, metres; more makes no difference to how a path is driven."""

SAMPLE_ANGLE = 0.05
"""Largest angle between samples of a path, radians."""


@dataclass(frozen=True, eq=False)
class PlannedPath:
    """Moves of a robot one after the other; it stops where their kind changes.

    Attributes:
        start: the centre's first pose.
        moves: rows as `motion.Move`, shape (K, 3).
        axle: x of the axle in the robot frame, metres.
        complete: whether it reaches the target; otherwise it leads as near as was found.
        margin: distance that the search kept from obstacles, metres.
        clearance: distance to the nearest obstacle at the samples, metres, at most
            `MAX_CLEARANCE`, shape (M,).
        expansions: number of states that the search expanded.
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
        return sampled(compose(self.start, (self.axle, 0.0, 0.0)), self.moves)

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
        """Index of the move from each sample to the next, shape (M - 1,)."""
        return self._samples[2]

    @cached_property
    def length(self) -> float:
        """Distance that the axle travels, metres."""
        return float(np.hypot(self.moves[:, 0], self.moves[:, 1]).sum())

    @property
    def backs(self) -> bool:
        """Whether a part of it is driven backwards."""
        return bool((self.kinds == REVERSE).any())

    def part(self, first: int, last: int, frame: Pose) -> PlannedPath:
        """The stretch between two samples.

        Args:
            first: its first sample.
            last: its last sample.
            frame: pose of the frame of this path; the stretch lies in the parent frame.
        """
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


@kernel
def sampled(
    start: Pose, moves: FloatArray
) -> tuple[FloatArray, NDArray[np.int64], NDArray[np.int64]]:
    """Axle poses along the moves, (M, 3), and the kind and the index of the move between two."""
    counts = np.empty(len(moves), dtype=np.int64)
    for k in range(len(moves)):
        travel = np.hypot(moves[k, 0], moves[k, 1])
        counts[k] = max(
            1, np.ceil(max(travel / SAMPLE_DISTANCE, abs(moves[k, 2]) / SAMPLE_ANGLE) - 1e-6)
        )
    total = counts.sum()
    poses, kinds = np.empty((total + 1, 3)), np.empty(total, dtype=np.int64)
    index = np.empty(total, dtype=np.int64)
    poses[0] = start
    pose, n = start, 0
    for k in range(len(moves)):
        move = move_at(moves, k)
        for step in range(1, counts[k] + 1):
            poses[n + 1] = moved(pose[0], pose[1], pose[2], move, step / counts[k])
            kinds[n], index[n] = kind_of(move), k
            n += 1
        pose = moved(pose[0], pose[1], pose[2], move)
    return poses, kinds, index


def joined(first: PlannedPath, then: PlannedPath) -> PlannedPath:
    """The two paths as one; the second must start where the first ends."""
    return replace(
        then,
        start=first.start,
        moves=np.concatenate((first.moves, then.moves)),
        clearance=np.concatenate((first.clearance, then.clearance[1:])),
    )
