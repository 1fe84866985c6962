"""Events of a drive as typed values.

`step` is the row of the recording at which it is first true; `seconds` the time since the start.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import TypeAlias


class Arm(StrEnum):
    """Arm by which a junction was left, as seen from the arm of entry."""

    AHEAD = "ahead"
    LEFT = "left"
    RIGHT = "right"
    BACK = "back"


@dataclass(frozen=True, slots=True)
class DoorCrossed:
    """The robot's centre crossed the line between a door's jambs.

    Attributes:
        step: row of the recording.
        seconds: since the start.
        door: name of the door.
        from_left: whether the robot came from the left of the line from the first jamb of the
            door to its second, where the corridor lies in the bundled plans.
        origin: the region that it came from; empty where the plan names none.
        into: the region that it came into.
    """

    step: int
    seconds: float
    door: str
    from_left: bool
    origin: str
    into: str


@dataclass(frozen=True, slots=True)
class JunctionEntered:
    """The robot's centre entered an intersection of the plan.

    Attributes:
        step: row of the recording.
        seconds: since the start.
        junction: name of the intersection.
        origin: the region that it came from.
    """

    step: int
    seconds: float
    junction: str
    origin: str


@dataclass(frozen=True, slots=True)
class JunctionLeft:
    """The robot's centre left an intersection of the plan.

    Attributes:
        step: row of the recording.
        seconds: since the start.
        junction: name of the intersection.
        arm: side of the exit, as seen from the side of entry.
        into: the region that it came into.
    """

    step: int
    seconds: float
    junction: str
    arm: Arm
    into: str


@dataclass(frozen=True, slots=True)
class Turned:
    """The robot turned without a pause.

    Attributes:
        step: row of the recording at which the turn began.
        seconds: since the start.
        angle: heading change, radians, positive to the left.
        duration: seconds.
    """

    step: int
    seconds: float
    angle: float
    duration: float


@dataclass(frozen=True, slots=True)
class Stopped:
    """The robot stopped.

    Attributes:
        step: row of the recording.
        seconds: since the start.
        duration: time of standing still, seconds.
    """

    step: int
    seconds: float
    duration: float


@dataclass(frozen=True, slots=True)
class ContactBegun:
    """The robot touched something.

    Attributes:
        step: row of the recording.
        seconds: since the start.
        impulse: received in that step, N s.
        total: received until the contact ended, N s.
        duration: duration of the contact, seconds.
    """

    step: int
    seconds: float
    impulse: float
    total: float
    duration: float


Event: TypeAlias = DoorCrossed | JunctionEntered | JunctionLeft | Turned | Stopped | ContactBegun
"""Any event of a drive."""
