"""How much room is around a robot: remembered lidar hits, as clearances from its footprint.

A lidar in front sees nothing behind, where a robot turns and backs. So hits are kept as keyframes
in the odometry frame while the robot drives on.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from semnav_env.features.frames import FloatArray, Point, Pose, to_local, to_parent, wrap_angle
from semnav_env.features.kernels.compiling import kernel
from semnav_env.features.lidar_spec import LidarSpec
from semnav_env.robots import RobotSpec

SECTORS = 72
"""Directions around the robot for which there is a clearance: 5 degrees each."""

NO_HIT = 10.0
"""Clearance of a direction in which nothing is known, metres."""

KEYFRAMES = 24
"""Remembered scans of each robot: some 5 m of driving, or a full turn."""

KEYFRAME_HITS = 60
"""Hits of a keyframe: the nearest of each group of neighbouring beams."""

KEYFRAME_DISTANCE, KEYFRAME_ANGLE = 0.2, 0.35
"""A scan is remembered when the robot has moved or turned so far since the last one that was,
metres and radians."""

Array = NDArray[np.float32]


class ClearanceMemory:
    """The room around each of several robots.

    Args:
        robots: the body of each.
        lidar: of all.
    """

    def __init__(self, robots: Sequence[RobotSpec], lidar: LidarSpec) -> None:
        count = len(robots)
        self._bodies = np.array([(r.length / 2, r.width / 2, *r.lidar_mount) for r in robots])
        self._beams, self._range_max = lidar.directions, lidar.range_max
        self._hits = np.zeros((count, KEYFRAMES, KEYFRAME_HITS, 2))
        self._poses = np.zeros((count, 3))
        self._taken = np.zeros(count, np.int64)

    def forget(self, robots: NDArray[np.bool_]) -> None:
        """Begin anew.

        Args:
            robots: which of them, shape (n,).
        """
        self._taken[robots] = 0

    def clearances(self, robots: NDArray[np.intp], poses: FloatArray, scans: Array) -> Array:
        """Take in a scan of each of some robots, and tell the room around it.

        Args:
            robots: which ones, shape (n,).
            poses: believed, odometry frame, shape (n, 3).
            scans: ranges, shape (n, beams).

        Returns:
            Distance from the footprint to the nearest hit in each direction from its centre,
            metres, shape (n, `SECTORS`), counter-clockwise; the first sector begins straight
            behind.
        """
        nearest = np.full((len(poses), SECTORS), NO_HIT, np.float32)
        for row, (k, pose) in enumerate(zip(robots.tolist(), poses.tolist(), strict=True)):
            take_in(
                scans[row],
                self._beams,
                self._range_max,
                self._bodies[k],
                tuple(pose),
                self._hits[k],
                self._poses[k],
                self._taken[k : k + 1],
                nearest[row],
            )
        return nearest


@kernel
def take_in(
    scan: Array,
    beams: FloatArray,
    range_max: float,
    body: FloatArray,
    pose: Pose,
    hits: FloatArray,
    last: FloatArray,
    taken: NDArray[np.int64],
    nearest: Array,
) -> None:
    """Take in a scan of one robot.

    Args:
        scan: ranges, shape (beams,).
        beams: directions in the lidar frame, shape (beams, 2).
        range_max: metres; a range of so much is no return.
        body: half the length and half the width of the footprint, and the pose of the lidar in it.
        pose: of the robot, odometry frame.
        hits: of the keyframes, odometry frame, shape (`KEYFRAMES`, `KEYFRAME_HITS`, 2); changed.
        last: pose of the last keyframe; changed.
        taken: number of keyframes taken so far, shape (1,); changed.
        nearest: clearances, shape (`SECTORS`,); changed.
    """
    mount = (body[2], body[3], body[4])
    is_keyframe = taken[0] == 0 or (
        math.hypot(pose[0] - last[0], pose[1] - last[1]) > KEYFRAME_DISTANCE
        or abs(wrap_angle(pose[2] - last[2])) > KEYFRAME_ANGLE
    )
    row = hits[taken[0] % KEYFRAMES]
    for group in range(KEYFRAME_HITS):
        closest, place = range_max, (math.nan, math.nan)
        first = group * len(scan) // KEYFRAME_HITS
        for i in range(first, (group + 1) * len(scan) // KEYFRAME_HITS):
            if not 0.0 < scan[i] < range_max:
                continue
            hit = to_parent(mount, (scan[i] * beams[i, 0], scan[i] * beams[i, 1]))
            note_hit(hit, body, nearest)
            if scan[i] < closest:
                closest, place = scan[i], hit
        if is_keyframe:
            row[group] = to_parent(pose, place)
    if is_keyframe:
        taken[0] += 1
        last[0], last[1], last[2] = pose
    for k in range(min(taken[0], KEYFRAMES)):
        for group in range(KEYFRAME_HITS):
            if not math.isnan(hits[k, group, 0]):
                note_hit(to_local(pose, (hits[k, group, 0], hits[k, group, 1])), body, nearest)


@kernel
def note_hit(hit: Point, body: FloatArray, nearest: Array) -> None:
    """Lower the clearance of the sector in which a hit lies, robot frame."""
    x, y = hit
    clearance = math.hypot(max(abs(x) - body[0], 0.0), max(abs(y) - body[1], 0.0))
    sector = int((math.atan2(y, x) + math.pi) * (SECTORS / math.tau)) % SECTORS
    nearest[sector] = min(nearest[sector], np.float32(clearance))
