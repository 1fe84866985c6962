"""One compiled call per control period: physics, odometry, scan.

Handing an array to a compiled function costs more than most of what is done with it, so all of a
robot's are put into one structure beforehand. A call works on this structure alone, needs no Python
and lets other threads run, so that many robots can be simulated side by side.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from semnav_env.world.lidar.lidar import measure
from semnav_env.world.physics.drive import drive, lost_motion
from semnav_env.world.physics.drive_record import POSE, TWIST
from semnav_env.world.simulator.odometry import advance
from semnav_features.frames import FloatArray, Pose
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.structures import Structure, numba_type

TOUCHED = 1
"""Event: the body touched something."""

SENSING = np.dtype(
    [
        ("pose", POSE),
        ("velocity", TWIST),
        ("odometry", POSE),
        ("speed", "f8"),
        ("noise_seed", "i8"),
        ("step", "i8"),
        ("exact", "i8"),
    ]
)
"""What one robot senses besides its scan; shape (1,).

Written in each control period:
    pose: true pose of the robot's centre, world frame.
    velocity: of the robot.
    odometry: pose by dead reckoning, odometry frame; the true pose if `exact`.
    speed: m/s.
    step: control periods since the reset.

Set when a simulator is made or reset:
    noise_seed: of the lidar's noise in this episode.
    exact: 1 if odometry is the true pose, else 0.
"""

NUMBERS = 10
"""How many numbers pose, velocity, odometry and speed are, with which `SENSING` begins."""


class SimulatorArrays(Structure):
    """The arrays of one simulated robot.

    Attributes:
        drive: `World.record`, dtype `DRIVE`.
        solids: `World.solids`.
        odometry: `Odometry.record`, dtype `ODOMETRY`.
        sensing: dtype `SENSING`, shape (1,).
        lidar: `Lidar.arrays`.
        mount: pose of the lidar in the robot frame.
        ranges: of the last scan, metres, shape (beams,).
    """

    drive: np.ndarray
    solids: Any
    odometry: np.ndarray
    sensing: np.ndarray
    lidar: Any
    mount: Pose
    ranges: FloatArray


SimulatorArraysType = numba_type(SimulatorArrays)


@kernel
def sense(arrays: SimulatorArrays) -> int:
    """Drive a robot for one control period and sense; returns events, 0 or `TOUCHED`."""
    drive(arrays.drive, arrays.solids)
    pose = arrays.drive[0].pose
    advance(arrays.odometry, pose.x, pose.y, pose.heading, *lost_motion(arrays.drive))
    arrays.sensing[0].step += 1
    return look(arrays)


@kernel
def look(arrays: SimulatorArrays) -> int:
    """Sense where the robot is now; returns events, 0 or `TOUCHED`."""
    driven, sensing = arrays.drive[0], arrays.sensing[0]
    sensing.pose, sensing.velocity = driven.pose, driven.velocity
    sensing.odometry = driven.pose if sensing.exact else arrays.odometry[0].pose
    sensing.speed = math.hypot(driven.velocity.forward, driven.velocity.left)
    _scan(arrays, driven.pose.x, driven.pose.y, driven.pose.heading)
    return TOUCHED if driven.touches > 0 else 0


@kernel
def _scan(arrays: SimulatorArrays, x: float, y: float, heading: float) -> None:
    """Measure the ranges from a robot's true pose, world frame."""
    grid, starts, ends, beams, sensor, discs, leaves = arrays.lidar
    mount, sensing = arrays.mount, arrays.sensing[0]
    c, s = math.cos(heading), math.sin(heading)
    measure(
        x + c * mount[0] - s * mount[1],
        y + s * mount[0] + c * mount[1],
        heading + mount[2],
        grid,
        starts,
        ends,
        beams,
        sensor,
        discs,
        leaves,
        sensing.noise_seed,
        0,
        sensing.step,
        arrays.ranges,
    )
