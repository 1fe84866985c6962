"""Runs a node on a wire: hears topics, says velocities at once and the rest now and then."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace

from semnav_features.frames import Pose
from semnav_ros import conversions
from semnav_ros.fields import Values
from semnav_ros.garbage import garbage_when_idle
from semnav_ros.goal_sender import GoalSender
from semnav_ros.messages import NodeReply
from semnav_ros.navigator import Navigator
from semnav_ros.robot_node import STILL, RobotNode
from semnav_ros.shown_belief import markers_of
from semnav_ros.topics import NodeTopics
from semnav_ros.wire import Wire

TICK = 0.05
"""Longest time between two looks at the clock, seconds: so much may be added to `STALE`."""

SHOW_PERIOD = 0.5
"""Time between two pictures of the belief, seconds."""


class NodeShell:
    """A node on a wire.

    Args:
        node: the node.
        wire: what carries its messages.
        topics: their names and qualities.
        notes: called with the status when phase, clause, problem or words change.
        navigator: what drives to the goals of a node without an agent.
    """

    def __init__(
        self,
        node: RobotNode,
        wire: Wire,
        topics: NodeTopics = NodeTopics(),
        notes: Callable[[NodeReply], None] = lambda reply: None,
        navigator: Navigator | None = None,
    ) -> None:
        self._node, self._wire, self._topics, self._notes = node, wire, topics, notes
        self._goals = None if navigator is None else GoalSender(navigator)
        self._told: tuple[object, ...] = ()
        self._shown_at = 0.0
        self._is_idle = False  # whether a scan was just answered, so that the next one is far off
        for topic in (topics.cmd_vel, topics.status, topics.said):
            wire.announce(topic)
        for topic in (topics.belief, topics.goal, topics.markers):
            wire.announce(topic)
        wire.hear(topics.stop, lambda v: self._say(node.stop(v["value"], _now())))
        wire.hear(topics.command, lambda v: self._say(node.command(v["text"], _now())))
        if node.needs_transforms:
            wire.hear(topics.tf_static, self._take_transforms)
        wire.hear(topics.odom, self._take_odometry)
        wire.hear(topics.bumps, lambda v: node.bumps(conversions.bumps_of(v)))
        wire.hear(topics.scan, self._take_scan)

    def run(self, goes_on: Callable[[], bool] = lambda: True) -> None:
        """Run until told otherwise; the last word is that the robot stands."""
        with garbage_when_idle() as collect_garbage:
            try:
                while goes_on():
                    self._wire.wait(TICK)
                    reply = self._node.tick(_now())
                    if reply.velocity == STILL:
                        self._say(reply)
                    if self._is_idle:
                        self._is_idle = False
                        self._show()
                        collect_garbage()
            finally:
                self._wire.say(self._topics.cmd_vel, conversions.twist_values(STILL))
                self._navigate(None)

    def _take_transforms(self, values: Values) -> None:
        for transform in conversions.transform_messages(values):
            self._node.transform(transform)

    def _take_odometry(self, values: Values) -> None:
        self._node.odometry(conversions.odometry_message(values), _now())

    def _take_scan(self, values: Values) -> None:
        self._node.scan(conversions.scan_message(values), _now())
        self._say(self._node.tick(_now()))  # later: the scan may be old once it is understood
        self._is_idle = True

    def _say(self, reply: NodeReply) -> None:
        """Say the velocity, or the goal, first, and then what else is new."""
        if reply.drives and reply.goal is None:  # while it has a goal the navigator drives
            self._wire.say(self._topics.cmd_vel, conversions.twist_values(reply.velocity))
        if problem := self._navigate(reply.goal):
            reply = replace(reply, status=replace(reply.status, problem=problem))
        status = reply.status
        told = status.phase, status.problem, status.clause, status.reasons, reply.said
        if told == self._told:
            return
        self._told = told
        self._wire.say(self._topics.status, {"text": conversions.status_text(status)})
        self._wire.say(self._topics.said, {"text": reply.said})
        self._notes(reply)

    def _navigate(self, goal: Pose | None) -> str:
        """Keep the navigator, if there is one, at a goal; returns why it does not drive."""
        if self._goals is None:
            return ""
        return self._goals.want(goal, self._node.pose, self._node.odometry_frame, _now())

    def _show(self) -> None:
        """Show the belief, if it is time to."""
        if (now := _now()) - self._shown_at < SHOW_PERIOD or (belief := self._node.belief) is None:
            return
        self._shown_at, frame, topics = now, self._node.odometry_frame, self._topics
        self._wire.say(topics.belief, {"text": conversions.belief_text(belief)})
        self._wire.say(topics.markers, conversions.marker_values(markers_of(belief), frame))
        if belief.goal is not None:
            goal = {"frame": frame} | conversions.pose_values(belief.goal)
            self._wire.say(topics.goal, goal)


def _now() -> float:
    return time.monotonic()
