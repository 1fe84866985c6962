"""Simulates depth cameras in a raised floor plan: from a pose to a point cloud."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from semnav_env.robots.depth_camera import DepthCamera
from semnav_env.robots.depth_rig import DepthRig
from semnav_env.world.depth.faces import column, upright
from semnav_env.world.depth.match import match
from semnav_env.world.depth.raised_plan import NO_JAMB, FaceKind, RaisedPlan
from semnav_env.world.depth.rasterise import rasterise
from semnav_env.world.lidar.moving import NO_MOVING_THINGS
from semnav_features.clouds.point_cloud import PointCloud
from semnav_features.frames import FloatArray, Pose

PERSON_HEIGHT = 1.75
"""Height of a walking person, metres."""


class RigHits(NamedTuple):
    """The measured cloud, with the true faces of its points, which no robot knows.

    Attributes:
        cloud: the measured points.
        jambs: `RaisedPlan.jambs` of the face that each point lies on, shape (n,).
        kinds: its `FaceKind`, shape (n,).
    """

    cloud: PointCloud
    jambs: NDArray[np.int64]
    kinds: NDArray[np.int64]


def rig_hits(
    rig: DepthRig,
    raised: RaisedPlan,
    pose: Pose,
    rng: np.random.Generator,
    moving: tuple[FloatArray, FloatArray] = NO_MOVING_THINGS,
) -> RigHits:
    """The cloud of depth cameras, with the face on which each of its points lies.

    Args:
        rig: the cameras.
        raised: the plan.
        pose: of the robot, world frame.
        rng: of the errors; one number is drawn.
        moving: discs of people, shape (n, 3), and leaves, shape (m, 4), as a lidar takes them.

    Raises:
        ValueError: a pose that is not finite.
    """
    if not all(map(math.isfinite, pose)):
        raise ValueError(f"pose is {pose}; it must be finite")
    seed = int(rng.integers(2**62))
    corners, kinds, jambs = _faces_near(rig, raised, pose, moving)
    found = [
        _look(camera, number, corners, kinds, seed) for number, camera in enumerate(rig.cameras)
    ]
    seen = np.concatenate([faces for _, faces in found])
    counts = [len(faces) for _, faces in found]
    origins = np.repeat([camera.position for camera in rig.cameras], counts, axis=0)
    cloud = PointCloud(np.concatenate([points for points, _ in found]), origins)
    return RigHits(cloud, jambs[seen], kinds[seen])


def _faces_near(
    rig: DepthRig, raised: RaisedPlan, pose: Pose, moving: tuple[FloatArray, FloatArray]
) -> tuple[FloatArray, NDArray[np.int64], NDArray[np.int64]]:
    """Faces within range in the robot frame, shape (n, 4, 3), their kinds and their jambs."""
    x, y, heading = pose
    reach = max(_reach(camera) for camera in rig.cameras)
    circles = raised.circles
    near = np.hypot(circles[:, 0] - x, circles[:, 1] - y) < reach + circles[:, 2]
    levels = [_level(x, y, reach, height) for height in (0.0, raised.ceiling)]
    extra = [*levels, *_moving_faces(moving, raised.lintel)]
    corners = np.concatenate((raised.corners[near], [face for face, _ in extra]))
    kinds = np.concatenate((raised.kinds[near], [kind for _, kind in extra]))
    jambs = np.concatenate((raised.jambs[near], np.full(len(extra), NO_JAMB)))
    c, s = math.cos(heading), math.sin(heading)
    turned = (corners - (x, y, 0.0)) @ np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    return turned, kinds, jambs


def _reach(camera: DepthCamera) -> float:
    """Largest distance from the robot's centre to a point that the camera can measure, metres."""
    corner = math.hypot(1.0, math.tan(0.5 * camera.across), math.tan(0.5 * camera.up))
    return math.hypot(*camera.position[:2]) + camera.range_max * corner


def _level(x: float, y: float, reach: float, height: float) -> tuple[FloatArray, FaceKind]:
    """The floor or the ceiling as far as it is in range."""
    ring = ((x - reach, y - reach), (x + reach, y - reach), (x + reach, y + reach))
    corners = [(*corner, height) for corner in (*ring, (x - reach, y + reach))]
    return np.array(corners), FaceKind.FLOOR


def _moving_faces(
    moving: tuple[FloatArray, FloatArray], lintel: float
) -> Iterator[tuple[FloatArray, FaceKind]]:
    discs, leaves = moving
    for x, y, radius in discs.tolist():
        for side in column(x, y, radius, PERSON_HEIGHT):
            yield side, FaceKind.PERSON
    for x1, y1, x2, y2 in leaves.tolist():
        yield upright((x1, y1), (x2, y2), 0.0, lintel), FaceKind.LEAF


def _look(
    camera: DepthCamera, number: int, corners: FloatArray, kinds: NDArray[np.int64], seed: int
) -> tuple[FloatArray, NDArray[np.int64]]:
    """Points that one camera measures, robot frame, and the faces they lie on."""
    us, vs = camera.directions
    shape = camera.rows, camera.columns
    inverse, second, faces = np.empty(shape), np.empty(shape), np.empty(shape, np.int64)
    local = np.ascontiguousarray((corners - camera.position) @ camera.rotation)
    if camera.baseline != 0.0:
        beside = np.add(local, (0.0, camera.baseline, 0.0))  # as the second eye sees it
        rasterise(beside, us, vs, 1.0 / camera.range_max, second, faces)
    rasterise(local, us, vs, 1.0 / camera.range_max, inverse, faces)
    points, hits = np.empty((faces.size, 3)), np.empty(faces.size, np.int64)
    arrays = inverse, faces, second, kinds, np.array(camera.missing), us, vs, camera.record
    count = match(*arrays, seed, number, points, hits)
    return points[:count] @ camera.rotation.T + camera.position, hits[:count]
