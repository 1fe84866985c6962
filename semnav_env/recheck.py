"""A second opinion: judges a recorded path by Shapely's geometry, apart from the verifier.

It shares no code with the verifier or with the follower, only the goals that a command has on the
true scene and the rules of docs/commands.md. It works on the whole path at once: first where each
goal is met, each door crossed and each wrong arm entered, then which came first.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import LineString, Point, Polygon
from shapely.affinity import affine_transform

from semnav_env.features.frames import FloatArray, Pose
from semnav_env.features.frames import Point as Position
from semnav_env.features.hallway import Junction, Opening
from semnav_env.grounding.goal import Goal, GoalKind
from semnav_env.maps.floor_plan import FloorPlan
from semnav_env.metrics.recording import Recording

INSIDE_ARM, BEHIND_JUNCTION = 1.2, 2.4
"""So far inside an arm that is not named, or behind the junction that is, is a wrong turn, m."""

ARM_AHEAD = 0.5
"""Arms whose far edge is no farther ahead than this do not count, metres."""

AT_REST, STILL_SPEED, STILL_RATE = 0.05, 0.02, 0.02
"""A "stop" is done below the first, m/s; the robot stands still below the others, m/s, rad/s."""

LONGEST_STAND, SHORT_STAND = 10.0, 1.0
"""Standing still for longer, or for longer at the very end, is stopping short, seconds."""

FAR = 1000.0
"""Longer than any building, metres."""

DONE, WRONG_DOOR, WRONG_TURN = "done", "wrong door", "wrong turn"
STOPPED_SHORT, OUT_OF_TIME = "stopped short", "out of time"

Mask = NDArray[np.bool_]


@dataclass(frozen=True)
class Finding:
    """What the second opinion says.

    Attributes:
        verdict: "done", "wrong door", "wrong turn", "stopped short" or "out of time".
        clauses_done: how many goals were met, in order, before it was over.
        step: row of the recording at which it was over; its last one if it never was.
    """

    verdict: str
    clauses_done: int
    step: int


def recheck(recording: Recording, floor_plan: FloorPlan, goals: Sequence[Goal]) -> Finding:
    """Judge a recorded path.

    Args:
        recording: of the episode; what comes after its end is not looked at.
        floor_plan: the truth.
        goals: what the command asks for, one after the other, on the true scene.
    """
    path = _Path(recording)
    crossings = {door.name: path.crosses(door.start, door.end) for door in floor_plan.doors}
    short = _stood_too_long(recording)
    last = 0
    for done, goal in enumerate(goals):
        met = _first(path.meets(goal), after=last)
        until = recording.steps if met is None else met
        own = goal.door.name if goal.kind is GoalKind.PASS and goal.door is not None else None
        others = [mask for name, mask in crossings.items() if name != own]
        wrong_door = np.logical_or.reduce([*others, np.zeros(recording.steps + 1, dtype=bool)])
        wrong_turn = path.enters(_wrong_places(goal))
        if met is not None:
            wrong_turn[met] = False  # to arrive is never a wrong turn
            short[met] &= done + 1 < len(goals)
        failures = (WRONG_DOOR, wrong_door), (WRONG_TURN, wrong_turn), (STOPPED_SHORT, short)
        steps = [(_first(mask, after=last), verdict) for verdict, mask in failures]
        early = [(step, verdict) for step, verdict in steps if step is not None and step <= until]
        if early:
            step, verdict = min(early, key=lambda item: item[0])
            return Finding(verdict, done, step)
        if met is None:
            stands = _standing(recording)[-1] > SHORT_STAND
            return Finding(STOPPED_SHORT if stands else OUT_OF_TIME, done, recording.steps)
        last = met
    return Finding(DONE, len(goals), last)


class _Path:
    """A recorded path as Shapely's geometries; masks have one value per row, the first false."""

    def __init__(self, recording: Recording) -> None:
        self._recording = recording
        self._points = shapely.points(recording.path)
        pairs = np.stack((recording.path[:-1], recording.path[1:]), axis=1)
        self._pieces = shapely.linestrings(pairs)

    def crosses(self, start: Position, end: Position) -> Mask:
        """At which steps the path crosses the line between two jambs, either way."""
        line = LineString((start, end))
        touched = shapely.intersects(self._pieces, line)
        left = _left_of(self._recording.path, start, end)
        return _later(touched & (left[1:] != left[:-1]))

    def meets(self, goal: Goal) -> Mask:
        """At which steps a goal is met, whatever was before."""
        recording = self._recording
        if goal.kind is GoalKind.STOP:
            return _later(recording.speeds[1:] < AT_REST)
        if goal.kind is GoalKind.PASS and goal.door is not None:
            start, end = goal.door.start, goal.door.end
            beyond = _left_of(np.array([goal.pose[:2]]), start, end)
            there = _left_of(recording.path, start, end) == beyond
            return np.asarray(self.crosses(start, end) & there)
        near = shapely.distance(self._points, Point(goal.pose[:2])) <= goal.distance_tolerance
        turned = np.angle(np.exp(1j * (recording.poses[:, 2] - goal.pose[2])))
        facing = (np.abs(turned) <= goal.heading_tolerance) | (goal.heading_tolerance >= np.pi)
        return _later((near & facing)[1:])

    def enters(self, places: Sequence[Polygon]) -> Mask:
        """At which steps the robot's centre is inside one of some places."""
        if not places:
            return np.zeros(len(self._points), dtype=bool)
        inside = shapely.contains_properly(np.array(places)[:, None], self._points)
        return _later(inside.any(axis=0)[1:])


def _left_of(path: FloatArray, start: Position, end: Position) -> Mask:
    """Which points lie to the left of a line: with it they go round counter-clockwise."""
    line = np.broadcast_to(np.array((start, end)), (len(path), 2, 2))
    rings = np.concatenate((line, path[:, None], line[:, :1]), axis=1)
    return np.asarray(shapely.is_ccw(shapely.linearrings(rings)))


def _wrong_places(goal: Goal) -> list[Polygon]:
    """Where the robot has gone astray: arms that are not named, and far behind the junction."""
    if goal.hallway is None:
        return []
    frame, named = goal.hallway.frame, _named_arm(goal)
    boxes = [
        _arm(opening, INSIDE_ARM)
        for junction in goal.hallway.junctions
        for opening in junction.openings
        if opening is not named and opening.far > ARM_AHEAD
    ]
    if goal.junction is not None:
        boxes.append(shapely.box(goal.junction.far + BEHIND_JUNCTION, -FAR, FAR, FAR))
    return [_placed(frame, box) for box in boxes]


def _named_arm(goal: Goal) -> Opening | None:
    """The arm of the goal's junction that the goal lies in."""
    if goal.hallway is None or goal.junction is None:
        return None
    frame, there = goal.hallway.frame, Point(goal.pose[:2])
    junction: Junction = goal.junction
    return min(junction.openings, key=lambda arm: _placed(frame, _arm(arm, 0.0)).distance(there))


def _arm(opening: Opening, depth: float) -> Polygon:
    """What lies at least `depth` inside an arm, in the hallway's frame."""
    near = opening.offset + depth
    low, high = (near, FAR) if opening.left else (-FAR, -near)
    return shapely.box(opening.near, low, opening.far, high)


def _placed(frame: Pose, polygon: Polygon) -> Polygon:
    c, s = np.cos(frame[2]), np.sin(frame[2])
    return affine_transform(polygon, (c, -s, s, c, frame[0], frame[1]))


def _stood_too_long(recording: Recording) -> Mask:
    """At which steps the robot has stood still for too long."""
    return _standing(recording) > LONGEST_STAND + recording.period / 2


def _standing(recording: Recording) -> NDArray[np.float64]:
    """For how long the robot has been standing still at each row, seconds."""
    rates = np.abs(recording.velocities[:, 2])
    moving = (recording.speeds >= STILL_SPEED) | (rates >= STILL_RATE)
    moving[0] = True
    rows = np.arange(len(moving))
    since = np.maximum.accumulate(np.where(moving, rows, 0))
    return np.asarray((rows - since) * recording.period)


def _first(mask: Mask, after: int) -> int | None:
    """The first true row behind `after`."""
    rows = np.flatnonzero(mask[after + 1 :])
    return int(rows[0]) + after + 1 if len(rows) else None


def _later(mask: Mask) -> Mask:
    """One value per row from one per step: nothing has happened at the start."""
    return np.concatenate(([False], mask))
