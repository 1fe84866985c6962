"""Detectors of doors on the simulated robot of the tour."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np

from semnav_env.robots import SPOT, DepthRig
from semnav_env.world.depth import RaisedPlan, raise_plan, rig_hits
from semnav_env.world.simulator import Sensed
from semnav_features import Scan, extract
from semnav_features.clouds.detected_door import DetectedDoor
from semnav_features.clouds.finder import DoorFinder
from semnav_features.clouds.lidar_doors import door_in_scene
from semnav_features.clouds.mes import MesDetector
from semnav_features.clouds.point_cloud import PointCloud
from semnav_features.elements import Door
from semnav_features.frames import FloatArray
from semnav_features.lidars import TIM561
from studies.tour.villa import villa

DoorSearch = Callable[[Door, float], DetectedDoor | None]
"""Looks for an expected door, whose place is known to a standard deviation in metres."""

DoorSensor = Callable[[Sensed, np.random.Generator], DoorSearch]
"""Looks around; returns the search for doors in what it saw."""


@cache
def raised_villa() -> RaisedPlan:
    """The villa with the frames of its doors."""
    return raise_plan(villa())


def _cloud(sensed: Sensed, rng: np.random.Generator) -> PointCloud:
    """What SPOT's stereo pairs see."""
    return rig_hits(DepthRig.spot(), raised_villa(), sensed.motion.pose, rng).cloud


def by_finder(sensed: Sensed, rng: np.random.Generator) -> DoorSearch:
    """`DoorFinder` on a stereo cloud."""
    cloud, finder = _cloud(sensed, rng), DoorFinder()
    return lambda door, sigma: finder.find_door(cloud, door, sigma)


def by_mes(sensed: Sensed, rng: np.random.Generator) -> DoorSearch:
    """The pipeline of Mes 2021 on a stereo cloud."""
    cloud, detector = _cloud(sensed, rng), MesDetector()
    return lambda door, sigma: detector.find_door(cloud, door, sigma, rng)


def by_lidar(sensed: Sensed, _: np.random.Generator) -> DoorSearch:
    """The doors that the extractor finds in the scan."""
    scene = extract(_scan(sensed.ranges)).placed(SPOT.lidar_mount)
    return lambda door, sigma: door_in_scene(scene, door, sigma)


def _scan(ranges: FloatArray) -> Scan:
    spec = TIM561
    return Scan(ranges.copy(), spec.angle_min, spec.angle_increment, spec.range_min, spec.range_max)
