"""Keeps a navigator at the goal that the node wants: sends it, sends it anew, and calls it back."""

from __future__ import annotations

import math

from semnav_features.frames import Pose, wrap_angle
from semnav_ros.goal_state import GoalState
from semnav_ros.navigator import Navigator

MARGIN_DISTANCE, MARGIN_TURN = 0.1, 0.1
"""Change of a goal from which on it is sent anew, metres and radians."""

FAR = 0.5
"""Change of a goal that is no correction but another goal, and is sent at once, metres."""

CORRECTION_PERIOD = 0.5
"""Least time between two corrections of a goal, seconds: a navigator plans anew for each."""

RETRY_AFTER = 3.0
"""Time after which a goal is sent again that was not answered, given up, refused, cancelled by
somebody else, or reached although its clause is not done, seconds."""

ANSWER_TIME = 1.0
"""Time for which a goal may go without an answer, or be reached without its clause being done,
before that is a problem, seconds."""

CANCEL_PERIOD, CANCEL_TIME = 0.2, 2.0
"""How often a goal is called back until the navigator says that it is over, and for how long,
seconds: the first call may come before the goal."""


class GoalSender:
    """Compares the wanted goal with the one that was sent.

    Args:
        navigator: what drives.
    """

    def __init__(self, navigator: Navigator) -> None:
        self._navigator = navigator
        self._sent: Pose | None = None
        self._sent_at = self._driven_at = self._ended_at = self._called_at = -math.inf

    def want(self, goal: Pose | None, here: Pose, frame: str, now: float) -> str:
        """Send the wanted goal if need be, or call the last one back where none is wanted.

        Args:
            goal: pose of the base frame; None: the robot shall stand.
            here: pose of the base frame now.
            frame: name of the frame of both.
            now: time of the call, seconds.

        Returns:
            Why the robot stands although it has a goal; empty if it drives.
        """
        if goal is None:
            self._call_back(here, frame, now)
            return ""
        if self._navigator.state is GoalState.DRIVING:
            self._driven_at = now
        if self._sent is None or self._is_due(self._sent, goal, now):
            self._navigator.send(goal, frame)
            self._sent, self._sent_at, self._driven_at = goal, now, now
        return self._problem(now)

    def _is_due(self, sent: Pose, goal: Pose, now: float) -> bool:
        """Whether a goal has to be sent, although one was sent before."""
        off = math.dist(sent[:2], goal[:2])
        turned = abs(wrap_angle(goal[2] - sent[2]))
        if off > FAR:
            return True
        if off > MARGIN_DISTANCE or turned > MARGIN_TURN:
            return now - self._sent_at >= CORRECTION_PERIOD
        if self._navigator.state is GoalState.UNTOLD:
            return False
        return now - self._driven_at >= RETRY_AFTER

    def _call_back(self, here: Pose, frame: str, now: float) -> None:
        if self._sent is not None:
            self._sent, self._ended_at, self._called_at = None, now, -math.inf
        waits = now - self._ended_at <= CANCEL_TIME and not self._navigator.state.is_over
        untold = self._navigator.state is GoalState.UNTOLD and self._called_at >= self._ended_at
        if waits and not untold and now - self._called_at >= CANCEL_PERIOD:
            self._navigator.cancel(here, frame)
            self._called_at = now

    def _problem(self, now: float) -> str:
        state = self._navigator.state
        waits = (
            state in (GoalState.SENT, GoalState.REACHED) and now - self._driven_at <= ANSWER_TIME
        )
        return "" if waits else state.problem
