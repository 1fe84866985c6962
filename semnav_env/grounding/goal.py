"""Where a clause leads: the interface between grounding and driving."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

from semnav_env.features.frames import Pose
from semnav_env.features.scene import Door


class GoalKind(IntEnum):
    """What reaching a goal means.

    SEEK: the referent has not been seen yet; drive towards `pose` and keep looking.
    REACH: stand at `pose`, heading included.
    PASS: cross `door`; `pose` lies behind it, heading away from it.
    STOP: stand still.
    """

    SEEK = 0
    REACH = 1
    PASS = 2
    STOP = 3


@dataclass(frozen=True, slots=True)
class Goal:
    """A place to be, in the frame of the scene it was grounded on.

    Attributes:
        kind: what reaching it means.
        pose: where the robot's centre should come to be, (x, y, heading).
        door: the doorway to cross or to stand before; its `name` only on a true scene.
        because: one sentence that says what was understood, for the picture and the log.
    """

    kind: GoalKind
    pose: Pose
    door: Door | None = None
    because: str = ""
