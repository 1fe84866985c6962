"""Random starts, and random commands that make sense where the robot stands."""

from __future__ import annotations

import math
from itertools import count

import numpy as np
from numpy.typing import NDArray

from semnav_env.commands import (
    LAST,
    Approach,
    Clause,
    Command,
    DoorReference,
    Follow,
    GoToDoor,
    Place,
    PlaceReference,
    Side,
    Turn,
    Turning,
)
from semnav_env.features.corridor import CorridorAxis, openings_at
from semnav_env.features.frames import FloatArray, Pose, wrap_angle
from semnav_env.features.kernels.compiling import kernel
from semnav_env.features.kernels.corridor_survey import axis_along, axis_heading
from semnav_env.grounding import Goal, GroundingError, ReachGoal
from semnav_env.maps.floor_plan import FloorPlan
from semnav_env.maps.geodesic import Geodesic
from semnav_env.maps.placement import is_clear, placement_error, sample_pose, uniform
from semnav_env.robots import RobotSpec
from semnav_env.rules import Rules
from semnav_env.verifier import Mission, plan_mission

TRIES = 50
"""Commands drawn before a start pose is given up."""

SPACE = 0.3
"""Around a place to go to, metres."""


START_TRIES = 200
"""Start poses that are drawn before any free pose is taken."""

LEAST_AHEAD, WIDEST_HALF = 3.0, 1.5
"""A random start has at least this length of corridor ahead, and the corridor is at most this half
width wide, metres, if there is any such place."""

OUTSIDE = 0.6
"""Least distance between a random start and a junction along the corridor, metres: half a body."""

ABEAM, ASIDE = 0.9, 2.0
"""No door's midpoint is within these distances of a random start, along its heading and across it,
metres."""


def sample_start(
    floor_plan: FloorPlan, robot: RobotSpec, rng: np.random.Generator, rules: Rules = Rules()
) -> Pose:
    """A free pose in a corridor, looking along it; not across it, in a junction or by a door."""
    corridors = floor_plan.corridors
    region = corridors[rng.integers(len(corridors))] if corridors else None
    scene, counted = floor_plan.scene, floor_plan.scene_by(rules.door).door_ends
    bounds = scene.wall_ends, scene.door_ends, scene.named_doors
    for attempt in count():
        pose = sample_pose(floor_plan, robot, rng, region)
        seen = CorridorAxis(*_seen_from_start(*bounds, counted, pose, uniform(rng, -0.2, 0.2)))
        start = seen.frame
        fits = leads_on(seen) and not in_junction(floor_plan, start)
        if (fits or attempt >= START_TRIES) and placement_error(floor_plan, robot, start) is None:
            return start
    raise AssertionError("count() never ends")


def leads_on(seen: CorridorAxis) -> bool:
    """Whether a corridor is one that one would speak of, rather than the wall of one."""
    return seen.end > LEAST_AHEAD and seen.half_width < WIDEST_HALF


def in_junction(floor_plan: FloorPlan, pose: Pose) -> bool:
    """Whether a junction, seen along or against the heading, lies beside a robot at a pose.

    Its mouth can then be out of the lidar's sight, so that a robot counts it for nothing while who
    knows the plan takes it for the first.
    """
    x, y, heading = pose
    views = (openings_at(floor_plan.scene, (x, y, heading + turn)) for turn in (0.0, math.pi))
    return any(mouth.near < OUTSIDE and mouth.far > -OUTSIDE for view in views for mouth in view)


@kernel(counts_references=True)
def _seen_from_start(
    walls: FloatArray,
    doors: FloatArray,
    certain: NDArray[np.bool_],
    counted: FloatArray,
    pose: Pose,
    turn: float,
) -> tuple[Pose, float, float]:
    """Turn a pose along the corridor there, and look how wide that is and how far it goes.

    Args:
        walls: that bound the corridor, as for `survey`, and so on.
        doors: likewise.
        certain: likewise.
        counted: the doors that count, shape (k, 4), metres.
        pose: metres and radians.
        turn: between the corridor's axis and the start, radians.

    Returns:
        The start; the corridor's half width, and where it ends along its axis, metres: at 0 where
        a door lies beside the start, for then it does not matter.
    """
    x, y, _ = pose
    solid, axis = axis_heading(walls, doors, certain, pose)
    heading = wrap_angle(wrap_angle(axis) + turn)
    if _is_beside_door(counted, x, y, heading):
        return (x, y, heading), 0.0, 0.0
    _, _, end, left, right, _ = axis_along(solid, x, y, axis)
    return (x, y, heading), 0.5 * (left + right), end


@kernel
def _is_beside_door(doors: FloatArray, x: float, y: float, heading: float) -> bool:
    """Whether a door lies right beside a robot at a pose.

    One jamb can then be out of the lidar's sight, so that a robot does not make out what who knows
    the plan counts, or just does not count.
    """
    c, s = math.cos(heading), math.sin(heading)
    for x1, y1, x2, y2 in doors:
        dx, dy = (x1 + x2) / 2 - x, (y1 + y2) / 2 - y
        if abs(c * dx + s * dy) < ABEAM and abs(c * dy - s * dx) < ASIDE:
            return True
    return False


def sample_mission(
    floor_plan: FloorPlan,
    geodesic: Geodesic,
    start: Pose,
    rng: np.random.Generator,
    most_clauses: int = 3,
    rules: Rules = Rules(),
) -> Mission | None:
    """A random command of one to `most_clauses` clauses that can be carried out from `start`.

    Returns:
        None if `TRIES` draws found none.
    """
    for _ in range(TRIES):
        command = _draw(rng, most_clauses)
        try:
            mission = plan_mission(floor_plan, geodesic, command, start, rules=rules)
        except GroundingError:
            continue
        if all(_has_space(floor_plan, goal) for goal in mission.goals):
            return mission
    return None


def _has_space(floor_plan: FloorPlan, goal: Goal) -> bool:
    """Whether no desk stands where a robot is told to be: at the end of a lounge, say."""
    return not isinstance(goal, ReachGoal) or is_clear(floor_plan, goal.pose[:2], SPACE)


def _draw(rng: np.random.Generator, most_clauses: int) -> Command:
    last = _last_clause(rng)
    turns = tuple(_turn(rng) for _ in range(int(rng.integers(0, most_clauses))))
    along = (Follow(),) if 0 < len(turns) < most_clauses - 1 and rng.random() < 0.3 else ()
    return Command((*along, *turns, last))


def _turn(rng: np.random.Generator) -> Clause:
    turning = (Turning.LEFT, Turning.RIGHT)[rng.integers(2)]
    place = (Place.INTERSECTION, Place.CORNER)[rng.integers(2)]
    return Turn(turning, PlaceReference(place, (1, 1, 1, 2)[rng.integers(4)]))


def _last_clause(rng: np.random.Generator) -> Clause:
    side = (Side.LEFT, Side.RIGHT)[rng.integers(2)]
    ordinal = (1, 1, 2, 2, 3, 4, LAST)[rng.integers(7)]
    approach = Approach.TO if rng.random() < 0.15 else Approach.THROUGH
    if rng.random() < 0.15:
        return Follow(PlaceReference(Place.END))
    return GoToDoor(DoorReference(ordinal, side), approach)
