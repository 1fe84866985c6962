"""The mission of an episode: its command, with the true goals and ways from the floor plan."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np

from semnav_env.judge.goals import goals_in_turn, place
from semnav_env.judge.readings import answers
from semnav_env.judge.routes.room_guide import RoomGuide
from semnav_env.language import Command
from semnav_env.mind.grounding.errors import GroundingError
from semnav_env.mind.grounding.goal import Goal
from semnav_env.mind.grounding.ways import Way
from semnav_env.rules import Rules
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_env.world.maps.geodesic import Geodesic
from semnav_features.frames import FloatArray, Pose, path_length
from semnav_features.scene import Scene


@dataclass(frozen=True, eq=False)
class Mission:
    """A command at a start pose in a floor plan, with its true goals and ways.

    Attributes:
        floor_plan: the truth, or one of its `readings`.
        geodesic: its shortest ways.
        command: what the robot is told.
        start: pose of the robot's centre, world frame.
        goals: of the clauses on the true scene, each grounded where the one before ends.
        ways: to the rooms that the command names, by the number of the clause, world frame.
        rules: rules by which the command is grounded and judged.
        others: the missions with the other right answers; their routes are no shorter.
    """

    floor_plan: FloorPlan
    geodesic: Geodesic = field(repr=False)
    command: Command
    start: Pose
    goals: tuple[Goal, ...]
    ways: Mapping[int, Way] = field(repr=False)
    rules: Rules = field(default=Rules(), repr=False)
    others: tuple[Mission, ...] = field(default=(), repr=False)

    @property
    def scene(self) -> Scene:
        """All walls and all doors that count, world frame."""
        return self.floor_plan.scene_by(self.rules.door)

    @cached_property
    def route(self) -> FloatArray:
        """The true route as points, shape (k, 2), world frame."""
        points = [self.start[:2], *(place(goal) for goal in self.goals)]
        ways = [self.geodesic.to(b).way(a) for a, b in pairwise(points)]
        return np.vstack(ways) if ways else np.array([self.start[:2]])

    @cached_property
    def route_length(self) -> float:
        """Length of the true route, metres."""
        return path_length(self.route)

    @property
    def info(self) -> dict[str, Any]:
        """Entries of `info` of `reset` about the mission: small plain values."""
        said, plan = str(self.command), self.floor_plan.name
        return {"command": said, "instruction": said, "floor_plan": plan, "pose": self.start}

    def ways_seen_from(self, frame: Pose) -> dict[int, Way]:
        """The ways to named rooms in the frame of a robot, by the number of the clause."""
        return {clause: way.seen_from(frame) for clause, way in self.ways.items()}


def plan_mission(
    floor_plan: FloorPlan,
    geodesic: Geodesic,
    command: Command,
    start: Pose,
    feasible: bool = True,
    rules: Rules = Rules(),
) -> Mission:
    """Ground a command on the floor plan; of several right answers the nearest comes first.

    Args:
        floor_plan: the truth.
        geodesic: its shortest ways.
        command: what the robot is told.
        start: its pose, world frame.
        feasible: whether the command must be one that can be carried out. If not, goals and route
            of one that cannot lead as far as it can.
        rules: distances and tolerances.

    Raises:
        GroundingError: the command cannot be carried out from there; says what there is.
    """
    if feasible:
        found = answers(floor_plan, geodesic, command, start, rules)
        missions = [
            Mission(each.plan, geodesic, command, start, each.goals, each.ways, rules)
            for each in found
        ]
        return missions[0] if len(missions) == 1 else _nearest(missions)
    guide = RoomGuide(floor_plan, command, geodesic)
    goals: tuple[Goal, ...] = ()
    with suppress(GroundingError):
        for _, goal in goals_in_turn(floor_plan, command, start, guide, rules):
            goals += (goal,)
    return Mission(floor_plan, geodesic, command, start, goals, dict(guide.ways), rules)


def _nearest(missions: Sequence[Mission]) -> Mission:
    """The mission with the shortest route, which knows the others."""
    nearest, *others = sorted(missions, key=lambda mission: mission.route_length)
    return replace(nearest, others=tuple(others))
