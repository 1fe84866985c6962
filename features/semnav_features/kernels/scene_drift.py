"""Corrects drift by the walls of a scene that is at hand, such as one of a log; see `drift`."""

from __future__ import annotations

from semnav_features.frames import FloatArray, Pose
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.drift import PRIOR, corrected, with_sighting


@kernel
def without_drift(walls: FloatArray, known: FloatArray, used: int, pose: Pose) -> Pose:
    """The pose at which the walls of a scan lie best on the remembered ones.

    One Gauss-Newton step towards the least

        sum w_i d_i^2 + (dx^2 + dy^2) / s^2 + dtheta^2 / t^2,

    where d_i are the distances of both ends of each shared stretch from the remembered line, w_i
    grows with its length and falls for outliers, and s and t are `drift.DRIFT_DEVIATION` and
    `drift.DRIFT_ANGLE_DEVIATION`. What the walls do not determine, such as the place along a
    corridor without doors, stays as odometry has it.

    Args:
        walls: x1, y1, x2, y2 of the scan's walls as the pose places them, metres, shape (n, 4).
        known: remembered walls in the same frame, shape (`WALL_ROWS`, room), the room a multiple of
            `WIDTH`.
        used: how many of its columns are used.
        pose: of the lidar by odometry, in the same frame.

    Returns:
        The corrected pose.
    """
    sums = PRIOR
    for i in range(len(walls)):
        ends = (walls[i, 0], walls[i, 1], walls[i, 2], walls[i, 3])
        sums = with_sighting(ends, known, used, pose, sums)
    return corrected(pose, sums)
