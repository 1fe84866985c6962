"""Rectangles on a grid of centimetres: whole numbers, so that walls meet exactly."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple, TypeAlias

import shapely

Span: TypeAlias = tuple[int, int]
"""From and to along an axis, centimetres."""


class Box(NamedTuple):
    """A rectangle, centimetres."""

    west: int
    south: int
    east: int
    north: int

    @property
    def size(self) -> tuple[int, int]:
        """Its extent along x and y."""
        return self.east - self.west, self.north - self.south

    def span(self, along_x: bool) -> Span:
        """Its extent along x, or along y."""
        return (self.west, self.east) if along_x else (self.south, self.north)

    def overlaps(self, other: Box) -> bool:
        """Whether they share an area."""
        return (
            self.west < other.east
            and other.west < self.east
            and self.south < other.north
            and other.south < self.north
        )

    def grown(self, margin: int) -> Box:
        """The box with a margin added on all sides."""
        west, south, east, north = self
        return Box(west - margin, south - margin, east + margin, north + margin)

    def polygon(self) -> shapely.Polygon:
        """The same rectangle in metres."""
        west, south, east, north = (value / 100 for value in self)
        return shapely.box(west, south, east, north)

    def transposed(self) -> Box:
        """The box with x and y exchanged."""
        return Box(self.south, self.west, self.north, self.east)


def box_of(along_x: bool, along: Span, across: Span) -> Box:
    """The box that spans `along` in the direction of its line and `across` beside it."""
    (a, b), (c, d) = along, sorted(across)
    return Box(a, c, b, d) if along_x else Box(c, a, d, b)


def is_free(box: Box, taken: Iterable[Box]) -> bool:
    """Whether a box overlaps none of the others."""
    west, south, east, north = box
    return not any(west < e and w < east and south < n and s < north for w, s, e, n in taken)


def without(spans: Iterable[Span], holes: Iterable[Span]) -> list[Span]:
    """The parts of spans outside some holes, in order and merged."""
    left = merged(spans)
    for low, high in holes:
        left = [
            piece
            for a, b in left
            for piece in ((a, min(b, low)), (max(a, high), b))
            if piece[0] < piece[1]
        ]
    return left


def merged(spans: Iterable[Span]) -> list[Span]:
    """The union of some spans, in order."""
    union: list[Span] = []
    for low, high in sorted(spans):
        if union and low <= union[-1][1]:
            union[-1] = union[-1][0], max(union[-1][1], high)
        else:
            union.append((low, high))
    return union
