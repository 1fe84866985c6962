"""Simulated scans whose truth is known: random poses, noise and clutter in floor plans."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
import shapely
from shapely.geometry.base import BaseGeometry

from semnav_env.world.lidar.lidar import Lidar
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_features.frames import Pose
from semnav_features.lidar_spec import LidarSpec
from semnav_features.lidars import TIM561
from semnav_features.scan import Scan
from semnav_features.scene import Scene
from studies.features.clutter import cluttered, free_floor
from studies.truth import TrueView

CORRIDOR, ANYWHERE = "corridor", "anywhere"
PLACES = (CORRIDOR, ANYWHERE)

LIDAR_CLEARANCE = 0.35
"""Least distance from the lidar to anything solid, metres: about half the width of a robot."""

MAX_POSE_TRIES = 10_000
"""Random places that are drawn for one pose before the plan is found to have no room."""

POSES_PER_LAYOUT = 20
"""Poses in one arrangement of clutter."""


@dataclass(frozen=True)
class CaseSituation:
    """Where a pose was drawn.

    Attributes:
        plan: name of the floor plan.
        place: "corridor" (and where corridors meet) or "anywhere" in the plan.
        clutter: whether there is furniture and the like beyond what the plan shows.
    """

    plan: str
    place: str
    clutter: bool


@dataclass(frozen=True, eq=False)
class Case:
    """A pose, what is in view from it, and what a lidar measures with each noise.

    Attributes:
        situation: where it is.
        pose: of the lidar, world frame.
        truth: what is in view, lidar frame.
        scans: the standard deviation of the ranges, metres, and a scan with it.
    """

    situation: CaseSituation
    pose: Pose
    truth: Scene
    scans: tuple[tuple[float, Scan], ...]


def draw_cases(
    plan: FloorPlan,
    poses: int,
    sigmas: tuple[float, ...],
    clutter: bool,
    rng: np.random.Generator,
    spec: LidarSpec = TIM561,
) -> Iterator[Case]:
    """Cases in a floor plan, half of them from corridors and half from anywhere.

    Args:
        plan: the plan.
        poses: how many cases.
        sigmas: standard deviations of the ranges, metres; each case has a scan for each.
        clutter: put things into the plan, anew for every `POSES_PER_LAYOUT` poses.
        rng: source of randomness.
        spec: the lidar; its sigma does not matter.

    Raises:
        ValueError: there is no room to stand in the plan.
    """
    for first in range(0, poses, POSES_PER_LAYOUT):
        layout = cluttered(plan, rng) if clutter else plan
        floor = free_floor(layout)
        view = TrueView(layout, spec)
        lidars = [(s, Lidar(layout, replace(spec, sigma=s))) for s in sigmas]
        for number in range(first, min(first + POSES_PER_LAYOUT, poses)):
            place = PLACES[number % 2]
            pose = _draw_pose(_area(floor, plan, place), layout, rng)
            key = (int(rng.integers(2**31)), 0, number)
            scans = tuple([(sigma, lidar.scan(pose, key)) for sigma, lidar in lidars])
            situation = CaseSituation(plan.name, place, clutter)
            yield Case(situation, pose, view.scene(pose), scans)


def _area(floor: BaseGeometry, plan: FloorPlan, place: str) -> BaseGeometry:
    """The part of the free floor that is meant; all of it in a plan without corridors."""
    ways = [region.polygon for region in (*plan.corridors, *plan.intersections)]
    if place == ANYWHERE or not ways:
        return floor
    return floor.intersection(shapely.union_all(ways))


def _draw_pose(area: BaseGeometry, layout: FloorPlan, rng: np.random.Generator) -> Pose:
    west, south, east, north = area.bounds
    for _ in range(MAX_POSE_TRIES):
        x, y = rng.uniform((west, south), (east, north)).tolist()
        near = layout.solids.query(shapely.Point(x, y), "dwithin", LIDAR_CLEARANCE)
        if not len(near) and shapely.contains_xy(area, x, y):
            return x, y, float(rng.uniform(-math.pi, math.pi))
    raise ValueError(f"no place in {layout.name} is {LIDAR_CLEARANCE} m from everything solid")
