"""Observations of one robot, and what a small policy sees of them."""

import numpy as np

from semnav_agents.learning.compact import CompactObserver
from semnav_env.mind.observations import GOAL
from semnav_env.mind.observations.layout import BUMP_ROWS
from semnav_env.robots import ROBOTS
from semnav_features.lidars import lidar_spec

LIDAR = lidar_spec("tim561")


def observation(scan, goal=None, velocity=(0, 0, 0)):
    odometry = np.array([0, 0, 1, 0, *velocity], np.float32)
    goal = np.zeros(GOAL.size, np.float32) if goal is None else goal
    bumps = np.zeros((2, BUMP_ROWS * 4), np.float32)
    return {
        "scan": np.asarray(scan, np.float32),
        "odometry": odometry,
        "goal": goal,
        "bumps": bumps[0],
        "bumps_mask": bumps[1, :BUMP_ROWS],
    }


def compact(seen, robot="wheelchair", lidar=LIDAR):
    """The compact observation at the start of an episode."""
    row = {name: entry[None] for name, entry in seen.items()}
    return CompactObserver([ROBOTS[robot]], lidar).observe(row)[0]
