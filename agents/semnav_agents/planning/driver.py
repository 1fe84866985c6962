"""Drives a robot to a target: plans, checks and follows, one call for each step."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from semnav_agents.planning.cruise import CHANGING_COUNTS, fits, put_body, put_path
from semnav_agents.planning.doorway import room_behind
from semnav_agents.planning.follower import PathProgress, Steering, follow
from semnav_agents.planning.free import points_around
from semnav_agents.planning.guard import SPEED_SHARES, safe_share
from semnav_agents.planning.known_obstacles import JoinedObstacles, Obstacles, as_obstacles
from semnav_agents.planning.nudge import best_nudge, path_clearance, path_clearances
from semnav_agents.planning.path import PlannedPath, joined
from semnav_agents.planning.planner import DriveTarget, PlannerSettings, is_free, plan
from semnav_agents.planning.track import FollowerSettings, PathTrack
from semnav_env.language.clauses import Speed
from semnav_env.mind.observations.pace_entry import PACES
from semnav_env.robots import RobotSpec
from semnav_features.frames import (
    ORIGIN,
    FloatArray,
    Pose,
    Twist,
    compose,
    points_to_parent,
    relative,
    wrap_angle,
)

NO_POINTS: FloatArray = np.empty((0, 2))
"""No obstacle points, shape (0, 2)."""

STANDSTILL = Steering(0.0, 0.0, 0.0, PathProgress())
"""Velocity zero: stand still, or brake."""

REPLAN_SHARE = 0.3
"""Share of a partial path that is left when it is planned again; for long paths, one metre is left.
Most of the path must have been driven: from the same place the same path would be found again."""

NUDGED_LENGTH, CHECKED_LENGTH = 1.2, 2.5
"""Length of the path ahead that is corrected, and that must be free, metres."""

LOOKAHEAD = 4.0
"""Distance beyond which obstacles do not matter to the next metres of a path, metres."""

YIELD_CLEARANCE = 0.2
"""Clearance from what moves below which a robot waits, metres."""

YIELD_APPROACH = 0.02
"""A robot waits only where it would come nearer than it is by this much, metres."""

YIELD_DISTANCE, YIELD_SECONDS = 0.5, 1.2
"""What moves matters on the path up to this distance, and up to what is driven in this time, metres
and seconds."""

GATE_DETOUR = 6.0
"""Length by which a path around barriers to a gate may exceed what `detour` allows, metres: the
robot may have to turn in the hallway first. A longer one leads through what has not been seen."""

EVASION_LENGTH = 1.5
"""Length by which a path around what moves may exceed what `detour` allows, metres: the robot may
have to get clear first."""

JAM_STEPS, STANDING_SPEED = 75, 0.05
"""Steps of standing before what moves after which a robot is in a jam, and the speed below which it
stands, m/s and rad/s: somebody who stands before it for five seconds cannot go on either."""

INSISTING_SHARE, INSISTING_STEPS = 0.15, 45
"""Share of its velocity with which a robot creeps on in a jam, and for how many steps: people make
room for it. In each second jam it backs off instead."""

AMONG_PEOPLE_STEPS = 150
"""Steps after something moved in view for which a robot among people goes through no door that is
not its own, but waits: whoever stands in its way will go."""

BACKING_SPEED, BACKING_STEPS = 0.2, 22
"""Speed of backing off, m/s, and its duration in steps: slow, because the lidar sees little
behind."""


@dataclass
class Driver:
    """Drives one robot to targets, and plans again when needed.

    It plans again when the target moves, when an obstacle lies on the path, when the robot is off
    the path, and when a path that led only part of the way is nearly driven. For what moves it
    waits; only if that does not go away it plans around it, by a short way; and from a jam it backs
    off.

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
        self._heeds_barriers = False
        self._yielded = self._around = self._barred = self._held = self._backing = 0
        self._jams = self._insisting = 0
        self._met_at = -AMONG_PEOPLE_STEPS

    def put(self, record: Any) -> None:
        """Write what compiled code must know to drive on, see `cruise.CRUISE`."""
        counts, track = record["counts"], self._track
        follows = track is not None and not self._braking and self._insisting <= 0
        counts["ready"] = follows and track is not None and fits(track)
        if not counts["ready"] or track is None or self._target is None:
            return
        for name in (*CHANGING_COUNTS, "heeds_barriers"):
            counts[name] = getattr(self, f"_{name}")
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
        for name in CHANGING_COUNTS:
            setattr(self, f"_{name}", int(counts[name]))
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
        self._around -= 1
        self._backing -= 1
        self._insisting -= 1
        self._met_at = self._step if len(moving) else self._met_at
        standing = obstacles = as_obstacles(points)
        barriers = as_obstacles(barriers)
        if self._around > 0:
            obstacles = JoinedObstacles((standing, as_obstacles(moving)))
        if self._backing > 0:
            return self._back_off(standing, moving, pose, velocity)
        self._braking = self._braking and max(map(abs, velocity)) > 0.05
        if self._braking:
            return STANDSTILL
        if self._must_plan(obstacles, target, pose, barriers):
            if self._wait > 0:
                return self._hold(velocity) if self._is_among_people() else STANDSTILL
            self._plan(obstacles.points(), target, pose, velocity, barriers.points())
            if self._around > 0 and not self._leads_around(target, barriers.points()):
                self._around = 0
                self._plan(standing.points(), target, pose, velocity, barriers.points())
        if self._track is None:
            return self._hold(velocity)
        insists = self._insisting > 0
        if not insists and self._around <= 0 and self._yields(moving, pose, velocity):
            return self._hold(velocity)
        steering = follow(self._track, self._progress, relative(self._shift, pose), velocity)
        self._progress = steering.progress
        if steering.deviation > self.follower.lost:
            return self._stop()
        if insists and not steering.done:
            steering = steering.slowed(INSISTING_SHARE)
        near = points_around(pose, moving, 1.5 * self.robot.length)
        if safe_share(near, steering.twist, velocity, self.robot) == 0.0:
            return self._hold(velocity)  # it is no noise, so that the robot never insists
        return self._guarded(obstacles, pose, velocity, steering)

    def _yields(self, moving: FloatArray, pose: Pose, velocity: Twist) -> bool:
        """Whether to wait for what moves on the next stretch of the path, nearer than it is now.

        What is still there after `patience` steps is planned around for as long, if there is a
        short way.
        """
        distance = YIELD_DISTANCE + YIELD_SECONDS * math.hypot(velocity[0], velocity[1])
        near = points_around(pose, moving, distance + self.robot.length)
        if not len(near):
            self._yielded = max(self._yielded - 1, 0)
            return False
        ahead, size = self._ahead(pose, distance), (self.robot.length, self.robot.width)
        now = path_clearance(near, np.zeros((1, 3)), *size, 0.0, 0.0, -math.inf)
        enough = min(YIELD_CLEARANCE, now - YIELD_APPROACH)
        if path_clearance(near, ahead, *size, 0.0, 0.0, enough) >= enough:
            self._yielded = max(self._yielded - 1, 0)
            return False
        self._yielded += 1
        if self._yielded > self.patience:
            self._yielded, self._around, self._track = 0, self.patience, None
        return True

    def _is_among_people(self) -> bool:
        return self._step - self._met_at < AMONG_PEOPLE_STEPS

    def _hold(self, velocity: Twist) -> Steering:
        """Stand still before what moves; after `JAM_STEPS` of it, creep on or back off next."""
        self._held = self._held + 1 if max(map(abs, velocity)) < STANDING_SPEED else 0
        if self._held > JAM_STEPS:
            self._held = 0
            self._jams += 1
            if self._jams % 2 == 1:
                self._insisting = INSISTING_STEPS
            else:
                self._backing = BACKING_STEPS
        return STANDSTILL

    def _back_off(
        self, standing: Obstacles, moving: FloatArray, pose: Pose, velocity: Twist
    ) -> Steering:
        """Make room: slowly straight backwards, as far as nothing is seen there."""
        self._track = None
        reach = 1.5 * self.robot.length
        seen = np.vstack((standing.near(pose, reach), points_around(pose, moving, reach)))
        back = Steering(-BACKING_SPEED, 0.0, 0.0, PathProgress())
        return back if safe_share(seen, back.twist, velocity, self.robot) == 1.0 else STANDSTILL

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
        seen = obstacles.near(pose, 1.5 * self.robot.length)
        share = safe_share(seen, steering.twist, velocity, self.robot)
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
        if _apart(self._target, target) or _asks_for_more(self._target, target):
            return True
        if not self.path.complete and self._remaining() <= min(
            1.0, REPLAN_SHARE * self.path.length
        ):
            return True
        if self._step % self.check_every:
            return False
        solid = JoinedObstacles((obstacles, barriers)) if self._heeds_barriers else obstacles
        return not self._stays_free(solid, pose)

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
        path = self._path_around(points, start, target, barriers)
        if path is None:
            self._track, self._wait = None, self.retry_after
            return
        self.path = path if kept is None else joined(kept, path)
        self._target, self._progress, self._shift = target, PathProgress(), ORIGIN
        self._track = self._track_of(self.path)
        if not self.path.complete:
            self._wait = self.retry_after

    def _path_around(
        self, points: FloatArray, start: Pose, target: DriveTarget, barriers: FloatArray
    ) -> PlannedPath | None:
        """A path through the target's gate, if it has one, and through no barrier.

        The first of these is taken that leads right: among the points alone; around barriers and
        the walls beside the gate; and, where the first misses the gate, around those walls alone,
        for a barrier may be no door. A way around barriers must be no longer than `detour` allows,
        to a gate by `GATE_DETOUR` longer; without a gate the robot waits for such a way before it
        takes the first. Among people only a way around barriers is taken, or a part of it; None
        where it is too long.
        """
        path = plan(points, start, target, self.robot, self.planner)
        beside = NO_POINTS if target.gate is None else room_behind(target.gate, target.pose)
        closed = np.vstack((barriers, beside))
        self._heeds_barriers = False
        if self._heads_right(path, target, closed):
            self._barred = 0
            return path
        longest = self.detour * path.length + (GATE_DETOUR if target.gate is not None else 0.0)
        around = plan(np.vstack((points, closed)), start, target, self.robot, self.planner)
        if self._leads(around, target, barriers) and around.length < longest:
            self._heeds_barriers = True
            return around
        if self._is_among_people() and not is_free(barriers, path.poses, self.robot):
            self._heeds_barriers = True
            return None if around.complete else around
        if len(barriers) and not self._heads_right(path, target, NO_POINTS):
            around = plan(np.vstack((points, beside)), start, target, self.robot, self.planner)
            if self._leads(around, target, NO_POINTS):
                return around
        if target.gate is None and not around.complete and self._barred < self.patience:
            self._barred += self.retry_after
            self._heeds_barriers = True
            return around
        return path

    def _leads(self, path: PlannedPath, target: DriveTarget, barriers: FloatArray) -> bool:
        """Whether a path leads to the target through its gate and through no barrier."""
        return path.complete and self._heads_right(path, target, barriers)

    def _heads_right(self, path: PlannedPath, target: DriveTarget, barriers: FloatArray) -> bool:
        """Whether a path crosses no barrier, and the target's gate if it has one."""
        if target.gate is not None and not path.crosses(*target.gate):
            return False
        return is_free(barriers, path.poses, self.robot)

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

    def _remaining(self) -> float:
        assert self._track is not None
        return float(self._track.distance[-1] - self._track.distance[self._progress.sample])

    def _stays_free(self, obstacles: Obstacles, pose: Pose) -> bool:
        """Whether the next metres of the path are free, after a small correction if need be."""
        assert self.path is not None
        seen, margin = obstacles.near(pose, LOOKAHEAD), self.path.margin
        size = (self.robot.length, self.robot.width)
        left, turn, _ = best_nudge(seen, self._ahead(pose, NUDGED_LENGTH), *size, margin + 0.005)
        if left or turn:
            shift = compose((0.0, left, turn), relative(pose, self._shift))
            self._shift = compose(pose, shift)
        planned = self.path.clearance[self._samples_ahead(CHECKED_LENGTH)]
        now = path_clearances(seen, self._ahead(pose, CHECKED_LENGTH), *size, margin)
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


def _apart(a: DriveTarget, b: DriveTarget) -> bool:
    """Whether the targets differ by more than half a tolerance."""
    turned = abs(wrap_angle(a.pose[2] - b.pose[2]))
    heading_matters = b.heading_tolerance is not None and turned > 0.5 * b.heading_tolerance
    return math.dist(a.pose[:2], b.pose[:2]) > 0.5 * b.position_tolerance or heading_matters


def _asks_for_more(a: DriveTarget, b: DriveTarget) -> bool:
    """Whether a path to the first target may end where the second is not reached yet.

    This happens when a lookout point becomes the place at which to stop.
    """
    heading = a.heading_tolerance is None and b.heading_tolerance is not None
    return heading or b.position_tolerance < a.position_tolerance
