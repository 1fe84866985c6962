"""What drives to goals where the node does not say velocities: nav2, move_base, or another one."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol, TypeAlias

from semnav_features.frames import Pose
from semnav_ros.goal_state import GoalState

TakeGoal: TypeAlias = Callable[[Pose | None], None]
"""What a goal is given to; None when it is called back."""


class Navigator(Protocol):
    """Drives a robot to one goal at a time.

    Attributes:
        state: what has become of the goal that was sent last.
    """

    state: GoalState

    def send(self, goal: Pose, frame: str) -> None:
        """Send a goal, the pose of the base frame in a frame; it replaces the last one."""

    def cancel(self, here: Pose, frame: str) -> None:
        """Call the last goal back; the base frame lies `here` now."""


class NavigatorServer(Protocol):
    """The other side: gives goals to what drives, and tells what becomes of them."""

    def tell(self, state: GoalState) -> None:
        """Tell what has become of the goal."""
