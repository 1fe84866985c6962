"""The verifier: follows one episode on the true scene and judges it."""

from __future__ import annotations

import math
from functools import cached_property
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from semnav_env.commands import Command, encode
from semnav_env.features.frames import FloatArray, Pose, path_length
from semnav_env.features.scene import Scene
from semnav_env.grounding.crossing import first_crossed
from semnav_env.grounding.follower import Follower
from semnav_env.grounding.goal import Goal, PassGoal, wait_of
from semnav_env.grounding.situation import GroundingError
from semnav_env.grounding.ways import KnownWays
from semnav_env.maps.floor_plan import FloorPlan, PlanDoor
from semnav_env.maps.geodesic import Geodesic, WaysTo
from semnav_env.routes.room_guide import RoomGuide
from semnav_env.verifier.astray import went_astray
from semnav_env.verifier.goals import goals_in_turn, place
from semnav_env.verifier.verdict import Verdict, verdicts

STILL_FOR = 10.0
"""After standing still for so long before the end, the robot has stopped short, seconds."""

STILL = 0.02
"""Slower than this is standing still, m/s."""


class Motion(NamedTuple):
    """What the verifier is told after each step.

    Attributes:
        pose: true pose of the robot's centre, world frame.
        speed: m/s.
        turn_rate: rad/s.
        in_contact: whether the body touches anything.
        seconds: duration of the step.
    """

    pose: Pose
    speed: float
    turn_rate: float
    in_contact: bool
    seconds: float


class Verifier:
    """Follows one episode on the true scene.

    A door clause is done when the robot's centre crosses that very door; a place is reached when
    the centre comes within the tolerances of the clause's goal on the true scene.

    Args:
        floor_plan: the truth.
        geodesic: its shortest ways.
        command: what the robot was told.
        start: its pose, world frame.
        feasible: whether the command must be one that can be carried out. If not, the route and
            the planned goals of one that cannot lead as far as it can.

    Raises:
        GroundingError: the command cannot be carried out from there; says what there is.
    """

    def __init__(
        self,
        floor_plan: FloorPlan,
        geodesic: Geodesic,
        command: Command,
        start: Pose,
        feasible: bool = True,
    ) -> None:
        self.floor_plan = floor_plan
        self.command = command
        self.start = start
        directory = RoomGuide(floor_plan, command, geodesic)
        self.planned_goals: tuple[Goal, ...] = ()
        try:
            for goal in goals_in_turn(floor_plan, command, start, directory):
                self.planned_goals += (goal,)
        except GroundingError:
            if feasible:
                raise
        self.ways = dict(directory.ways)
        self.tokens = encode(command, floor_plan.room_names)
        self.follower = Follower(command, complete=True, guide=KnownWays(self.ways))
        self.follower.start(floor_plan.scene, start)
        self.failure: Verdict | None = None
        self.crossed: list[str] = []
        self.collisions = 0
        self.path_length = 0.0
        self.geodesic = geodesic
        self._ways = self._ways_to_goal()
        self._met: list[Goal] = []
        self._still = 0.0
        self._in_contact = False
        self._last = start

    def update(self, motion: Motion) -> bool:
        """Note one step; returns whether a clause was completed by it."""
        pose, speed, turn_rate, in_contact, seconds = motion
        last = self._last
        self.path_length += math.hypot(pose[0] - last[0], pose[1] - last[1])
        self.collisions += in_contact and not self._in_contact
        self._in_contact = in_contact
        still = speed < STILL and abs(turn_rate) < STILL
        self._still = self._still + seconds if still else 0.0
        goal = self.follower.goal
        allowed = STILL_FOR + wait_of(goal)
        completed = self.follower.advance(self._scene, pose, speed, seconds)
        if completed:
            self._met.append(goal)
            if not self.follower.done:
                self._ways = self._ways_to_goal()
        self._judge(goal, completed, pose, self._still > allowed)
        self._last = pose
        return completed

    def out_of_time(self) -> None:
        """The episode ended before the command was carried out."""
        if not self.over:
            self.failure = Verdict.STOPPED_SHORT if self._still > 1.0 else Verdict.OUT_OF_TIME

    @property
    def success(self) -> bool:
        """Whether the whole command was carried out."""
        return self.failure is None and self.follower.done

    @property
    def over(self) -> bool:
        """Whether there is nothing more to come: success or failure."""
        return self.failure is not None or self.follower.done

    @property
    def goals(self) -> tuple[Goal, ...]:
        """The goals as they were judged, one after the other, and those planned for the rest.

        They differ from the planned ones after "go back", which leads along the way driven.
        """
        met = len(self._met)
        active = () if self.follower.done else (self.follower.goal,)
        return (*self._met, *active, *self.planned_goals[met + 1 :])

    @property
    def verdict(self) -> Verdict:
        """What became of the command as a whole; active while it is under way."""
        return self.failure or (Verdict.DONE if self.follower.done else Verdict.ACTIVE)

    @property
    def verdicts(self) -> tuple[Verdict, ...]:
        """One per clause."""
        follower = self.follower
        return verdicts(len(self.command.clauses), follower.active, self.failure, follower.skipped)

    @property
    def remaining(self) -> float:
        """Length of the shortest way to the active clause's goal, metres; 0 when all is done."""
        return 0.0 if self.follower.done else self._ways.length((self._last[0], self._last[1]))

    @cached_property
    def route(self) -> FloatArray:
        """The true route as points, shape (k, 2), world frame."""
        points = [self.start[:2], *(place(goal) for goal in self.planned_goals)]
        ways = [self.geodesic.to(b).way(a) for a, b in pairwise(points)]
        return np.vstack(ways) if ways else np.array([self.start[:2]])

    def true_route(self) -> dict[str, Any]:
        """The true route as plain points, for vector environments stack arrays, and its length."""
        points = tuple((x, y) for x, y in self.route.tolist())
        return {"route": points, "route_length": self.route_length}

    def outcome(self) -> dict[str, Any]:
        """What is known at the end, for `info`."""
        crossed = tuple(self.crossed)
        return {"is_success": self.success, "crossed_doors": crossed, **self.true_route()}

    @property
    def route_length(self) -> float:
        """Length of the true route, metres."""
        return path_length(self.route)

    def _ways_to_goal(self) -> WaysTo:
        return self.geodesic.to(place(self.follower.goal))

    def _scene(self) -> Scene:
        return self.floor_plan.scene

    def _judge(self, goal: Goal, completed: bool, pose: Pose, too_still: bool) -> None:
        crossed = self._crossed_door(pose)
        if crossed is not None:
            self.crossed.append(crossed.name)
        if (self.failure is None and not self.follower.done) or completed:
            if crossed is not None and not _may_cross(goal, crossed):
                self.failure = Verdict.WRONG_DOOR
            elif not completed and self._went_astray(goal, pose):
                self.failure = Verdict.WRONG_TURN
            elif not self.follower.done and too_still:
                self.failure = Verdict.STOPPED_SHORT

    def _went_astray(self, goal: Goal, pose: Pose) -> bool:
        return went_astray(self.command.clauses[self.follower.active], goal, pose)

    def _crossed_door(self, pose: Pose) -> PlanDoor | None:
        index = first_crossed(self.floor_plan.door_ends, *self._last[:2], *pose[:2])
        return None if index < 0 else self.floor_plan.doors[index]


def _may_cross(goal: Goal, crossed: PlanDoor) -> bool:
    """Whether a goal is to pass that very door, or is beyond it on the way that is known.

    What is too wide to count as a door may be crossed anyway.
    """
    if crossed.is_opening:
        return True
    if isinstance(goal, PassGoal) and goal.door.name == crossed.name:
        return True
    line = np.array([(*crossed.start, *crossed.end)])
    return any(first_crossed(line, *a, *b) == 0 for a, b in pairwise(goal.places))
