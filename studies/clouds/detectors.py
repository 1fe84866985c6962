"""The detectors that are compared: from what a robot senses in a scene to a door."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from time import process_time
from typing import NamedTuple, TypeAlias

import numpy as np

from semnav_env.robots import SPOT, DepthRig
from semnav_env.world.depth import rig_hits
from semnav_features import extract
from semnav_features.clouds import (
    DetectedDoor,
    DoorFinder,
    MesDetector,
    MesStep,
    PointCloud,
    door_in_scene,
    find_shut_door,
    fused,
    joined,
)
from semnav_features.frames import compose
from semnav_features.scan import Scan
from studies.clouds.scenes import DRIFT_SIGMA, CloudScene, merged

SIGMA = 1.2 * DRIFT_SIGMA
"""Standard deviation of the expected place of a jamb, metres: of the pose, and of its heading."""

RIGHT = 0.10
"""Largest distance of a jamb that was found from where it is, metres: the width of her jambs."""

BACK = (0.24, 0.12)
"""How far behind its pose the robot was when it took the clouds that are fused, metres."""

STORED = 0.01
"""Side of the cells of a cloud that is stored with one point in each, metres."""

STEP_SIGMA = 0.005
"""Error of odometry between these clouds, metres."""


class CloudView(NamedTuple):
    """What a sensor gives of a scene.

    Attributes:
        cloud: robot frame; empty for a lidar.
        shown: whether it shows the start and the end of the door.
        scan: of a lidar.
    """

    cloud: PointCloud
    shown: tuple[bool, bool]
    scan: Scan | None = None


Sensor: TypeAlias = Callable[[CloudScene], CloudView]
Look: TypeAlias = Callable[[CloudScene, CloudView], DetectedDoor | None]
"""From a scene, of which a detector may know what is expected, and a view of it, to a door."""


def spot(scene: CloudScene) -> CloudView:
    """One cloud of SPOT's stereo pairs."""
    return CloudView(scene.hits.cloud, scene.shows(scene.hits))


def spot_on_its_way(scene: CloudScene) -> CloudView:
    """Three clouds of SPOT's stereo pairs, the last one where the others have their one."""
    rng, rig = _rng(scene), DepthRig.spot()
    behind = [compose(scene.pose, (-back, 0.0, 0.0)) for back in BACK]
    hits = [*(rig_hits(rig, scene.raised, pose, rng) for pose in behind), scene.hits]
    errors = rng.normal(0.0, STEP_SIGMA, (len(BACK), 2)).tolist()
    odometry = [(-b + dx, dy, 0.0) for b, (dx, dy) in zip(BACK, errors, strict=True)]
    cloud = fused([each.cloud for each in hits], [*odometry, (0.0, 0.0, 0.0)])
    return CloudView(cloud, scene.shows(merged(hits)))


def full_height(scene: CloudScene) -> CloudView:
    """One cloud of a sensor that sees from the floor to the lintel."""
    hits = scene.look(DepthRig.full_height())
    return CloudView(hits.cloud, scene.shows(hits))


def lidar(scene: CloudScene) -> CloudView:
    """A scan of SPOT's 2D lidar; whether it shows a jamb is not judged."""
    return CloudView(PointCloud(), (True, True), scene.scan())


def by_hand(*without: MesStep) -> Look:
    """Her pipeline, the crop made as she made it: around the door as it is in the cloud."""
    detector = MesDetector(without=frozenset(without))

    def look(scene: CloudScene, view: CloudView) -> DetectedDoor | None:
        return detector.find_door(view.cloud, scene.truth, 0.0, _rng(scene))

    return look


def by_robot(scene: CloudScene, view: CloudView) -> DetectedDoor | None:
    """Her pipeline, the crop made by the robot about where it believes the door to be."""
    return MesDetector().find_door(view.cloud, scene.expected, SIGMA, _rng(scene))


def finder(scene: CloudScene, view: CloudView) -> DetectedDoor | None:
    """The better detector."""
    return DoorFinder().find_door(view.cloud, scene.expected, SIGMA)


def finder_of_both(scene: CloudScene, view: CloudView) -> DetectedDoor | None:
    """The better detector, and where it finds none that of shut doors."""
    open_door = finder(scene, view)
    if open_door is not None:
        return open_door
    return find_shut_door(view.cloud, scene.expected, SIGMA)


def scan_doors(scene: CloudScene, view: CloudView) -> DetectedDoor | None:
    """The doors that the feature extractor finds in a scan."""
    assert view.scan is not None
    return door_in_scene(extract(view.scan).placed(SPOT.lidar_mount), scene.expected, SIGMA)


def with_lidar(scene: CloudScene, view: CloudView) -> DetectedDoor | None:
    """The better detector, and the lidar's door for the jambs that the cloud does not show."""
    return joined(finder(scene, view), scan_doors(scene, lidar(scene)))


def thinned(scene: CloudScene, view: CloudView) -> DetectedDoor | None:
    """Her pipeline, cropped by hand, on a cloud that was stored with one point in each cm^3."""
    cells = np.floor(view.cloud.points_robot / STORED).astype(np.int64)
    _, first = np.unique(cells, axis=0, return_index=True)
    cloud = PointCloud(view.cloud.points_robot[np.sort(first)])
    return MesDetector().find_door(cloud, scene.truth, 0.0, _rng(scene))


def _rng(scene: CloudScene) -> np.random.Generator:
    return np.random.default_rng((scene.seed, 1))


@dataclass(frozen=True)
class CloudResult:
    """What a detector made of a scene; start first, then end.

    Attributes:
        shown: whether the view shows each jamb.
        right: whether each was found where it is.
        wrong: whether each was found where it is not.
        errors: distance of each jamb that was found from where it is, metres.
        seconds: of the processor, from the view to the jambs.
    """

    shown: tuple[bool, bool]
    right: tuple[bool, bool]
    wrong: tuple[bool, bool]
    errors: tuple[float, ...]
    seconds: float


def judge(scene: CloudScene, view: CloudView, look: Look) -> CloudResult:
    """Run a detector on a view of a scene and compare it with the truth."""
    begun = process_time()
    door = look(scene, view)
    seconds = process_time() - begun
    if door is None:
        return CloudResult(view.shown, (False, False), (False, False), (), seconds)
    truth = scene.truth
    off = math.dist(door.start, truth.start), math.dist(door.end, truth.end)
    seen = door.start_seen, door.end_seen
    right = seen[0] and off[0] <= RIGHT, seen[1] and off[1] <= RIGHT
    wrong = seen[0] and off[0] > RIGHT, seen[1] and off[1] > RIGHT
    errors = tuple(each for each, one in zip(off, seen, strict=True) if one)
    return CloudResult(view.shown, right, wrong, errors, seconds)
