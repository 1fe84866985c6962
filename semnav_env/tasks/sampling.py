"""Random commands that make sense where the robot stands."""

from __future__ import annotations

import numpy as np

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
from semnav_env.features.frames import Pose
from semnav_env.grounding import Goal, GroundingError, ReachGoal
from semnav_env.maps.floor_plan import FloorPlan
from semnav_env.maps.geodesic import Geodesic
from semnav_env.maps.placement import is_clear
from semnav_env.rules import Rules
from semnav_env.verifier import Mission, plan_mission

TRIES = 50
"""Commands drawn before a start pose is given up."""

SPACE = 0.3
"""Around a place to go to, metres."""


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
