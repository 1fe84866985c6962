"""Suites of trials, on which agents are measured."""

from __future__ import annotations

import math
from dataclasses import dataclass

from semnav_env.judge.episodes import SPLITS
from semnav_env.language.suggest import did_you_mean
from semnav_features.frames import Pose


@dataclass(frozen=True)
class Trial:
    """A command and an approximate start pose.

    Attributes:
        floor_plan: bundled name or path.
        command: what the robot is told.
        pose: pose around which the robot starts, world frame.
        scatter: largest deviation of the start in x, y (metres) and heading (radians).
    """

    floor_plan: str
    command: str
    pose: Pose
    scatter: Pose = (0.2, 0.2, 0.2)

    @property
    def group(self) -> str:
        """Name of its group in tables: the plan and the command."""
        return f"{self.floor_plan}: {self.command}"


def _trials(floor_plan: str, pose: Pose, *commands: str) -> tuple[Trial, ...]:
    return tuple(Trial(floor_plan, command, pose) for command in commands)


_HEIDELBERG = _trials(
    "heidelberg_hallway",
    (-2.5, -0.3, 0.24),
    "go through the first door on the right",
    "go through the second door on the right",
    "go through the third door on the right",
    "go down the hallway, turn left at the intersection and go in the first door on the right",
)

_FROM_WEST = _trials(
    "office_cross",
    (1.3, 9.1, 0.0),
    "go through the first door on the right",
    "enter the second door on the left",
    "go through the third door on the right",
    "go to the second door on the right",
    "go through the fourth door on the left",
    "follow the hallway until the intersection",
    "go to the end of the hallway",
    "turn left at the intersection and go in the first door on the right",
    "turn right at the intersection and go through the first door on the left",
    "turn right at the intersection and follow the hallway until the end",
    "go down the hallway, turn left at the intersection and go through the first door on the left",
    "turn left at the intersection, turn right at the corner and take the second door on the right",
    "turn left at the intersection, turn right at the corner and take the last door on the left",
)

_FROM_EAST = _trials(
    "office_cross",
    (28.6, 9.1, math.pi),
    "take the first door on the right",
    "go through the second door on the left",
    "turn right at the intersection and take the first door on the left",
)

_FROM_SOUTH = _trials(
    "office_cross",
    (15.0, 1.0, math.pi / 2),
    "go through the first door on the left",
    "turn right at the intersection and go through the second door on the right",
    "turn left at the intersection and go through the first door on the right",
    "follow the hallway to the intersection, then turn around",
)

_FROM_BEND = _trials(
    "office_cross",
    (26.0, 19.1, math.pi),
    "go in the first door on the right",
    "turn left at the corner and go through the second door on the left",
    "go down the hallway, turn left and take the first door on the right",
)

_VILLA_HALL = (
    *_trials(
        "villa_hall",
        (1.0, 1.0, math.pi / 2),
        "turn left at the next corner",
        "turn left at the corner and go through the first door on the right",
        "go to the parents' bedroom",
        "go to the daughter's room",
    ),
    *_trials("villa_hall", (1.2, 3.7, -math.pi / 2), "go through the first door on the left"),
    *_trials(
        "villa_hall",
        (-3.0, 4.35, 0.0),
        "turn right at the next corner",
        "go to the living room",
        "go to the kitchen",
    ),
    *_trials("villa_hall", (-5.4, 4.35, 0.0), "take the first door on the left"),
    *_trials("villa_hall", (-1.5, 4.35, math.pi), "go through the first door on the right"),
)

SUITES = {
    "heidelberg": _HEIDELBERG,
    "office_cross": _FROM_WEST + _FROM_EAST + _FROM_SOUTH + _FROM_BEND,
    "villa_hall": _VILLA_HALL,
}
"""The suites by name; each is in the floor plan whose name it has, or begins with."""


def suite(name: str) -> tuple[Trial, ...]:
    """The trials of a suite, or of all suites for "all".

    Raises:
        ValueError: there is no such suite; the error lists the suites.
    """
    if name == "all":
        return tuple(trial for trials in SUITES.values() for trial in trials)
    if name not in SUITES:
        there = f"{', '.join(SUITES)}, all, and the splits {', '.join(SPLITS)}"
        hint = did_you_mean(name, (*SUITES, "all", *SPLITS))
        raise ValueError(f"no suite {name!r:.80}; there are: {there}{hint}")
    return SUITES[name]
