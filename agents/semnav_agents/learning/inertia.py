"""Starts a robot that stands still because of the inertia of its imitating policy.

Where an expert may take either of two actions, a policy that imitates it learns the mean of both,
and learns to continue its present motion; a robot that has come to rest there stays at rest. This
is the inertia problem of imitation (Codevilla et al. 2019). Therefore the policy of a resting robot
is evaluated as if the robot were already moving, for several motions, and the best fit is driven.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from semnav_agents.learning.compact import VELOCITY, squashed
from semnav_agents.learning.policy import Policy
from semnav_env.robots import RobotSpec
from semnav_features.frames import FloatArray, Pose, wrap_angle

Array = NDArray[np.float32]

REST_DISTANCE, REST_ANGLE = 0.1, 0.35
"""Motion below which a robot counts as resting, metres and radians."""

REST_DECISIONS, PUSH_DECISIONS = 8, 4
"""Decisions of rest after which a robot is pushed, and decisions for which it is pushed."""

IMAGINED_VELOCITIES: FloatArray = np.array(
    [(v, 0.0, w) for v in (0.3, 0.0, -0.25) for w in (0.0, 0.4, -0.4) if v or w]
)
"""Velocities of the axle for which a policy is evaluated: forward, left, yaw rate, m/s and
rad/s."""


class Inertia:
    """Measures how long a robot has rested, and pushes it.

    Args:
        robot: the body.
    """

    def __init__(self, robot: RobotSpec) -> None:
        self._rested = self._pushes = self._tries = 0
        self._place: Pose = (math.inf, 0.0, 0.0)
        self._action: Array
        limits = robot.max_speed, robot.max_sideways_speed or 1.0, robot.max_turn_rate
        self._shares = IMAGINED_VELOCITIES / limits
        imagined = IMAGINED_VELOCITIES.copy()
        imagined[:, 1] -= robot.axle * imagined[:, 2]  # what the centre does as the axle turns
        self._velocities = squashed(imagined.astype(np.float32))

    def act(self, policy: Policy, values: Array, pose: Pose) -> Array:
        """The action of a policy, or the push of a robot at rest.

        Args:
            policy: the policy of a learned agent.
            values: the compact observation.
            pose: of the robot, odometry frame.
        """
        if self._has_left(pose):
            self._place, self._rested, self._tries = pose, 0, 0
        self._rested += 1
        if self._pushes:
            self._pushes -= 1
        elif self._rested >= REST_DECISIONS:
            self._rested, self._pushes = 0, PUSH_DECISIONS - 1
            self._action = self._pushed(policy, values)
            self._tries += 1
        else:
            return policy.act(values)
        return self._action

    def _has_left(self, pose: Pose) -> bool:
        away = math.dist(pose[:2], self._place[:2])
        return away > REST_DISTANCE or abs(wrap_angle(pose[2] - self._place[2])) > REST_ANGLE

    def _pushed(self, policy: Policy, values: Array) -> Array:
        """The action of the policy for the best fitting motion; later for the next best."""
        rows = np.repeat(values[None], len(self._velocities), axis=0)
        rows[:, VELOCITY] = self._velocities
        actions = np.array([policy.act(row) for row in rows])
        shares = self._shares if actions.shape[1] == 3 else self._shares[:, [0, 2]]
        fits = (actions * shares).sum(axis=1) / np.linalg.norm(shares, axis=1)
        ranked = np.argsort(-fits, kind="stable")
        chosen: Array = actions[ranked[self._tries % len(ranked)]]
        return chosen
