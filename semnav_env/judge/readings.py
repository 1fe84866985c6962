"""Plausible readings of a floor plan: an opening about as wide as a door may be one or not.

Whoever sees or remembers an opening 1.25 m wide may count it as a door or go past it as a mere
opening, and nobody is wrong. So a command has a set of right answers, one for each reading of the
plan. A reading in which the command cannot be carried out is not what its speaker has in mind.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

from semnav_env.judge.goals import goals_in_turn
from semnav_env.judge.routes.room_guide import RoomGuide
from semnav_env.language import Command
from semnav_env.mind.grounding.errors import GroundingError
from semnav_env.mind.grounding.goal import Goal, PassGoal, ReachGoal
from semnav_env.mind.grounding.ways import Way
from semnav_env.rules import Rules
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_env.world.maps.geodesic import Geodesic
from semnav_features.frames import Pose

SAME_SHARE = 0.5
"""Share of the judge's tolerances within which two goals are the same."""


class Answer(NamedTuple):
    """What a command means in one reading of a floor plan.

    Attributes:
        plan: the reading.
        goals: of the clauses, each grounded where the one before ends.
        ways: to the rooms that the command names, by the number of the clause, world frame.
    """

    plan: FloorPlan
    goals: tuple[Goal, ...]
    ways: Mapping[int, Way]


@dataclass(eq=False)
class PlanReadings:
    """The readings of a floor plan by some rules: the usual one, and one for each doubtful opening.

    In each of the others a single opening is taken otherwise: two at once added no right answer to
    105 commands on real floors (docs/lab/buildings.md).

    Attributes:
        plan: the floor plan, in which widths tell what is a door.
        rules: widths of doors, and how far the doubt goes.
    """

    plan: FloorPlan
    rules: Rules

    def __iter__(self) -> Iterator[FloorPlan]:
        """The readings, the usual one first."""
        return iter((self.plan, *self._others))

    @cached_property
    def _others(self) -> tuple[FloorPlan, ...]:
        rules, doubt = self.rules.door, self.rules.success.door_doubt
        doubtful = (door.name for door in self.plan.doors if door.is_doubtful(rules, doubt))
        return tuple(map(self._otherwise, doubtful))

    def _otherwise(self, name: str) -> FloorPlan:
        """The plan with one opening taken for a door if it does not count as one, or for none."""
        doors = [
            replace(door, is_door=not door.counts(self.rules.door)) if door.name == name else door
            for door in self.plan.doors
        ]
        return replace(self.plan, doors=tuple(doors))


def readings(plan: FloorPlan, rules: Rules = Rules()) -> PlanReadings:
    """The readings of a floor plan, made once for each set of rules."""
    known = plan.derived(_known_readings)
    if rules not in known:
        known[rules] = PlanReadings(plan, rules)
    return known[rules]


def _known_readings(plan: FloorPlan) -> dict[Rules, PlanReadings]:
    return {}


def answers(
    plan: FloorPlan, geodesic: Geodesic, command: Command, start: Pose, rules: Rules = Rules()
) -> tuple[Answer, ...]:
    """The different right answers to a command, that of the usual reading first.

    Args:
        plan: the floor plan.
        geodesic: its shortest ways.
        command: what is said.
        start: pose of the robot's centre, world frame.
        rules: distances and tolerances.

    Raises:
        GroundingError: the command cannot be carried out in any reading; says what there is in the
            usual one.
    """
    found: list[Answer] = []
    usual: GroundingError | None = None
    for reading in readings(plan, rules):
        guide = RoomGuide(reading, command, geodesic)
        try:
            goals = tuple(g for _, g in goals_in_turn(reading, command, start, guide, rules))
        except GroundingError as error:
            usual = usual or error
            continue
        if not any(same_answer(goals, other.goals) for other in found):
            found.append(Answer(reading, goals, dict(guide.ways)))
    if not found:
        assert usual is not None
        raise usual
    return tuple(found)


def same_answer(one: tuple[Goal, ...], other: tuple[Goal, ...]) -> bool:
    """Whether two sequences of goals lead to the same places."""
    return len(one) == len(other) and all(map(same_goal, one, other))


def same_goal(one: Goal, other: Goal) -> bool:
    """Whether two goals are through the same door, or at the same place before the same door."""
    if isinstance(one, PassGoal) and isinstance(other, PassGoal):
        return one.door.name == other.door.name
    if isinstance(one, ReachGoal) and isinstance(other, ReachGoal):
        names = [(g.door and g.door.name, g.beside and g.beside.name) for g in (one, other)]
        return names[0] == names[1] and one.reached_by(other.pose, SAME_SHARE)
    return one.kind == other.kind
