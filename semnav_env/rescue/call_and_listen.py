"""A payload: a robot that calls wherever it stands still, and locates those who answer."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from semnav_env.judge.payload import PayloadMarks
from semnav_env.language.clauses import Clause
from semnav_env.mind.belief import BeliefTracker
from semnav_env.rescue.microphones import USUAL_MICROPHONES, MicrophoneArray, MicrophoneSettings
from semnav_env.rescue.voice_fix import HeardVoice, PersonVoice, VoiceFix, by_speaker, fix
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_env.world.simulator import Motion, RobotSetup
from semnav_features.frames import ORIGIN, Pose, to_parent

STILL_SPEED, STILL_YAW_RATE = 0.02, 0.05
"""Below both a robot stands still, m/s and rad/s: its own noise would drown an answer."""

NEXT_CALL_DISTANCE = 1.0
"""Least distance between the places of two calls, metres: from nearly the same place the same is
heard."""


class CallAndListen:
    """The payload of a robot that calls out and listens; give it as `payload=` to `SemNavEnv`.

    The robot calls when it has stood still for as long as a call and its answers last, at least
    `NEXT_CALL_DISTANCE` from where it called before. It uses its believed pose alone.

    Args:
        settings: of the microphones, and of the people.

    Attributes:
        voices: the directions of voices, in the order in which they were heard.
    """

    settings: MicrophoneSettings

    def __init__(self, settings: MicrophoneSettings = USUAL_MICROPHONES) -> None:
        self.settings = settings

    def begin(
        self, plan: FloorPlan, setup: RobotSetup, start: Pose, rng: np.random.Generator
    ) -> None:
        """See `Payload`."""
        self._microphones = MicrophoneArray(
            plan, self.settings, np.random.default_rng(rng.integers(2**62))
        )
        self._frame = ORIGIN if setup.exact else start
        self._still, self._called_at = 0.0, list[Pose]()
        self.voices: list[PersonVoice] = []

    def update(self, motion: Motion, tracker: BeliefTracker) -> None:
        """See `Payload`."""
        stands = abs(motion.speed) < STILL_SPEED and abs(motion.yaw_rate) < STILL_YAW_RATE
        self._still = self._still + motion.seconds if stands else 0.0
        pose = tracker.belief.pose
        near = any(math.dist(pose[:2], p[:2]) < NEXT_CALL_DISTANCE for p in self._called_at)
        if self._still < self.settings.listening or near:
            return
        self._called_at.append(pose)
        for person, bearing, std in self._microphones.call(motion.pose):
            self.voices.append(PersonVoice(person, HeardVoice(pose, bearing, std)))

    @property
    def calls(self) -> int:
        """Number of calls so far."""
        return len(self._called_at)

    @property
    def fixes(self) -> dict[int, VoiceFix]:
        """The people whose place is known, by number of the person, odometry frame."""
        found = {person: fix(voices) for person, voices in by_speaker(self.voices).items()}
        return {person: each for person, each in found.items() if each is not None}

    def fulfils(self, clause: Clause) -> bool:
        """See `Payload`: listening decides on no clause."""
        return True

    def marks(self) -> PayloadMarks:
        """See `Payload`: flags where the people are believed to be."""
        flags = [to_parent(self._frame, each.place) for each in self.fixes.values()]
        status = (
            f"calls: {self.calls}   heard: {len(by_speaker(self.voices))}   located: {len(flags)}"
        )
        return PayloadMarks(np.empty((0, 2)), np.array(flags).reshape(-1, 2), status)

    def start_info(self) -> dict[str, Any]:
        """See `Payload`: the robot knows the settings of its microphones."""
        return {"microphones": vars(self.settings).copy()}

    def final_info(self) -> dict[str, Any]:
        """See `Payload`: world frame."""
        places = {p: to_parent(self._frame, each.place) for p, each in self.fixes.items()}
        heard = len(by_speaker(self.voices))
        return {"voices": {"calls": self.calls, "heard": heard, "located": places}}
