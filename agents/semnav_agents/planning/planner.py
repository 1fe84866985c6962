"""A path for a rectangular robot among obstacle points."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Annotated, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from semnav_agents.planning.aim import Aim, trimmed
from semnav_agents.planning.collision import (
    Footprint,
    ObstacleField,
    footprint_of,
    is_clear,
    obstacle_field,
)
from semnav_agents.planning.free import all_clear, clearances
from semnav_agents.planning.guidance import Guidance, guidance_to
from semnav_agents.planning.heuristic import least_seconds
from semnav_agents.planning.lanes import lane_anchors
from semnav_agents.planning.motion import MotionCosts, SafetyMargin
from semnav_agents.planning.path import MAX_CLEARANCE, PlannedPath, sampled
from semnav_agents.planning.search import SearchProblem, search
from semnav_agents.planning.shorten import merged, rounded, shortened
from semnav_env.robots import RobotSpec
from semnav_features.checked_fields import Bounds, Count, Length, check_fields
from semnav_features.frames import FloatArray, Point, Pose, compose


@dataclass(frozen=True)
class DriveTarget:
    """The target of the robot's centre.

    Attributes:
        pose: (x, y, heading) in the frame of the obstacle points.
        position_tolerance: metres.
        heading_tolerance: radians; None where any heading will do.
        gate: the ends of a line that the path should cross, such as the jambs of a door; `Driver`
            uses it, `plan` does not.
    """

    pose: Pose
    position_tolerance: float = 0.10
    heading_tolerance: float | None = 0.10
    gate: tuple[Point, Point] | None = None

    @staticmethod
    def of(aim: Aim, gate: tuple[Point, Point] | None = None) -> DriveTarget:
        """The target that kernels know as an aim."""
        turned = None if aim.any_heading else aim.heading_tolerance
        return DriveTarget((aim.x, aim.y, aim.heading), aim.position_tolerance, turned, gate)

    def aim(self, robot: RobotSpec) -> Aim:
        """The target as kernels know it."""
        near, turned = float(self.position_tolerance), self.heading_tolerance
        return Aim(*self.pose, near, float(turned or 0.0), turned is None, float(robot.axle))


Price: TypeAlias = Annotated[float, Bounds(0.0, 1000.0)]
Effort: TypeAlias = tuple[Annotated[float, Bounds(1.0, 100.0)], Count]


@dataclass(frozen=True)
class PlannerSettings:
    """Limits and costs of the planner.

    Attributes:
        margins: distances to keep from obstacles, the widest first, metres.
        detour: time of detour that each step to a wider margin is worth, seconds.
        half_window: half the side of the square around the start in which is planned, metres; it
            grows with the distance of the target up to `widest`.
        widest: the largest half window, metres.
        speed: assumed speed on straight lines, m/s.
        turn_rate: assumed yaw rate of turns on the spot, rad/s.
        reverse: factor on the time of backward motion.
        stop: cost of a change between turning, forward and backward motion, seconds.
        steering: cost of a change of curvature by 1/m, seconds.
        room: clearance beyond which more is worth nothing, metres.
        crowding: share by which a second counts more where there is no clearance.
        efforts: the searches that are tried in turn, each (greed, nodes): the weight of the time
            still to go, and the largest number of nodes to expand.
    """

    margins: tuple[Length, ...] = (0.10, 0.06, 0.03, 0.0)
    detour: Price = 1.0
    half_window: Length = 7.0
    widest: Length = 64.0
    speed: Annotated[float, Bounds(0.01, 10.0, "m/s")] = 1.0
    turn_rate: Annotated[float, Bounds(0.01, 20.0, "rad/s")] = 0.8
    reverse: Price = 3.0
    stop: Price = 0.4
    steering: Price = 0.1
    room: Length = 0.25
    crowding: Price = 3.0
    efforts: tuple[Effort, ...] = ((2.0, 500), (5.0, 2500))

    def __post_init__(self) -> None:
        check_fields(self)


def plan(
    points: ArrayLike,
    start: Pose,
    target: DriveTarget,
    robot: RobotSpec,
    settings: PlannerSettings | None = None,
) -> PlannedPath:
    """Plan a path from a pose of the centre to a target; all space except the points is free.

    Args:
        points: obstacle points, metres, shape (N, 2); those that are not finite are left out.
        start: the centre's pose, in the frame of the points.
        target: where to go; if it lies outside the window or cannot be reached, the path leads to
            the free place that seems nearest to it, and is not `complete`.
        robot: gives the footprint and the axle.
        settings: None for the defaults.

    Raises:
        ValueError: points of another shape, a pose that is not finite, or settings without
            margins or efforts.
    """
    settings = settings or PlannerSettings()
    if not settings.margins or not settings.efforts:
        raise ValueError("settings need at least one of `margins` and one of `efforts`")
    start = _checked_pose("start", start)
    target = replace(target, pose=_checked_pose("target", target.pose))
    body, axle = footprint_of(robot), compose(start, (robot.axle, 0.0, 0.0))
    solid = _without_impossible(_checked_points(points), axle, body)
    field = obstacle_field(solid, start[:2], _half_window(start, target, settings))
    costs = _costs(robot, settings)
    best: PlannedPath | None = None
    for guidance in _ways(target.pose[:2], start[:2], field, body, costs, settings):
        path = _search(field, body, start, target, robot, settings, guidance)
        if path.complete or not guidance.exact:
            return path
        best = _nearer(best, path, target)
    assert best is not None
    return best


def is_free(points: ArrayLike, poses: FloatArray, robot: RobotSpec, margin: float = 0.0) -> bool:
    """Whether the footprint, grown by the margin, holds none of the points at any of the poses.

    Args:
        points: obstacle points, metres, shape (N, 2).
        poses: poses of the centre, shape (M, 3).
        robot: gives the footprint.
        margin: metres.
    """
    return bool(all_clear(_checked_points(points), poses, robot.length, robot.width, margin))


def _ways(
    target: Point,
    start: Point,
    field: ObstacleField,
    body: Footprint,
    costs: MotionCosts,
    settings: PlannerSettings,
) -> Iterator[Guidance]:
    """The coarse paths for all margins, the most promising first; at least one.

    No path is quicker than the one for the smallest margin. If the path for the widest margin is
    hardly slower, it is the best, and the others need not be computed.
    """

    def way(margin: float) -> Guidance:
        return guidance_to(target, start, field, body, margin, costs)

    widest = way(settings.margins[0])
    shortest = least_seconds(field, target, start, costs)
    surely = widest.exact and widest.seconds <= shortest + settings.detour
    if surely:  # then the quickest of all need not even be looked for
        yield widest
    least = way(settings.margins[-1])
    settled = widest.seconds <= least.seconds + settings.detour < math.inf
    if settled and not surely:
        yield widest
    ways = [widest, *map(way, settings.margins[1:-1]), least]
    order = sorted(range(len(ways)), key=lambda k: ways[k].seconds + k * settings.detour)
    reachable = [ways[k] for k in order if ways[k].reachable]
    yield from (reachable[1:] if settled else reachable or [least])


def _search(
    field: ObstacleField,
    body: Footprint,
    start: Pose,
    target: DriveTarget,
    robot: RobotSpec,
    settings: PlannerSettings,
    guidance: Guidance,
) -> PlannedPath:
    """The path along one coarse path."""
    axle, full = compose(start, (robot.axle, 0.0, 0.0)), guidance.margin
    costs = _costs(robot, settings)
    margin = SafetyMargin(full, _start_room(field, body, axle, full), 0.1, axle[0], axle[1])
    anchors = lane_anchors(field, body, guidance.room, guidance.way, settings.room + 0.1, full)
    problem = SearchProblem(
        field,
        body,
        _aim(target, guidance, robot),
        guidance.time,
        primitives(robot),
        margin,
        costs,
        0.0,
    )
    moves, found, expansions = np.empty((0, 3)), False, 0
    for greed, limit in settings.efforts:
        moves, found, count = search(problem._replace(greed=greed), axle, anchors, limit)
        expansions += int(count)
        if found:
            break
    hurried = costs._replace(stop=0.25 * costs.stop)
    moves = shortened(field, body, axle, merged(moves), margin, hurried)
    moves = trimmed(problem.aim, axle, rounded(field, body, axle, moves, margin, costs))
    clearance = clearances(field, body, sampled(axle, moves)[0], MAX_CLEARANCE)
    complete = bool(found and guidance.exact)
    return PlannedPath(start, moves, robot.axle, complete, full, clearance, expansions)


def _aim(target: DriveTarget, guidance: Guidance, robot: RobotSpec) -> Aim:
    """The target, or a region around the place that replaces it."""
    if guidance.exact:
        return target.aim(robot)
    x, y = guidance.place
    return Aim(x, y, 0.0, max(0.3, target.position_tolerance), 0.0, True, robot.axle)


def _half_window(start: Pose, target: DriveTarget, settings: PlannerSettings) -> float:
    """Half the side of the window: wide enough for the target and a detour near it."""
    away = max(abs(target.pose[0] - start[0]), abs(target.pose[1] - start[1]))
    return min(max(settings.half_window, away + 3.0), settings.widest)


def _nearer(a: PlannedPath | None, b: PlannedPath, target: DriveTarget) -> PlannedPath:
    """Path `b` if it ends clearly nearer to the target, else `a`."""
    if a is None:
        return b
    place = target.pose[:2]
    return b if math.dist(b.end[:2], place) < math.dist(a.end[:2], place) - 0.2 else a


def primitives(robot: RobotSpec) -> FloatArray:
    """The moves that the search combines, rows as `motion.Move`, shape (P, 3)."""
    eighth, small = math.radians(15.0), math.radians(7.5)
    moves = [(0.2, 0.0, turn) for turn in (0.0, small, -small, eighth, -eighth)]
    moves += [(-0.2, 0.0, turn) for turn in (0.0, eighth, -eighth)]
    moves += [(0.0, 0.0, turn) for turn in (eighth, -eighth)]
    if robot.holonomic:
        moves += [(0.0, left, 0.0) for left in (0.15, -0.15)]
    return np.array(moves)


def _costs(robot: RobotSpec, settings: PlannerSettings) -> MotionCosts:
    return MotionCosts(
        min(settings.speed, robot.max_speed),
        settings.reverse,
        0.7 * robot.max_sideways_speed,
        min(settings.turn_rate, robot.max_turn_rate),
        settings.stop,
        settings.steering,
        settings.room,
        settings.crowding,
    )


def _start_room(field: ObstacleField, body: Footprint, axle: Pose, full: float) -> float:
    """The largest margin that is free where the robot stands, at most `full`, metres.

    Where it is smaller than `full` it is reduced by another centimetre, for noise.
    """
    margin = full
    while margin > -0.06 and not is_clear(field, body, *axle, margin):
        margin -= 0.005
    return margin if margin == full else margin - 0.01


def _without_impossible(points: FloatArray, axle: Pose, body: Footprint) -> FloatArray:
    """The points without those well inside the robot, which noise or drift must have put there."""
    c, s = math.cos(axle[2]), math.sin(axle[2])
    dx, dy = points[:, 0] - axle[0], points[:, 1] - axle[1]
    forward, left = c * dx + s * dy, c * dy - s * dx
    inside = (forward < body.front - 0.05) & (forward > 0.05 - body.rear)
    inside &= np.abs(left) < body.half_width - 0.05
    return points[~inside]


def _checked_points(points: ArrayLike) -> FloatArray:
    """The finite points, shape (N, 2)."""
    array = np.asarray(points, dtype=np.float64)
    if array.size == 0:
        return np.empty((0, 2))
    if array.ndim != 2 or array.shape[1] != 2:
        raise ValueError(f"points have shape {array.shape}; obstacle points have shape (N, 2)")
    return array[np.isfinite(array).all(axis=1)]


def _checked_pose(name: str, pose: Pose) -> Pose:
    """The pose as plain floats, the only type for which the kernels are compiled."""
    if len(pose) != 3 or not all(math.isfinite(value) for value in pose):
        raise ValueError(f"{name} is {pose}; a pose is three finite numbers (x, y, heading)")
    return float(pose[0]), float(pose[1]), float(pose[2])
