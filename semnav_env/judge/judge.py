"""The judge: says whether an episode gives one of the right answers to its command."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from semnav_env.judge.judge_record import SEVERAL_ANSWERS, JudgeRecord, judge_motion
from semnav_env.judge.judge_state import Period
from semnav_env.judge.mission import Mission
from semnav_env.judge.reading_judge import ReadingJudge
from semnav_env.judge.verdict import Verdict
from semnav_env.language.finding_clauses import FindingClause
from semnav_env.mind.grounding.follower import Follower
from semnav_env.mind.grounding.goal import Goal
from semnav_env.world.simulator.sensed import Motion

if TYPE_CHECKING:
    from semnav_env.judge.payload import Payload


class Judge:
    """Judges one episode; nearly always its command has one right answer.

    Where it has several, because an opening of the plan may be a door or not, one `ReadingJudge`
    judges each. The episode succeeds with the first of them that does, and fails with the last.
    All other properties are those of the leading judge: the one with the nearest answer, until that
    fails.

    Args:
        mission: what is to be done.
        payload: decides on some clauses, in addition to the robot's pose.
        measures_way: whether to measure the progress towards the goal, which needs the shortest
            paths to each goal.

    Attributes:
        leading: the judge of the leading answer.

    Raises:
        ValueError: people are to be found without a payload.
    """

    leading: ReadingJudge

    def __init__(
        self, mission: Mission, payload: Payload | None = None, *, measures_way: bool = True
    ) -> None:
        finding = [c for c in mission.command.clauses if isinstance(c, FindingClause)]
        if payload is None and finding:
            raise ValueError(
                f'"{finding[0]}" needs a person detector: make "semnav_env:SearchAndRescue-v0", '
                "or give payload=PersonFinder() of semnav_env.rescue"
            )
        judge_of = partial(ReadingJudge, payload=payload, measures_way=measures_way)
        self._nearest = judge_of(mission)
        self._others = tuple(map(judge_of, mission.others))
        self._all = (self._nearest, *self._others)
        self.leading = self._nearest

    def update(self, motion: Motion) -> Period:
        """Judge one control period."""
        self.write(motion)
        self.think(judge_motion(self.record))
        return self.period

    def write(self, motion: Motion) -> None:
        """Put the motion of a control period into the record, for `judge_motion`."""
        self._nearest.write(motion)

    def think(self, events: int) -> None:
        """Handle the events of `judge_motion`, and complete `row`."""
        self._nearest.think(events & ~SEVERAL_ANSWERS)
        if events & SEVERAL_ANSWERS:
            for other in self._others:
                other.update_like(self._nearest)
            self._choose_leading()

    def _choose_leading(self) -> None:
        """Let an answer lead that was given, or else that can still be; copy its result."""
        judges = (self.leading, self._nearest, *self._others)
        given = (each for each in judges if each.success)
        possible = (each for each in judges if not each.over)
        self.leading = next(given, None) or next(possible, None) or self.leading
        self.row[:] = self.leading.row

    def conclude(self, truncated: bool) -> dict[str, Any]:
        """End the episode, whose time may be over; returns the entries of `info` at the end."""
        if truncated:
            for each in self._all:
                each.truncated = True
            self.out_of_time()
        return {
            "is_success": self.success,
            "crossed_doors": tuple(self.crossed),
            "route_length": self.route_length,
        }

    def out_of_time(self) -> None:
        """The episode ended before the command was carried out."""
        for each in self._all:
            each.out_of_time()

    @property
    def record(self) -> JudgeRecord:
        """Counters of the judge, for `judge_motion`."""
        return self._nearest.record

    @property
    def row(self) -> np.ndarray:
        """Result of the last control period, dtype `PERIOD`, shape (1,); part of the record."""
        return self._nearest.row

    @property
    def period(self) -> Period:
        """The result of the last control period in plain numbers."""
        return self._nearest.period

    @property
    def route_length(self) -> float:
        """Length of the route of the nearest answer, metres."""
        return self._nearest.mission.route_length

    @property
    def mission(self) -> Mission:
        """What is to be done."""
        return self.leading.mission

    @property
    def follower(self) -> Follower:
        """The follower of the command on the true scene."""
        return self.leading.follower

    @property
    def verdicts(self) -> tuple[str, ...]:
        """One word per clause, plain text for `info`; see `Verdict`."""
        return self.leading.verdicts

    @property
    def failure(self) -> Verdict | None:
        """Why the episode failed; None if it has not."""
        return self.leading.failure

    @property
    def crossed(self) -> list[str]:
        """Names of the doors that were crossed, in order."""
        return self.leading.crossed

    @property
    def remaining(self) -> float:
        """Length of the shortest path to the active goal, metres; 0 when all clauses are done."""
        return self.leading.remaining

    @property
    def success(self) -> bool:
        """Whether the whole command was carried out."""
        return self.leading.success

    @property
    def over(self) -> bool:
        """Whether the command has ended, by success or failure."""
        return self.leading.over

    @property
    def clause(self) -> int:
        """Index of the clause that is judged, see `ReadingJudge.clause`."""
        return self.leading.clause

    @property
    def completed(self) -> int:
        """Number of clauses that have been carried out."""
        return self.leading.completed

    @property
    def goals(self) -> tuple[Goal, ...]:
        """The judged goals in their order, followed by the planned goals of the remaining clauses.

        They differ from the planned goals after "go back", which leads along the driven path.
        """
        return self.leading.goals

    @property
    def verdict(self) -> Verdict:
        """The verdict on the whole command; `ACTIVE` until it ends."""
        return self.leading.verdict
