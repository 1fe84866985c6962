"""The simulator as a robot that senses, obeys velocities, and is judged by what it was told."""

from __future__ import annotations

from typing import Any

import numpy as np

from semnav_env.env import SemNavEnv
from semnav_env.language import Command, CommandError, parse
from semnav_env.mind.grounding import GroundingError
from semnav_features.frames import ORIGIN, Pose, Twist, compose
from semnav_ros.messages import Bumps, OdometryMessage, ScanMessage
from semnav_ros.simulated_navigator import SimulatedNavigator

FIRST_STAMP = 100.0
"""Time by the robot's clock when it starts, seconds: as by a clock of a simulation."""


class SimulatedRobot:
    """A robot in a floor plan, with the environment's judge.

    It obeys velocities from the start. When it is told a command that it understands, an episode
    begins where it stands, which the judge judges by these words. The node of the robot hears the
    same words, and nothing of the plan.

    Args:
        floor_plan: name or path.
        robot: "wheelchair" or "spot".
        pose: start, world frame; drawn by the seed if not given.
        seed: of everything that is random.

    Attributes:
        outcome: `info` at the end of the last episode; None while one runs, and before.
        refusal: why the last text began no episode; empty if it did.

    Raises:
        ValueError: no such plan or robot, or a pose that is not free.
    """

    def __init__(
        self, floor_plan: str, robot: str = "wheelchair", pose: Pose | None = None, seed: int = 0
    ) -> None:
        self._env = SemNavEnv(robot, floor_plan, observation="raw")
        self._seed, self._steps, self._origin = seed, 0, ORIGIN
        self._env.reset(seed=seed, options={} if pose is None else {"pose": pose})
        self._simulator, self._runs = self._env.simulator, False
        body = self._env.robot
        speeds = body.max_speed, body.max_sideways_speed or 1.0, body.max_turn_rate
        self._limits = np.array(speeds)
        self.outcome: dict[str, Any] | None = None
        self.refusal = ""

    @property
    def period(self) -> float:
        """Seconds between scans."""
        return 1.0 / self._env.lidar_spec.rate_hz

    @property
    def navigator(self) -> SimulatedNavigator:
        """A new navigator for this robot."""
        return SimulatedNavigator(self._env.robot, self._env.lidar_spec)

    @property
    def mount(self) -> Pose:
        """Pose of the lidar in the base frame, which lies in the middle of the body."""
        return self._env.robot.lidar_mount

    def read(self, text: str) -> Command:
        """The command that a text means in this floor plan.

        Raises:
            CommandError: it means none, or leaves open which.
        """
        return parse(text, rooms=self._env.floor_plan.room_names)

    def tell(self, text: str) -> None:
        """Begin an episode with a command, where the robot stands."""
        at, odometry = self._simulator.motion.pose, self._odometry
        try:
            self._env.reset(seed=self._seed, options={"command": self.read(text), "pose": at})
        except (CommandError, GroundingError) as error:
            self.refusal = str(error)
            self._runs = False
            self._env.reset(seed=self._seed, options={"pose": at})
        else:
            self._runs, self.outcome, self.refusal = True, None, ""
        self._origin = odometry

    def drive(self, velocity: Twist) -> None:
        """Drive for one control period with a velocity."""
        self._steps += 1
        shares = np.array(velocity) / self._limits
        action = shares if self._env.robot.holonomic else shares[[0, 2]]
        *_, terminated, truncated, info = self._env.step(action.astype(np.float32))
        if self._runs and (terminated or truncated):
            self._runs, self.outcome = False, info

    def sensed(self) -> tuple[ScanMessage, OdometryMessage, Bumps]:
        """What the robot senses now."""
        lidar, last = self._env.lidar_spec, self._simulator.last
        stamp = FIRST_STAMP + self._steps * self.period
        scan = ScanMessage(
            stamp,
            last.ranges.copy(),
            lidar.angle_min,
            lidar.angle_increment,
            lidar.range_min,
            lidar.range_max,
            self.period,
        )
        return scan, OdometryMessage(stamp, self._odometry, last.velocity), last.bumps

    @property
    def _odometry(self) -> Pose:
        return compose(self._origin, self._simulator.last.odometry)
