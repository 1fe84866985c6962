"""What is done at every step, in one compiled call on arrays that were handed over once.

Handing an array to a compiled function costs a third of a microsecond, and there are some
thirty of them: more than all the work. So they are put into one structure beforehand.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numba import njit, types
from numba.experimental import structref
from numpy.typing import NDArray

from semnav_env.features.frames import FloatArray, Pose
from semnav_env.features.kernels.chain import extract_arrays
from semnav_env.features.kernels.memory import relocate, remember
from semnav_env.lidar.lidar import sense
from semnav_env.observation_row import write_features, write_remembered, write_scan
from semnav_env.observations import ROW_SIZE


@structref.register
class SensesType(types.StructRef):
    """How compiled code sees `Senses`."""

    def preprocess_fields(self, fields: Any) -> Any:
        """Fields of a general type, not of a literal value."""
        return tuple((name, types.unliteral(kind)) for name, kind in fields)


class Senses(structref.StructRefProxy):
    """The arrays of one robot's senses.

    Attributes:
        lidar: `Lidar.arrays`.
        beams: cosine and sine of each beam, shape (n, 2).
        record: `ExtractorSettings.as_record()`.
        scratch: of the extractor.
        mount: pose of the lidar in the robot frame.
        ranges: written at every step, metres, shape (n,).
        features: written at every step.
        remembered: (walls, doors, used) of the memory, updated at every step.
        row: the observation, written at every step.
    """

    lidar: Any
    beams: FloatArray
    record: np.ndarray
    scratch: Any
    mount: Pose
    ranges: FloatArray
    features: Any
    remembered: Any
    row: NDArray[np.float32]


structref.define_proxy(Senses, SensesType, list(Senses.__annotations__))


@njit(cache=True, error_model="numpy")
def join_senses(
    lidar: Any,
    beams: FloatArray,
    record: np.ndarray,
    scratch: Any,
    mount: Pose,
    ranges: FloatArray,
    features: Any,
    remembered: Any,
    row: NDArray[np.float32],
) -> Senses:
    """The arrays as one structure; they are shared, not copied."""
    return Senses(lidar, beams, record, scratch, mount, ranges, features, remembered, row)


@njit(cache=True, error_model="numpy")
def observe(
    senses: Senses,
    robot_world: Pose,
    odometry: Pose,
    before: tuple[Pose, Pose],
    drifts: bool,
    key: tuple[int, int, int],
) -> Pose:
    """Scan, extract, remember and write the observation row (but for goal and odometry).

    Args:
        senses: the arrays to read and write.
        robot_world: true pose of the robot's centre, world frame.
        odometry: the same by odometry, odometry frame.
        before: odometry at the last scan, and what was returned for it.
        drifts: walls that are seen again tell where the robot is, and odometry only about where;
            else the memory's frame is that of odometry.
        key: (seed, episode, step) of the noise.

    Returns:
        Where the robot takes itself to be, in the memory's frame.
    """
    ranges, features, row = senses.ranges, senses.features, senses.row
    grid, starts, ends, directions, sensor, discs, leaves = senses.lidar
    x, y, heading = _mounted(robot_world, senses.mount)
    seed, episode, step = key
    sense(
        x,
        y,
        heading,
        grid,
        starts,
        ends,
        directions,
        sensor,
        discs,
        leaves,
        seed,
        episode,
        step,
        ranges,
    )
    limits = sensor[0]
    extract_features(senses)
    write_features(row, features, senses.mount)
    robot = _moved_on(odometry, before) if drifts else odometry
    lidar = _mounted(robot, senses.mount)
    if drifts:
        lidar = relocate(features.walls, features.counts, lidar, senses.remembered)
        robot = _carrying(lidar, senses.mount)
    remember(
        features.walls,
        features.doors,
        features.counts,
        ranges,
        limits.angle_min,
        limits.angle_increment,
        lidar,
        senses.remembered,
    )
    _, doors, used = senses.remembered
    write_remembered(row, doors, used[1], robot)
    write_scan(row[ROW_SIZE:], ranges, limits.range_min, limits.range_max)
    return robot


@njit(cache=True, error_model="numpy")
def extract_features(senses: Senses) -> None:
    """Extract the features of the scan that was taken last."""
    features, limits = senses.features, senses.lidar[4][0]
    extract_arrays(
        senses.ranges,
        senses.beams,
        limits.angle_increment,
        limits.range_min,
        limits.range_max,
        senses.record,
        senses.scratch,
        features.walls,
        features.doors,
        features.corners,
        features.corridors,
        features.arcs,
        features.counts,
    )


@njit(cache=True, error_model="numpy")
def _mounted(robot: Pose, mount: Pose) -> Pose:
    """The pose of a lidar on its mount; its heading is not wrapped."""
    c, s = math.cos(robot[2]), math.sin(robot[2])
    x, y = robot[0] + c * mount[0] - s * mount[1], robot[1] + s * mount[0] + c * mount[1]
    return x, y, robot[2] + mount[2]


@njit(cache=True, error_model="numpy")
def _carrying(lidar: Pose, mount: Pose) -> Pose:
    """The pose of a robot whose lidar on its mount has a pose."""
    heading = lidar[2] - mount[2]
    heading -= 2.0 * math.pi * np.rint(heading / (2.0 * math.pi))
    c, s = math.cos(heading), math.sin(heading)
    return lidar[0] - c * mount[0] + s * mount[1], lidar[1] - s * mount[0] - c * mount[1], heading


@njit(cache=True, error_model="numpy")
def _moved_on(odometry: Pose, before: tuple[Pose, Pose]) -> Pose:
    """Where a robot is if odometry was right since it was somewhere; its heading is not wrapped."""
    last, pose = before
    x, y, turned = odometry[0] - last[0], odometry[1] - last[1], pose[2] - last[2]
    c, s = math.cos(turned), math.sin(turned)
    return pose[0] + c * x - s * y, pose[1] + s * x + c * y, odometry[2] + turned
