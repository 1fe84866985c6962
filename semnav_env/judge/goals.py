"""The goals of a command on the true scene."""

from __future__ import annotations

from collections.abc import Iterator

import shapely

from semnav_env.judge.routes.room_guide import RoomGuide
from semnav_env.language import Command
from semnav_env.language.told import Told
from semnav_env.mind.grounding.errors import GroundingError
from semnav_env.mind.grounding.follower import Follower
from semnav_env.mind.grounding.goal import Goal, PassGoal, ReachGoal, SeekGoal
from semnav_env.mind.grounding.ways import Guide
from semnav_env.rules import Rules
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_features.frames import Point, Pose
from semnav_features.scene import Scene


def plan_goals(
    floor_plan: FloorPlan,
    command: Command,
    start: Pose,
    guide: Guide | None = None,
    rules: Rules = Rules(),
) -> tuple[Goal, ...]:
    """The goals of a command on the true scene, each grounded where the one before ends.

    Args:
        floor_plan: the truth.
        command: what to do.
        start: pose of the robot's centre, world frame.
        guide: points out the ways to rooms; a `RoomGuide` of the floor plan if not given.
        rules: distances and tolerances.

    Raises:
        GroundingError: a clause cannot be carried out; of several, the message says which.
    """
    return tuple(goal for _, goal in goals_in_turn(floor_plan, command, start, guide, rules))


def goals_in_turn(
    floor_plan: FloorPlan,
    command: Command,
    start: Pose,
    guide: Guide | None = None,
    rules: Rules = Rules(),
    scene: Scene | None = None,
) -> Iterator[tuple[int, Goal]]:
    """Yield each goal with the index of its clause; an error comes after the goals before it.

    The arguments are those of `plan_goals`, and another scene in place of the plan's own.
    """
    guide = RoomGuide(floor_plan, command) if guide is None else guide
    follower = Follower(command, complete=True, guide=guide, rules=rules)
    scene = floor_plan.scene_by(rules.door) if scene is None else scene
    try:
        follower.start(scene, start)
        while not follower.done:
            check_grounded(follower)
            _check_inside(follower.goal, floor_plan)
            if follower.leads_in:
                follower.skip_to_next(scene)
            yield follower.active, follower.goal
            follower.skip_to_next(scene)
    except GroundingError as error:
        if len(command.clauses) == 1:
            raise
        from semnav_env.mind.grounding.clause_error import ClauseError  # few commands need it

        raise ClauseError(command, follower.active, error.reason) from None


def check_grounded(follower: Follower) -> None:
    """Refuse the active clause if the true scene does not have its referent.

    Raises:
        GroundingError: says what is missing.
    """
    if follower.impossible is not None:
        raise GroundingError(follower.impossible)
    if isinstance(follower.goal, SeekGoal):
        raise GroundingError(
            Told("{what}: the floor plan shows none there", what=follower.goal.what)
        )


def _check_inside(goal: Goal, floor_plan: FloorPlan) -> None:
    """Refuse a goal that no pose in the plan reaches.

    For a robot that stands across a corridor, the end of another corridor can look like a corner.

    Raises:
        GroundingError: says where the goal leads.
    """
    if isinstance(goal, ReachGoal):
        away = floor_plan.boundary.distance(shapely.Point(goal.pose[:2]))
        if away > goal.distance_tolerance:
            leads_out = Told(
                "{what}: that leads out of {plan}", what=goal.because, plan=floor_plan.name
            )
            raise GroundingError(leads_out)


def place(goal: Goal) -> Point:
    """The point that a goal leads to: the middle of the doorway to cross, else its pose."""
    return goal.door.midpoint if isinstance(goal, PassGoal) else goal.pose[:2]
