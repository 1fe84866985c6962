"""The cloud of the depth cameras in the picture, and the jambs that are found in it."""

from __future__ import annotations

import math

import numpy as np

from semnav_env.mind.belief import BeliefTracker
from semnav_env.rendering import marks
from semnav_env.rendering.camera import Camera
from semnav_env.rendering.canvas import Canvas
from semnav_features.clouds import PointCloud, find_door
from semnav_features.frames import ORIGIN, FloatArray, Pose, points_to_parent, relative

DRAWN_POINTS = 3000
"""Approximate number of points of a cloud that are drawn."""

MAX_DOOR_DISTANCE = 2.5
"""Largest distance of a remembered door whose jambs are looked for, metres."""

DOOR_SIGMA = 0.1
"""Standard deviation of a remembered jamb, metres."""

FLOOR = 0.1
"""Height below which points are not drawn, metres: the floor would cover everything."""


def cloud_on_the_map(cloud: PointCloud, pose: Pose) -> FloatArray:
    """A sample of the points above the floor, (x, y) in the world frame, shape (n, 2)."""
    points = cloud.points_robot[cloud.points_robot[:, 2] > FLOOR, :2]
    return points_to_parent(pose, points[:: max(1, len(points) // DRAWN_POINTS)])


def jambs_on_the_map(cloud: PointCloud, tracker: BeliefTracker, pose: Pose) -> FloatArray:
    """The jambs that a robot finds where it remembers doors, world frame, shape (n, 2)."""
    if not len(cloud.points_robot):
        return np.zeros((0, 2))
    belief = tracker.belief
    here = tracker.scene().placed(relative(belief.pose, ORIGIN))
    near = [door for door in here.doors if math.hypot(*door.midpoint) <= MAX_DOOR_DISTANCE]
    found = [find_door(cloud, door, DOOR_SIGMA) for door in near]
    jambs = [
        jamb
        for door in found
        if door is not None
        for jamb, seen in ((door.start, door.start_seen), (door.end, door.end_seen))
        if seen
    ]
    return points_to_parent(pose, np.array(jambs).reshape(-1, 2))


def draw_depth(canvas: Canvas, camera: Camera, cloud: FloatArray, jambs: FloatArray) -> None:
    """Draw what the cameras saw, and the jambs on top of it."""
    if len(cloud):
        marks.cloud(canvas, camera.pixels(cloud))
    for jamb in camera.pixels(jambs) if len(jambs) else ():
        marks.jamb(canvas, jamb)
