"""Planning, checking and following joined: what an agent calls at every step."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from semnav_env.agents.planning.follower import Progress, Steering, follow
from semnav_env.agents.planning.free import points_around
from semnav_env.agents.planning.guard import SHARES, safe_share
from semnav_env.agents.planning.nudge import best_nudge, path_clearances
from semnav_env.agents.planning.path import Path, joined
from semnav_env.agents.planning.planner import PlannerSettings, Target, is_free, plan
from semnav_env.agents.planning.track import FollowerSettings, Track
from semnav_env.features.frames import (
    FloatArray,
    Pose,
    compose,
    points_to_parent,
    relative,
)
from semnav_env.robots import RobotSpec

NOTHING: FloatArray = np.empty((0, 2))

STOP = Steering(0.0, 0.0, 0.0, Progress())

NEARLY = 0.3
"""A path that does not lead all the way is planned anew when a metre is left, or this share of a
short one: it must be driven, or nothing would change."""

LOOK = 4.0
"""What is farther away than this does not matter to the next metres of a path, metres."""


@dataclass
class Driver:
    """Drives one robot to targets, planning again when that is needed.

    It plans again when the target moves, an obstacle lies on the path, the robot is off it, or
    the path was only a part of the way and is nearly driven.

    Attributes:
        robot: footprint and limits.
        planner: the planner's settings.
        follower: the follower's settings.
        check_every: steps between two looks whether the path is still free.
        tolerance: metres by which a path may lose clearance before it is planned anew.
        insist_after: how often in a row a steering may be refused before it is let through.
        retry_after: steps to stand still where no way leads on.
        detour: how many times as long a way around barriers may be.
    """

    robot: RobotSpec
    planner: PlannerSettings = field(default_factory=PlannerSettings)
    follower: FollowerSettings = field(default_factory=FollowerSettings)
    check_every: int = 3
    tolerance: float = 0.03
    insist_after: int = 4
    retry_after: int = 8
    detour: float = 1.5

    def __post_init__(self) -> None:
        self.reset()

    def reset(self) -> None:
        """Forget path and target."""
        self.path: Path | None = None
        self.plans = 0
        self._track: Track | None = None
        self._target: Target | None = None
        self._progress = Progress()
        self._shift: Pose = (0.0, 0.0, 0.0)
        self._step = self._wait = 0
        self._braking = False
        self._refusals = 0
        self._heeds_barriers = False

    def drive(
        self,
        points: FloatArray,
        target: Target,
        pose: Pose,
        velocity: tuple[float, float, float] = (0.0, 0.0, 0.0),
        barriers: FloatArray = NOTHING,
    ) -> Steering:
        """The velocities for this step; `done` once the target is reached.

        Args:
            points: obstacle points, metres, shape (N, 2).
            target: where to go, in the frame of the points.
            pose: the centre's pose in that frame.
            velocity: (forward, left, turn) now, m/s and rad/s.
            barriers: points across what is no way to the target's gate, metres, shape (M, 2);
                nothing that one could run into.
        """
        self._step += 1
        self._wait -= 1
        self._braking = self._braking and max(map(abs, velocity)) > 0.05
        if self._braking:
            return STOP
        if self._must_plan(points, target, pose, barriers):
            if self._wait > 0:
                return STOP
            self._plan(points, target, pose, velocity, barriers)
        assert self._track is not None
        steering = follow(self._track, self._progress, relative(self._shift, pose), velocity)
        self._progress = steering.progress
        if steering.deviation > self.follower.lost:
            return self._stop()
        return self._guarded(points, pose, velocity, steering)

    def _stop(self) -> Steering:
        """Brake, and plan anew from standstill."""
        self._track, self._braking = None, True
        return STOP

    def _guarded(
        self,
        points: FloatArray,
        pose: Pose,
        velocity: tuple[float, float, float],
        steering: Steering,
    ) -> Steering:
        """The steering, slowed or refused where it leads into something.

        After `insist_after` refusals in a row it is let through slowly: what is seen may be noise.
        """
        seen = points_around(pose, points, 1.5 * self.robot.length)
        share = safe_share(seen, steering.command, velocity, self.robot)
        if share == 0.0:
            self._refusals += 1
            if self._refusals <= self.insist_after:
                return self._stop()
            share = SHARES[-1]
        elif share == 1.0:
            self._refusals = 0
        if steering.done and self.path is not None and not self.path.complete:
            return STOP
        return steering.slowed(share)

    def _must_plan(
        self, points: FloatArray, target: Target, pose: Pose, barriers: FloatArray
    ) -> bool:
        if self._track is None or self._target is None or self.path is None:
            return True
        if _apart(self._target, target):
            return True
        if not self.path.complete and self._remaining() < min(1.0, NEARLY * self.path.length):
            return True
        if self._step % self.check_every:
            return False
        solid = np.vstack((points, barriers)) if self._heeds_barriers else points
        return not self._stays_free(solid, pose)

    def _plan(
        self,
        points: FloatArray,
        target: Target,
        pose: Pose,
        velocity: tuple[float, float, float],
        barriers: FloatArray,
    ) -> None:
        """Plan from here, or while driving from where the old path allows a stop."""
        kept = self._path_to_stop(points, pose, velocity)
        start = pose if kept is None else kept.end
        self.path = self._path_around(points, start, target, barriers)
        if kept is not None:
            self.path = joined(kept, self.path)
        self.plans += 1
        self._target, self._progress, self._shift = target, Progress(), (0.0, 0.0, 0.0)
        self._track = Track(self.path, self.robot, self.follower)
        if not self.path.complete:
            self._wait = self.retry_after

    def _path_around(
        self, points: FloatArray, start: Pose, target: Target, barriers: FloatArray
    ) -> Path:
        """A path through the target's gate, if it has one; around the barriers, if that helps.

        Without a gate a path leads around them where that is no great `detour`.
        """
        path = plan(points, start, target, self.robot, self.planner)
        self._heeds_barriers = False
        if not len(barriers) or self._is_the_way(path, target, barriers):
            return path
        solid = np.vstack((points, barriers))
        around = plan(solid, start, target, self.robot, self.planner)
        near = target.gate is not None or around.length < self.detour * path.length
        leads = around.complete and near and self._is_the_way(around, target, barriers)
        self._heeds_barriers = leads
        return around if leads else path

    def _is_the_way(self, path: Path, target: Target, barriers: FloatArray) -> bool:
        """Whether a path crosses the target's gate, or without one no barrier."""
        if target.gate is not None:
            return path.crosses(*target.gate)
        return is_free(barriers, path.poses, self.robot)

    def _path_to_stop(
        self, points: FloatArray, pose: Pose, velocity: tuple[float, float, float]
    ) -> Path | None:
        """The stretch of the old path that braking takes, if it is free; None if there is none."""
        speed = math.hypot(velocity[0], velocity[1])
        if self._track is None or self.path is None or speed < 0.1:
            return None
        braking = self.follower.braking * self.robot.max_acceleration
        along, first = self._track.distance, self._progress.sample
        distance = along[first] + speed**2 / (2.0 * braking) + 0.1 * speed
        last = int(np.searchsorted(along, distance))
        if last >= len(along) or last == first:
            return None
        kept = self.path.part(first, last, self._shift)
        return kept if is_free(points, kept.poses, self.robot) else None

    def _remaining(self) -> float:
        assert self._track is not None
        return float(self._track.distance[-1] - self._track.distance[self._progress.sample])

    def _stays_free(self, points: FloatArray, pose: Pose) -> bool:
        """Whether the next metres of the path are free, if need be after a small correction."""
        assert self.path is not None
        seen, margin = points_around(pose, points, LOOK), self.path.margin
        size = (self.robot.length, self.robot.width)
        left, turn, _ = best_nudge(seen, self._ahead(pose, 1.2), *size, margin + 0.005)
        if left or turn:
            shift = compose((0.0, left, turn), relative(pose, self._shift))
            self._shift = compose(pose, shift)
        planned = self.path.clearance[self._samples_ahead(2.5)]
        now = path_clearances(seen, self._ahead(pose, 2.5), *size, margin)
        return bool((now > np.minimum(planned, margin) - self.tolerance).all())

    def _samples_ahead(self, distance: float) -> slice:
        assert self._track is not None
        along, first = self._track.distance, self._progress.sample
        return slice(first, int(np.searchsorted(along, along[first] + distance)) + 1, 2)

    def _ahead(self, pose: Pose, distance: float) -> FloatArray:
        """The centre's poses on the path ahead, about 0.1 m apart, in the robot frame, (M, 3)."""
        assert self.path is not None
        poses = self.path.poses[self._samples_ahead(distance)]
        frame = relative(pose, self._shift)
        places = points_to_parent(frame, poses[:, :2])
        return np.column_stack((places, poses[:, 2] + frame[2]))


def _apart(a: Target, b: Target) -> bool:
    turned = abs(math.remainder(a.pose[2] - b.pose[2], 2 * math.pi))
    heading_matters = b.heading_tolerance is not None and turned > 0.5 * b.heading_tolerance
    return math.dist(a.pose[:2], b.pose[:2]) > 0.5 * b.position_tolerance or heading_matters
