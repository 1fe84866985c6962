"""A navigator that hears goals on a topic, both sides."""

from __future__ import annotations

from semnav_features.frames import Pose
from semnav_ros import conversions
from semnav_ros.goal_state import GoalState
from semnav_ros.navigator import TakeGoal
from semnav_ros.topics import Topic
from semnav_ros.wire import Wire


class TopicNavigator:
    """A navigator that hears goals on a topic, as from RViz, and tells nothing.

    A goal is called back by another one: where the robot is now.

    Args:
        wire: what carries the goals.
        topic: geometry_msgs/PoseStamped, such as nav2's goal_pose.
    """

    state = GoalState.UNTOLD

    def __init__(self, wire: Wire, topic: Topic) -> None:
        self._wire, self._topic = wire, topic
        wire.announce(topic)

    def send(self, goal: Pose, frame: str) -> None:
        """Send a goal."""
        self._wire.say(self._topic, {"frame": frame} | conversions.pose_values(goal))

    def cancel(self, here: Pose, frame: str) -> None:
        """Send the robot to where it is."""
        self.send(here, frame)


class TopicServer:
    """The other side: hears goals, and tells nothing.

    Args:
        wire: what carries the goals.
        take: called with each goal.
        topic: of the goals.
    """

    def __init__(self, wire: Wire, take: TakeGoal, topic: Topic) -> None:
        wire.hear(topic, lambda values: take(conversions.pose_of(values)))

    def tell(self, state: GoalState) -> None:
        """Tell nobody."""
