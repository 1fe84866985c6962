"""A path made ready to be followed: legs between stops, and how fast to drive where."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from semnav_env.agents.planning.motion import TURN
from semnav_env.agents.planning.path import Path
from semnav_env.features.frames import FloatArray
from semnav_env.robots import RobotSpec


@dataclass(frozen=True)
class FollowerSettings:
    """Speeds and gains of the path follower.

    Attributes:
        cruise: m/s where there is room.
        creep: m/s at least, where the path is crowded or the robot is off it.
        sideways: m/s at most.
        crowded: m/s that are added for each metre of clearance.
        turn_rate: rad/s, on the spot and along arcs.
        crowded_turn: rad/s along arcs without clearance.
        braking: share of the acceleration limit that stops are planned with.
        stiffness: 1/m; errors die out over about the inverse of this distance.
        preview: seconds by which the curvature is looked up ahead.
        small_turn: radians; turns on the spot below this are driven through without a stop.
        done_distance: metres before a leg's end at which it counts as driven.
        done_angle: radians, the same for a turn.
        lost: metres off the path at which to plan again.
        lost_at_turn: the same, where the robot stands to turn.
    """

    cruise: float = 1.1
    creep: float = 0.12
    sideways: float = 0.3
    crowded: float = 3.0
    turn_rate: float = 1.0
    crowded_turn: float = 0.4
    braking: float = 0.6
    stiffness: float = 2.5
    preview: float = 0.2
    small_turn: float = 0.06
    done_distance: float = 0.015
    done_angle: float = 0.02
    lost: float = 0.12
    lost_at_turn: float = 0.06


class Leg(NamedTuple):
    """Samples `first` to `last` of one kind of motion."""

    kind: int
    first: int
    last: int


@dataclass(frozen=True, eq=False)
class Track:
    """A path, for one robot, with legs and speeds worked out once."""

    path: Path
    robot: RobotSpec
    settings: FollowerSettings = FollowerSettings()

    @cached_property
    def legs(self) -> tuple[Leg, ...]:
        """Runs of one kind of motion; small turns belong to the leg before or after."""
        kinds = self._kinds
        cuts = [0, *(np.flatnonzero(np.diff(kinds)) + 1).tolist(), len(kinds)]
        pairs = itertools.pairwise(cuts)
        return tuple(Leg(int(kinds[a]), a, b) for a, b in pairs if b > a)

    @cached_property
    def distance(self) -> FloatArray:
        """Metres travelled by the axle up to each sample, shape (M,)."""
        steps = np.diff(self.path.axle_poses[:, :2], axis=0)
        return np.concatenate(([0.0], np.cumsum(np.hypot(steps[:, 0], steps[:, 1]))))

    @cached_property
    def curvature(self) -> FloatArray:
        """Turn per metre forward of the step after each sample, 1/m, shape (M - 1,)."""
        moves = self.path.moves
        straight = np.abs(moves[:, 0]) < 1e-9
        per_metre = np.where(straight, 0.0, moves[:, 2] / np.where(straight, 1.0, moves[:, 0]))
        return per_metre[self.path.move_of]

    @cached_property
    def speed(self) -> FloatArray:
        """m/s at each sample, zero at the ends of legs, shape (M,)."""
        s = self.settings
        limit = np.clip(s.creep + s.crowded * self.path.clearance, 0.25, s.cruise)
        bend = np.abs(self.curvature)
        rate = np.clip(
            s.crowded_turn + s.crowded * self.path.clearance, s.crowded_turn, s.turn_rate
        )
        limit[:-1] = np.minimum(limit[:-1], rate[:-1] / np.maximum(bend, 1e-6))
        limit[1:] = np.minimum(limit[1:], rate[1:] / np.maximum(bend, 1e-6))
        for leg in self.legs:
            limit[leg.last] = 0.0
        braking = s.braking * self.robot.max_acceleration
        for k in range(len(limit) - 2, -1, -1):
            step = self.distance[k + 1] - self.distance[k]
            limit[k] = min(limit[k], math.sqrt(limit[k + 1] ** 2 + 2.0 * braking * step))
        return limit

    @property
    def _kinds(self) -> np.ndarray:
        kinds, moves = self.path.kinds.copy(), self.path.move_of
        for k in range(len(self.path.moves)):
            at = np.flatnonzero(moves == k)
            if kinds[at[0]] == TURN and abs(self.path.moves[k, 2]) < self.settings.small_turn:
                neighbour = at[0] - 1 if at[0] > 0 else at[-1] + 1
                if neighbour < len(kinds):
                    kinds[at] = kinds[neighbour]
        return kinds
