"""Waiting for what moves, and making room for it."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from semnav_agents.planning.nudge import path_clearance
from semnav_env.robots import RobotSpec
from semnav_features.frames import FloatArray, Twist

YIELD_CLEARANCE = 0.2
"""Clearance from what moves below which a robot waits, metres."""

YIELD_APPROACH = 0.02
"""A robot waits only where it would come nearer than it is by this much, metres."""

YIELD_DISTANCE, YIELD_SECONDS = 0.5, 1.2
"""What moves matters on the path up to this distance, and up to what is driven in this time, metres
and seconds."""

JAM_STEPS, STANDING_SPEED = 75, 0.05
"""Steps of standing before what moves after which a robot is in a jam, and the speed below which it
stands, m/s and rad/s: somebody who stands before it for five seconds cannot go on either."""

INSISTING_SHARE, INSISTING_STEPS = 0.15, 45
"""Share of its velocity with which a robot creeps on in a jam, and for how many steps: people make
room for it. In every second jam it backs off instead."""

AMONG_PEOPLE_STEPS = 150
"""Steps after something moved in view for which a robot counts as among people."""

BACKING_SPEED, BACKING_STEPS = 0.2, 22
"""Speed of backing off, m/s, and its duration in steps: slow, because the lidar sees little
behind."""


@dataclass
class Yielding:
    """Decides when to wait for what moves, to plan around it, to creep on and to back off.

    Attributes:
        robot: gives the footprint.
        patience: steps to wait before it is planned around, and for which it then counts as solid.
        yielded: steps of waiting, less those without.
        around: steps for which what moves still counts as solid; not above 0 if it does not.
        held: steps of standing.
        jams: in how many jams it has been.
        insisting: steps for which it still creeps on; not above 0 if it does not.
        backing: steps for which it still backs off; the same.
        met_at: step at which something moved in view the last time.
    """

    robot: RobotSpec
    patience: int
    yielded: int = field(default=0, init=False)
    around: int = field(default=0, init=False)
    held: int = field(default=0, init=False)
    jams: int = field(default=0, init=False)
    insisting: int = field(default=0, init=False)
    backing: int = field(default=0, init=False)
    met_at: int = field(default=-AMONG_PEOPLE_STEPS, init=False)

    def reset(self) -> None:
        """Begin anew."""
        self.yielded = self.around = self.held = self.jams = self.insisting = self.backing = 0
        self.met_at = -AMONG_PEOPLE_STEPS

    def count_step(self, step: int, something_moves: bool) -> None:
        """A step has passed.

        Args:
            step: its number.
            something_moves: whether something moves in view.
        """
        self.around -= 1
        self.insisting -= 1
        self.backing -= 1
        if something_moves:
            self.met_at = step

    def is_among_people(self, step: int) -> bool:
        """Whether something moved in view not long before a step."""
        return step - self.met_at < AMONG_PEOPLE_STEPS

    def must_wait(self, near: FloatArray, ahead: FloatArray) -> bool:
        """Whether to wait for what moves on the next stretch of the path, nearer than it is now.

        Args:
            near: what moves around the robot, in its frame, shape (n, 2).
            ahead: poses of the next stretch, the same frame, shape (m, 3).
        """
        size = self.robot.length, self.robot.width
        if len(near):
            now = path_clearance(near, np.zeros((1, 3)), *size, 0.0, 0.0, -math.inf)
            enough = min(YIELD_CLEARANCE, now - YIELD_APPROACH)
            if path_clearance(near, ahead, *size, 0.0, 0.0, enough) < enough:
                self.yielded += 1
                return True
        self.yielded = max(self.yielded - 1, 0)
        return False

    def loses_patience(self) -> bool:
        """Whether to plan around what is waited for, which is solid from here on for a while."""
        if self.yielded <= self.patience:
            return False
        self.yielded, self.around = 0, self.patience
        return True

    def hold(self, velocity: Twist) -> None:
        """Stand still before what moves; after `JAM_STEPS` of it, creep on or back off next."""
        self.held = self.held + 1 if max(map(abs, velocity)) < STANDING_SPEED else 0
        if self.held > JAM_STEPS:
            self.held, self.jams = 0, self.jams + 1
            if self.jams % 2 == 1:
                self.insisting = INSISTING_STEPS
            else:
                self.backing = BACKING_STEPS


def yield_distance(velocity: Twist) -> float:
    """Length of the path ahead on which what moves matters, metres."""
    return YIELD_DISTANCE + YIELD_SECONDS * math.hypot(velocity[0], velocity[1])
