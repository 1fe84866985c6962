"""A corridor with the ten landmarks of Weerakoon et al., table II, and its three scans."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from shapely import box

from semnav_env.world.lidar import Lidar
from semnav_env.world.maps import FloorPlan, Surface
from semnav_features import ExtractorSettings, Scene, extract
from semnav_features.frames import FloatArray, Point, Pose, compose
from semnav_features.mapping import LandmarkMap, LandmarkSettings, LineMap, MapSettings
from semnav_features.scan import Scan

LANDMARKS: dict[str, Point] = {
    "C1": (-1.659, 1.672),
    "C2": (-1.417, 1.728),
    "C3": (-1.435, 2.163),
    "C4": (-1.089, 2.204),
    "C5": (0.909, 2.156),
    "C6": (1.483, 2.181),
    "C7": (0.947, 4.004),
    "C8": (0.918, 2.796),
    "C9": (1.027, 7.108),
    "C10": (1.949, 3.409),
}
"""Their estimated places, which are the true ones here; C10 by the one scan that shows it."""

SPREAD = {
    "C3": math.dist((-1.435, 2.163), (-1.386, 2.162)),
    "C4": math.dist((-1.089, 2.141), (-1.026, 2.205)),
    "C5": math.dist((0.909, 2.155), (0.8973, 2.115)),
    "C6": math.dist((1.483, 2.182), (1.493, 2.103)),
    "C7": math.dist((0.947, 4.011), (0.941, 3.751)),
}
"""How far apart the places are that the paper reports for two scans, metres: its only figure of
how exact they are."""

POSES: tuple[Pose, ...] = ((0.0, 0.0, math.pi / 2), (0.0, 2.0, math.pi / 2), (-0.5, 4.0, 0.0))
"""Of the three scans. The paper counts headings from the y axis."""

SHIFT, TURN = 0.1, 0.1
"""Each trial moves and turns the poses by up to this, metres and radians."""


def room() -> FloorPlan:
    """The corridor. C7 and C8 are taken for the jambs of a door, behind which C10 lies."""
    c = LANDMARKS
    walls = (
        ((-1.659, -4.0), c["C1"], c["C2"], c["C3"], c["C4"], (-1.089, 12.0)),
        ((1.483, -4.0), c["C6"], c["C5"], c["C8"], (1.1, 2.81)),
        ((1.1, 4.0), c["C7"], c["C9"], (1.9, 7.108)),
        ((3.5, 3.409), c["C10"], (1.949, 4.7)),
    )
    everywhere = box(-100.0, -100.0, 100.0, 100.0)
    return FloorPlan("room", tuple(map(Surface, walls)), (), (), (), (), everywhere)


def views(sigma: float, trial: int) -> list[tuple[Scene, Scan, Pose]]:
    """The three scans of a trial, with noise of `sigma` metres, and their poses."""
    rng = np.random.default_rng(trial)
    plan = room()
    lidar = Lidar(plan, replace(Lidar(plan).spec, sigma=sigma, dropout=0.0))
    settings = ExtractorSettings(sigma=sigma)
    seen = []
    for step, pose in enumerate(POSES):
        x, y, turn = rng.uniform(-1.0, 1.0, 3)
        moved = compose(pose, (SHIFT * x, SHIFT * y, TURN * turn))
        scan = lidar.scan(moved, key=(trial, 0, step))
        seen.append((extract(scan, settings), scan, moved))
    return seen


def fused(seen: list[tuple[Scene, Scan, Pose]]) -> list[tuple[FloatArray, FloatArray]]:
    """Places and covariances of the landmarks by least squares."""
    exact = LandmarkSettings(position=0.0, angle=0.0, sightings=1)
    landmarks = LandmarkMap(exact)
    for scene, scan, pose in seen:
        landmarks.add(scene, scan, pose)
    return [(np.array(corner.point), corner.covariance) for corner in landmarks.corners]


def segments(seen: list[tuple[Scene, Scan, Pose]]) -> tuple[int, int]:
    """Number of walls of the scans before they are merged in a line map, and after (figure 11)."""
    line_map = LineMap(MapSettings(wall_hits=1))
    for scene, scan, pose in seen:
        line_map.add(scene, scan, pose)
    return sum(len(scene.walls) for scene, _, _ in seen), len(line_map.walls)
