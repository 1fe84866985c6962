"""World, robot, lidar and odometry behind one object; it knows nothing of commands."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from semnav_env.dynamics import NO_DYNAMICS, Dynamics
from semnav_env.features.frames import Pose, Twist
from semnav_env.features.lidar_spec import TIM561, LidarSpec
from semnav_env.lidar.lidar import Lidar
from semnav_env.maps.floor_plan import FloorPlan
from semnav_env.robots import WHEELCHAIR, RobotSpec
from semnav_env.simulator.odometry import Odometry, OdometrySettings
from semnav_env.simulator.sensed import Motion, Sensed
from semnav_env.simulator.sweep import LidarArrays, join_lidar, sweep
from semnav_env.world import World


@dataclass(frozen=True)
class RobotSetup:
    """The body and the sensors of a simulated robot.

    Attributes:
        robot: the body.
        lidar: on the body's mount; its rate is the control rate.
        odometry: how dead reckoning errs.
        exact: whether the lidar has no error and odometry is the true pose, world frame.
    """

    robot: RobotSpec = WHEELCHAIR
    lidar: LidarSpec = TIM561
    odometry: OdometrySettings = OdometrySettings()
    exact: bool = False

    @property
    def control_hz(self) -> float:
        """Control periods per second: one scan in each."""
        return self.lidar.rate_hz

    def with_changes(
        self,
        robot: RobotSpec | None = None,
        lidar: LidarSpec | None = None,
        odometry: OdometrySettings | None = None,
    ) -> RobotSetup:
        """The setup with another body, lidar or odometry; itself where nothing is given.

        Raises:
            ValueError: action or observation would have another shape or bounds, or the control
                rate would be another one.
        """
        if robot is not None and robot.action_size != self.robot.action_size:
            raise ValueError(
                f"{robot.name} takes {robot.action_size} values as an action; the environment's "
                f"{self.robot.name} takes {self.robot.action_size}"
            )
        for name in ("beams", "range_max", "rate_hz") if lidar is not None else ():
            if getattr(lidar, name) != getattr(self.lidar, name):
                raise ValueError(
                    f"the lidar has {name} {getattr(lidar, name)}; "
                    f"the environment's has {getattr(self.lidar, name)}"
                )
        changes = {"robot": robot, "lidar": lidar, "odometry": odometry}
        given: dict[str, Any] = {name: new for name, new in changes.items() if new is not None}
        return replace(self, **given) if given else self


class Simulator:
    """A robot that senses while it is driven through a floor plan.

    Args:
        floor_plan: where it drives.
        setup: its body and its sensors.
        dynamics: what else moves.

    Attributes:
        world: the physics.
        lidar: on its mount.
        odometry: dead reckoning.
        steps: control periods since the reset.
    """

    def __init__(
        self,
        floor_plan: FloorPlan,
        setup: RobotSetup = RobotSetup(),
        dynamics: Dynamics = NO_DYNAMICS,
    ) -> None:
        self.floor_plan, self.setup, robot = floor_plan, setup, setup.robot
        self.world = World(floor_plan, robot, setup.control_hz, dynamics=dynamics)
        spec = setup.lidar
        if setup.exact:
            spec = replace(spec, sigma=0.0, dropout=0.0, systematic=0.0)
        self.lidar = Lidar(self.world.still, spec, robot.lidar_mount, self.world.moving_shapes)
        self.odometry = Odometry(setup.odometry)
        self.steps = 0
        self._seconds = 1.0 / setup.control_hz
        self._ranges = np.zeros(spec.beams)
        self._arrays = self._join()

    def _join(self) -> LidarArrays:
        return join_lidar(self.lidar.arrays, self.lidar.mount, self._ranges)

    def __getstate__(self) -> dict[str, Any]:
        return {name: value for name, value in self.__dict__.items() if name != "_arrays"}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        self._arrays = self._join()

    def reset(self, start: Pose, rng: np.random.Generator) -> Sensed:
        """Put the robot at rest at a pose, world frame; returns what it senses there.

        Args:
            start: pose of the robot's centre, world frame.
            rng: draws what moves, the drift and the noise of the episode.

        Raises:
            ValueError: the robot cannot stand there.
        """
        self.world.reset(start, rng)
        self.odometry.reset(start, rng)
        self._noise_seed = int(rng.integers(2**62))
        self.steps = 0
        return self._sense()

    def step(self, twist: Twist) -> Sensed:
        """Drive for one control period; returns what the robot senses at its end.

        Args:
            twist: commanded velocity, cut to what the robot can do.

        Raises:
            ValueError: not three finite numbers.
            RuntimeError: before the first `reset`.
        """
        self.world.step(twist)
        self.odometry.update(self.world.pose)
        self.steps += 1
        return self._sense()

    def _sense(self) -> Sensed:
        world = self.world
        pose, velocity = world.pose, world.velocity
        sweep(self._arrays, pose, (self._noise_seed, 0, self.steps))
        speed = math.hypot(velocity[0], velocity[1])
        motion = Motion(pose, speed, velocity[2], world.in_contact, self._seconds)
        odometry = pose if self.setup.exact else self.odometry.pose
        return Sensed(self._ranges, odometry, velocity, world.touches, motion)
