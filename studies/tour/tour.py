"""One tour: the robot follows its way through the villa on what it believes."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from semnav_env.mind.localization import PlanLocalizer
from semnav_env.robots import SPOT
from semnav_env.world.simulator import (
    SPOT_ODOMETRY,
    OdometrySettings,
    RobotSetup,
    Sensed,
    Simulator,
)
from semnav_features.frames import Point, Pose, compose
from studies.tour.beliefs import (
    DeadReckoning,
    DoorsOfThePlan,
    PoseBelief,
    WallsSeenAgain,
)
from studies.tour.detectors import DoorSensor, by_finder, by_lidar, by_mes
from studies.tour.pursuit import PlanPursuit
from studies.tour.villa import ROOMS, START, room_at, tour_way, villa

MAX_SECONDS = 400.0
"""After so much simulated time a tour is given up; one without errors takes 138 s."""

DOORWAY = 0.5
"""An error below this says nothing about the room, metres."""

CORRECTIONS: dict[str, tuple[DoorSensor | None, bool]] = {
    "none": (None, False),
    "walls seen again": (None, True),
    "doors, Mes 2021": (by_mes, False),
    "doors, finder": (by_finder, False),
    "doors, lidar": (by_lidar, False),
    "doors, lidar, and walls": (by_lidar, True),
}
"""What corrects the pose: a detector for the doors of the plan, and whether walls do."""


@dataclass(frozen=True)
class TourPeriod:
    """One control period of a tour; poses in the world frame.

    Attributes:
        true: pose.
        believed: pose.
        reckoned: pose by odometry alone.
        touching: whether the body touches anything.
        corrections: believed poses before and after each door that was taken.
        refused: detections that were refused so far.
    """

    true: Pose
    believed: Pose
    reckoned: Pose
    touching: bool
    corrections: tuple[tuple[Pose, Pose], ...]
    refused: int

    @property
    def error(self) -> float:
        """Distance of the believed from the true place, metres."""
        return math.dist(self.true[:2], self.believed[:2])

    @property
    def is_lost(self) -> bool:
        """Whether the robot is in another room than it believes."""
        return room_at(_place(self.true)) != room_at(_place(self.believed)) and self.error > DOORWAY


def _place(pose: Pose) -> Point:
    return pose[:2]


def tour(correction: str, factor: float, seed: int) -> Iterator[TourPeriod]:
    """The control periods of a tour.

    Args:
        correction: a key of `CORRECTIONS`.
        factor: the errors of SPOT's odometry are this many times as large as in its preset.
        seed: of the odometry's and the sensors' errors.
    """
    odometry = SPOT_ODOMETRY.scaled(factor)
    simulator = Simulator(villa(), RobotSetup(SPOT, odometry=odometry))
    sensed = simulator.reset(START, np.random.default_rng((seed, 0)))
    belief = make_belief(correction, odometry, np.random.default_rng((seed, 1)))
    pursuit, limit = PlanPursuit(tour_way()), round(MAX_SECONDS * simulator.setup.control_hz)
    while True:
        belief.update(sensed)
        yield _period(sensed, belief)
        if pursuit.is_done or simulator.steps >= limit:
            return
        sensed = simulator.step(pursuit.twist(belief.pose, sensed.bumps))


def make_belief(
    correction: str, odometry: OdometrySettings, rng: np.random.Generator
) -> PoseBelief:
    """The belief of a robot at `START`, with a correction of `CORRECTIONS`."""
    sensor, by_walls = CORRECTIONS[correction]
    reckoning = WallsSeenAgain(START) if by_walls else DeadReckoning(START)
    if sensor is None:
        return reckoning
    doors = tuple(door.as_door() for door in villa().doors)
    localizer = PlanLocalizer(doors, START, odometry)
    return DoorsOfThePlan(localizer, sensor, rng, reckoning)


def _period(sensed: Sensed, belief: PoseBelief) -> TourPeriod:
    corrections: tuple[tuple[Pose, Pose], ...] = ()
    refused = 0
    if isinstance(belief, DoorsOfThePlan):
        corrections, refused = tuple(belief.corrected), belief.refused
    reckoned = compose(START, sensed.odometry)
    motion = sensed.motion
    return TourPeriod(motion.pose, belief.pose, reckoned, motion.in_contact, corrections, refused)


@dataclass(frozen=True)
class TourResult:
    """What became of a tour.

    Attributes:
        error: distance of the believed from the true place at the end, metres.
        heading_error: likewise, radians.
        reckoned_error: that of the odometry alone, over the same way.
        rooms: how many of the ten were truly entered.
        lost: whether the robot was ever in another room than it believed.
        corrections: doors that were taken.
        refused: detections that were refused.
        worst_correction: largest error of the place right after a correction, metres.
        worst_harm: by how much a correction made the error larger at most, metres.
        contacts: seconds in contact with anything.
        seconds: of the tour.
    """

    error: float
    heading_error: float
    reckoned_error: float
    rooms: int
    lost: bool
    corrections: int
    refused: int
    worst_correction: float
    worst_harm: float
    contacts: float
    seconds: float


def result(periods: list[TourPeriod], control_hz: float = 15.0) -> TourResult:
    """The figures of a tour."""
    last = periods[-1]
    offs = [
        [math.dist(period.true[:2], pose[:2]) for pose in poses]
        for period in periods
        for poses in period.corrections
    ]
    return TourResult(
        last.error,
        abs(math.remainder(last.true[2] - last.believed[2], math.tau)),
        math.dist(last.true[:2], last.reckoned[:2]),
        len({room_at(_place(period.true)) for period in periods} & ROOMS.keys()),
        any(period.is_lost for period in periods),
        len(offs),
        last.refused,
        max((after for _, after in offs), default=0.0),
        max((after - before for before, after in offs), default=0.0),
        sum(period.touching for period in periods) / control_hz,
        len(periods) / control_hz,
    )
