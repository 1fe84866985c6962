"""What a robot on the tour takes its pose to be, with each correction of its odometry."""

from __future__ import annotations

from typing import Protocol

import numpy as np

from semnav_env.language import parse
from semnav_env.mind.belief import BeliefTracker
from semnav_env.mind.localization import PlanLocalizer
from semnav_env.robots import SPOT
from semnav_env.world.simulator import Sensed
from semnav_features.frames import Pose, compose, relative
from studies.tour.detectors import DoorSensor

LOOK_DISTANCE, LOOK_TURN = 0.4, 0.3
"""The robot looks for doors again after such a way or such a turn, metres and radians. The less it
moves from look to look, the better it knows what to expect, and the fewer wrong doors pass the
gate."""

REACH = 2.5
"""Distance to the middle of a door within which it is looked for, metres."""


class PoseBelief(Protocol):
    """A pose in the frame of the plan that is believed at every control period."""

    pose: Pose

    def update(self, sensed: Sensed) -> None:
        """Take in a control period."""


class DeadReckoning:
    """Odometry alone."""

    def __init__(self, start: Pose) -> None:
        self.start = self.pose = start

    def update(self, sensed: Sensed) -> None:
        """Take in a control period."""
        self.pose = compose(self.start, sensed.odometry)


class WallsSeenAgain:
    """Odometry corrected as that of an agent without a map (`BeliefTracker`)."""

    def __init__(self, start: Pose) -> None:
        self.start = self.pose = start
        self._tracker = BeliefTracker(mount=SPOT.lidar_mount)
        self._tracker.begin(parse("stop"))

    def update(self, sensed: Sensed) -> None:
        """Take in a control period."""
        belief = self._tracker.update(sensed.ranges, sensed.odometry, sensed.velocity, sensed.bumps)
        self.pose = compose(self.start, belief.pose)


class DoorsOfThePlan:
    """A `PlanLocalizer` that looks for doors from time to time.

    Args:
        localizer: at the start.
        sensor: finds doors.
        rng: of its errors.
        reckoning: what moves the localizer: odometry, corrected or not.

    Attributes:
        corrected: the poses before and after each correction of this period.
        refused: detections that were refused so far.
    """

    def __init__(
        self,
        localizer: PlanLocalizer,
        sensor: DoorSensor,
        rng: np.random.Generator,
        reckoning: PoseBelief,
    ) -> None:
        self.localizer, self.reckoning = localizer, reckoning
        self.pose, self.corrected, self.refused = localizer.pose, list[tuple[Pose, Pose]](), 0
        self._sensor, self._rng = sensor, rng
        self._looked: Pose | None = None

    def update(self, sensed: Sensed) -> None:
        """Take in a control period, and look for doors where it is time."""
        self.reckoning.update(sensed)
        self.localizer.move(self.reckoning.pose, bool(sensed.bumps))
        self.corrected = []
        if self._looked is None or _is_far(relative(self._looked, sensed.odometry)):
            self._looked = sensed.odometry
            self._look(sensed)
        self.pose = self.localizer.pose

    def _look(self, sensed: Sensed) -> None:
        expected = list(self.localizer.expected(REACH))
        search = self._sensor(sensed, self._rng) if expected else None
        for door, sigma in expected:
            detected = search(door, sigma) if search else None
            if detected is None:
                continue
            before = self.localizer.pose
            if self.localizer.correct(detected) is None:
                self.refused += 1
            else:
                self.corrected.append((before, self.localizer.pose))


def _is_far(moved: Pose) -> bool:
    return float(np.hypot(*moved[:2])) > LOOK_DISTANCE or abs(moved[2]) > LOOK_TURN
