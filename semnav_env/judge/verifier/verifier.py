"""The verifier: follows one episode on the true scene and judges it."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from typing import Any

import numpy as np

from semnav_env.judge.verifier.astray import wrong_arms
from semnav_env.judge.verifier.judge_record import (
    ASTRAY,
    DOOR_CROSSED,
    NO_ARMS,
    NO_DISTANCES,
    TOO_STILL,
    JudgeRecord,
    join_record,
    judge_motion,
    set_arms,
    set_distances,
)
from semnav_env.judge.verifier.judge_state import (
    Outcome,
    first_state,
    limit_goal,
    outcome,
    put_motion,
)
from semnav_env.judge.verifier.mission import Mission
from semnav_env.judge.verifier.verdict import Verdict, verdicts
from semnav_env.language.clauses import Clause
from semnav_env.mind.grounding.crossing import first_crossed
from semnav_env.mind.grounding.follower import Follower
from semnav_env.mind.grounding.goal import Goal, PassGoal, StopGoal
from semnav_env.mind.grounding.ways import KnownWays
from semnav_env.world.maps.floor_plan import FloorPlan, PlanDoor
from semnav_env.world.simulator.sensed import Motion
from semnav_features.frames import FloatArray, Pose
from semnav_features.rules import DoorRules
from semnav_features.scene import Scene


class Verifier:
    """Judges one episode on the true scene.

    A door clause is done when the robot's centre crosses that very door; a place is reached when
    the centre comes within the tolerances of the clause's goal on the true scene.

    Args:
        mission: what is to be done.
        fulfils: says of a clause whose goal was reached whether it has been carried out in full,
            for clauses that are judged by more than where the robot is.

    Attributes:
        mission: likewise.
        follower: how far the command has truly come.
        record: what is kept count of, for `judge_motion`.
        failure: why the episode failed; None if it has not.
        crossed: names of the doors that were crossed, in order.
    """

    def __init__(self, mission: Mission, fulfils: Callable[[Clause], bool] | None = None) -> None:
        self.mission, self._fulfils = mission, fulfils
        self.follower = Follower(
            mission.command, complete=True, guide=KnownWays(mission.ways), rules=mission.rules
        )
        self.follower.start(mission.scene, mission.start)
        self.failure: Verdict | None = None
        self.crossed: list[str] = []
        self._met: list[Goal] = []
        self._state, self._arms, self._distances = first_state(mission), NO_ARMS, NO_DISTANCES
        self.record = self._join()
        self._head_for(self.follower.goal)

    def _join(self) -> JudgeRecord:
        self._numbers = self._state.view(np.uint8).data
        doors = self.mission.floor_plan.derived(_door_ends)
        progress = self.follower.progress
        return join_record(self._state, doors, self._arms, self._distances, progress)

    def __getstate__(self) -> dict[str, Any]:
        left_out = ("record", "_numbers")
        return {name: value for name, value in self.__dict__.items() if name not in left_out}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        self.record = self._join()

    def update(self, motion: Motion) -> bool:
        """Judge one control period; returns whether it completed a clause."""
        self.write(motion)
        return self.think(judge_motion(self.record))

    def write(self, motion: Motion) -> None:
        """Put the motion of a control period into the record, for `judge_motion`."""
        put_motion(self._numbers, motion)

    def think(self, events: int) -> bool:
        """Do what the events of `judge_motion` call for; returns whether a clause was completed."""
        if not events:
            return False
        clause = self.follower.active
        completed = self.follower.think(events, self._scene, self._pose())
        goal, crossed = self._goal, None
        if events & DOOR_CROSSED:
            crossed = self.mission.floor_plan.doors[int(self.read().crossed_door)]
            self.crossed.append(crossed.name)
        if completed:
            self._met.append(goal)
            self._head_for(self.follower.goal)
        if (self.failure is None and not self.follower.done) or completed:
            if crossed is not None and not _may_cross(goal, crossed, self.mission.rules.door):
                self.failure = Verdict.WRONG_DOOR
            elif not completed and events & ASTRAY:
                self.failure = Verdict.WRONG_TURN
            elif completed and not self._carried_out(clause):
                self.failure = Verdict.INCOMPLETE
            elif not self.follower.done and events & TOO_STILL:
                self.failure = Verdict.STOPPED_SHORT
        return completed and self.failure is not Verdict.INCOMPLETE

    def head_along(self, distances: FloatArray) -> None:
        """Measure the way to the goal in a field of distances, see `WaysTo.distances`."""
        self._distances = distances
        set_distances(self.record, distances)

    def read(self) -> Outcome:
        """What the record says of the last control period."""
        return outcome(self._numbers)

    def out_of_time(self) -> None:
        """The episode ended before the command was carried out."""
        if not self.over:
            still, rules = float(self._state["still_seconds"][0]), self.mission.rules.success
            stopped = still > rules.final_still_seconds
            self.failure = Verdict.STOPPED_SHORT if stopped else Verdict.OUT_OF_TIME

    @property
    def success(self) -> bool:
        """Whether the whole command was carried out."""
        return self.failure is None and self.follower.done

    @property
    def over(self) -> bool:
        """Whether nothing more is to come: success or failure."""
        return self.failure is not None or self.follower.done

    @property
    def completed(self) -> int:
        """How many clauses have been carried out."""
        return len(self._met)

    @property
    def goals(self) -> tuple[Goal, ...]:
        """The goals as they were judged, one after the other, and those planned for the rest.

        They differ from the planned ones after "go back", which leads along the way driven.
        """
        active = () if self.follower.done else (self.follower.goal,)
        return (*self._met, *active, *self.mission.goals[self.completed + 1 :])

    @property
    def verdict(self) -> Verdict:
        """What became of the command as a whole; active while it is under way."""
        return self.failure or (Verdict.DONE if self.follower.done else Verdict.ACTIVE)

    @property
    def verdicts(self) -> tuple[Verdict, ...]:
        """One per clause."""
        follower, clauses = self.follower, len(self.mission.command.clauses)
        return verdicts(clauses, follower.active, self.failure, follower.skipped)

    def _carried_out(self, clause: int) -> bool:
        """Whether the clause of that index, whose goal was reached, is carried out in full."""
        return self._fulfils is None or self._fulfils(self.mission.command.clauses[clause])

    def _pose(self) -> Pose:
        return self.read()[:3]

    def _scene(self) -> Scene:
        return self.mission.scene

    def _head_for(self, goal: Goal) -> None:
        """Tell the record of a new goal."""
        self._goal = goal
        clauses, rules = self.mission.command.clauses, self.mission.rules.success
        limit_goal(self._state, goal, rules)
        done = self.follower.done
        self._arms = NO_ARMS if done else wrong_arms(clauses[self.follower.active], goal, rules)
        set_arms(self.record, self._arms)


def _door_ends(floor_plan: FloorPlan) -> FloatArray:
    """The jambs of all doors in an array that is not read-only, and so of one type with others."""
    return floor_plan.door_ends.copy()


def _may_cross(goal: Goal, crossed: PlanDoor, rules: DoorRules) -> bool:
    """Whether a goal is to pass that very door, lies beyond it on the known way, or lets roam.

    What is too wide to count as a door may be crossed anyway.
    """
    if crossed.is_opening(rules) or (isinstance(goal, StopGoal) and goal.roams):
        return True
    if isinstance(goal, PassGoal) and goal.door.name == crossed.name:
        return True
    line = np.array([(*crossed.start, *crossed.end)])
    return any(first_crossed(line, *a, *b) == 0 for a, b in pairwise(goal.places))
