"""nav2's NavigateToPose by DDS, both sides: a ROS 2 action is five topics and services.

A service is a topic of requests and one of replies. Each message begins with the number of the
client and of the request, as rmw_cyclonedds_cpp puts them there; Fast DDS hands them over in
another way, so that this works only where nav2 runs with RMW_IMPLEMENTATION=rmw_cyclonedds_cpp.
"""

from __future__ import annotations

import uuid

from semnav_features.frames import Pose
from semnav_ros import conversions
from semnav_ros.fields import Values
from semnav_ros.goal_state import ACTION_STATES, GoalState, number_of
from semnav_ros.navigator import TakeGoal
from semnav_ros.topics import Topic
from semnav_ros.wire import Wire

NAVIGATE_TO_POSE = "navigate_to_pose"
"""The usual name of the action."""

SEND_GOAL, CANCEL_GOAL = "nav2_msgs/NavigateToPose_SendGoal", "action_msgs/CancelGoal"


class ActionTopics:
    """The topics and services of the action that count here.

    Args:
        name: of the action.
    """

    def __init__(self, name: str) -> None:
        inner = f"{name}/_action"
        self.goal = Topic(f"{inner}/send_goalRequest", f"{SEND_GOAL}_Request", prefix="rq")
        self.answer = Topic(f"{inner}/send_goalReply", f"{SEND_GOAL}_Response", prefix="rr")
        self.cancel = Topic(f"{inner}/cancel_goalRequest", f"{CANCEL_GOAL}_Request", prefix="rq")
        self.status = Topic(f"{inner}/status", "action_msgs/GoalStatusArray", 1, latched=True)


class Nav2Navigator:
    """Sends goals to nav2.

    Args:
        wire: a wire of DDS.
        name: of the action.
    """

    state: GoalState

    def __init__(self, wire: Wire, name: str = NAVIGATE_TO_POSE) -> None:
        self._wire, self._topics = wire, ActionTopics(name)
        self._client, self._count = uuid.uuid4().int % 2**63, 0
        self._id, self.state = bytes(16), GoalState.CANCELLED
        wire.announce(self._topics.goal)
        wire.announce(self._topics.cancel)
        wire.hear(self._topics.answer, self._take_answer)
        wire.hear(self._topics.status, self._take)

    def send(self, goal: Pose, frame: str) -> None:
        """Send a goal; nav2 drops the one before."""
        self._id, self.state = uuid.uuid4().bytes, GoalState.SENT
        values = {"id": list(self._id), "frame": frame} | conversions.pose_values(goal)
        self._request(self._topics.goal, values)

    def cancel(self, here: Pose, frame: str) -> None:
        """Call the last goal back."""
        self._request(self._topics.cancel, {"id": list(self._id)})

    def _request(self, topic: Topic, values: Values) -> None:
        self._count += 1
        self._wire.say(topic, {"client": self._client, "number": self._count} | values)

    def _take_answer(self, values: Values) -> None:
        of_this = (values["client"], values["number"]) == (self._client, self._count)
        if of_this and not values["accepted"]:
            self.state = GoalState.REFUSED

    def _take(self, values: Values) -> None:
        for status in values["states"]:
            if bytes(status["id"]) == self._id:
                self.state = ACTION_STATES.get(status["state"], GoalState.GIVEN_UP)


class Nav2Server:
    """The other side: hears goals and tells what becomes of them, as nav2 does.

    Args:
        wire: a wire of DDS.
        take: called with each goal; None when it is called back.
        name: of the action.
    """

    def __init__(self, wire: Wire, take: TakeGoal, name: str = NAVIGATE_TO_POSE) -> None:
        self._wire, self._topics, self._give = wire, ActionTopics(name), take
        self._id = bytes(16)
        wire.announce(self._topics.status)
        wire.announce(self._topics.answer)
        wire.hear(self._topics.cancel, self._cancel)
        wire.hear(self._topics.goal, self._take)

    def tell(self, state: GoalState) -> None:
        """Tell what has become of the goal."""
        status = {"id": list(self._id), "state": number_of(ACTION_STATES, state)}
        self._wire.say(self._topics.status, {"states": [status]})

    def _take(self, values: Values) -> None:
        self._id = bytes(values["id"])
        answer = {"client": values["client"], "number": values["number"], "accepted": True}
        self._wire.say(self._topics.answer, answer)
        self._give(conversions.pose_of(values))
        self.tell(GoalState.DRIVING)

    def _cancel(self, values: Values) -> None:
        if any(self._id) and bytes(values["id"]) in (self._id, bytes(16)):  # zeros mean all
            self._give(None)
            self.tell(GoalState.CANCELLED)
