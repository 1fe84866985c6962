"""A payload: a further sensor, what the robot makes of it, and how clauses are judged by it."""

from __future__ import annotations

from typing import Any, NamedTuple, Protocol, runtime_checkable

import numpy as np

from semnav_env.language.clauses import Clause
from semnav_env.mind.belief import BeliefTracker
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_env.world.simulator.sensed import Motion
from semnav_env.world.simulator.simulator import RobotSetup
from semnav_features.frames import FloatArray, Pose


class PayloadMarks(NamedTuple):
    """What a picture shows of a payload, world frame.

    Attributes:
        floor: middles of the cells of floor that were looked at, shape (n, 2).
        flags: places to show a flag at, shape (k, 2).
        status: a line of text.
    """

    floor: FloatArray
    flags: FloatArray
    status: str


@runtime_checkable
class Payload(Protocol):
    """What a robot carries beside its lidar, as `SemNavEnv(payload=...)` takes it.

    Entries of the observation see it as `Moment.payload`, rewards as `Tick.payload`.
    """

    def begin(
        self, plan: FloorPlan, setup: RobotSetup, start: Pose, rng: np.random.Generator
    ) -> None:
        """Begin an episode; `update` follows at once.

        Args:
            plan: of the episode.
            setup: body and sensors of the robot.
            start: its true pose, world frame.
            rng: of the environment.
        """

    def update(self, motion: Motion, tracker: BeliefTracker) -> None:
        """Take in one control period, after the robot's belief and before `Judge.think`.

        Args:
            motion: the true one.
            tracker: the robot's belief.
        """

    def fulfils(self, clause: Clause) -> bool:
        """Whether a clause whose goal was reached has been carried out in full."""
        ...

    def marks(self) -> PayloadMarks:
        """What a picture shows of it."""
        ...

    def start_info(self) -> dict[str, Any]:
        """What `reset` says of it, for `info`."""
        ...

    def final_info(self) -> dict[str, Any]:
        """What is known at the end of an episode, for `info`."""
        ...


def as_payload(value: object) -> Payload | None:
    """What `payload=` takes, as it is.

    Raises:
        ValueError: an object that is none.
    """
    if value is None or (isinstance(value, Payload) and not isinstance(value, type)):
        return value
    raise ValueError(
        f"payload is {value!r:.80}; it must be None or have begin, update, fulfils, "
        "marks, start_info and final_info, as semnav_env.rescue.PersonSearch has"
    )
