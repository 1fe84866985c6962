"""A floor plan with what all its episodes share."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import shapely

from semnav_env.judge.episodes.fingerprint import fingerprint
from semnav_env.robots import ROBOTS, WHEELCHAIR
from semnav_env.world.grid.poses import Reach
from semnav_env.world.maps import FloorPlan
from semnav_env.world.maps.geodesic import Geodesic
from semnav_env.world.maps.placement import sample_pose
from semnav_env.world.maps.reach import reach
from semnav_features.frames import Point

LARGEST_BODY = replace(
    WHEELCHAIR,
    name="body",
    length=max(robot.length for robot in ROBOTS.values()),
    width=max(robot.width for robot in ROBOTS.values()),
)
"""A body as long as the longest robot and as wide as the widest: every robot gets to where it
gets."""

PLACES_IN_CORRIDOR = 50
"""Random places in each corridor from which further parts of a plan are looked for."""

LEAST_PART = 2.0
"""Area for the centre of a body below which a part is a niche, square metres."""


@dataclass(frozen=True)
class Site:
    """A floor plan with what all its episodes share.

    Attributes:
        plan: the floor plan.
        name: name by which `load_floor_plan` finds it.
        whole: whether episodes take place in every part of the plan that has a corridor. If not,
            they do so in what is reached from the middle of the largest corridor.
    """

    plan: FloorPlan
    name: str
    whole: bool = False

    @cached_property
    def geodesic(self) -> Geodesic:
        """Shortest ways of a robot's centre."""
        return self.plan.derived(Geodesic)

    @cached_property
    def parts(self) -> tuple[Reach, ...]:
        """The parts that are not connected: the cells of each that every body reaches."""
        parts = [reach(self.plan, LARGEST_BODY.length, LARGEST_BODY.width)]
        for place in self._places_in_corridors() if self.whole else ():
            if any(part.near(shapely.Point(place)) for part in parts):
                continue
            part = reach(self.plan, LARGEST_BODY.length, LARGEST_BODY.width, start=place)
            if part.area >= LEAST_PART:
                parts.append(part)
        return tuple(parts)

    def part_at(self, place: Point) -> Reach | None:
        """The part in which a place lies; None if no body reaches it."""
        point = shapely.Point(place)
        return next((part for part in self.parts if part.near(point)), None)

    @cached_property
    def unreached(self) -> tuple[str, ...]:
        """Names of the corridors and rooms that no body gets into from any part."""
        regions = (*self.plan.corridors, *self.plan.rooms)
        return tuple(
            region.name
            for region in regions
            if not any(part.near(region.polygon) for part in self.parts)
        )

    @cached_property
    def plan_hash(self) -> str:
        """Its fingerprint."""
        return fingerprint(self.plan)

    def _places_in_corridors(self) -> Iterator[Point]:
        """Free places in all corridors, the same ones each time."""
        rng = np.random.default_rng(0)
        for corridor in self.plan.corridors:
            for _ in range(PLACES_IN_CORRIDOR):
                try:
                    x, y, _ = sample_pose(self.plan, LARGEST_BODY, rng, corridor)
                except ValueError:  # no body finds a place in this corridor
                    break
                yield x, y
