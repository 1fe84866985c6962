"""One thing that is wrong with a floor plan, and where."""

from __future__ import annotations

from dataclasses import dataclass

from shapely.geometry.base import BaseGeometry

from semnav_env.features.frames import Point


@dataclass(frozen=True)
class PlanFault:
    """Something that a maker of plans would want to mend.

    Attributes:
        part: the door, region or plan it is about.
        problem: what is wrong with it.
        where: a place to look at, (x, y) in metres, if there is one.
    """

    part: str
    problem: str
    where: Point | None = None

    def __str__(self) -> str:
        return f"{self.part}: {self.problem}"


def point_in(geometry: BaseGeometry) -> Point:
    """A place in a geometry, metres."""
    point = geometry.representative_point()
    return point.x, point.y


def written(point: Point) -> str:
    """As "(1.20, 3.40)"."""
    return f"({point[0]:.2f}, {point[1]:.2f})"
