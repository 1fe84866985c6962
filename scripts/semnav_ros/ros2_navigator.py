"""nav2's NavigateToPose by rclpy's action client."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from rclpy.action import ActionClient

from semnav_features.frames import Pose
from semnav_ros import conversions
from semnav_ros.fields import written
from semnav_ros.goal_state import ACTION_STATES, GoalState
from semnav_ros.nav2 import NAVIGATE_TO_POSE


class Ros2Navigator:
    """Sends goals to nav2.

    Args:
        node: of rclpy.
        name: of the action.
    """

    state: GoalState

    def __init__(self, node: Any, name: str = NAVIGATE_TO_POSE) -> None:
        self._action = import_module("nav2_msgs.action").NavigateToPose
        self._client = ActionClient(node, self._action, name)
        self._asked: Any = None
        self._handle: Any = None
        self.state = GoalState.CANCELLED

    def send(self, goal: Pose, frame: str) -> None:
        """Send a goal; nav2 drops the one before. Nothing is sent where nobody listens."""
        self._asked = self._handle = None
        self.state = GoalState.SENT
        if not self._client.server_is_ready():
            return
        values = {"frame": frame} | conversions.pose_values(goal)
        message = written("nav2_msgs/NavigateToPose_Goal", values, lambda _: self._action.Goal())
        self._asked = asked = self._client.send_goal_async(message)
        asked.add_done_callback(self._take_answer)

    def cancel(self, here: Pose, frame: str) -> None:
        """Call the last goal back."""
        if self._handle is not None:
            self._handle.cancel_goal_async()

    def _take_answer(self, asked: Any) -> None:
        """Take whether a goal was accepted, and wait for what becomes of it."""
        if asked is not self._asked:
            return
        handle = asked.result()
        if not handle.accepted:
            self.state = GoalState.REFUSED
            return
        self._handle, self.state = handle, GoalState.DRIVING
        ended = handle.get_result_async()
        ended.add_done_callback(lambda result: self._take_result(asked, result))

    def _take_result(self, asked: Any, ended: Any) -> None:
        if asked is self._asked:
            self.state = ACTION_STATES.get(ended.result().status, GoalState.GIVEN_UP)
