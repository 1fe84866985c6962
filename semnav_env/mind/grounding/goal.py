"""Goals of clauses, the interface between grounding and driving."""

from __future__ import annotations

import math
from dataclasses import KW_ONLY, dataclass, field
from enum import IntEnum
from typing import ClassVar, TypeAlias

from semnav_env.language.references import Side
from semnav_env.language.told import Told
from semnav_env.mind.grounding.goal_check import is_crossed, is_reached
from semnav_features.corridor import Corridor, Junction
from semnav_features.frames import Point, Pose
from semnav_features.scene import Door

LOOKING = "looking for {what:dative}"
"""What a robot tells while its referent has not been seen."""


class GoalKind(IntEnum):
    """The kind of a goal, as a number for observations."""

    SEEK = 0
    REACH = 1
    PASS = 2
    STOP = 3


@dataclass(frozen=True, slots=True)
class BaseGoal:
    """Fields of all goals, in the frame of the scene on which the clause was grounded.

    Attributes:
        pose: pose that the robot's centre should reach, (x, y, heading), metres and radians.
        corridor: the corridor in which the referent was found.
        onward: pose at which the next clause begins, such as the middle of the crossed doorway or
            the mouth of the arm; None for `pose`.
        places: places of the known way to the goal, from its beginning on, (x, y) in metres.
        wall: the side of the corridor along whose wall that way leads; None for any other way.
    """

    kind: ClassVar[GoalKind]
    pose: Pose
    _: KW_ONLY
    corridor: Corridor | None = field(default=None, compare=False, repr=False)
    onward: Pose | None = None
    places: tuple[Point, ...] = field(default=(), compare=False, repr=False)
    wall: Side | None = field(default=None, compare=False, repr=False)

    @property
    def next_begin(self) -> Pose:
        """Pose at which the next clause begins."""
        return self.onward or self.pose


@dataclass(frozen=True, slots=True)
class SeekGoal(BaseGoal):
    """Drive towards `pose` and keep looking: the referent has not been seen yet.

    Attributes:
        what: the referent of the search, in words.
    """

    kind: ClassVar[GoalKind] = GoalKind.SEEK
    what: str

    @property
    def because(self) -> str:
        """The object of the goal in words, for the picture and the log."""
        return Told(LOOKING, what=self.what)


@dataclass(frozen=True, slots=True)
class ReachGoal(BaseGoal):
    """Be at `pose`, within the tolerances.

    Attributes:
        distance_tolerance: largest distance from `pose`, metres.
        heading_tolerance: largest heading error, radians; pi if the heading is free.
        because: the understood referent in words, for the picture and the log.
        door: the doorway to stand before; it has a `name` only on a true scene.
        junction: the junction at which to turn.
        beside: the door beside which the goal lies, of "until the second door".
        offset_tolerance: if it is not None, `distance_tolerance` counts only along the pose's
            heading, and this tolerance across it, metres: at the end of a known way, where
            odometry may have drifted, and in the arm of a junction, which may be wide.
        backwards: whether the robot drives to it backwards, without a turn.
    """

    kind: ClassVar[GoalKind] = GoalKind.REACH
    distance_tolerance: float
    heading_tolerance: float = math.pi
    because: str = ""
    door: Door | None = None
    junction: Junction | None = field(default=None, compare=False, repr=False)
    beside: Door | None = field(default=None, compare=False, repr=False)
    offset_tolerance: float | None = field(default=None, compare=False, repr=False)
    backwards: bool = field(default=False, compare=False, repr=False)

    @property
    def fixes_heading(self) -> bool:
        """Whether the robot must face a direction there."""
        return self.heading_tolerance < math.pi

    @property
    def tolerances(self) -> tuple[float, float, float]:
        """Tolerances of distance, heading and offset; NaN if there is none for the offset."""
        offset = math.nan if self.offset_tolerance is None else self.offset_tolerance
        return self.distance_tolerance, self.heading_tolerance, offset

    def reached_by(self, pose: Pose, share: float = 1.0) -> bool:
        """Whether `pose` lies within the tolerances, or within a `share` of them."""
        return is_reached(self.pose, self.tolerances, pose, share)


@dataclass(frozen=True, slots=True)
class PassGoal(BaseGoal):
    """Cross a doorway; `pose` lies behind it, heading away from it.

    Attributes:
        door: the doorway; its `name` only on a true scene.
        because: what was understood, for the picture and the log.
    """

    kind: ClassVar[GoalKind] = GoalKind.PASS
    door: Door
    because: str = ""

    def crossed_between(self, before: Pose, after: Pose, margin: float = 0.0) -> bool:
        """Whether the step from `before` to `after` leads forward through the door.

        Args:
            before: a pose of the robot's centre.
            after: the next pose.
            margin: distance beside the jambs that still counts, and distance behind them that the
                step must reach, metres; for a door that is not known exactly.
        """
        ends, heading = (*self.door.start, *self.door.end), self.pose[2]
        return is_crossed(before[:2], after[:2], ends, self.door.width, heading, margin)


@dataclass(frozen=True, slots=True)
class StopGoal(BaseGoal):
    """Stand still.

    Attributes:
        because: what was understood, for the picture and the log.
        wait: duration of standing still, seconds.
        roams: whether the robot may drive anywhere before, through any door; it then stands still
            to say that it has finished.
    """

    kind: ClassVar[GoalKind] = GoalKind.STOP
    because: str = ""
    wait: float = 0.0
    roams: bool = False


Goal: TypeAlias = SeekGoal | ReachGoal | PassGoal | StopGoal
"""The goal of a clause."""


def door_of(goal: Goal) -> Door | None:
    """The doorway that a goal is to cross, or to stand before."""
    match goal:
        case PassGoal(door=door) | ReachGoal(door=door):
            return door
        case SeekGoal() | StopGoal():
            return None


def wait_of(goal: Goal) -> float:
    """Time for which the robot must stand still at a goal, seconds."""
    return goal.wait if isinstance(goal, StopGoal) else 0.0
