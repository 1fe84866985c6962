"""What clauses mean on scenes made by hand."""

from __future__ import annotations

import math

from semnav_env.language import Clause, parse
from semnav_env.mind.grounding import Goal, ground
from semnav_env.mind.grounding.goal import door_of
from semnav_features.frames import Pose
from semnav_features.scene import Scene
from tests.support.hand_made import corridor

START: Pose = (0.0, 0.0, 0.0)
QUARTER = math.pi / 2
DOORS = corridor(left=(2.0, 5.0, 9.0), right=(5.0, 7.0), end_door=True)


def clause(text: str) -> Clause:
    (only,) = parse(text).clauses
    return only


def goal_of(text: str, scene: Scene, begin: Pose = START, after_corridor: bool = False) -> Goal:
    """The goal on a scene that is wholly known."""
    return ground(clause(text), scene, begin, complete=True, after_corridor=after_corridor)


def middle(goal: Goal) -> float:
    door = door_of(goal)
    assert door is not None
    return door.midpoint[0]
