"""Turns a clause and a scene into a goal; one implementation for perceived and true scenes."""

from __future__ import annotations

from semnav_env.language.clauses import (
    Approach,
    BackUp,
    Clause,
    Face,
    Follow,
    GoBack,
    GoToDoor,
    GoToRoom,
    IfThere,
    Leave,
    Pace,
    Stop,
    Turn,
)
from semnav_env.language.command import reference_of
from semnav_env.language.finding_clauses import FindingClause
from semnav_env.language.references import ENTRY, DoorReference, PlaceOffset, RoomReference
from semnav_env.language.told import Told, told
from semnav_env.mind.grounding.corridor_goals import follow_goal, turn_goal
from semnav_env.mind.grounding.errors import GroundingError
from semnav_env.mind.grounding.goal import Goal, StopGoal
from semnav_env.mind.grounding.goals import door_goal, leave_goal, search_goal, way_goal
from semnav_env.mind.grounding.own_clause import GroundedClause
from semnav_env.mind.grounding.search import Searching
from semnav_env.mind.grounding.situation import Situation
from semnav_env.mind.grounding.ways import Way
from semnav_env.rules import Rules
from semnav_features.frames import Pose
from semnav_features.scene import Scene


def ground(
    clause: Clause,
    scene: Scene,
    begin: Pose,
    pose: Pose | None = None,
    *,
    complete: bool = False,
    after_corridor: bool = False,
    way: Way | None = None,
    rules: Rules = Rules(),
) -> Goal:
    """Find the referent of a clause, and return its goal.

    Args:
        clause: one clause of a command.
        scene: remembered or true walls and doors, any frame.
        begin: pose of the robot when the clause began, in the scene's frame.
        pose: pose of the robot now, in the scene's frame; `begin` if not given.
        complete: whether the scene is complete, so that no search is needed.
        after_corridor: whether the clause follows "go down the hallway"; a turn without a place is
            then made at the next place that allows it.
        way: way to the room that the clause names, or back, in the scene's frame.
        rules: distances and tolerances.

    Returns:
        The goal in the scene's frame; a `SeekGoal` while the referent has not been seen.

    Raises:
        GroundingError: the referent cannot be there; the message says what is there.
        ValueError: a door of the scene has no width, and another door may lie behind it.
    """
    here = begin if pose is None else pose
    wall = clause.along if isinstance(clause, Follow) else None
    situation = Situation(scene, begin, here, complete, after_corridor, way, wall=wall, rules=rules)
    return goal_of(clause, situation)


def goal_of(clause: Clause, situation: Situation) -> Goal:
    """The goal of a clause in a situation; see `ground`.

    Raises:
        GroundingError: the referent cannot be there, or the clause is a condition.
    """
    situation = situation.towards(reference_of(clause))
    goal = _goal_of(clause, situation)
    if situation.wall is None:
        return goal
    from semnav_env.mind.grounding.along_wall import kept_along  # here, as it is rare

    return kept_along(goal, situation.wall, situation)


def _goal_of(clause: Clause, situation: Situation) -> Goal:
    """The goal of a clause, wherever in the hallway the robot is to keep."""
    match reference_of(clause):
        case DoorReference(to=RoomReference()) as reference if not isinstance(clause, Face):
            return _goal_by_room(clause, reference, situation)
    return _goal_in_hallway(clause, situation)


def _goal_by_room(clause: Clause, reference: DoorReference, situation: Situation) -> Goal:
    """The goal of a clause with a door beside or before a named room, to which a way leads."""
    from semnav_env.mind.grounding.room_hallway import hallway_of, led_along  # here, as it is rare

    hallway = hallway_of(reference, situation)
    if isinstance(hallway, Searching):
        return search_goal(hallway)
    goal = _goal_in_hallway(clause, hallway)
    if hallway is situation or situation.way is None or not situation.complete:
        return goal  # a robot that is in the hallway needs no way
    return led_along(goal, situation.way, hallway)


def _goal_in_hallway(clause: Clause, situation: Situation) -> Goal:
    match clause:
        case GoToDoor(DoorReference(ordinal), Approach.THROUGH) if (
            ordinal == ENTRY and situation.entry is None
        ):
            return leave_goal(situation)
        case GoToDoor():
            return door_goal(clause, situation)
        case Turn():
            return turn_goal(clause, situation)
        case Follow(PlaceOffset() as offset):
            from semnav_env.mind.grounding.offset_goals import offset_goal  # here, as it is rare

            return offset_goal(offset, situation)
        case Follow(RoomReference()) | Face():
            from semnav_env.mind.grounding.landmark_goals import (
                landmark_goal,  # here, as it is rare
            )

            return landmark_goal(clause, situation)
        case Follow():
            return follow_goal(clause, situation)
        case Leave():
            return leave_goal(situation)
        case GoToRoom() | GoBack():
            return way_goal(clause, situation)
        case BackUp():
            from semnav_env.mind.grounding.backing_up import backing_up_goal  # here, as it is rare

            return backing_up_goal(clause, situation)
        case IfThere():
            raise GroundingError(Told("{what}: a condition leads nowhere by itself", what=clause))
        case Pace():
            raise GroundingError(Told("{what}: a pace leads nowhere by itself", what=clause))
        case FindingClause():
            from semnav_env.mind.grounding.finding_goals import finding_goal  # here, as it is rare

            return finding_goal(clause, situation)
        case Stop():
            return StopGoal(situation.begin, told(clause), float(clause.seconds))
        case GroundedClause():
            return clause.goal(situation)
    raise TypeError(f"{clause!r} is no clause")
