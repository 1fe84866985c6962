"""Says, clause by clause, whether a command was carried out. It alone knows the floor plan."""

from __future__ import annotations

import math
from enum import StrEnum
from functools import cached_property, lru_cache
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from semnav_env.commands import Command, encode
from semnav_env.commands.clauses import Turn
from semnav_env.features.frames import FloatArray, Point, Pose, to_local
from semnav_env.features.hallway import Opening
from semnav_env.features.scene import Scene
from semnav_env.grounding.follower import Follower
from semnav_env.grounding.goal import Goal, GoalKind, first_crossed
from semnav_env.grounding.situation import GroundingError
from semnav_env.maps.floor_plan import FloorPlan, PlanDoor
from semnav_env.maps.geodesic import Geodesic, WaysTo

ASTRAY = 1.2
"""A wrong turn is taken when the robot is this far inside an arm it should not be in, metres."""

STILL_FOR = 10.0
"""After standing still for so long before the end, the robot has stopped short, seconds."""

STILL = 0.02
"""Slower than this is standing still, m/s."""


class Verdict(StrEnum):
    """What became of a clause or of a command."""

    PENDING = "pending"
    ACTIVE = "active"
    DONE = "done"
    WRONG_DOOR = "wrong door"
    WRONG_TURN = "wrong turn"
    STOPPED_SHORT = "stopped short"
    OUT_OF_TIME = "out of time"


FAILURES = (Verdict.WRONG_DOOR, Verdict.WRONG_TURN, Verdict.STOPPED_SHORT, Verdict.OUT_OF_TIME)


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

    Raises:
        GroundingError: the command cannot be carried out from there; says what there is.
    """

    def __init__(
        self, floor_plan: FloorPlan, geodesic: Geodesic, command: Command, start: Pose
    ) -> None:
        self.floor_plan = floor_plan
        self.command = command
        self.start = start
        self.planned_goals = plan_goals(floor_plan, command, start)
        self.tokens = encode(command, floor_plan.room_names)
        self.follower = Follower(command, complete=True)
        self.follower.start(floor_plan.scene, start)
        self.failure: Verdict | None = None
        self.crossed: list[str] = []
        self.collisions = 0
        self.path_length = 0.0
        self._geodesic = geodesic
        self._ways = self._ways_to_goal()
        self._door_ends = np.array(
            [(*door.start, *door.end) for door in floor_plan.doors], dtype=np.float64
        ).reshape(-1, 4)
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
        completed = self.follower.advance(self._scene, pose, speed)
        if completed and not self.follower.done:
            self._ways = self._ways_to_goal()
        self._judge(goal, completed, pose)
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
    def verdicts(self) -> tuple[Verdict, ...]:
        """One per clause."""
        return _verdicts(len(self.command.clauses), self.follower.active, self.failure)

    @property
    def remaining(self) -> float:
        """Length of the shortest way to the active clause's goal, metres; 0 when all is done."""
        return 0.0 if self.follower.done else self._ways.length((self._last[0], self._last[1]))

    @cached_property
    def route(self) -> FloatArray:
        """The true route as points, shape (k, 2), world frame."""
        points = [self.start[:2], *(place(goal) for goal in self.planned_goals)]
        ways = [self._geodesic.to(b).way(a) for a, b in pairwise(points)]
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
        steps = np.diff(self.route, axis=0)
        return float(np.hypot(steps[:, 0], steps[:, 1]).sum())

    def _ways_to_goal(self) -> WaysTo:
        return self._geodesic.to(place(self.follower.goal))

    def _scene(self) -> Scene:
        return self.floor_plan.scene

    def _judge(self, goal: Goal, completed: bool, pose: Pose) -> None:
        crossed = self._crossed_door(pose)
        if crossed is not None:
            self.crossed.append(crossed.name)
        if (self.failure is None and not self.follower.done) or completed:
            if crossed is not None and not _is_door_of(goal, crossed):
                self.failure = Verdict.WRONG_DOOR
            elif not completed and self._went_astray(goal, pose):
                self.failure = Verdict.WRONG_TURN
            elif not self.follower.done and self._still > STILL_FOR:
                self.failure = Verdict.STOPPED_SHORT

    def _crossed_door(self, pose: Pose) -> PlanDoor | None:
        index = first_crossed(self._door_ends, *self._last[:2], *pose[:2])
        return None if index < 0 else self.floor_plan.doors[index]

    def _went_astray(self, goal: Goal, pose: Pose) -> bool:
        """Whether the robot left the hallway by an arm that the clause does not name."""
        if goal.hallway is None:
            return False
        along, offset = to_local(goal.hallway.frame, (pose[0], pose[1]))
        for junction in goal.hallway.junctions if abs(offset) > ASTRAY else ():
            for opening in (junction.left, junction.right):
                if opening is None or not opening.near < along < opening.far:
                    continue
                depth = (offset if opening.left else -offset) - opening.offset
                named = goal.junction is junction and self._is_named(opening)
                if depth > ASTRAY and opening.far > 0.5 and not named:
                    return True
        return goal.junction is not None and along > goal.junction.far + 2 * ASTRAY

    def _is_named(self, opening: Opening) -> bool:
        clause = self.command.clauses[min(self.follower.active, len(self.command.clauses) - 1)]
        return isinstance(clause, Turn) and clause.turning.value == (
            "left" if opening.left else "right"
        )


def plan_goals(floor_plan: FloorPlan, command: Command, start: Pose) -> tuple[Goal, ...]:
    """The goals of a command on the true scene, each grounded where the one before ends.

    Raises:
        GroundingError: a clause cannot be carried out.
    """
    follower = Follower(command, complete=True)
    follower.start(floor_plan.scene, start)
    goals = []
    while not follower.done:
        if follower.impossible is not None:
            raise GroundingError(follower.impossible)
        goals.append(follower.goal)
        follower.skip_to_next(floor_plan.scene)
    return tuple(goals)


def place(goal: Goal) -> Point:
    """The point that a goal leads to: the middle of the doorway to cross, else its pose."""
    if goal.kind is GoalKind.PASS and goal.door is not None:
        return goal.door.midpoint
    return goal.pose[:2]


def _is_door_of(goal: Goal, crossed: PlanDoor) -> bool:
    """Whether a goal is to pass that very door."""
    return goal.kind is GoalKind.PASS and goal.door is not None and goal.door.name == crossed.name


@lru_cache(maxsize=256)
def _verdicts(clauses: int, active: int, failure: Verdict | None) -> tuple[Verdict, ...]:
    """Done, then what became of the active clause, then pending."""
    rest = clauses - active - 1
    done = (Verdict.DONE,) * active
    return done if rest < 0 else (*done, failure or Verdict.ACTIVE, *(Verdict.PENDING,) * rest)
