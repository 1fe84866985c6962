"""The part of a path that is still ahead: where it lies, and whether it stays free."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from semnav_agents.planning.nudge import best_nudge, path_clearances
from semnav_agents.planning.obstacle_selection import SearchBox
from semnav_features.frames import FloatArray, Pose, compose, relative
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.exact_hypot import exact_hypot

NUDGED_LENGTH, CHECKED_LENGTH = 1.2, 2.5
"""Length of the path ahead that is corrected, and that must be free, metres."""

PATH_ROOM = 0.25
"""Distance beside the footprints on a path within which points matter to it, besides the margin,
metres: the diagonal of `RELEVANT_DISTANCE`, and the largest correction at the end of the path."""

REPLAN_SHARE, REPLAN_LENGTH = 0.3, 1.0
"""Share of a partial path that is left when it is planned again, and the most that is left, metres.
Most of the path must have been driven: from the same place the same path would be found again."""


class PathAhead(NamedTuple):
    """A path of M samples, and how far it is driven.

    Attributes:
        poses: of the robot's centre at the samples, (M, 3).
        distance: travelled up to each sample, metres, (M,).
        clearance: at the samples as the planner measured it, metres, (M,).
        sample: the last one passed.
        margin: distance that the path keeps from obstacles, metres.
        travel: distance that the axle travels on the whole path, metres.
        length: of the robot, metres.
        width: of the robot, metres.
    """

    poses: FloatArray
    distance: FloatArray
    clearance: FloatArray
    sample: int
    margin: float
    travel: float
    length: float
    width: float


@kernel
def is_nearly_driven(path: PathAhead) -> bool:
    """Whether a path that leads only part of the way is to be planned again."""
    left_over = path.distance[len(path.distance) - 1] - path.distance[path.sample]
    return bool(left_over <= min(REPLAN_LENGTH, REPLAN_SHARE * path.travel))


@kernel
def poses_ahead(path: PathAhead, frame: Pose, distance: float) -> FloatArray:
    """The centre's poses on the path ahead, about 0.1 m apart, shape (N, 3).

    Args:
        path: the path.
        frame: of the path, in the frame of the answer.
        distance: how far ahead, metres.
    """
    first, along = path.sample, path.distance
    upto = min(np.searchsorted(along, along[first] + distance) + 1, len(along))
    poses = np.empty(((upto - first + 1) // 2, 3))
    c, s = math.cos(frame[2]), math.sin(frame[2])
    for k in range(len(poses)):
        x, y = path.poses[first + 2 * k, 0], path.poses[first + 2 * k, 1]
        poses[k, 0], poses[k, 1] = frame[0] + c * x - s * y, frame[1] + s * x + c * y
        poses[k, 2] = path.poses[first + 2 * k, 2] + frame[2]
    return poses


@kernel
def stays_free(
    path: PathAhead, seen: FloatArray, frame: Pose, pose: Pose, tolerance: float
) -> tuple[bool, Pose]:
    """Whether the next metres of a path are free, after a small correction if need be.

    Args:
        path: the path.
        seen: obstacle points around the robot, in its frame, (N, 2).
        frame: of the path.
        pose: of the robot's centre, in the same frame as `frame`.
        tolerance: loss of clearance at which a path is not free any more, metres.

    Returns:
        that, and the frame of the corrected path.
    """
    size, margin = (path.length, path.width), path.margin
    near = poses_ahead(path, relative(pose, frame), NUDGED_LENGTH)
    left, turn, _ = best_nudge(seen, near, size[0], size[1], margin + 0.005)
    if left != 0.0 or turn != 0.0:
        frame = compose(pose, compose((0.0, left, turn), relative(pose, frame)))
    far = poses_ahead(path, relative(pose, frame), CHECKED_LENGTH)
    now = path_clearances(seen, far, size[0], size[1], margin)
    for k in range(len(now)):
        planned = min(path.clearance[path.sample + 2 * k], margin)
        if not now[k] > planned - tolerance:
            return False, frame
    return True, frame


@kernel
def box_of_path(path: PathAhead, frame: Pose, box: SearchBox) -> SearchBox:
    """A box, grown to hold all points that matter to `stays_free`."""
    more = exact_hypot(path.length, path.width) / 2 + PATH_ROOM + 1.5 * path.margin
    poses = poses_ahead(path, frame, CHECKED_LENGTH)
    left, lower, right, upper = box
    for k in range(len(poses)):
        left, right = min(left, poses[k, 0] - more), max(right, poses[k, 0] + more)
        lower, upper = min(lower, poses[k, 1] - more), max(upper, poses[k, 1] + more)
    return SearchBox(left, lower, right, upper)
