"""The last second of odometry: the pose at the time of a scan, without jumps."""

from __future__ import annotations

import math
from collections import deque

from semnav_env.robots import RobotSpec
from semnav_features.frames import ORIGIN, Pose, compose, relative, wrap_angle
from semnav_ros.messages import Counts, OdometryMessage

KEPT = 100
"""Number of poses that are kept: a second of fast odometry."""

STALE = 0.5
"""Largest difference between the stamps of a scan and of the nearest odometry, seconds."""

SPARE_DISTANCE, SPARE_TURN, SPARE_SHARE = 0.3, 0.5, 1.5
"""What odometry may change at once, metres and radians, beside this times what the robot can drive
in the time; more is a jump."""


class OdometryTrack:
    """Poses of the base frame by odometry, as if it never jumped.

    After a jump the robot counts as standing where it stood: odometry was reset, and the robot was
    not carried. `frame` is the pose in which the numbers of the robot's odometry now lie, and
    `reported` the last pose in these numbers.

    Args:
        robot: the body, whose largest speeds bound what is no jump.
        counts: where jumps are counted.
    """

    def __init__(self, robot: RobotSpec, counts: Counts) -> None:
        self._robot, self._counts = robot, counts
        self._poses: deque[tuple[float, Pose]] = deque(maxlen=KEPT)
        self.frame = self.reported = ORIGIN
        self.name = "odom"

    def take(self, message: OdometryMessage) -> bool:
        """Note a pose; returns whether it jumped.

        Raises:
            ValueError: it is not finite.
        """
        if not all(map(math.isfinite, (message.stamp, *message.pose))):
            raise ValueError(f"odometry is not finite: {message.pose} at {message.stamp}")
        pose, jumped = compose(self.frame, message.pose), False
        if self._poses:
            stamp, last = self._poses[-1]
            if jumped := self._is_jump(last, pose, message.stamp - stamp):
                self._counts.odometry_jumps += 1
                self.frame, pose = compose(last, relative(message.pose, ORIGIN)), last
            if message.stamp < stamp:
                self._poses.clear()
        self._poses.append((message.stamp, pose))
        self.reported = message.pose
        self.name = message.frame
        return jumped

    def at(self, stamp: float) -> Pose | None:
        """The pose at a time, between the poses around it; None if there is none near enough."""
        later = None
        for time, pose in reversed(self._poses):
            if time <= stamp:
                if later is None:
                    return pose if stamp - time <= STALE else None
                share = (stamp - time) / (later[0] - time)
                return _between(pose, later[1], share)
            later = time, pose
        return later[1] if later is not None and later[0] - stamp <= STALE else None

    def _is_jump(self, last: Pose, pose: Pose, seconds: float) -> bool:
        robot, passed = self._robot, SPARE_SHARE * max(0.0, seconds)
        speed = math.hypot(robot.max_speed, robot.max_sideways_speed)
        far = math.dist(last[:2], pose[:2]) > SPARE_DISTANCE + passed * speed
        turned = abs(wrap_angle(pose[2] - last[2]))
        return far or turned > SPARE_TURN + passed * robot.max_turn_rate


def _between(before: Pose, after: Pose, share: float) -> Pose:
    """The pose at a share of the way from one pose to another."""
    turn = wrap_angle(after[2] - before[2])
    x, y = (a + share * (b - a) for a, b in zip(before[:2], after[:2], strict=True))
    return x, y, wrap_angle(before[2] + share * turn)
