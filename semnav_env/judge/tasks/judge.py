"""Judges an episode, control period by control period, on the floor plan."""

from __future__ import annotations

from math import isfinite
from typing import TYPE_CHECKING, Any, NamedTuple

from semnav_env.judge.verifier import Mission, Verifier, place
from semnav_env.judge.verifier.judge_record import NO_DISTANCES, judge_motion
from semnav_env.judge.verifier.judge_state import Outcome
from semnav_env.language import SearchHouse
from semnav_env.world.simulator.sensed import Motion

if TYPE_CHECKING:
    from semnav_env.judge.payload import Payload


class Judgement(NamedTuple):
    """What became of one control period; see `rewards.Tick`."""

    progress: float
    clause: bool
    success: bool
    failure: bool


class EpisodeJudge:
    """The verdict on an episode, the progress towards its goal and what was driven.

    Args:
        mission: what is to be done.
        payload: by which some clauses are judged.

    Attributes:
        verifier: says what became of each clause.
        verdicts: one word per clause, plain text for `info`; see `Verdict`.
        truncated: whether the time was over before the command was carried out.
    """

    truncated = False

    def __init__(self, mission: Mission, payload: Payload | None = None) -> None:
        if payload is None and SearchHouse() in mission.command.clauses:
            raise ValueError(
                '"search the house" needs a person detector: make "semnav_env:SearchAndRescue-v0", '
                "or give payload=PersonSearch() of semnav_env.rescue"
            )
        self.verifier = Verifier(mission, None if payload is None else payload.fulfils)
        self._note_verdicts()
        self._measure_way()

    def update(self, motion: Motion) -> Judgement:
        """Judge one control period."""
        self.write(motion)
        return self.think(judge_motion(self.verifier.record))

    def write(self, motion: Motion) -> None:
        """Put the motion of a control period into the verifier's record."""
        self.verifier.write(motion)

    def think(self, events: int) -> Judgement:
        """Say what became of a control period, given the events of `judge_motion`."""
        verifier, outcome = self.verifier, self.outcome
        if not events:
            return Judgement(outcome.progress, False, False, False)
        was_over = verifier.over
        completed = verifier.think(events)
        self._note_verdicts()
        ended = verifier.over and not was_over
        success = ended and verifier.success
        progress = outcome.progress
        if completed:
            progress = outcome.remaining_before if isfinite(outcome.remaining_before) else 0.0
            self._measure_way()
        return Judgement(progress, completed, success, ended != success)

    def _note_verdicts(self) -> None:
        self.verdicts = tuple(map(str, self.verifier.verdicts))

    def _measure_way(self) -> None:
        """Measure the way to the goal under way from now on, and anew from where the robot is."""
        verifier, follower = self.verifier, self.verifier.follower
        ways = verifier.mission.geodesic.to(place(follower.goal))
        verifier.head_along(NO_DISTANCES if follower.done else ways.distances)

    @property
    def outcome(self) -> Outcome:
        """What the verifier's record says of the last control period."""
        return self.verifier.read()

    @property
    def remaining(self) -> float:
        """Length of the shortest way to the goal under way, metres; 0 when all is done."""
        return self.outcome.remaining

    @property
    def info(self) -> dict[str, Any]:
        """What is known after each step, for `info`."""
        return self.info_of(self.outcome)

    def info_of(self, outcome: Outcome) -> dict[str, Any]:
        """What is known after a step, given the `outcome`."""
        return {
            "verdicts": self.verdicts,
            "collisions": outcome.collisions,
            "path_length": outcome.path_length,
            "in_contact": outcome.in_contact != 0,
            "pose": (outcome.x, outcome.y, outcome.heading),
        }

    def conclude(self, truncated: bool) -> dict[str, Any]:
        """End the episode, whose time may be over; returns what is known then, for `info`."""
        verifier = self.verifier
        if truncated:
            self.truncated = True
            verifier.out_of_time()
            self._note_verdicts()
        return {
            "is_success": verifier.success,
            "crossed_doors": tuple(verifier.crossed),
            "route_length": verifier.mission.route_length,
        }
