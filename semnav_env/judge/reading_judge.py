"""Judges one right answer to a command: follows it on the true scene, with a verdict a clause."""

from __future__ import annotations

from math import isfinite
from typing import TYPE_CHECKING, Any

import numpy as np

from semnav_env.judge.astray import may_cross, wrong_arms
from semnav_env.judge.goals import place
from semnav_env.judge.judge_record import (
    ASTRAY,
    DOOR_CROSSED,
    NO_ARMS,
    NO_DISTANCES,
    TOO_STILL,
    JudgeRecord,
    judge_motion,
    set_arms,
    set_distances,
)
from semnav_env.judge.judge_state import (
    Period,
    copy_motion,
    first_state,
    left_the_wall,
    limit_goal,
    put_motion,
    read_period,
)
from semnav_env.judge.mission import Mission
from semnav_env.judge.verdict import Verdict, verdicts
from semnav_env.mind.grounding.clause_progress import CLAUSE_DONE
from semnav_env.mind.grounding.follower import Follower
from semnav_env.mind.grounding.goal import Goal, wait_of
from semnav_env.mind.grounding.ways import KnownWays
from semnav_env.world.maps.floor_plan import FloorPlan, PlanDoor
from semnav_env.world.simulator.sensed import Motion
from semnav_features.frames import FloatArray, Pose
from semnav_features.scene import Scene

if TYPE_CHECKING:
    from semnav_env.judge.payload import Payload


class ReadingJudge:
    """Judges whether an episode gives one right answer, control period by control period.

    A door clause is done when the robot's centre crosses exactly the named door. A place is reached
    when the centre comes within the tolerances of the clause's goal on the true scene.

    Args:
        mission: what is to be done, in one reading of the floor plan.
        payload: decides on some clauses, in addition to the robot's pose.
        measures_way: whether to measure the progress towards the goal, which needs the shortest
            paths to each goal.

    Attributes:
        mission: likewise.
        follower: the follower of the command on the true scene.
        record: counters of the judge, for `judge_motion`.
        row: result of the last control period, dtype `PERIOD`, shape (1,); part of the record.
        verdicts: one word per clause, plain text for `info`; see `Verdict`.
        failure: why the episode failed; None if it has not.
        truncated: whether the time was over before the command was carried out.
        crossed: names of the doors that were crossed, in order.
    """

    def __init__(
        self, mission: Mission, payload: Payload | None = None, *, measures_way: bool = True
    ) -> None:
        self.mission, self._payload, self._measures_way = mission, payload, measures_way
        self.follower = Follower(
            mission.command, complete=True, guide=KnownWays(mission.ways), rules=mission.rules
        )
        self.follower.start(mission.scene, mission.start)
        self.failure: Verdict | None = None
        self.truncated = False
        self.crossed: list[str] = []
        self._failed: int | None = None  # the clause that was not carried out in full
        self._met: list[Goal] = []
        self._state, self._arms, self._distances = first_state(mission), NO_ARMS, NO_DISTANCES
        self.record = self._join()
        self._head_for(self.follower.goal)
        self._measure_way()
        self._note_verdicts()

    def _join(self) -> JudgeRecord:
        self._numbers, self.row = self._state.view(np.uint8).data, self._state["period"]
        return JudgeRecord.of(
            state=self._state,
            doors=self.mission.floor_plan.derived(_door_ends),
            arms=self._arms,
            distances=self._distances,
            progress=self.follower.progress,
        )

    def __getstate__(self) -> dict[str, Any]:
        left_out = ("record", "row", "_numbers")
        return {name: value for name, value in self.__dict__.items() if name not in left_out}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        self.record = self._join()

    def update_like(self, other: ReadingJudge) -> None:
        """Judge the control period that another judge of the episode has judged."""
        copy_motion(other._numbers, self._numbers)
        self.think(judge_motion(self.record))

    def write(self, motion: Motion) -> None:
        """Put the motion of a control period into the record, for `judge_motion`."""
        put_motion(self._numbers, motion)

    def think(self, events: int) -> None:
        """Handle the events of `judge_motion`, and complete `row`."""
        if not events:
            return
        was_over = self.over
        completed = self._follow(events)
        ended = self.over and not was_over
        self.row["clause"], self.row["success"] = completed, ended and self.success
        self.row["failure"] = ended and not self.success
        self.row["over"] = self.over and not self.truncated
        if completed:
            before = float(self._state["remaining_before"][0])
            self.row["progress"] = before if isfinite(before) else 0.0
            self._measure_way()
        self._note_verdicts()

    def out_of_time(self) -> None:
        """The episode ended before the command was carried out."""
        if not self.over:
            still, rules = float(self._state["still_seconds"][0]), self.mission.rules.success
            stopped = still > rules.final_still_seconds
            self.failure = Verdict.STOPPED_SHORT if stopped else Verdict.OUT_OF_TIME
            self._note_verdicts()

    @property
    def period(self) -> Period:
        """The result of the last control period in plain numbers."""
        return read_period(self._numbers)

    @property
    def remaining(self) -> float:
        """Length of the shortest path to the active goal, metres; 0 when all clauses are done."""
        return float(self._state["remaining"][0])

    @property
    def success(self) -> bool:
        """Whether the whole command was carried out."""
        return self.failure is None and self.follower.done

    @property
    def over(self) -> bool:
        """Whether the command has ended, by success or failure."""
        return self.failure is not None or self.follower.done

    @property
    def clause(self) -> int:
        """Index of the clause that is judged: the active one, or the one that was not carried out.

        It is the number of clauses when all are done.
        """
        return self.follower.active if self._failed is None else self._failed

    @property
    def completed(self) -> int:
        """Number of clauses that have been carried out."""
        return len(self._met)

    @property
    def goals(self) -> tuple[Goal, ...]:
        """The judged goals in their order, followed by the planned goals of the remaining clauses.

        They differ from the planned goals after "go back", which leads along the driven path.
        """
        active = () if self.follower.done else (self.follower.goal,)
        return (*self._met, *active, *self.mission.goals[self.completed + 1 :])

    @property
    def verdict(self) -> Verdict:
        """The verdict on the whole command; `ACTIVE` until it ends."""
        return self.failure or (Verdict.DONE if self.follower.done else Verdict.ACTIVE)

    def _follow(self, events: int) -> bool:
        """Continue with the command; returns whether a clause was carried out in full."""
        clause, goal, crossed = self.follower.active, self._goal, None
        state = self._state[0]
        pose: Pose = (float(state["x"]), float(state["y"]), float(state["heading"]))
        strayed = left_the_wall(self._state, self.mission.rules.success)
        if events & DOOR_CROSSED:
            crossed = self.mission.floor_plan.doors[int(state["crossed_door"])]
            self.crossed.append(crossed.name)
            self.follower.note_doorway(pose)
        completed = self.follower.think(events, self._scene, pose)
        if completed:
            self._met.append(goal)
            if wait_of(goal) > 0.0:  # to stand still as told counts no more
                self._state["still_seconds"] = 0.0
        if completed or (events & CLAUSE_DONE and self.follower.goal is not goal):
            self._head_for(self.follower.goal)  # of a room it is searched behind its door
        if (self.failure is None and not self.follower.done) or completed:
            self.failure = self._fault(events, clause if completed else None, goal, crossed)
            if completed and strayed and self.failure is None:
                self.failure = Verdict.INCOMPLETE
            if self.failure is Verdict.INCOMPLETE:
                self._failed = clause
        return completed and self.failure is not Verdict.INCOMPLETE

    def _fault(
        self, events: int, completed: int | None, goal: Goal, crossed: PlanDoor | None
    ) -> Verdict | None:
        """The failure of this control period, if there is one.

        Args:
            events: of `judge_motion`.
            completed: index of the clause whose goal was reached.
            goal: the goal that was active.
            crossed: the door that was crossed.
        """
        if crossed is not None and not may_cross(goal, crossed, self.mission.rules.door):
            return Verdict.WRONG_DOOR
        if completed is None and events & ASTRAY:
            return Verdict.WRONG_TURN
        if completed is not None and not self._carried_out(completed):
            return Verdict.INCOMPLETE
        if not self.follower.done and events & TOO_STILL:
            return Verdict.STOPPED_SHORT
        return self.failure

    def _carried_out(self, clause: int) -> bool:
        """Whether the clause with this index, whose goal was reached, is carried out in full."""
        return self._payload is None or self._payload.fulfils(self.mission.command.clauses[clause])

    def _note_verdicts(self) -> None:
        clauses = len(self.mission.command.clauses)
        found = verdicts(clauses, self.clause, self.failure, self.follower.skipped)
        self.verdicts = tuple(map(str, found))

    def _scene(self) -> Scene:
        return self.mission.scene

    def _head_for(self, goal: Goal) -> None:
        """Tell the record of a new goal."""
        self._goal = goal
        clauses, rules = self.mission.command.clauses, self.mission.rules.success
        limit_goal(self._state, goal, self.mission.rules)
        done = self.follower.done
        self._arms = NO_ARMS if done else wrong_arms(clauses[self.follower.active], goal, rules)
        set_arms(self.record, self._arms)

    def _measure_way(self) -> None:
        """Measure the path to the active goal from the robot's present pose on."""
        if self._measures_way:
            ways, done = self.mission.geodesic.to(place(self.follower.goal)), self.follower.done
            self._distances = NO_DISTANCES if done else ways.distances
            set_distances(self.record, self._distances)


def _door_ends(floor_plan: FloorPlan) -> FloatArray:
    """The jambs of all doors in an array that is not read-only, and so of one type with others."""
    return floor_plan.door_ends.copy()
