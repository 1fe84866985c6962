"""Shared control: somebody else drives, and the robot prevents contacts and helps through doors.

Barbret 2021, section 6.3, wishes for it: a system that knows how open doors are approached "could
potentially prevent collisions with parts of the door by overriding such an input".
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from semnav_agents.assistance.door_help import DoorHelp
from semnav_agents.base import Agent, Observation, PlanReader
from semnav_agents.learning.shield import Shield, ShieldSettings
from semnav_agents.planning.obstacles import points_of_segments
from semnav_agents.planning.perception import Perception
from semnav_agents.scripted import with_felt_walls
from semnav_env.approach import DoorSide
from semnav_env.mind.observations import ObservationType, read_odometry, table
from semnav_env.robots import RobotSpec
from semnav_env.world.maps import FloorPlan
from semnav_features.frames import FloatArray, points_to_parent
from semnav_features.lidar_spec import LidarSpec

NEEDED = ("scan", "odometry")
"""Entries of the observation without which there is no assistance."""


NOTABLE_CHANGE = 1e-3
"""Share of the largest speed by which an action must differ from the driver's to be another."""


def strict_shield(robot: RobotSpec, control_hz: float) -> Shield:
    """A shield that lets a robot come near, but never touch, obstacles that it knows.

    It tests the motion of the next control period and of full braking after it, as the body
    carries them out. So braking is possible after each action that it lets pass.
    """
    period = 1.0 / control_hz
    settings = ShieldSettings(
        foresight=period, period=period, tests=8, margin=0.05, deeper=0.001, least=0.02
    )
    return Shield(robot, settings)


class Assisted:
    """Lets an agent or a person drive, but into no obstacle, and straight through doors.

    Each action of the driver is changed as little as possible: where it means to pass a door, the
    robot steers and the driver only says how fast (see `DoorHelp`); where it leads into an obstacle
    that the robot remembers, the nearest action that does not takes its place (see `Shield`).

    Args:
        driver: whose actions are assisted.
        doors: whether to help through doors.

    Attributes:
        active: whether to assist; what the robot has seen meanwhile counts once it is set again.
        observation: that of the driver; "all" in place of "semantic", which lacks the scan.
        changed: whether the last action was not the driver's own.
    """

    driver: Agent
    active: bool
    changed: bool

    def __init__(self, driver: Agent, doors: bool = True) -> None:
        self.driver, self._doors = driver, doors
        mode = driver.observation
        self.observation: str | ObservationType = "all" if mode == "semantic" else mode
        self._perception = Perception(1)
        self.active, self.changed = True, False

    def read_plan(self, floor_plan: FloorPlan) -> None:
        """Tell the driver the floor plan, if it wants to know."""
        if isinstance(self.driver, PlanReader):
            self.driver.read_plan(floor_plan)

    def reset(self, info: dict[str, Any]) -> None:
        """Begin an episode with the body and the lidar of `info`."""
        robot, lidar = RobotSpec(**info["robot"]), LidarSpec(**info["lidar"])
        self.driver.reset(info)
        self._perception.reset(0, robot.lidar_mount, lidar)
        self._shield = strict_shield(robot, lidar.rate_hz)
        self._help = DoorHelp(robot, lidar.rate_hz)
        self.changed = False

    def act(self, observation: Observation) -> NDArray[np.float32]:
        """The driver's action, or what replaces it.

        Raises:
            ValueError: the observation lacks scan or odometry.
        """
        for name in NEEDED:
            if name not in observation:
                raise ValueError(f'assistance needs the {name}: let the driver take "all"')
        wanted = np.asarray(self.driver.act(observation), np.float32)
        odometry, scan = observation["odometry"], observation["scan"]
        self._perception.update(odometry[None], scan[None], np.zeros(1, np.int64))
        action = self._assisted(wanted, observation) if self.active else wanted
        self.changed = bool(np.abs(action - wanted).max() > NOTABLE_CHANGE)
        return action

    def _assisted(
        self, wanted: NDArray[np.float32], observation: Observation
    ) -> NDArray[np.float32]:
        """What replaces an action, after the scan has been taken in."""
        pose, velocity = read_odometry(observation)
        moving = self._perception.moving(0, pose, observation["scan"])
        obstacles = with_felt_walls(self._perception.obstacles(0), observation, pose)
        doors = _rows(observation, "remembered_doors")
        action = wanted
        if self._doors:
            action = self._help.helped(wanted, obstacles, doors, pose, velocity, moving)
        ends = np.vstack((points_of_segments(_rows(observation, "walls")), doors.reshape(-1, 2)))
        points = np.vstack((obstacles.points(), moving, points_to_parent(pose, ends)))
        return self._shield.checked(action, points, pose, velocity)

    @property
    def door(self) -> DoorSide | None:
        """The door that the robot helps to pass, odometry frame; None if there is none."""
        return self._help.door


def _rows(observation: Observation, name: str) -> FloatArray:
    """Ends of walls or doors of the observation, robot frame, shape (n, 4); none without them.

    They show where a wall ends more exactly than the memory of hits, which averages.
    """
    if name not in observation:
        return np.empty((0, 4))
    rows: FloatArray = table(observation, name).astype(np.float64)[:, :4]
    return rows
