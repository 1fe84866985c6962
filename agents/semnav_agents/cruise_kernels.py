"""Drives cruising robots on: the decisions of `Pilot` and `Driver` while nothing happens.

The rules themselves are kernels that both use.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numba.extending import register_jitable
from numpy.typing import NDArray

from semnav_agents.pilot_rules import STUCK_STEPS, count_pushing, place_aim
from semnav_agents.planning.aim import Aim, is_outdated
from semnav_agents.planning.door_aims import (
    aim_through,
    ends_at_door,
    is_same_door,
    jambs_facing,
)
from semnav_agents.planning.follower import steer
from semnav_agents.planning.free import points_around
from semnav_agents.planning.guard import GUARD_REACH, GuardedBody, safe_share
from semnav_agents.planning.obstacle_selection import SelectionLimits, box_around, select
from semnav_agents.planning.path_ahead import PathAhead, box_of_path, is_nearly_driven, stays_free
from semnav_agents.planning.track import TrackArrays
from semnav_env.approach.door_side import MIN_DOOR_WIDTH
from semnav_env.mind.grounding.goal import GoalKind
from semnav_env.robots.actions import cut_share
from semnav_features.frames import FloatArray, Point, Pose, Twist, middle_of, relative, to_parent
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.exact_hypot import exact_hypot

register_jitable(cut_share)

PASS, SEEK, STOP = int(GoalKind.PASS), int(GoalKind.SEEK), int(GoalKind.STOP)
"""Kinds of goals, as numbers that kernels know."""


@kernel
def cruise(
    robots: NDArray[Any],
    driven: NDArray[np.int64],
    odometry: NDArray[Any],
    goals: NDArray[Any],
    paces: NDArray[np.int64],
    disturbed: NDArray[np.bool_],
    states: NDArray[Any],
    centres: NDArray[Any],
    table: NDArray[np.int32],
    limits: SelectionLimits,
    actions: NDArray[np.float32],
    decided: NDArray[np.bool_],
) -> None:
    """Decide for the robots that cruise; those for which anything happens are left as they are.

    Args:
        robots: dtype `CRUISE`, shape (n,), changed in place.
        driven: numbers of the robots that decide.
        odometry: entries of the observations, dtype `ODOMETRY_ROW`, shape (n,).
        goals: the same, dtype `GOAL_ROW`, shape (n,).
        paces: told to the robots, shape (n,).
        disturbed: which see something move, or feel walls, shape (n,).
        states: of the obstacle memories, see `remember`, like the next two.
        centres: the same.
        table: the same.
        limits: of the selection of centres.
        actions: written for robots that are decided, shape (n, action size).
        decided: written, shape (n,).
    """
    for k in driven:
        decided[k] = False
        if robots[k].counts.ready and not disturbed[k] and paces[k] == robots[k].counts.pace:
            known = centres[k, : states[k].count]
            decided[k] = _go_on(robots[k], odometry[k], goals[k], known, table, limits, actions[k])


@kernel
def _go_on(
    robot: Any,
    odometry: Any,
    goal: Any,
    centres: NDArray[Any],
    table: NDArray[np.int32],
    limits: SelectionLimits,
    action: NDArray[np.float32],
) -> bool:
    """One step of `Pilot.act` of a robot; False, and nothing changed, if Python must decide."""
    n, pose, velocity = robot.counts, _pose(odometry), _velocity(odometry)
    last = robot.last[0], robot.last[1], robot.last[2]
    pushed, path = count_pushing(n.pushed, last, velocity), _path(robot)
    if n.backing_out > 0 or pushed >= STUCK_STEPS or n.around > 1 or n.backing > 1:
        return False
    kind, (start, end) = int(np.argmax(goal.kinds)), _jambs(goal, pose)
    passes, middle = kind == PASS and goal.has_door > 0.5, middle_of(start, end)
    if kind == STOP or (passes and not _knows(robot, start, end)):
        return False
    if not robot.complete and is_nearly_driven(path):
        return False
    place = np.float64(goal.x), np.float64(goal.y), _angle(goal)
    if passes:
        right, left_jamb = jambs_facing(start, end, pose[2] + place[2])
        in_door = robot.door[2], robot.door[3], robot.door[4]
        aim = aim_through(right, left_jamb, n.aims_at_pose != 0, in_door, robot.body.axle)
    else:
        aim = place_aim(kind == SEEK, place, pose, robot.body.axle)
    if is_outdated(_aim(robot), aim):
        return False
    step, shift = n.step + 1, (robot.shift[0], robot.shift[1], robot.shift[2])
    checks = step % int(robot.body.check_every) == 0
    if checks and n.heeds_barriers:
        return False
    box = box_around(pose[0], pose[1], GUARD_REACH * robot.body.length)
    if checks:
        box = box_of_path(path, shift, box)
    seen = _seen(select(centres, table, box, limits), goal.has_door > 0.5, start, end, pose)
    if checks:
        is_free, shift = stays_free(path, seen, shift, pose, robot.body.tolerance)
        if not is_free:
            return False
    leg, sample, forward, left, yaw_rate, off, done = steer(
        _track(robot), robot.limits, n.leg, n.sample, relative(shift, pose), velocity
    )
    if off > robot.limits.lost:
        return False
    share = safe_share(seen, (forward, left, yaw_rate), velocity, _body(robot))
    notes = done if robot.complete else n.tries_ways != 0 and ends_at_door(_end(robot), middle)
    if share == 0.0 or (passes and notes):
        return False
    n.refusals = 0 if share == 1.0 else n.refusals
    n.step, n.wait, n.around, n.backing = step, n.wait - 1, n.around - 1, n.backing - 1
    n.yielded, n.pushed, n.leg, n.sample = max(n.yielded - 1, 0), pushed, leg, sample
    twist = share * forward, share * left, share * yaw_rate
    for i in range(3):
        robot.last[i], robot.shift[i] = twist[i], shift[i]
    if passes:
        robot.door[0], robot.door[1] = middle
    _write_shares(robot.body, twist, action)
    return True


@kernel
def _pose(odometry: Any) -> Pose:
    return np.float64(odometry.x), np.float64(odometry.y), _angle(odometry)


@kernel
def _velocity(odometry: Any) -> Twist:
    forward, left = np.float64(odometry.forward), np.float64(odometry.left)
    return forward, left, np.float64(odometry.yaw_rate)


@kernel
def _angle(entry: Any) -> float:
    """The heading of an entry of the observation, radians."""
    return math.atan2(np.float64(entry.sine), np.float64(entry.cosine))


@kernel
def _jambs(goal: Any, pose: Pose) -> tuple[Point, Point]:
    """The jambs of the goal's door, in the frame of the pose."""
    start = np.float64(goal.door_start_x), np.float64(goal.door_start_y)
    end = np.float64(goal.door_end_x), np.float64(goal.door_end_y)
    return to_parent(pose, start), to_parent(pose, end)


@kernel
def _knows(robot: Any, start: Point, end: Point) -> bool:
    """Whether the robot is passing this door; a door without width is none."""
    width = exact_hypot(start[0] - end[0], start[1] - end[1])
    if width < MIN_DOOR_WIDTH or not robot.counts.knows_door:
        return False
    return is_same_door((robot.door[0], robot.door[1]), middle_of(start, end))


@kernel
def _aim(robot: Any) -> Aim:
    """Where the path leads."""
    aim = robot.target
    near, turned = aim.position_tolerance, aim.heading_tolerance
    return Aim(aim.x, aim.y, aim.heading, near, turned, aim.any_heading != 0, aim.axle)


@kernel
def _end(robot: Any) -> Point:
    return robot.end[0], robot.end[1]


@kernel
def _seen(points: FloatArray, has_door: bool, start: Point, end: Point, pose: Pose) -> FloatArray:
    """Obstacles around the robot and the jambs of the goal's door, robot frame, shape (m, 2)."""
    solid, n = np.empty((len(points) + 2, 2)), len(points)
    for k in range(n):
        solid[k, 0], solid[k, 1] = points[k, 0], points[k, 1]
    if has_door:
        solid[n, 0], solid[n, 1] = start
        solid[n + 1, 0], solid[n + 1, 1] = end
        n += 2
    return points_around(pose, solid[:n], math.inf)


@kernel
def _path(robot: Any) -> PathAhead:
    """The path from the last sample on."""
    m, body = robot.samples, robot.body
    arrays = robot.centres[:m], robot.distance[:m], robot.clearance[:m]
    driven = robot.counts.sample, robot.margin, robot.travel
    return PathAhead(
        arrays[0], arrays[1], arrays[2], driven[0], driven[1], driven[2], body.length, body.width
    )


@kernel
def _track(robot: Any) -> TrackArrays:
    """The path as the follower takes it."""
    m = robot.samples
    return TrackArrays(
        robot.poses[:m],
        robot.distance[:m],
        robot.curvature[: m - 1],
        robot.speed[:m],
        robot.left[: m - 1],
        robot.legs[: robot.leg_count],
    )


@kernel
def _body(robot: Any) -> GuardedBody:
    body = robot.body
    return GuardedBody(body.length, body.width, body.axle, body.max_acceleration)


@kernel
def _write_shares(body: Any, twist: Twist, action: NDArray[np.float32]) -> None:
    """Write a velocity as `shares_of` gives it."""
    action[0] = cut_share(twist[0] / body.max_speed)
    if body.holonomic:
        action[1] = cut_share(twist[1] / body.max_sideways_speed)
    action[len(action) - 1] = cut_share(twist[2] / body.max_turn_rate)
