"""Turns a scan into a scene."""

from __future__ import annotations

import math
import threading
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import lru_cache
from typing import TypeVar, cast

import numpy as np

from semnav_features.frames import FloatArray
from semnav_features.kernels.chain import extract_arrays
from semnav_features.kernels.layout import (
    ARCS,
    AT_START,
    CORNERS,
    CORRIDORS,
    DOORS,
    END_BREAK,
    END_RUPTURE,
    NO_LEAF,
    START_BREAK,
    START_RUPTURE,
    WALLS,
)
from semnav_features.kernels.scratch import (
    Features,
    Scratch,
    allocate_features,
    allocate_scratch,
)
from semnav_features.lazy_items import LazyItems
from semnav_features.lidar_spec import SENSOR
from semnav_features.scan import Scan
from semnav_features.scene import (
    Arc,
    Corner,
    CornerKind,
    CorridorProbe,
    Door,
    Scene,
    SceneLeaf,
    Wall,
)
from semnav_features.settings import ExtractorSettings

DEFAULT_SETTINGS = ExtractorSettings()
KINDS = tuple(CornerKind)

_Item = TypeVar("_Item")

_LAST = threading.local()


def extract(
    scan: Scan, settings: ExtractorSettings = DEFAULT_SETTINGS, explain: bool = False
) -> Scene:
    """Walls, doors, corners, corridors and arcs of a scan, in the lidar frame.

    Beams beyond one full turn are left out. In a scan of a full circle it makes no difference
    which beam is the first.

    Args:
        scan: one sweep of a lidar.
        settings: every limit of the chain.
        explain: add the candidates that were turned down, and why, as `rejections`; some thousand
            times slower.

    Returns:
        The scene, features in beam order; those of a full circle begin at a break between walls,
        its corridors at the corner nearest to the lidar.
        Empty where the scan shows nothing.

    Raises:
        TypeError: `scan` is no `Scan`, such as bare ranges, which do not say where their beams
            point; or `settings` are no `ExtractorSettings`.
    """
    if not isinstance(scan, Scan):
        raise TypeError(
            f"extract takes a Scan, not {type(scan).__name__}; make one of the ranges: "
            "Scan(ranges, angle_min=..., angle_increment=..., range_max=...), angles in radians"
        )
    if not isinstance(settings, ExtractorSettings):
        raise TypeError(
            f"the settings are an ExtractorSettings, not {type(settings).__name__}; "
            "for example ExtractorSettings(sigma=0.03)"
        )
    directions = beam_directions(len(scan.ranges), scan.angle_min, scan.angle_increment)
    beams = len(directions)
    features, scratch = _arrays(beams)
    extract_arrays(
        scan.ranges[:beams].copy(),
        directions,
        sensor_of(scan),
        _record(settings)[0],
        scratch,
        features,
        True,
    )
    scene = to_scene(features)
    if explain:
        from semnav_features.explain import Trace, rejections  # seldom asked for

        scene = replace(scene, rejections=rejections(Trace(settings, scratch, features)))
    return scene


def sensor_of(scan: Scan) -> np.void:
    """The limits of a scan as kernels read them, an entry of dtype `SENSOR`."""
    return _sensor(scan.angle_min, scan.angle_increment, scan.range_min, scan.range_max)


@lru_cache(maxsize=16)
def _sensor(*limits: float) -> np.void:
    return cast(np.void, np.array([(*limits, 0.0, 0.0, 0.0)], SENSOR)[0])


@lru_cache(maxsize=16)
def beam_directions(beams: int, angle_min: float, angle_increment: float) -> FloatArray:
    """Unit vectors of the beams of at most one full turn, lidar frame, shape (n, 2); do not write.

    The beam that repeats the first direction is among them.
    """
    beams_per_turn = 2.0 * math.pi / angle_increment * (1.0 + 1e-9)
    angles = angle_min + angle_increment * np.arange(int(min(beams, beams_per_turn + 1.0)))
    return np.stack((np.cos(angles), np.sin(angles)), axis=1)


def to_scene(features: Features) -> Scene:
    """The used entries of the kernels' arrays as a scene."""
    counts = features.counts.tolist()
    return Scene(
        _items(features.walls, counts[WALLS], _wall),
        _items(features.doors, counts[DOORS], _door),
        _items(features.corners, counts[CORNERS], _corner),
        _items(features.corridors, counts[CORRIDORS], _corridor),
        _items(features.arcs, counts[ARCS], _arc),
    )


def _items(rows: np.ndarray, count: int, make: Callable[..., _Item]) -> Sequence[_Item]:
    return LazyItems(rows[:count], make) if count else ()


def _arrays(beams: int) -> tuple[Features, Scratch]:
    """Arrays for scans of that many beams; the ones of the thread's last scan if they fit."""
    arrays: tuple[int, Features, Scratch] | None = getattr(_LAST, "arrays", None)
    if arrays is None or arrays[0] != beams:
        arrays = _LAST.arrays = beams, allocate_features(), allocate_scratch(beams)
    return arrays[1:]


def _corner(x: float, y: float, kind: int) -> Corner:
    return Corner((x, y), KINDS[kind])


def _corridor(start_x: float, start_y: float, end_x: float, end_y: float) -> CorridorProbe:
    return CorridorProbe((start_x, start_y), (end_x, end_y))


def _door(
    start_x: float,
    start_y: float,
    end_x: float,
    end_y: float,
    confidence: float,
    leaf_angle: float,
    hinge: int,
) -> Door:
    leaf = None if hinge == NO_LEAF else SceneLeaf(hinge == AT_START, leaf_angle)
    return Door((start_x, start_y), (end_x, end_y), confidence=confidence, leaf=leaf)


def _wall(
    start_x: float,
    start_y: float,
    end_x: float,
    end_y: float,
    residual: float,
    first: int,
    last: int,
    flags: int,
    points: int,
    mean_x: float,
    mean_y: float,
    spread: float,
    variance: float,
) -> Wall:
    return Wall(
        (start_x, start_y),
        (end_x, end_y),
        flags & START_RUPTURE != 0,
        flags & END_RUPTURE != 0,
        flags & START_BREAK != 0,
        flags & END_BREAK != 0,
        points,
        residual,
        math.sqrt(variance / spread),
        math.sqrt(variance / points),
        (mean_x, mean_y),
    )


def _arc(
    centre_x: float,
    centre_y: float,
    radius: float,
    start_x: float,
    start_y: float,
    end_x: float,
    end_y: float,
    residual: float,
    first: int,
    last: int,
    convex: int,
    points: int,
) -> Arc:
    ends = (start_x, start_y), (end_x, end_y)
    return Arc((centre_x, centre_y), radius, *ends, convex != 0, points, residual)


@lru_cache(maxsize=16)
def _record(settings: ExtractorSettings) -> np.ndarray:
    return settings.as_record()
