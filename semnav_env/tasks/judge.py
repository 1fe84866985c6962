"""Judges an episode, control period by control period, on the floor plan."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from semnav_env.simulator.sensed import Motion
from semnav_env.verifier import Journey, Mission, RemainingWay, Verifier


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

    Attributes:
        verifier: says what became of each clause.
        journey: path length and contacts.
    """

    def __init__(self, mission: Mission) -> None:
        self.verifier = Verifier(mission)
        self.journey = Journey(mission.start)
        self._way = RemainingWay(self.verifier, mission.geodesic)
        self._remaining = self._way.length(mission.start)
        self._motion: Motion | None = None

    def update(self, motion: Motion) -> Judgement:
        """Judge one control period."""
        verifier = self.verifier
        was_over = verifier.over
        self._motion = motion
        self.journey.add(motion)
        completed = verifier.update(motion)
        remaining = self._way.length(motion.pose)
        progress = self._remaining - (0.0 if completed else remaining)
        self._remaining = remaining
        ended = verifier.over and not was_over
        success = ended and verifier.success
        progress = progress if math.isfinite(progress) else 0.0
        return Judgement(progress, completed, success, ended != success)

    @property
    def info(self) -> dict[str, Any]:
        """What is known after each step, for `info`."""
        assert self._motion is not None, "call update(motion) first"
        return {
            "verdicts": self.verifier.verdicts,
            "collisions": self.journey.collisions,
            "path_length": self.journey.path_length,
            "in_contact": self._motion.in_contact,
            "pose": self._motion.pose,
        }

    @property
    def outcome(self) -> dict[str, Any]:
        """What is known at the end."""
        verifier = self.verifier
        crossed = tuple(verifier.crossed)
        ended = {"is_success": verifier.success, "crossed_doors": crossed}
        return ended | verifier.mission.info
