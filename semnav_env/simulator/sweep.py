"""One compiled call per scan: the arrays of a lidar are handed over once."""

from __future__ import annotations

import math
from typing import Any

from numba import njit, types
from numba.experimental import structref

from semnav_env.features.frames import FloatArray, Pose
from semnav_env.lidar.lidar import sense


@structref.register
class LidarArraysType(types.StructRef):
    """How compiled code sees `LidarArrays`."""

    def preprocess_fields(self, fields: Any) -> Any:
        """Fields of a general type, not of a literal value."""
        return tuple((name, types.unliteral(kind)) for name, kind in fields)


class LidarArrays(structref.StructRefProxy):
    """The arrays of a lidar on its mount.

    Attributes:
        lidar: `Lidar.arrays`.
        mount: pose of the lidar in the robot frame.
        ranges: written at every sweep, metres, shape (beams,).
    """

    lidar: Any
    mount: Pose
    ranges: FloatArray


structref.define_proxy(LidarArrays, LidarArraysType, list(LidarArrays.__annotations__))


@njit(cache=True, error_model="numpy")
def join_lidar(lidar: Any, mount: Pose, ranges: FloatArray) -> LidarArrays:
    """The arrays as one structure; they are shared, not copied."""
    return LidarArrays(lidar, mount, ranges)


@njit(cache=True, error_model="numpy")
def sweep(arrays: LidarArrays, robot: Pose, key: tuple[int, int, int]) -> None:
    """Measure the ranges from a robot's true pose, world frame.

    Args:
        arrays: of the lidar; its `ranges` are written.
        robot: pose of the robot's centre, world frame.
        key: (seed, episode, step) of the noise.
    """
    grid, starts, ends, directions, sensor, discs, leaves = arrays.lidar
    mount = arrays.mount
    c, s = math.cos(robot[2]), math.sin(robot[2])
    x, y = robot[0] + c * mount[0] - s * mount[1], robot[1] + s * mount[0] + c * mount[1]
    sense(
        x,
        y,
        robot[2] + mount[2],
        grid,
        starts,
        ends,
        directions,
        sensor,
        discs,
        leaves,
        key[0],
        key[1],
        key[2],
        arrays.ranges,
    )
