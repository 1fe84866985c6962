"""From a clause and a scene to a goal; one implementation for perceived and true scenes."""

from __future__ import annotations

from semnav_env.commands.clauses import Clause, Follow, GoToDoor, Stop, Turn
from semnav_env.features.frames import Pose
from semnav_env.features.scene import Scene
from semnav_env.grounding.doors import ground_door
from semnav_env.grounding.goal import Goal, GoalKind
from semnav_env.grounding.junctions import ground_follow, ground_turn
from semnav_env.grounding.situation import Situation


def ground(
    clause: Clause,
    scene: Scene,
    begin: Pose,
    pose: Pose | None = None,
    *,
    complete: bool = False,
    after_hallway: bool = False,
) -> Goal:
    """Find what a clause refers to.

    Args:
        clause: one clause of a command.
        scene: remembered or true walls and doors, any frame.
        begin: where the robot was when the clause began, in the scene's frame.
        pose: how far it has come since then; `begin` if not given.
        complete: the scene holds everything there is, so there is nothing to look for.
        after_hallway: the clause follows "go down the hallway", so a bare turn means the next
            place that offers it.

    Returns:
        The goal in the scene's frame. Its kind is SEEK while the referent is not seen yet.

    Raises:
        GroundingError: the referent cannot be there; the message says what is.
    """
    situation = Situation(scene, begin, begin if pose is None else pose, complete, after_hallway)
    match clause:
        case GoToDoor():
            return ground_door(clause, situation)
        case Turn():
            return ground_turn(clause, situation)
        case Follow():
            return ground_follow(clause, situation)
        case Stop():
            return Goal(GoalKind.STOP, situation.pose, because="stop here")
