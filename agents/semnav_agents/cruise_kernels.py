"""Drives cruising robots on: the decisions of `Pilot` and `Driver` while nothing happens."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from semnav_agents.pilot import (
    LOOKOUT_TOLERANCE,
    REACH_HEADING_TOLERANCE,
    REACH_TOLERANCE,
    STUCK_STEPS,
)
from semnav_agents.planning.doorway import THROUGH_DISTANCE, THROUGH_TOLERANCE
from semnav_agents.planning.driver import CHECKED_LENGTH, NUDGED_LENGTH, REPLAN_SHARE
from semnav_agents.planning.exit_via_door import (
    MAX_OBSTACLE_DISTANCE,
    POSE_HEADING_TOLERANCE,
    POSE_TOLERANCE,
    SAME_DOOR_DISTANCE,
)
from semnav_agents.planning.follower import steer
from semnav_agents.planning.free import points_around
from semnav_agents.planning.guard import FORESIGHT, free_share
from semnav_agents.planning.motion import Move
from semnav_agents.planning.nudge import best_nudge, path_clearances
from semnav_agents.planning.obstacle_selection import SearchBox, SelectionLimits, box_around, select
from semnav_agents.planning.track import TrackArrays
from semnav_env.mind.grounding.goal import GoalKind
from semnav_features.frames import (
    FloatArray,
    Point,
    Pose,
    Twist,
    compose,
    relative,
    to_local,
    to_parent,
    wrap_angle,
)
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.exact_hypot import exact_hypot

PASS, SEEK, STOP = int(GoalKind.PASS), int(GoalKind.SEEK), int(GoalKind.STOP)
"""Kinds of goals, as numbers that kernels know."""

PATH_ROOM = 0.25
"""Distance beside the footprints on a path within which points matter to it, besides the margin,
metres: the diagonal of `RELEVANT_DISTANCE`, and the largest correction at the end of the path."""

Jambs = tuple[float, float, float, float]
"""x and y of both jambs of a door, metres."""


@kernel
def cruise(
    robots: NDArray[Any],
    driven: NDArray[np.int64],
    odometry: NDArray[np.float32],
    goals: NDArray[np.float32],
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
        odometry: entries of the observations, shape (n, 7).
        goals: the same, shape (n, 13).
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
    odometry: NDArray[np.float32],
    goal: NDArray[np.float32],
    centres: NDArray[Any],
    table: NDArray[np.int32],
    limits: SelectionLimits,
    action: NDArray[np.float32],
) -> bool:
    """One step of `Pilot.act` of a robot; False, and nothing changed, if Python must decide."""
    n, body = robot.counts, robot.body
    heading = math.atan2(np.float64(odometry[3]), np.float64(odometry[2]))
    pose = np.float64(odometry[0]), np.float64(odometry[1]), heading
    velocity = np.float64(odometry[4]), np.float64(odometry[5]), np.float64(odometry[6])
    kind = int(np.argmax(goal[:4]))
    pushed = n.pushed + 1 if _pushes(robot.last, velocity) else 0
    if kind == STOP or n.backing_out > 0 or pushed >= STUCK_STEPS:
        return False
    if n.around > 1 or n.backing > 1 or _nearly_driven(robot):
        return False
    jambs = _jambs(goal, pose)
    passes = kind == PASS and goal[12] > 0.5
    if passes:
        is_same, target, middle = _door_target(robot, jambs, pose[2] + _heading(goal))
    else:
        is_same, target, middle = True, _place_target(goal, kind, pose), (0.0, 0.0)
    if not is_same or _has_moved(robot.target, target):
        return False
    step, shift = n.step + 1, (robot.shift[0], robot.shift[1], robot.shift[2])
    checks = step % int(body.check_every) == 0
    if checks and n.heeds_barriers:
        return False
    box = box_around(pose[0], pose[1], 1.5 * body.length)
    if checks:
        box = _around_path(robot, box)
    seen = _seen(select(centres, table, box, limits), goal, jambs, pose)
    if checks:
        is_free, shift = _stays_free(robot, seen, pose)
        if not is_free:
            return False
    axle = compose(relative(shift, pose), (body.axle, 0.0, 0.0))
    leg, sample, forward, left, yaw_rate, off, done = steer(
        _track(robot), robot.limits, n.leg, n.sample, axle, velocity
    )
    if off > robot.limits.lost:
        return False
    seconds = FORESIGHT + exact_hypot(velocity[0], velocity[1]) / body.max_acceleration / 2
    moves = Move(forward, left - body.axle * yaw_rate, yaw_rate)
    share = free_share(seen, moves, seconds, body.length, body.width)
    if share == 0.0 or (passes and _is_noted(robot, middle, done)):
        return False
    twist = forward * share, left * share, yaw_rate * share
    if share == 1.0:
        n.refusals, twist = 0, (forward, left, yaw_rate)
    if done and not robot.complete:
        twist = 0.0, 0.0, 0.0
    n.step, n.wait, n.around, n.backing = step, n.wait - 1, n.around - 1, n.backing - 1
    n.yielded, n.pushed, n.leg, n.sample = max(n.yielded - 1, 0), pushed, leg, sample
    for i in range(3):
        robot.last[i], robot.shift[i] = twist[i], shift[i]
    if passes:
        robot.door[0], robot.door[1] = middle
    _write_shares(body, twist, action)
    return True


@kernel
def _pushes(last: FloatArray, velocity: Twist) -> bool:
    """Whether a robot should move and does not."""
    wanted = max(abs(last[0]), abs(last[1]), abs(last[2]))
    return wanted > 0.03 and max(abs(velocity[0]), abs(velocity[1]), abs(velocity[2])) < 0.02


@kernel
def _nearly_driven(robot: Any) -> bool:
    """Whether a path that leads only part of the way is to be planned again."""
    remaining = robot.distance[robot.samples - 1] - robot.distance[robot.counts.sample]
    return not robot.complete and remaining <= min(1.0, REPLAN_SHARE * robot.path_length)


@kernel
def _heading(goal: NDArray[np.float32]) -> float:
    return math.atan2(np.float64(goal[7]), np.float64(goal[6]))


@kernel
def _jambs(goal: NDArray[np.float32], pose: Pose) -> Jambs:
    """The jambs of the goal's door, in the frame of the pose."""
    a = to_parent(pose, (np.float64(goal[8]), np.float64(goal[9])))
    b = to_parent(pose, (np.float64(goal[10]), np.float64(goal[11])))
    return a[0], a[1], b[0], b[1]


class CruiseTarget(NamedTuple):
    """A `DriveTarget` without gate; the tolerance of heading is NaN where any heading will do."""

    x: float
    y: float
    heading: float
    near: float
    turned: float


@kernel
def _place_target(goal: NDArray[np.float32], kind: int, pose: Pose) -> CruiseTarget:
    """The target of a goal that is no door."""
    seen = np.float64(goal[4]), np.float64(goal[5]), _heading(goal)
    x, y, heading = compose(pose, seen)
    if kind == SEEK:
        return CruiseTarget(x, y, heading, LOOKOUT_TOLERANCE, math.nan)
    return CruiseTarget(x, y, heading, REACH_TOLERANCE, REACH_HEADING_TOLERANCE)


@kernel
def _door_target(robot: Any, jambs: Jambs, outward: float) -> tuple[bool, CruiseTarget, Point]:
    """The target of `ExitViaDoor`, and the middle of the door.

    Returns:
        whether it is the same door as before, the target, and the middle, metres.
    """
    ax, ay, bx, by = jambs
    middle = (ax + bx) / 2, (ay + by) / 2
    nowhere = CruiseTarget(0.0, 0.0, 0.0, 0.0, math.nan)
    if not exact_hypot(ax - bx, ay - by) >= 1e-6 or not robot.counts.knows_door:
        return False, nowhere, middle
    if exact_hypot(robot.door[0] - middle[0], robot.door[1] - middle[1]) > SAME_DOOR_DISTANCE:
        return False, nowhere, middle
    before = middle[0] - math.cos(outward), middle[1] - math.sin(outward)
    through = math.atan2(-(bx - ax), by - ay)
    if -to_local((middle[0], middle[1], through), before)[0] < 0.0:  # it lies on the other side
        ax, ay, bx, by = bx, by, ax, ay
        through = math.atan2(-(bx - ax), by - ay)
    frame = middle[0], middle[1], through
    if robot.counts.aims_at_pose:
        x, y, heading = compose(frame, (robot.door[2], robot.door[3], robot.door[4]))
        return True, CruiseTarget(x, y, heading, POSE_TOLERANCE, POSE_HEADING_TOLERANCE), middle
    heading = math.atan2(by - ay, bx - ax) + math.pi / 2
    c, s = math.cos(heading), math.sin(heading)
    place = to_parent(frame, (-1.0, 0.0))
    if (place[0] - middle[0]) * c + (place[1] - middle[1]) * s > 0:
        heading, c, s = wrap_angle(heading + math.pi), -c, -s
    x, y = middle[0] + THROUGH_DISTANCE * c, middle[1] + THROUGH_DISTANCE * s
    return True, CruiseTarget(x, y, wrap_angle(heading), THROUGH_TOLERANCE, math.nan), middle


@kernel
def _has_moved(planned: FloatArray, aim: CruiseTarget) -> bool:
    """Whether a path to the planned target may not reach this one."""
    turned = abs(wrap_angle(planned[2] - aim.heading))
    if (
        exact_hypot(planned[0] - aim.x, planned[1] - aim.y) > 0.5 * aim.near
        or aim.near < planned[3]
    ):
        return True
    return not math.isnan(aim.turned) and (math.isnan(planned[4]) or turned > 0.5 * aim.turned)


@kernel
def _seen(points: FloatArray, goal: NDArray[np.float32], jambs: Jambs, pose: Pose) -> FloatArray:
    """Obstacles around the robot and the jambs of the goal's door, robot frame, shape (m, 2)."""
    solid = np.empty((len(points) + 2, 2))
    n = len(points)
    for k in range(n):
        solid[k, 0], solid[k, 1] = points[k, 0], points[k, 1]
    if goal[12] > 0.5:
        solid[n, 0], solid[n, 1], solid[n + 1, 0], solid[n + 1, 1] = jambs
        n += 2
    return points_around(pose, solid[:n], math.inf)


@kernel
def _around_path(robot: Any, box: SearchBox) -> SearchBox:
    """A box, grown to hold all places that matter to the next metres of the path."""
    half = exact_hypot(robot.body.length, robot.body.width) / 2
    more = half + PATH_ROOM + 1.5 * robot.margin
    shift = robot.shift[0], robot.shift[1], robot.shift[2]
    poses = _ahead(robot, shift, CHECKED_LENGTH)
    left, lower, right, upper = box
    for k in range(len(poses)):
        left, right = min(left, poses[k, 0] - more), max(right, poses[k, 0] + more)
        lower, upper = min(lower, poses[k, 1] - more), max(upper, poses[k, 1] + more)
    return SearchBox(left, lower, right, upper)


@kernel
def _stays_free(robot: Any, seen: FloatArray, pose: Pose) -> tuple[bool, Pose]:
    """Whether the next metres of the path are free, and the frame of the corrected path."""
    length, width, margin = robot.body.length, robot.body.width, robot.margin
    shift = robot.shift[0], robot.shift[1], robot.shift[2]
    near = _ahead(robot, relative(pose, shift), NUDGED_LENGTH)
    left, turn, _ = best_nudge(seen, near, length, width, margin + 0.005)
    if left != 0.0 or turn != 0.0:
        shift = compose(pose, compose((0.0, left, turn), relative(pose, shift)))
    far = _ahead(robot, relative(pose, shift), CHECKED_LENGTH)
    now = path_clearances(seen, far, length, width, margin)
    first = robot.counts.sample
    for k in range(len(now)):
        planned = min(robot.clearance[first + 2 * k], margin)
        if not now[k] > planned - robot.body.tolerance:
            return False, shift
    return True, shift


@kernel
def _ahead(robot: Any, frame: Pose, distance: float) -> FloatArray:
    """The centre's poses on the path ahead, about 0.1 m apart, in the robot frame, (M, 3)."""
    along, first = robot.distance[: robot.samples], robot.counts.sample
    last = min(np.searchsorted(along, along[first] + distance) + 1, robot.samples)
    poses = np.empty(((last - first + 1) // 2, 3))
    c, s = math.cos(frame[2]), math.sin(frame[2])
    for k in range(len(poses)):
        x, y = robot.centres[first + 2 * k, 0], robot.centres[first + 2 * k, 1]
        poses[k, 0], poses[k, 1] = frame[0] + c * x - s * y, frame[1] + s * x + c * y
        poses[k, 2] = robot.centres[first + 2 * k, 2] + frame[2]
    return poses


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
def _is_noted(robot: Any, middle: Point, done: bool) -> bool:
    """Whether `ExitViaDoor` is to be told that a pose was reached or a path failed."""
    if robot.complete:
        return done
    away = exact_hypot(robot.end[0] - middle[0], robot.end[1] - middle[1])
    return robot.counts.tries_ways and away <= MAX_OBSTACLE_DISTANCE


@kernel
def _write_shares(body: Any, twist: Twist, action: NDArray[np.float32]) -> None:
    """Write velocities as shares of the body's largest, see `shares_of`."""
    action[0] = _share(twist[0] / body.max_speed)
    if body.holonomic:
        action[1] = _share(twist[1] / body.max_sideways_speed)
    action[len(action) - 1] = _share(twist[2] / body.max_turn_rate)


@kernel
def _share(value: float) -> float:
    return min(max(value, -1.0), 1.0)
