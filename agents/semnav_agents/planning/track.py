"""A path prepared for the follower: its legs between stops, and its speed profile."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Annotated, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from semnav_agents.planning.motion import REVERSE, TURN
from semnav_agents.planning.path import PlannedPath
from semnav_agents.planning.path_ahead import PathAhead
from semnav_env.language.clauses import Speed
from semnav_env.robots import RobotSpec
from semnav_features.checked_fields import Bounds, check_fields
from semnav_features.frames import FloatArray, distances_along
from semnav_features.kernels.compiling import kernel

SLOW_SHARE = 0.5
"""Share of the usual largest speeds at which a robot drives slowly."""

Gain: TypeAlias = Annotated[float, Bounds(0.0, 1000.0)]


@dataclass(frozen=True)
class FollowerSettings:
    """Speeds and gains of the path follower.

    Attributes:
        cruise: speed where there is room, m/s.
        creep: smallest speed, where the path is crowded or the robot is off it, m/s.
        reverse: largest speed backwards, where a lidar at the front sees little, m/s.
        sideways: largest sideways speed, m/s.
        crowded: speed that is added for each metre of clearance, m/s.
        turn_rate: largest yaw rate on the spot and along arcs, rad/s.
        crowded_turn: largest yaw rate along arcs without clearance, rad/s.
        braking: share of the acceleration limit with which stops are planned.
        stiffness: inverse of the distance over which errors die out, 1/m.
        preview: time by which the curvature is looked up ahead, seconds.
        small_turn: angle below which a turn on the spot is driven without a stop, radians.
        done_distance: distance before the end of a leg at which it counts as driven, metres.
        done_angle: angle before the end of a turn at which it counts as driven, radians.
        lost: distance from the path at which to plan again, metres.
        lost_at_turn: the same where the robot stands to turn, metres.
    """

    cruise: Gain = 1.1
    creep: Gain = 0.12
    reverse: Gain = 0.35
    sideways: Gain = 0.3
    crowded: Gain = 3.0
    turn_rate: Gain = 1.0
    crowded_turn: Gain = 0.4
    braking: Gain = 0.6
    stiffness: Gain = 2.5
    preview: Gain = 0.2
    small_turn: Gain = 0.06
    done_distance: Gain = 0.015
    done_angle: Gain = 0.02
    lost: Gain = 0.12
    lost_at_turn: Gain = 0.06

    def __post_init__(self) -> None:
        check_fields(self)

    def at(self, pace: Speed | None, robot: RobotSpec) -> FollowerSettings:
        """The settings at a pace; None is the usual one.

        Slow is `SLOW_SHARE` of the largest speeds and yaw rate; fast is the body's largest speed
        forwards, where there is as much room as the usual one needs.
        """
        if pace is Speed.SLOW:
            names = ("cruise", "reverse", "sideways", "turn_rate", "crowded_turn")
            return replace(self, **{each: SLOW_SHARE * getattr(self, each) for each in names})
        if pace is Speed.FAST:
            faster = max(1.0, robot.max_speed / self.cruise)
            return replace(self, cruise=faster * self.cruise, crowded=faster * self.crowded)
        return self


class PathLeg(NamedTuple):
    """A part of a path with one kind of motion: its samples from `first` to `last`."""

    kind: int
    first: int
    last: int


class TrackArrays(NamedTuple):
    """A `PathTrack` of M samples and L legs, as kernels take it.

    Attributes:
        poses: of the axle at the samples, (M, 3).
        distance: travelled up to each sample, metres, (M,).
        curvature: of the step after each sample, 1/m, (M - 1,).
        speed: at each sample, m/s, (M,).
        left: part to the left of the move after each sample, metres, (M - 1,).
        legs: rows as `PathLeg`, (L, 3).
    """

    poses: FloatArray
    distance: FloatArray
    curvature: FloatArray
    speed: FloatArray
    left: FloatArray
    legs: NDArray[np.int64]


class FollowerLimits(NamedTuple):
    """Those of `FollowerSettings` and of the robot that decide how a path is followed.

    Attributes:
        braking: deceleration with which stops are planned, m/s^2.
        turn_braking: the same of turns on the spot, rad/s^2.
        max_acceleration: of the robot, m/s^2.
        axle: x of the robot's axle in its frame, metres.
        holonomic: whether the robot can move sideways.
    """

    creep: float
    sideways: float
    turn_rate: float
    stiffness: float
    preview: float
    done_distance: float
    done_angle: float
    lost: float
    lost_at_turn: float
    braking: float
    turn_braking: float
    max_acceleration: float
    axle: float
    holonomic: bool


@dataclass(frozen=True, eq=False)
class PathTrack:
    """A path for one robot, with legs and speeds that are computed once."""

    path: PlannedPath
    robot: RobotSpec
    settings: FollowerSettings = FollowerSettings()

    @cached_property
    def legs(self) -> tuple[PathLeg, ...]:
        """Parts of one kind of motion; a small turn belongs to the leg before or after it."""
        kinds = self._kinds
        cuts = [0, *(np.flatnonzero(np.diff(kinds)) + 1).tolist(), len(kinds)]
        pairs = itertools.pairwise(cuts)
        return tuple(PathLeg(int(kinds[a]), a, b) for a, b in pairs if b > a)

    @cached_property
    def distance(self) -> FloatArray:
        """Distance travelled by the axle up to each sample, metres, shape (M,)."""
        return distances_along(self.path.axle_poses[:, :2])

    @cached_property
    def curvature(self) -> FloatArray:
        """Curvature of the step after each sample, 1/m, shape (M - 1,)."""
        moves = self.path.moves
        straight = np.abs(moves[:, 0]) < 1e-9
        per_metre = np.where(straight, 0.0, moves[:, 2] / np.where(straight, 1.0, moves[:, 0]))
        return per_metre[self.path.move_of]

    @cached_property
    def speed(self) -> FloatArray:
        """Speed at each sample, m/s, zero at the ends of legs, shape (M,)."""
        s = self.settings
        limit = np.clip(s.creep + s.crowded * self.path.clearance, 0.25, s.cruise)
        bend = np.abs(self.curvature)
        rate = np.clip(
            s.crowded_turn + s.crowded * self.path.clearance, s.crowded_turn, s.turn_rate
        )
        limit[:-1] = np.minimum(limit[:-1], rate[:-1] / np.maximum(bend, 1e-6))
        limit[1:] = np.minimum(limit[1:], rate[1:] / np.maximum(bend, 1e-6))
        for leg in self.legs:
            if leg.kind == REVERSE:
                span = slice(leg.first, leg.last + 1)
                limit[span] = np.minimum(limit[span], s.reverse)
            limit[leg.last] = 0.0
        _brake_in_time(limit, self.distance, s.braking * self.robot.max_acceleration)
        return limit

    @cached_property
    def arrays(self) -> TrackArrays:
        """What the follower needs to know of the path."""
        legs = np.array([tuple(leg) for leg in self.legs], np.int64).reshape(-1, 3)
        left = self.path.moves[self.path.move_of, 1]
        profile = self.distance, self.curvature, self.speed
        return TrackArrays(self.path.axle_poses, *profile, left, legs)

    @cached_property
    def limits(self) -> FollowerLimits:
        """What the follower needs to know of the settings and the robot."""
        s, robot = self.settings, self.robot
        return FollowerLimits(
            creep=float(s.creep),
            sideways=float(s.sideways),
            turn_rate=float(s.turn_rate),
            stiffness=float(s.stiffness),
            preview=float(s.preview),
            done_distance=float(s.done_distance),
            done_angle=float(s.done_angle),
            lost=float(s.lost),
            lost_at_turn=float(s.lost_at_turn),
            braking=float(s.braking * robot.max_acceleration),
            turn_braking=float(s.braking * robot.max_turn_acceleration),
            max_acceleration=float(robot.max_acceleration),
            axle=float(robot.axle),
            holonomic=bool(robot.holonomic),
        )

    def ahead(self, sample: int) -> PathAhead:
        """The path from a sample on."""
        path, robot = self.path, self.robot
        arrays, lengths = (path.poses, self.distance, path.clearance), (path.margin, path.length)
        sizes = *lengths, robot.length, robot.width
        return PathAhead(*arrays, sample, *map(float, sizes))

    @property
    def _kinds(self) -> NDArray[np.int64]:
        """Kind of motion of each step, small turns counted as what they lie beside."""
        kinds = self.path.kinds.copy()
        _join_small_turns(kinds, self.path.move_of, self.path.moves, self.settings.small_turn)
        return kinds


@kernel
def _brake_in_time(limit: FloatArray, distance: FloatArray, braking: float) -> None:
    """Lower the speed at each sample, m/s, so that braking suffices for the samples behind it."""
    for k in range(len(limit) - 2, -1, -1):
        step = distance[k + 1] - distance[k]
        limit[k] = min(limit[k], math.sqrt(limit[k + 1] ** 2 + 2.0 * braking * step))


@kernel
def _join_small_turns(
    kinds: NDArray[np.int64], move_of: NDArray[np.int64], moves: FloatArray, small: float
) -> None:
    """Count the steps of turns below `small` radians as what lies before them, or else behind."""
    first = 0
    while first < len(kinds):
        move, behind = move_of[first], first
        while behind < len(kinds) and move_of[behind] == move:
            behind += 1
        if kinds[first] == TURN and abs(moves[move, 2]) < small:
            neighbour = first - 1 if first > 0 else behind
            if neighbour < len(kinds):
                kinds[first:behind] = kinds[neighbour]
        first = behind
