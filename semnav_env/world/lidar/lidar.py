"""A lidar in a floor plan: from the robot's pose to measured ranges."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

import numpy as np
from numpy.typing import NDArray

from semnav_env.world.lidar.culling import shared_culling
from semnav_env.world.lidar.moving import NO_MOVING_THINGS, cast_moving
from semnav_env.world.lidar.noise import corrupt
from semnav_env.world.lidar.raster import cast
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_features.frames import ORIGIN, FloatArray, Pose, compose
from semnav_features.kernels.compiling import kernel
from semnav_features.lidar_spec import CosinesSines, LidarSpec
from semnav_features.lidars import lidar_spec

if TYPE_CHECKING:
    from semnav_features.scan import Scan

Key: TypeAlias = tuple[int, int, int]
"""(seed, episode, step), each at least 0 and below 2**63; the step counts scans."""


@kernel
def measure(
    x: float,
    y: float,
    heading: float,
    grid: np.ndarray,
    starts: NDArray[np.int64],
    ends: FloatArray,
    beams: CosinesSines,
    sensor: np.ndarray,
    discs: FloatArray,
    leaves: FloatArray,
    seed: int,
    episode: int,
    step: int,
    out: FloatArray,
) -> None:
    """Write measured ranges: `cast`, `cast_moving`, `corrupt`; the arguments are theirs."""
    cast(x, y, heading, grid, starts, ends, beams, sensor, out)
    if len(discs) + len(leaves) > 0:
        cast_moving(x, y, heading, discs, leaves, beams, sensor[0].range_max, out)
    corrupt(out, sensor, seed, episode, step)


class Lidar:
    """A lidar on a robot in a floor plan; glass does not stop its beams.

    Args:
        floor_plan: the floor plan whose opaque segments the beams meet.
        spec: a lidar's name or its spec.
        mount: pose of the lidar in the robot frame.
        moving: moving things: discs, shape (n, 3), and segments, shape (m, 4); read again at every
            scan.

    Attributes:
        arrays: (grid, starts, ends, beams, sensor, discs, segments), as `measure` takes them;
            `cast` takes the first five.
    """

    spec: LidarSpec
    mount: Pose
    arrays: tuple[
        np.ndarray, NDArray[np.int64], FloatArray, CosinesSines, np.ndarray, FloatArray, FloatArray
    ]

    def __init__(
        self,
        floor_plan: FloorPlan,
        spec: str | LidarSpec = "tim561",
        mount: Pose = ORIGIN,
        moving: tuple[FloatArray, FloatArray] = NO_MOVING_THINGS,
    ) -> None:
        self.spec = lidar_spec(spec)
        self.mount = mount
        self._culling = shared_culling(floor_plan, self.spec.range_max, glass=False)
        tables = (self.spec.cosines_sines, self.spec.sensor)
        self.arrays = (*self._culling.arrays, *tables, *moving)

    def ranges(self, robot_pose: Pose, key: Key, out: FloatArray | None = None) -> FloatArray:
        """The measured range of each beam from `robot_pose` in the world, metres, shape (beams,).

        Written into `out` if given. -inf is too close, +inf no return (REP 117); never NaN.
        """
        out = np.empty(self.spec.beams) if out is None else out
        x, y, heading = compose(robot_pose, self.mount)
        measure(x, y, heading, *self.arrays, key[0], key[1], key[2], out)
        return out

    def exact_ranges(self, robot_pose: Pose) -> FloatArray:
        """The ranges without any error: metres, shape (beams,), +inf for no return."""
        out = np.empty(self.spec.beams)
        x, y, heading = compose(robot_pose, self.mount)
        grid, starts, ends, beams, sensor, discs, leaves = self.arrays
        cast(x, y, heading, grid, starts, ends, beams, sensor, out)
        cast_moving(x, y, heading, discs, leaves, beams, self.spec.range_max, out)
        return out

    def scan(self, robot_pose: Pose, key: Key) -> Scan:
        """`ranges` as a scan in the lidar frame, with the time of scan `key[2]`."""
        from semnav_features.scan import Scan  # a simulator needs the ranges only

        spec = self.spec
        return Scan(
            self.ranges(robot_pose, key),
            spec.angle_min,
            spec.angle_increment,
            spec.range_min,
            spec.range_max,
            stamp=key[2] / spec.rate_hz,
        )
