"""From a clause and a scene to a goal; one implementation for perceived and true scenes."""

from __future__ import annotations

from semnav_env.commands.clauses import (
    Clause,
    Follow,
    GoBack,
    GoToDoor,
    GoToRoom,
    Leave,
    Stop,
    Turn,
)
from semnav_env.features.frames import Pose
from semnav_env.features.scene import Scene
from semnav_env.grounding.doors import ground_door, ground_leave
from semnav_env.grounding.goal import Goal, GoalKind
from semnav_env.grounding.junctions import ground_follow, ground_turn
from semnav_env.grounding.situation import GroundingError, Situation

NOT_YET: dict[type[Clause], str] = {
    Stop: 'how long is not minded yet; say "stop"',
    GoToRoom: 'names cannot be seen; name a door, for example "the second door on the left"',
    GoBack: 'the way back is not found yet; say "turn around" and what to do then',
}
"""What is understood but not carried out, and what would be."""


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
        case Leave():
            return ground_leave(situation)
        case Stop(0):
            return Goal(GoalKind.STOP, situation.pose, because="stop here")
        case Stop() | GoToRoom() | GoBack():
            raise GroundingError(f"{clause}: {NOT_YET[type(clause)]}")
    raise TypeError(f"{clause!r} is no clause")
