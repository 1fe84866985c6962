"""The verifier: follows one episode on the true scene and judges it."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from semnav_env.features.frames import Pose
from semnav_env.features.rules import DoorRules
from semnav_env.features.scene import Scene
from semnav_env.grounding.crossing import first_crossed
from semnav_env.grounding.follower import Follower
from semnav_env.grounding.goal import Goal, PassGoal, wait_of
from semnav_env.grounding.ways import KnownWays
from semnav_env.maps.floor_plan import PlanDoor
from semnav_env.simulator.sensed import Motion
from semnav_env.verifier.astray import went_astray
from semnav_env.verifier.mission import Mission
from semnav_env.verifier.verdict import Verdict, verdicts


class Verifier:
    """Judges one episode on the true scene.

    A door clause is done when the robot's centre crosses that very door; a place is reached when
    the centre comes within the tolerances of the clause's goal on the true scene.

    Args:
        mission: what is to be done.

    Attributes:
        mission: likewise.
        follower: how far the command has truly come.
        failure: why the episode failed; None if it has not.
        crossed: names of the doors that were crossed, in order.
    """

    def __init__(self, mission: Mission) -> None:
        self.mission = mission
        self.follower = Follower(
            mission.command, complete=True, guide=KnownWays(mission.ways), rules=mission.rules
        )
        self.follower.start(mission.scene, mission.start)
        self.failure: Verdict | None = None
        self.crossed: list[str] = []
        self._met: list[Goal] = []
        self._still = 0.0
        self._last = mission.start

    def update(self, motion: Motion) -> bool:
        """Judge one control period; returns whether it completed a clause."""
        pose, speed, yaw_rate, _, seconds = motion
        rules = self.mission.rules.success
        still = speed < rules.still_speed and abs(yaw_rate) < rules.still_yaw_rate
        self._still = self._still + seconds if still else 0.0
        goal = self.follower.goal
        allowed = rules.still_seconds + wait_of(goal)
        completed = self.follower.advance(self._scene, pose, speed, seconds)
        if completed:
            self._met.append(goal)
        self._judge(goal, completed, pose, self._still > allowed)
        self._last = pose
        return completed

    def out_of_time(self) -> None:
        """The episode ended before the command was carried out."""
        if not self.over:
            stopped = self._still > self.mission.rules.success.final_still_seconds
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

    def _scene(self) -> Scene:
        return self.mission.scene

    def _judge(self, goal: Goal, completed: bool, pose: Pose, too_still: bool) -> None:
        crossed, rules = self._crossed_door(pose), self.mission.rules.door
        if crossed is not None:
            self.crossed.append(crossed.name)
        if (self.failure is None and not self.follower.done) or completed:
            if crossed is not None and not _may_cross(goal, crossed, rules):
                self.failure = Verdict.WRONG_DOOR
            elif not completed and self._went_astray(goal, pose):
                self.failure = Verdict.WRONG_TURN
            elif not self.follower.done and too_still:
                self.failure = Verdict.STOPPED_SHORT

    def _went_astray(self, goal: Goal, pose: Pose) -> bool:
        clause = self.mission.command.clauses[self.follower.active]
        return went_astray(clause, goal, pose, self.mission.rules.success)

    def _crossed_door(self, pose: Pose) -> PlanDoor | None:
        plan = self.mission.floor_plan
        index = first_crossed(plan.door_ends, *self._last[:2], *pose[:2])
        return None if index < 0 else plan.doors[index]


def _may_cross(goal: Goal, crossed: PlanDoor, rules: DoorRules) -> bool:
    """Whether a goal is to pass that very door, or lies beyond it on the way that is known.

    What is too wide to count as a door may be crossed anyway.
    """
    if crossed.is_opening(rules):
        return True
    if isinstance(goal, PassGoal) and goal.door.name == crossed.name:
        return True
    line = np.array([(*crossed.start, *crossed.end)])
    return any(first_crossed(line, *a, *b) == 0 for a, b in pairwise(goal.places))
