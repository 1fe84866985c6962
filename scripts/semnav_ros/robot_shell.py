"""Runs the simulated robot on a wire, in real time or faster."""

from __future__ import annotations

import json
import math
import time
from collections.abc import Callable
from typing import Any

from semnav_features.frames import Twist
from semnav_ros import conversions
from semnav_ros.fields import Values
from semnav_ros.goal_state import GoalState
from semnav_ros.messages import OdometryMessage, Phase, ScanMessage
from semnav_ros.navigator import NavigatorServer
from semnav_ros.robot_node import STILL
from semnav_ros.simulated_navigator import SimulatedNavigator
from semnav_ros.simulated_robot import SimulatedRobot
from semnav_ros.topics import NodeTopics
from semnav_ros.wire import Wire

LONGEST_SILENCE = 0.5
"""Age of the last velocity from which on the robot stands, seconds."""

FAREWELL = 2.0
"""How long a robot goes on after its episode, seconds: its node may believe later than the judge
that a command is done."""

PATIENCE = 30.0
"""How long a robot in lockstep waits for the answer to a scan, seconds."""

OVERRULED = 0.2
"""Time for which a velocity on the topic goes before those of the robot's navigator, seconds."""

BASE, LASER = "base_link", "laser"


class RobotShell:
    """A simulated robot on a wire: it says what it senses and obeys velocities.

    Args:
        robot: the robot.
        wire: what carries its messages.
        topics: their names and qualities, as the node's.
        speed: simulated seconds a second, at most.
        lockstep: whether simulated time stands still until the node has answered a scan.
        navigator: drives the robot to the goals that it is given, unless velocities are heard.
        server: tells what becomes of these goals.
        notes: called with why a command begins no episode, or is impossible by its node.

    Attributes:
        delays: seconds from each scan that was said, or the oldest that got no answer, to the
            velocity that was heard.
    """

    def __init__(
        self,
        robot: SimulatedRobot,
        wire: Wire,
        topics: NodeTopics = NodeTopics(),
        speed: float = 1.0,
        lockstep: bool = False,
        navigator: SimulatedNavigator | None = None,
        server: NavigatorServer | None = None,
        notes: Callable[[str], None] = lambda note: None,
    ) -> None:
        self._navigator, self._server, self._notes = navigator, server, notes
        self._robot, self._wire, self._topics, self._speed = robot, wire, topics, speed
        self._lockstep, self._awaits = lockstep, False
        self._velocity: Twist = STILL
        self._unanswered: float | None = None
        self.delays: list[float] = []
        self._heard_at = -math.inf
        self._is_impossible = False
        for topic in (topics.scan, topics.odom, topics.bumps, topics.tf_static, topics.command):
            wire.announce(topic)
        wire.hear(topics.cmd_vel, self._obey)
        wire.hear(topics.command, self._listen)
        wire.hear(topics.status, self._take_status)

    def run(self, goes_on: Callable[[], bool], command: str | None = None) -> dict[str, Any] | None:
        """Run until told otherwise, or a little longer than an episode; returns its outcome.

        Args:
            goes_on: asked before each scan.
            command: told on the topic of commands as soon as a node listens.
        """
        mount = conversions.transform_values(BASE, LASER, self._robot.mount)
        self._wire.say(self._topics.tf_static, mount)
        due, end = time.monotonic(), math.inf
        while goes_on() and due < end:
            navigated = self._say_sensed()
            if command is not None and self._wire.listeners(self._topics.command) > 1:
                self._wire.say(self._topics.command, {"text": command})
                command = None
            due = max(due + self._robot.period / self._speed, time.monotonic())
            while (left := due - time.monotonic()) > 0.0:
                self._wire.wait(left)
            if self._lockstep and self._robot.outcome is None:
                self._wait_for_answer()
            silent = time.monotonic() - self._heard_at
            told = STILL if silent > LONGEST_SILENCE else self._velocity
            self._robot.drive(told if silent <= OVERRULED or navigated is None else navigated)
            if self._robot.outcome is not None:
                end = min(end, due + FAREWELL)
        return self._robot.outcome

    def _wait_for_answer(self) -> None:
        """Wait until the last scan is answered.

        A node that takes longer than `PATIENCE` is waited for no more until it says something.
        """
        end = time.monotonic() + PATIENCE
        while self._awaits and self._unanswered is not None:
            self._awaits = (left := end - time.monotonic()) > 0.0
            self._wire.wait(max(left, 0.0))

    def _say_sensed(self) -> Twist | None:
        """Say what is sensed; returns the velocity of the navigator, if there is one."""
        scan, odometry, bumps = self._robot.sensed()
        self._wire.say(self._topics.odom, conversions.odometry_values(odometry, BASE))
        self._wire.say(self._topics.bumps, conversions.bumps_values(bumps, BASE))
        self._wire.say(self._topics.scan, conversions.scan_values(scan))
        if self._unanswered is None:
            self._unanswered = time.monotonic()
        return None if self._navigator is None else self._navigated(self._navigator, scan, odometry)

    def _navigated(
        self, navigator: SimulatedNavigator, scan: ScanMessage, odometry: OdometryMessage
    ) -> Twist:
        """The navigator's velocity; tells when it has come to its goal."""
        drives = navigator.goal is not None
        velocity = navigator.velocity(scan, odometry)
        if drives and navigator.state is GoalState.REACHED and self._server is not None:
            self._server.tell(navigator.state)
        return velocity

    def _listen(self, values: Values) -> None:
        self._robot.tell(values["text"])
        if self._robot.refusal:
            self._notes(self._robot.refusal)
        self._unanswered, self._awaits = None, True

    def _take_status(self, values: Values) -> None:
        status = json.loads(values["text"])
        was_impossible, self._is_impossible = (
            self._is_impossible,
            status["phase"] == Phase.IMPOSSIBLE,
        )
        if self._is_impossible and not was_impossible:
            self._notes(f"impossible: {'; '.join(status['reasons'])}")

    def _obey(self, values: Values) -> None:
        self._velocity, self._heard_at = conversions.twist_of(values), time.monotonic()
        if self._velocity != STILL and self._unanswered is not None:
            self.delays.append(self._heard_at - self._unanswered)
        self._unanswered, self._awaits = None, True
