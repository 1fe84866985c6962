"""Drops commands that mean something else if the plan or the start differs by a few centimetres.

A robot sees walls to some centimetres, and people do not measure doors. If walls move by 3 cm, and
a command then leads to a place that the judge does not accept, nobody can blame a robot for it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np

from semnav_env.judge.goals import goals_in_turn
from semnav_env.judge.readings import Answer, answers, same_answer
from semnav_env.language import Command
from semnav_env.mind.grounding import GroundingError
from semnav_env.mind.grounding.goal import Goal
from semnav_env.mind.grounding.ways import KnownWays
from semnav_env.world.maps.floor_plan import FloorPlan, PlanDoor, Surface
from semnav_env.world.maps.geodesic import Geodesic
from semnav_features.frames import FloatArray, Point, Pose, compose
from semnav_features.rules import DoorRules
from semnav_features.scene import StillScene

WALL_SPREAD = 0.03
"""Standard deviation by which the corners of walls are moved, metres: the error of a remembered
wall."""

START_SHIFT, START_TURN = 0.1, math.radians(5.0)
"""Largest distance by which a start is moved along x and along y, metres, and turned, radians."""

LIMIT_CHANGE = 0.1
"""Change of the widths from which on and up to which something is a door or an opening, metres."""

TIMES = 5
"""Number of times that walls and start are moved."""


class Variant(NamedTuple):
    """Another view of a plan, in which a command should have an accepted answer or none.

    Attributes:
        cause: what was changed: "walls", "start" or "limits".
        scene: the walls and the doors that count, world frame.
        shift: by which the start is moved, in the frame of the start: metres and radians.
    """

    cause: str
    scene: StillScene
    shift: Pose = (0.0, 0.0, 0.0)


@dataclass(eq=False)
class StableAnswers:
    """Tells which commands lead to accepted places alone in every `Variant` of a floor plan.

    A variant in which a command cannot be carried out says nothing: its speaker presupposes that it
    can. So of a command that cannot be carried out in the plan, every variant that can says that it
    is not surely impossible.

    Attributes:
        plan: the floor plan.
    """

    plan: FloorPlan

    def change(self, command: Command, start: Pose) -> str | None:
        """The cause of the first variant with an answer that is not accepted; None without one."""
        accepted = self.accepted(command, start)
        ways = KnownWays(accepted[0].ways if accepted else {})
        for variant in self.variants:
            found = answer_in(variant, self.plan, command, start, ways)
            if found and not any(same_answer(found, each.goals) for each in accepted):
                return variant.cause
        return None

    def accepted(self, command: Command, start: Pose) -> tuple[Answer, ...]:
        """The right answers to a command; empty if it cannot be carried out."""
        try:
            return answers(self.plan, self.plan.derived(Geodesic), command, start)
        except GroundingError:
            return ()

    @cached_property
    def variants(self) -> tuple[Variant, ...]:
        """The plan with moved walls, other starts, and other limits; always the same ones."""
        rng = np.random.default_rng(0)
        walls = [Variant("walls", moved_walls(self.plan, rng).scene) for _ in range(TIMES)]
        shifts = rng.uniform(-1.0, 1.0, (TIMES, 3)) * (START_SHIFT, START_SHIFT, START_TURN)
        starts = [Variant("start", self.plan.scene, (x, y, turn)) for x, y, turn in shifts.tolist()]
        return (*walls, *starts, *(Variant("limits", scene) for scene in self._other_limits()))

    def _other_limits(self) -> Iterator[StillScene]:
        usual = DoorRules()
        for change in (-LIMIT_CHANGE, LIMIT_CHANGE):
            yield self.plan.scene_by(replace(usual, width_min=usual.width_min + change))
            yield self.plan.scene_by(replace(usual, width_max=usual.width_max + change))
            yield replace(self.plan.scene, opening_slack=change)


def answer_in(
    variant: Variant, plan: FloorPlan, command: Command, start: Pose, ways: KnownWays
) -> tuple[Goal, ...] | None:
    """The goals of a command in a variant of a plan; None if it cannot be carried out there."""
    moved = compose(start, variant.shift)
    try:
        found = goals_in_turn(plan, command, moved, ways, scene=variant.scene)
        return tuple(goal for _, goal in found)
    except GroundingError:
        return None


def moved_walls(plan: FloorPlan, rng: np.random.Generator) -> FloorPlan:
    """The plan with every corner of its walls moved at random; jambs move with the nearest corner.

    Corners at the same place stay together. The spread is `WALL_SPREAD`.
    """
    corners = np.unique(plan.segments.reshape(-1, 2), axis=0)
    there = corners + rng.normal(0.0, WALL_SPREAD, corners.shape)
    places = {
        (x, y): tuple(new) for (x, y), new in zip(corners.tolist(), there.tolist(), strict=True)
    }

    def surface(each: Surface) -> Surface:
        return replace(each, points=tuple([places[point] for point in each.points]))

    def door(each: PlanDoor) -> PlanDoor:
        start, end = (_moved(jamb, corners, there) for jamb in (each.start, each.end))
        return replace(each, start=start, end=end)

    return replace(
        plan,
        surfaces=tuple(map(surface, plan.surfaces)),
        doors=tuple(map(door, plan.doors)),
    )


def _moved(jamb: Point, corners: FloatArray, there: FloatArray) -> Point:
    """A jamb moved like the nearest corner."""
    nearest = int(np.argmin(((corners - jamb) ** 2).sum(axis=1)))
    x, y = (np.array(jamb) + there[nearest] - corners[nearest]).tolist()
    return x, y
