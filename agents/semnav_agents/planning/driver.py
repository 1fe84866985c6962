"""Drives a robot to a target: plans, checks and follows, one call for each step."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from semnav_agents.planning.aim import is_outdated
from semnav_agents.planning.barriers import BarrierPlanner
from semnav_agents.planning.cruise import fits, put_body, put_path
from semnav_agents.planning.follower import PathProgress, Steering, follow
from semnav_agents.planning.free import points_around
from semnav_agents.planning.guard import GUARD_REACH, SPEED_SHARES, GuardedBody, safe_share
from semnav_agents.planning.known_obstacles import (
    NO_POINTS,
    JoinedObstacles,
    Obstacles,
    as_obstacles,
)
from semnav_agents.planning.path import PlannedPath, joined
from semnav_agents.planning.path_ahead import PathAhead, is_nearly_driven, poses_ahead, stays_free
from semnav_agents.planning.planner import DriveTarget, PlannerSettings, is_free
from semnav_agents.planning.track import FollowerSettings, PathTrack
from semnav_agents.planning.yielding import (
    BACKING_SPEED,
    INSISTING_SHARE,
    Yielding,
    yield_distance,
)
from semnav_env.language.clauses import Speed
from semnav_env.mind.observations.pace_entry import PACES
from semnav_env.robots import RobotSpec
from semnav_features.frames import ORIGIN, FloatArray, Pose, Twist, relative

STANDSTILL = Steering(0.0, 0.0, 0.0, PathProgress())
"""Velocity zero: stand still, or brake."""

NO_POSES: FloatArray = np.empty((0, 3))

LOOKAHEAD = 4.0
"""Distance beyond which obstacles do not matter to the next metres of a path, metres."""

EVASION_LENGTH = 1.5
"""Length by which a path around what moves may exceed what `detour` allows, metres: the robot may
have to get clear first."""

REVERSE_AMONG_PEOPLE = 8.0
"""`PlannerSettings.reverse` among people: whoever walks behind a robot is not seen."""


@dataclass
class Driver:
    """Drives one robot to targets, and plans again when needed.

    It plans again when the target moves, when an obstacle lies on the path, when the robot is off
    the path, and when a path that led only part of the way is nearly driven. For what moves it
    waits; only if that does not go away it plans around it, by a short way; in a jam it creeps on,
    or backs off. Among people it passes no barrier.

    Attributes:
        robot: footprint and limits.
        planner: the planner's settings.
        follower: the follower's settings.
        check_every: steps between two checks whether the path is still free.
        tolerance: loss of clearance at which a path is planned again, metres.
        insist_after: number of refusals in a row after which a steering is allowed.
        retry_after: steps to stand still where there is no path.
        detour: largest length of a path around barriers, as a multiple of the direct path.
        patience: steps to wait for what moves; and for what leaves no way but through a barrier.
    """

    robot: RobotSpec
    planner: PlannerSettings = field(default_factory=PlannerSettings)
    follower: FollowerSettings = field(default_factory=FollowerSettings)
    check_every: int = 3
    tolerance: float = 0.03
    insist_after: int = 4
    retry_after: int = 8
    detour: float = 1.5
    patience: int = 45

    def __post_init__(self) -> None:
        self._pace: Speed | None = None
        self._body = GuardedBody.of(self.robot)
        self._yielding = Yielding(self.robot, self.patience)
        self._barriers = BarrierPlanner(self.robot, self.detour, self.patience, self.retry_after)
        self.reset()

    def reset(self) -> None:
        """Forget path and target."""
        self.path: PlannedPath | None = None
        self.plans = 0
        self._track: PathTrack | None = None
        self._written: PathTrack | None = None
        self._target: DriveTarget | None = None
        self._progress = PathProgress()
        self._shift: Pose = ORIGIN
        self._step = self._wait = 0
        self._braking = False
        self._refusals = 0
        self._yielding.reset()
        self._barriers.reset()

    def put(self, record: Any) -> None:
        """Write what compiled code must know to drive on, see `cruise.CRUISE`."""
        counts, track = record["counts"], self._track
        follows = not self._braking and self._yielding.insisting <= 0
        counts["ready"] = follows and track is not None and fits(track)
        if not counts["ready"] or track is None or self._target is None:
            return
        waiting = self._yielding
        counts["step"], counts["wait"], counts["refusals"] = self._step, self._wait, self._refusals
        counts["around"], counts["backing"] = waiting.around, waiting.backing
        counts["yielded"] = waiting.yielded
        counts["heeds_barriers"] = self._barriers.heeds_barriers
        counts["pace"] = PACES.index(self._pace)
        counts["leg"], counts["sample"] = self._progress.leg, self._progress.sample
        record["shift"] = self._shift
        if track is not self._written:
            self._written = track
            put_path(record, track, self._target)
            put_body(record, self.robot, self.check_every, self.tolerance)

    def take(self, record: Any) -> None:
        """Read what compiled code has changed."""
        counts = record["counts"]
        self._step, self._wait = int(counts["step"]), int(counts["wait"])
        self._refusals, waiting = int(counts["refusals"]), self._yielding
        waiting.around, waiting.backing = int(counts["around"]), int(counts["backing"])
        waiting.yielded = int(counts["yielded"])
        self._progress = PathProgress(int(counts["leg"]), int(counts["sample"]))
        x, y, heading = record["shift"].tolist()
        self._shift = x, y, heading

    def plan_at_once(self) -> None:
        """Plan to the next target without standing still first."""
        self._wait = 0

    def take_pace(self, pace: Speed | None) -> None:
        """Drive at a pace from here on, also along the path that is being driven."""
        if pace is not self._pace:
            self._pace = pace
            if self._track is not None:
                self._track = self._track_of(self._track.path)

    def _track_of(self, path: PlannedPath) -> PathTrack:
        return PathTrack(path, self.robot, self.follower.at(self._pace, self.robot))

    def drive(
        self,
        points: FloatArray | Obstacles,
        target: DriveTarget,
        pose: Pose,
        velocity: Twist = (0.0, 0.0, 0.0),
        barriers: FloatArray | Obstacles = NO_POINTS,
        moving: FloatArray = NO_POINTS,
    ) -> Steering:
        """The velocities for this step; `done` once the target is reached.

        Args:
            points: obstacles, or obstacle points, metres, shape (N, 2).
            target: where to go, in the frame of the points.
            pose: the centre's pose in that frame.
            velocity: of the robot now.
            barriers: points across doorways that do not lead to the target's gate, metres, shape
                (M, 2); nothing stands there.
            moving: points on what moves, metres, shape (L, 2).
        """
        self._step += 1
        self._wait -= 1
        self._yielding.count_step(self._step, len(moving) > 0)
        standing = obstacles = as_obstacles(points)
        barriers = as_obstacles(barriers)
        if self._yielding.around > 0:
            obstacles = JoinedObstacles((standing, as_obstacles(moving)))
        if self._yielding.backing > 0:
            return self._back_off(standing, moving, pose, velocity)
        self._braking = self._braking and max(map(abs, velocity)) > 0.05
        if self._braking:
            return STANDSTILL
        if self._must_plan(obstacles, target, pose, barriers):
            if self._wait > 0:
                return self._hold(velocity) if self._is_among_people() else STANDSTILL
            self._plan(obstacles.points(), target, pose, velocity, barriers.points())
            if self._yielding.around > 0 and not self._leads_around(target, barriers.points()):
                self._yielding.around = 0
                self._plan(standing.points(), target, pose, velocity, barriers.points())
        if self._track is None:
            return self._hold(velocity)
        insists = self._yielding.insisting > 0
        if not insists and self._yielding.around <= 0 and self._yields(moving, pose, velocity):
            return self._hold(velocity)
        steering = follow(self._track, self._progress, relative(self._shift, pose), velocity)
        self._progress = steering.progress
        if steering.deviation > self.follower.lost:
            return self._stop()
        if insists and not steering.done:
            steering = steering.slowed(INSISTING_SHARE)
        near = points_around(pose, moving, GUARD_REACH * self.robot.length)
        if safe_share(near, steering.twist, velocity, self._body) == 0.0:
            return self._hold(velocity)  # it is no noise, so that the robot never insists
        return self._guarded(obstacles, pose, velocity, steering)

    def _yields(self, moving: FloatArray, pose: Pose, velocity: Twist) -> bool:
        """Whether to wait for what moves.

        What is still there after `patience` steps is planned around for as long, if there is a
        short way.
        """
        distance = yield_distance(velocity)
        near = points_around(pose, moving, distance + self.robot.length)
        frame, path = relative(pose, self._shift), self._ahead()
        ahead = poses_ahead(path, frame, distance) if len(near) else NO_POSES
        if not self._yielding.must_wait(near, ahead):
            return False
        if self._yielding.loses_patience():
            self._track = None
        return True

    def _is_among_people(self) -> bool:
        return self._yielding.is_among_people(self._step)

    def _hold(self, velocity: Twist) -> Steering:
        self._yielding.hold(velocity)
        return STANDSTILL

    def _back_off(
        self, standing: Obstacles, moving: FloatArray, pose: Pose, velocity: Twist
    ) -> Steering:
        """Make room: slowly straight backwards, as far as nothing is seen there."""
        self._track = None
        reach = GUARD_REACH * self.robot.length
        seen = np.vstack((standing.near(pose, reach), points_around(pose, moving, reach)))
        back = Steering(-BACKING_SPEED, 0.0, 0.0, PathProgress())
        return back if safe_share(seen, back.twist, velocity, self._body) == 1.0 else STANDSTILL

    def _stop(self) -> Steering:
        """Brake, and plan again from standstill."""
        self._track, self._braking = None, True
        return STANDSTILL

    def _guarded(
        self,
        obstacles: Obstacles,
        pose: Pose,
        velocity: Twist,
        steering: Steering,
    ) -> Steering:
        """The steering, slowed down or refused where it leads into an obstacle.

        After `insist_after` refusals in a row it is allowed slowly, because the obstacle may be
        noise.
        """
        seen = obstacles.near(pose, GUARD_REACH * self.robot.length)
        share = safe_share(seen, steering.twist, velocity, self._body)
        if share == 0.0:
            self._refusals += 1
            if self._refusals <= self.insist_after:
                return self._stop()
            share = SPEED_SHARES[-1]
        elif share == 1.0:
            self._refusals = 0
        if steering.done and self.path is not None and not self.path.complete:
            return STANDSTILL
        return steering if share == 1.0 else steering.slowed(share)

    def _must_plan(
        self, obstacles: Obstacles, target: DriveTarget, pose: Pose, barriers: Obstacles
    ) -> bool:
        if self._track is None or self._target is None or self.path is None:
            return True
        if is_outdated(self._target.aim(self.robot), target.aim(self.robot)):
            return True
        if not self.path.complete and is_nearly_driven(self._ahead()):
            return True
        if self._step % self.check_every:
            return False
        heeded = (obstacles, barriers) if self._barriers.heeds_barriers else (obstacles,)
        seen = JoinedObstacles(heeded).near(pose, LOOKAHEAD)
        told = self._shift, pose, self.tolerance
        free, self._shift = stays_free(self._ahead(), seen, *told)
        return not free

    def _plan(
        self,
        points: FloatArray,
        target: DriveTarget,
        pose: Pose,
        velocity: Twist,
        barriers: FloatArray,
    ) -> None:
        """Plan from the robot's pose; while it drives, from where it can stop on its path."""
        kept = self._path_to_stop(points, pose, velocity)
        start = pose if kept is None else kept.end
        self.plans += 1
        among_people, settings = self._is_among_people(), self.planner
        if among_people:
            settings = replace(settings, reverse=REVERSE_AMONG_PEOPLE)
        path = self._barriers.path(points, start, target, barriers, settings, among_people)
        if path is None:
            self.path, self._track, self._wait = None, None, self.retry_after
            return
        self.path = path if kept is None else joined(kept, path)
        self._target, self._progress, self._shift = target, PathProgress(), ORIGIN
        self._track = self._track_of(self.path)
        if not self.path.complete:
            self._wait = self.retry_after

    def _leads_around(self, target: DriveTarget, barriers: FloatArray) -> bool:
        """Whether the path leads to the target by a short way, forward, and through no barrier.

        A long way leads through what has not been seen yet, and so through doors. Backwards the
        lidar sees little, and whoever walks behind the robot stands there when it stops.
        """
        path = self.path
        if path is None or not path.complete or not is_free(barriers, path.poses, self.robot):
            return False
        if path.backs:
            return False
        direct = math.dist(path.start[:2], target.pose[:2])
        return path.length < self.detour * direct + EVASION_LENGTH

    def _path_to_stop(self, points: FloatArray, pose: Pose, velocity: Twist) -> PlannedPath | None:
        """The part of the old path that braking needs; None if it is not free or missing."""
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

    def _ahead(self) -> PathAhead:
        """The path that is being driven, as kernels take it."""
        assert self._track is not None
        return self._track.ahead(self._progress.sample)
