"""The rules that are compared: the script of the thesis, today's lining up, `ExitViaDoor`."""

from __future__ import annotations

import numpy as np

from semnav_agents.door_exit import DoorExit
from semnav_agents.planning.driver import Driver
from semnav_agents.planning.planner import DriveTarget
from semnav_features.frames import Pose, Twist
from studies.exits.drives import ExitTask, Steer

RULE_DISTANCE = 1.0
"""Distance before and behind the door in the script of Mes 2021 (section 2.1), metres."""


def one_metre(task: ExitTask) -> Steer:
    """Stand 1 m before the door, then drive to 1 m behind it (Mes 2021, section 2.1)."""
    driver, through = Driver(task.robot), task.side.through
    poses = task.side.before(np.array([(RULE_DISTANCE, 0.0), (-RULE_DISTANCE, 0.0)])).tolist()
    targets = [DriveTarget((x, y, through)) for x, y in poses]

    def steer(pose: Pose, velocity: Twist) -> Twist:
        steering = driver.drive(task.points, targets[0], pose, velocity)
        if steering.done and len(targets) > 1:
            del targets[0]
        return steering.twist

    return steer


def lining_up(task: ExitTask) -> Steer:
    """Plan to the region straight behind the door and drive there, nothing else."""
    return DoorExit(task.plan, task.side, task.robot, alternatives=False).twist


def exit_via_door(task: ExitTask) -> Steer:
    """With the poses behind and before the door, as the scripted agent uses them."""
    return DoorExit(task.plan, task.side, task.robot).twist
