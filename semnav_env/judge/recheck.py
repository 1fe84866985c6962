"""A second opinion: judges a recorded path by Shapely's geometry, apart from the judge.

It shares no code with the judge or with the follower, only the goals that a command has on the
true scene and the rules of docs/concepts/commands.md. It works on the whole path at once: first
where each goal is met, each door crossed and each wrong arm entered, then which came first.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import LineString, Point, Polygon
from shapely.affinity import affine_transform

from semnav_env.judge.metrics.recording import Recording
from semnav_env.language.references import Side
from semnav_env.mind.grounding.goal import Goal, PassGoal, ReachGoal, SeekGoal, StopGoal, wait_of
from semnav_env.rules import Rules, SuccessRules
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_features.corridor import Junction, SideOpening
from semnav_features.frames import FloatArray, Pose
from semnav_features.frames import Point as Position
from semnav_features.rules import DoorRules

ROUNDING = 1e-9
"""Tolerance for points on the limit of a goal, which count as inside, metres and radians."""

FAR = 1000.0
"""Longer than any building, metres."""

DONE, WRONG_DOOR, WRONG_TURN = "done", "wrong door", "wrong turn"
STOPPED_SHORT, INCOMPLETE, OUT_OF_TIME = "stopped short", "incomplete", "out of time"

Mask = NDArray[np.bool_]
Jambs: TypeAlias = tuple[Position, Position]


@dataclass(frozen=True)
class SecondOpinion:
    """The result of the second opinion on an episode.

    Attributes:
        verdict: "done", "wrong door", "wrong turn", "stopped short", "incomplete" (not along the
            wall) or "out of time".
        clauses_done: number of goals that were met, in order, before the end.
        step: row of the recording at which the episode ended; the last row if it never did.
    """

    verdict: str
    clauses_done: int
    step: int


def recheck(
    recording: Recording, floor_plan: FloorPlan, goals: Sequence[Goal], rules: Rules = Rules()
) -> SecondOpinion:
    """Judge a recorded path.

    Args:
        recording: recording of the episode; rows after its end are ignored.
        floor_plan: the truth.
        goals: the goals of the command in their order, on the true scene.
        rules: tolerances of the judge.
    """
    path = _Path(recording, rules.success)
    last = 0
    for done, goal in enumerate(goals):
        if done and wait_of(goals[done - 1]) > 0.0:
            path.count_rest_from(last)
        met = _first(path.meets(goal, last), after=last)
        failure = _first_failure(path, floor_plan, goal, last, met, done + 1 == len(goals), rules)
        if failure is not None:
            return SecondOpinion(failure[1], done, failure[0])
        if met is None:
            stands = path.standing[-1] > rules.success.final_still_seconds
            return SecondOpinion(STOPPED_SHORT if stands else OUT_OF_TIME, done, recording.steps)
        if path.strays_from_wall(goal, last, met, rules):
            return SecondOpinion(INCOMPLETE, done, met)
        last = met
    return SecondOpinion(DONE, len(goals), last)


def _first_failure(
    path: _Path,
    floor_plan: FloorPlan,
    goal: Goal,
    after: int,
    met: int | None,
    final: bool,
    rules: Rules,
) -> tuple[int, str] | None:
    """The first failure after `after`, before a goal is met or in the same step."""
    wrong_door = path.crosses_any(_forbidden(floor_plan, goal, rules.door))
    wrong_turn = path.enters(_wrong_places(goal, rules.success))
    longest = rules.success.still_seconds + wait_of(goal)
    too_still = path.standing > longest + path.period / 2
    if met is not None:
        wrong_turn[met] = False  # to arrive is never a wrong turn
        too_still[met] &= not final
    failures = (WRONG_DOOR, wrong_door), (WRONG_TURN, wrong_turn), (STOPPED_SHORT, too_still)
    steps = [(_first(mask, after), verdict) for verdict, mask in failures]
    early = [(step, v) for step, v in steps if step is not None and (met is None or step <= met)]
    return min(early, key=lambda item: item[0], default=None)


class _Path:
    """A recorded path as Shapely's geometries; masks have one value per row, the first false."""

    def __init__(self, recording: Recording, rules: SuccessRules) -> None:
        self._recording, self._rules = recording, rules
        self._points = shapely.points(recording.path)
        pairs = np.stack((recording.path[:-1], recording.path[1:]), axis=1)
        self._pieces = shapely.linestrings(pairs)
        self.period = recording.period
        rates = np.abs(recording.velocities[:, 2])
        moving = (recording.speeds >= rules.still_speed) | (rates >= rules.still_yaw_rate)
        self.standing = _lasting(~moving) * recording.period

    def count_rest_from(self, row: int) -> None:
        """Count the time at rest only from a row on, up to which the robot stood still as told."""
        since = (np.arange(len(self.standing)) - row) * self.period
        self.standing = np.where(since > 0.0, np.minimum(self.standing, since), self.standing)

    def crosses(self, door: Jambs) -> Mask:
        """At which steps the path crosses the line between two jambs, either way."""
        touched = shapely.intersects(self._pieces, LineString(door))
        left = _left_of(self._recording.path, door)
        return _later(touched & (left[1:] != left[:-1]))

    def crosses_any(self, doors: Sequence[Jambs]) -> Mask:
        """At which steps the path crosses one of some doors."""
        return np.asarray(np.logical_or.reduce([self._never(), *map(self.crosses, doors)]))

    def meets(self, goal: Goal, since: int) -> Mask:
        """At which steps a goal is met that is active since some row."""
        match goal:
            case SeekGoal():
                return self._never()
            case StopGoal():
                return self._stands(goal, since)
            case PassGoal(door=door):
                jambs = door.start, door.end
                beyond = _left_of(np.array([goal.pose[:2]]), jambs)
                inside = _left_of(self._recording.path, jambs) == beyond
                return np.asarray(self.crosses(jambs) & inside)
            case ReachGoal():
                return self._arrives(goal)

    def _never(self) -> Mask:
        return np.zeros(len(self._recording.path), dtype=bool)

    def _stands(self, goal: StopGoal, since: int) -> Mask:
        slow: Mask = np.asarray(self._recording.speeds < self._rules.standstill_speed)
        slow[: since + 1] = False
        return np.asarray(slow & (_lasting(slow) * self.period >= goal.wait - 1e-6))

    def _arrives(self, goal: ReachGoal) -> Mask:
        reach, side = goal.distance_tolerance + ROUNDING, goal.offset_tolerance
        if side is not None:
            there = _placed(goal.pose, shapely.box(-reach, -side, reach, side))
            near = np.asarray(shapely.covers(there, self._points))
        else:
            near = shapely.distance(self._points, Point(goal.pose[:2])) <= reach
        turned = np.angle(np.exp(1j * (self._recording.poses[:, 2] - goal.pose[2])))
        aligned = np.abs(turned) <= goal.heading_tolerance + ROUNDING
        facing = aligned | (goal.heading_tolerance >= np.pi)
        return _later((near & facing)[1:])

    def strays_from_wall(self, goal: Goal, since: int, until: int, rules: Rules) -> bool:
        """Whether too little of the way between two rows leads along the wall of a goal."""
        hallway = goal.corridor
        least = rules.grounding.wall_distance + rules.success.wall_room
        if goal.wall is None or hallway is None or hallway.half_width < least:
            return False
        pieces, half = self._pieces[since:until], hallway.half_width
        end = max(x for x, y in _seen_from(hallway.frame, goal.places) if abs(y) < half)
        left = _placed(hallway.frame, shapely.box(-FAR, 0.0, end, half))
        right = _placed(hallway.frame, shapely.box(-FAR, -half, end, 0.0))
        beside, opposite = (left, right) if goal.wall is Side.LEFT else (right, left)
        near, far = (
            shapely.length(shapely.intersection(pieces, side)) for side in (beside, opposite)
        )
        so_far = np.cumsum(near + far) - rules.success.wall_entry
        way, beside_wall = so_far[-1], near[so_far > 0.0].sum()
        limits = rules.success
        return bool(way >= limits.wall_least and beside_wall < limits.wall_share * way)

    def enters(self, places: Sequence[Polygon]) -> Mask:
        """At which steps the robot's centre is inside one of some places."""
        if not places:
            return self._never()
        inside = shapely.contains_properly(np.array(places)[:, None], self._points)
        anywhere: Mask = np.asarray(np.any(inside, axis=0))
        return _later(anywhere[1:])


def _left_of(path: FloatArray, door: Jambs) -> Mask:
    """Mask of the points to the left of a directed line."""
    line = np.broadcast_to(np.array(door), (len(path), 2, 2))
    rings = np.concatenate((line, path[:, None], line[:, :1]), axis=1)
    return np.asarray(shapely.is_ccw(shapely.linearrings(rings)))


def _forbidden(floor_plan: FloorPlan, goal: Goal, rules: DoorRules) -> list[Jambs]:
    """The doors that must not be crossed: not the goal's, nor on a known way, nor too wide."""
    if isinstance(goal, StopGoal) and goal.roams:
        return []
    own = goal.door.name if isinstance(goal, PassGoal) else None
    way = LineString(goal.places) if len(goal.places) > 1 else LineString()
    doors = [door for door in floor_plan.doors if door.name != own and not door.is_opening(rules)]
    jambs = [(door.start, door.end) for door in doors]
    return [door for door in jambs if not way.intersects(LineString(door))]


def _wrong_places(goal: Goal, rules: SuccessRules) -> list[Polygon]:
    """The places of wrong turns: arms that are not named, and the corridor behind the junction."""
    if goal.corridor is None:
        return []
    frame, named = goal.corridor.frame, _named_arm(goal)
    boxes = [
        _arm(opening, rules.wrong_arm_depth)
        for junction in goal.corridor.junctions
        for opening in junction.openings
        if opening is not named and opening.far > rules.passed_arm_distance
    ]
    if isinstance(goal, ReachGoal) and goal.junction is not None:
        missed = goal.junction.far + rules.missed_turn_distance
        boxes.append(shapely.box(missed, -FAR, FAR, FAR))
    return [_placed(frame, box) for box in boxes]


def _named_arm(goal: Goal) -> SideOpening | None:
    """The arm of the goal's junction that the goal lies in."""
    if not isinstance(goal, ReachGoal) or goal.corridor is None or goal.junction is None:
        return None
    frame, there = goal.corridor.frame, Point(goal.pose[:2])
    junction: Junction = goal.junction
    return min(junction.openings, key=lambda arm: _placed(frame, _arm(arm, 0.0)).distance(there))


def _arm(opening: SideOpening, depth: float) -> Polygon:
    """The part of an arm that lies at least `depth` inside it, in the corridor's frame."""
    near = opening.offset + depth
    low, high = (near, FAR) if opening.left else (-FAR, -near)
    return shapely.box(opening.near, low, opening.far, high)


def _placed(frame: Pose, polygon: Polygon) -> Polygon:
    c, s = np.cos(frame[2]), np.sin(frame[2])
    return affine_transform(polygon, (c, -s, s, c, frame[0], frame[1]))


def _seen_from(frame: Pose, places: Sequence[Position]) -> FloatArray:
    """Places in a frame, shape (n, 2)."""
    c, s = np.cos(frame[2]), np.sin(frame[2])
    return np.asarray((np.array(places) - frame[:2]) @ np.array([[c, -s], [s, c]]))


def _lasting(mask: Mask) -> NDArray[np.int64]:
    """Number of rows for which a mask has been true at each row; the first does not count."""
    rows = np.arange(len(mask))
    false = ~mask | (rows == 0)
    return np.asarray(rows - np.maximum.accumulate(np.where(false, rows, 0)))


def _first(mask: Mask, after: int) -> int | None:
    """The first true row after `after`."""
    rows = np.flatnonzero(mask[after + 1 :])
    return int(rows[0]) + after + 1 if len(rows) else None


def _later(mask: Mask) -> Mask:
    """Turn one value per step into one per row; the row of the start is False."""
    return np.concatenate(([False], mask))
