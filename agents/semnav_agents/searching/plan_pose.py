"""Where a robot is in the frame of a plan: odometry, corrected by the walls that it sees."""

from __future__ import annotations

import math

import numpy as np

from semnav_features.frames import (
    ORIGIN,
    FloatArray,
    Pose,
    compose,
    points_to_parent,
    relative,
    wrap_angle,
)

CORRECTION_PERIOD = 5
"""Control periods between two corrections."""

MAX_HIT_RANGE = 6.0
"""Largest range of a hit that counts, metres: farther off a small turn is a large error."""

MAX_WALL_DISTANCE = 0.08
"""Largest distance of a hit from a wall of the plan that it is of, metres: less than the depth of
furniture before the wall."""

HIT_STD, MOST_HITS = 0.03, 40
"""Standard deviation of a hit from its wall, metres, and how many hits count as independent:
neighbours on one wall share its error in the plan."""

DRIFT_PLACE, DRIFT_HEADING, DRIFT_TURN = 0.02, math.radians(0.7), 0.02
"""Standard deviation of the drift of the place in a metre, metres; of the heading in a metre,
radians; and of the heading in a turn by a radian, radians. A robot that stands does not drift, so
furniture before a wall cannot draw its pose away for long."""

LEAST_DRIFT = 1e-4
"""Standard deviation of the drift of a robot that does not move, metres and radians: a small number
with which the fit is determined."""

LEAST_HITS = 10
"""With fewer hits on walls there is no correction."""

BEAM_STEP = 3
"""Every so many beams count: more of one wall tell nothing new."""


class PlanPose:
    """The pose of a robot in the frame of a plan whose walls it knows.

    Args:
        walls: ends of the walls, x and y of both, shape (n, 4), in the frame of the start pose.
        mount: of the lidar on the robot.
        beams: unit vectors, lidar frame, shape (m, 2).
    """

    def __init__(self, walls: FloatArray, mount: Pose, beams: FloatArray) -> None:
        self._walls, self._mount, self._beams = walls, mount, beams
        self._frame: Pose = ORIGIN
        self._last: Pose = ORIGIN
        self._steps = 0

    def update(self, odometry: Pose, ranges: FloatArray) -> Pose:
        """The pose in the frame of the plan.

        Args:
            odometry: pose by odometry, from the start on.
            ranges: of the present scan, metres, shape (m,).
        """
        pose = compose(self._frame, odometry)
        if self._steps % CORRECTION_PERIOD == 0:
            counted = np.zeros(len(ranges), np.bool_)
            counted[::BEAM_STEP] = True
            counted &= (ranges > 0.0) & (ranges < MAX_HIT_RANGE)
            hits = points_to_parent(self._mount, (ranges[:, None] * self._beams)[counted])
            pose = fitted_to_walls(
                pose, hits, self._walls, drift_of(relative(self._last, odometry))
            )
            self._last = odometry
            self._frame = compose(pose, relative(odometry, ORIGIN))
        self._steps += 1
        return pose


def drift_of(motion: Pose) -> Pose:
    """Standard deviations of the drift of a motion, x, y (metres) and heading (radians)."""
    metres = math.hypot(motion[0], motion[1])
    place = LEAST_DRIFT + DRIFT_PLACE * metres
    return place, place, LEAST_DRIFT + DRIFT_HEADING * metres + DRIFT_TURN * abs(motion[2])


def fitted_to_walls(pose: Pose, hits: FloatArray, walls: FloatArray, drift: Pose) -> Pose:
    """The likeliest pose, given where the robot believed to be and its hits on known walls.

    One Gauss-Newton step of point-to-line matching (Censi 2008, eq. (2)) with the belief as a
    prior, so that what the walls do not tell, as the place along a corridor, stays as it was.

    Args:
        pose: believed pose, in the frame of the walls.
        hits: robot frame, metres, shape (m, 2).
        walls: x and y of both ends, shape (n, 4).
        drift: standard deviations of the belief, x, y (metres) and heading (radians).
    """
    if len(hits) < LEAST_HITS or not len(walls):
        return pose
    points = points_to_parent(pose, hits)
    starts, along = walls[:, :2], walls[:, 2:] - walls[:, :2]
    lengths = np.maximum(np.hypot(*along.T), 1e-9)
    along = along / lengths[:, None]
    normals = np.column_stack((-along[:, 1], along[:, 0]))
    off = points[:, None] - starts
    foot, aside = np.einsum("mnk,nk->mn", off, along), np.einsum("mnk,nk->mn", off, normals)
    away = np.where((foot > 0.0) & (foot < lengths), np.abs(aside), np.inf)
    nearest = np.argmin(away, axis=1)
    every = np.arange(len(points))
    near = away[every, nearest] < MAX_WALL_DISTANCE
    if np.count_nonzero(near) < LEAST_HITS:
        return pose
    normal, error = normals[nearest[near]], aside[every[near], nearest[near]]
    arm = points[near] - pose[:2]
    turned = normal[:, 1] * arm[:, 0] - normal[:, 0] * arm[:, 1]
    slopes = np.column_stack((normal, turned))
    weight = min(1.0, MOST_HITS / len(slopes)) / HIT_STD**2
    information = weight * slopes.T @ slopes + np.diag(1.0 / np.square(drift))
    dx, dy, turn = np.linalg.solve(information, -weight * slopes.T @ error).tolist()
    return pose[0] + dx, pose[1] + dy, wrap_angle(pose[2] + turn)
