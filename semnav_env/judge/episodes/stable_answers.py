"""Drops commands whose right answer depends on a few centimetres of the plan or of the start.

A robot sees walls to some centimetres, and people do not measure doors. While the answer to a
command changes if walls move by 3 cm, no robot can be blamed for another answer.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np

from semnav_env.judge.goals import goals_in_turn
from semnav_env.judge.routes.room_guide import RoomGuide
from semnav_env.language import Command
from semnav_env.mind.grounding import GroundingError
from semnav_env.mind.grounding.goal import Goal, PassGoal, ReachGoal
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

SAME_SHARE = 0.5
"""Share of the judge's tolerances within which two goals are the same."""


class Variant(NamedTuple):
    """Another view of a plan, in which a command should have the same answer.

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
    """Tells which commands keep their answer in every `Variant` of a floor plan.

    Attributes:
        plan: the floor plan.
    """

    plan: FloorPlan

    def change(self, command: Command, start: Pose) -> str | None:
        """The cause of the first variant that gives another answer; None if there is none."""
        guide = RoomGuide(self.plan, command, self.plan.derived(Geodesic))
        answer = self.answer(command, start, guide)
        for variant in self.variants:
            moved = compose(start, variant.shift)
            found = self.answer(command, moved, KnownWays(guide.ways), variant.scene)
            if not same_answer(answer, found):
                return variant.cause
        return None

    def answer(
        self,
        command: Command,
        start: Pose,
        guide: RoomGuide | KnownWays,
        scene: StillScene | None = None,
    ) -> tuple[Goal, ...]:
        """The goals of a command, as far as it can be carried out.

        Args:
            command: what is said.
            start: where, world frame.
            guide: tells the ways to rooms.
            scene: that of a `Variant`; None for the plan's own.
        """
        goals: tuple[Goal, ...] = ()
        try:
            for _, goal in goals_in_turn(self.plan, command, start, guide, scene=scene):
                goals += (goal,)
        except GroundingError:
            pass
        return goals

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
