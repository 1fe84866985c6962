"""The observation of a small policy: one short vector, the same in training and afterwards."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from semnav_env.agents.base import Observation
from semnav_env.observations.layout import GOAL, ODOMETRY

Array = NDArray[np.float32]

SECTORS = 54
"""Sectors of the scan, each of which gives its nearest hit: 5 degrees of a lidar of 270 degrees."""

_GOAL_PARTS = [GOAL.columns.index(name) for name in ("x", "cosine", "door_start_x", "has_door")]
"""Where in the goal its place, its heading, its door and the flag of the door begin."""

_VELOCITY = ODOMETRY.columns.index("forward")
"""Where in the odometry the velocity begins."""

COMPACT_SIZE = GOAL.size + ODOMETRY.size - _VELOCITY + SECTORS
"""Length of the vector that `compact` returns: the goal, the velocity, the scan."""


def compact(observation: Observation) -> Array:
    """The goal, the velocity and the nearest hits around, each value in [-1, 1].

    Places and speeds p enter as p / (1 + |p|). This keeps the direction, tells near places apart
    more finely than far ones, and is bounded. The text of the command is left out: the goal says
    already what it refers to.

    Args:
        observation: of an environment with `observation="all"`, or of many such in one: all entries
            may have the same leading dimensions.

    Returns:
        Shape (..., COMPACT_SIZE): the kind of goal (4), its place (2), cosine and sine of its
        heading, the start (2) and end (2) of its door, whether it has one; the velocity forward,
        left and turning; and the nearest hit in each sector, from the clockwise end of the scan.
    """
    goal, scan = observation["goal"], observation["scan"]
    kind, place, heading, jambs, has_door = np.split(goal, _GOAL_PARTS, axis=-1)
    starts = np.arange(SECTORS) * scan.shape[-1] // SECTORS
    values: Array = np.concatenate(
        (
            kind,
            _squash_place(place),
            heading,
            _squash_place(jambs[..., :2]),
            _squash_place(jambs[..., 2:]),
            has_door,
            _squash(observation["odometry"][..., _VELOCITY:]),
            _squash(np.minimum.reduceat(scan, starts, axis=-1)),
        ),
        axis=-1,
        dtype=np.float32,
    )
    return values


def _squash_place(place: Array) -> Array:
    """Places (x, y), each with its distance squashed and its direction kept."""
    return np.asarray(place / (1.0 + np.hypot(place[..., :1], place[..., 1:])), np.float32)


def _squash(values: Array) -> Array:
    """Each value on its own."""
    return np.asarray(values / (1.0 + np.abs(values)), np.float32)
