"""Simulated scans for the training of the scorer of doors, and the doors that are in them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Protocol

import numpy as np
from numpy.random import Generator, default_rng

from semnav_env.world.lidar.lidar import Lidar
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_features.frames import Pose
from semnav_features.lidar_spec import LidarSpec
from semnav_features.lidars import TIM561
from semnav_features.scan import Scan
from semnav_features.scene import Door
from studies.door_scorer.drawn_floors import furnished_floor
from studies.door_scorer.random_offices import random_office

HALF_DEGREE = LidarSpec("half_degree", 361, -math.pi / 2, math.radians(0.5))
TRAINING_LIDARS = (TIM561, HALF_DEGREE)
"""Floors are scanned by these in turn."""

RANGE_SIGMAS = (0.0, 0.01, 0.02, 0.03)
"""Standard deviations of the simulated ranges, metres."""

EDGE_JUMP = 0.1
"""Least difference of neighbouring ranges at an edge, metres."""

MIXED_SHARE = 0.2
"""Share of the beams at edges that read a mixture of both ranges."""

DRAWN_FLOOR_KEY = 1
"""Set apart the random numbers of drawn floors from those of offices."""


class TrainingSite(Protocol):
    """A floor to scan: `TrainingOffice` or `FurnishedFloor`."""

    @property
    def floor_plan(self) -> FloorPlan:
        """What stops a beam."""

    def doors_from(self, pose: Pose) -> tuple[Door, ...]:
        """The doors in the frame of a pose."""

    def corridor_pose(self, rng: Generator) -> Pose:
        """A free pose in a corridor."""

    def any_pose(self, rng: Generator) -> Pose:
        """A free pose anywhere."""


def scans_of_offices(
    offices: int, poses: int, seed: int
) -> Iterator[tuple[Scan, tuple[Door, ...]]]:
    """Scans of random offices, with their doors in the lidar frame."""
    for number in range(offices):
        rng = default_rng((seed, number))
        office = random_office(rng, furnished=number % 8 != 0)
        yield from _scans(office, poses, number, seed, rng)


def scans_of_floors(
    floors: Sequence[FloorPlan], layouts: int, poses: int, seed: int
) -> Iterator[tuple[Scan, tuple[Door, ...]]]:
    """Scans of drawn floors, each furnished anew for every layout, with their doors."""
    for number in range(layouts * len(floors)):
        rng = default_rng((seed, number, DRAWN_FLOOR_KEY))
        floor = furnished_floor(floors[number % len(floors)], rng)
        yield from _scans(floor, poses, number, seed, rng)


def _scans(
    site: TrainingSite, poses: int, number: int, seed: int, rng: Generator
) -> Iterator[tuple[Scan, tuple[Door, ...]]]:
    """Scans from corridors and from anywhere, in turn; lidar and noise go by the site's number."""
    sigma = RANGE_SIGMAS[number // 2 % len(RANGE_SIGMAS)]
    lidar = Lidar(site.floor_plan, replace(TRAINING_LIDARS[number % 2], sigma=sigma))
    for k in range(poses):
        pose = site.any_pose(rng) if k % 2 else site.corridor_pose(rng)
        scan = blurred(lidar.scan(pose, (seed, number, k)), rng)
        yield scan, site.doors_from(pose)


def blurred(scan: Scan, rng: Generator) -> Scan:
    """The scan with some beams that met an edge with half of their width, and read a mixture."""
    ranges = scan.ranges.copy()
    with np.errstate(invalid="ignore"):  # no return beside no return
        jumps = np.abs(np.diff(ranges)) > EDGE_JUMP
    edges = np.flatnonzero(jumps & (rng.random(len(jumps)) < MIXED_SHARE))
    share = rng.random(len(edges))
    ranges[edges] = share * scan.ranges[edges] + (1.0 - share) * scan.ranges[edges + 1]
    return replace(scan, ranges=ranges)
