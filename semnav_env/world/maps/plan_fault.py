"""A fault of a floor plan, with its position."""

from __future__ import annotations

from dataclasses import dataclass

from shapely.geometry.base import BaseGeometry

from semnav_features.frames import Point


@dataclass(frozen=True)
class PlanFault:
    """A fault in a plan that its author should correct.

    Attributes:
        part: name of the door or region that has the fault, or of the plan.
        problem: what is wrong with it.
        where: place of the fault, (x, y) in metres; None if it has none.
    """

    part: str
    problem: str
    where: Point | None = None

    def __str__(self) -> str:
        return f"{self.part}: {self.problem}"


def point_in(geometry: BaseGeometry) -> Point:
    """A point that lies in a geometry, (x, y) in metres."""
    point = geometry.representative_point()
    return point.x, point.y


def written(point: Point) -> str:
    """The text of a point, as "(1.20, 3.40)"."""
    return f"({point[0]:.2f}, {point[1]:.2f})"
