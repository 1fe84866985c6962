"""What a navigator says about a goal, and the numbers that ROS has for it."""

from __future__ import annotations

from enum import Enum


class GoalState(Enum):
    """What has become of the goal that was sent last."""

    UNTOLD = "untold"
    """The navigator does not tell: it hears goals on a topic alone."""

    SENT = "sent"
    DRIVING = "driving"
    REACHED = "reached"
    GIVEN_UP = "given up"
    REFUSED = "refused"
    CANCELLED = "cancelled"

    @property
    def is_over(self) -> bool:
        """Whether the navigator is done with the goal."""
        return self not in (GoalState.UNTOLD, GoalState.SENT, GoalState.DRIVING)

    @property
    def problem(self) -> str:
        """Why a robot stands whose goal is still wanted; empty if it drives."""
        return _PROBLEMS.get(self, "")


_PROBLEMS = {
    GoalState.SENT: "no navigator has answered",
    GoalState.REACHED: "the navigator says that it is there, but the clause is not done",
    GoalState.GIVEN_UP: "the navigator has given up the goal",
    GoalState.REFUSED: "the navigator has refused the goal",
    GoalState.CANCELLED: "somebody else has cancelled the goal",
}

ACTIONLIB_STATES = {
    0: GoalState.DRIVING,
    1: GoalState.DRIVING,
    2: GoalState.CANCELLED,
    3: GoalState.REACHED,
    4: GoalState.GIVEN_UP,
    5: GoalState.REFUSED,
    6: GoalState.DRIVING,
    7: GoalState.DRIVING,
    8: GoalState.CANCELLED,
    9: GoalState.GIVEN_UP,
}
"""By the numbers of actionlib_msgs/GoalStatus, ROS 1: pending, active, preempted, succeeded,
aborted, rejected, preempting, recalling, recalled, lost."""

ACTION_STATES = {
    1: GoalState.DRIVING,
    2: GoalState.DRIVING,
    3: GoalState.DRIVING,
    4: GoalState.REACHED,
    5: GoalState.CANCELLED,
    6: GoalState.GIVEN_UP,
}
"""By the numbers of action_msgs/GoalStatus, ROS 2: accepted, executing, canceling, succeeded,
canceled, aborted."""


def number_of(states: dict[int, GoalState], state: GoalState) -> int:
    """The last number that stands for a state."""
    return max(number for number, known in states.items() if known is state)
