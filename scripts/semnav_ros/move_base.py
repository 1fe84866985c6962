"""ROS 1's move_base, both sides of its action: plain topics, as actionlib lays them out."""

from __future__ import annotations

import uuid

from semnav_features.frames import Pose
from semnav_ros import conversions
from semnav_ros.fields import Values
from semnav_ros.goal_state import ACTIONLIB_STATES, GoalState, number_of
from semnav_ros.navigator import TakeGoal
from semnav_ros.topics import Topic
from semnav_ros.wire import Wire

MOVE_BASE = "move_base"
"""The usual name of the action."""


class MoveBaseTopics:
    """The topics of the action that count here.

    Args:
        name: of the action.
    """

    def __init__(self, name: str) -> None:
        self.goal = Topic(f"{name}/goal", "move_base_msgs/MoveBaseActionGoal", 1)
        self.cancel = Topic(f"{name}/cancel", "actionlib_msgs/GoalID", 1)
        self.status = Topic(f"{name}/status", "actionlib_msgs/GoalStatusArray", 1, latched=True)


class MoveBaseNavigator:
    """Sends goals to move_base.

    Args:
        wire: a wire of ROS 1.
        name: of the action.
    """

    state: GoalState

    def __init__(self, wire: Wire, name: str = MOVE_BASE) -> None:
        self._wire, self._topics = wire, MoveBaseTopics(name)
        self._id, self.state = "", GoalState.CANCELLED
        wire.announce(self._topics.goal)
        wire.announce(self._topics.cancel)
        wire.hear(self._topics.status, self._take)

    def send(self, goal: Pose, frame: str) -> None:
        """Send a goal; move_base drops the one before."""
        self._id, self.state = f"semnav-{uuid.uuid4()}", GoalState.SENT
        values = {"id": self._id, "frame": frame} | conversions.pose_values(goal)
        self._wire.say(self._topics.goal, values)

    def cancel(self, here: Pose, frame: str) -> None:
        """Call the last goal back."""
        self._wire.say(self._topics.cancel, {"id": self._id})

    def _take(self, values: Values) -> None:
        for status in values["states"]:
            if status["id"] == self._id:
                self.state = ACTIONLIB_STATES.get(status["state"], GoalState.GIVEN_UP)


class MoveBaseServer:
    """The other side: hears goals and tells what becomes of them, as move_base does.

    Args:
        wire: a wire of ROS 1.
        take: called with each goal; None when it is called back.
        name: of the action.
    """

    def __init__(self, wire: Wire, take: TakeGoal, name: str = MOVE_BASE) -> None:
        self._wire, self._topics, self._give = wire, MoveBaseTopics(name), take
        self._id = ""
        wire.announce(self._topics.status)
        wire.hear(self._topics.cancel, self._cancel)
        wire.hear(self._topics.goal, self._take)

    def tell(self, state: GoalState) -> None:
        """Tell what has become of the goal."""
        status = {"id": self._id, "state": number_of(ACTIONLIB_STATES, state)}
        self._wire.say(self._topics.status, {"states": [status]})

    def _take(self, values: Values) -> None:
        self._id = values["id"]
        self._give(conversions.pose_of(values))
        self.tell(GoalState.DRIVING)

    def _cancel(self, values: Values) -> None:
        if self._id and values["id"] in (self._id, ""):  # an empty name means all
            self._give(None)
            self.tell(GoalState.CANCELLED)
