"""Random commands that can be carried out from the robot's pose."""

from __future__ import annotations

import numpy as np

from semnav_env.judge import Mission, plan_mission
from semnav_env.language import (
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
from semnav_env.mind.grounding import Goal, GroundingError, ReachGoal
from semnav_env.mind.grounding.counted_doors import doors_along
from semnav_env.mind.grounding.junctions import junctions_ahead
from semnav_env.rules import GroundingRules, Rules
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_env.world.maps.geodesic import Geodesic
from semnav_env.world.maps.placement import is_clear
from semnav_features.corridor import Corridor, corridor_at
from semnav_features.frames import Pose
from semnav_features.scene import StillScene

ALONG, TO_END = Follow(), Follow(PlaceReference(Place.END))
"""Two clauses that are drawn: go down the corridor, and go down the corridor to its end."""

TURNS = [
    [
        [Turn(turning, PlaceReference(place, ordinal)) for ordinal in (1, 1, 1, 2)]
        for place in (Place.INTERSECTION, Place.CORNER)
    ]
    for turning in (Turning.LEFT, Turning.RIGHT)
]
"""Turns that are drawn, by side, place and ordinal; an entry may occur twice to be more likely."""

DOORS = [
    [
        [GoToDoor(DoorReference(ordinal, side), how) for how in (Approach.THROUGH, Approach.TO)]
        for ordinal in (1, 1, 2, 2, 3, 4, LAST)
    ]
    for side in (Side.LEFT, Side.RIGHT)
]
"""Doors that are drawn, by side, ordinal, and whether to stop before them."""

MAX_COMMAND_DRAWS = 50
"""Largest number of commands drawn before a start pose is given up."""

GOAL_CLEARANCE = 0.3
"""Free radius that is needed around a goal, metres."""


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
        None if `MAX_COMMAND_DRAWS` draws found none.
    """
    scene = floor_plan.scene_by(rules.door)
    corridor = corridor_at(scene, start)
    for _ in range(MAX_COMMAND_DRAWS):
        clauses = _draw(rng, most_clauses)
        first = clauses[1] if clauses[0] is ALONG else clauses[0]
        if leads_nowhere(first, scene, corridor, rules.grounding):
            continue
        try:
            mission = plan_mission(floor_plan, geodesic, Command(clauses), start, rules=rules)
        except GroundingError:
            continue
        if all(_has_space(floor_plan, goal) for goal in mission.goals):
            return mission
    return None


def leads_nowhere(
    clause: Clause, scene: StillScene, corridor: Corridor, rules: GroundingRules
) -> bool:
    """Whether a corridor has too few doors or junctions for the first clause of a command.

    Grounding would also find this, but takes longer, and most drawn commands fail here.
    """
    match clause:
        case Turn(turning, PlaceReference(place, ordinal)):
            count = len(junctions_ahead(corridor, place, turning, rules))
        case GoToDoor(DoorReference(ordinal, side)):
            count = len(doors_along(scene, corridor, side, rules))
        case _:
            return False
    return count < abs(ordinal)


def _has_space(floor_plan: FloorPlan, goal: Goal) -> bool:
    """Whether a goal is free of furniture, such as a desk at the end of a lounge."""
    return not isinstance(goal, ReachGoal) or is_clear(floor_plan, goal.pose[:2], GOAL_CLEARANCE)


def _draw(rng: np.random.Generator, most_clauses: int) -> tuple[Clause, ...]:
    last = _last_clause(rng)
    turns = tuple([_turn(rng) for _ in range(rng.integers(0, most_clauses))])
    along = (ALONG,) if 0 < len(turns) < most_clauses - 1 and rng.random() < 0.3 else ()
    return (*along, *turns, last)


def _turn(rng: np.random.Generator) -> Clause:
    return TURNS[rng.integers(2)][rng.integers(2)][rng.integers(4)]


def _last_clause(rng: np.random.Generator) -> Clause:
    doors = DOORS[rng.integers(2)][rng.integers(7)]
    door = doors[rng.random() < 0.15]
    return TO_END if rng.random() < 0.15 else door
