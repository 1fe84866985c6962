"""Furniture for random offices: cabinets, screens, desks, chairs, bins and things of no shape.

Much of it stands in line with a wall or with another piece, a door's width away: such gaps are
what a detector takes for doors.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np
from numpy.random import Generator

from semnav_features.frames import Point

Span = tuple[float, float]
"""From and to along an axis, metres."""

CABINET_GAPS = (0.0, 0.05, 0.5, 0.8, 1.0)
"""Gaps between the cabinets of a row, metres; some are as wide as a door."""
DOORWAY_CLEARANCE = 0.9
"""Least distance of furniture from a door, metres."""


@dataclass
class TrainingFurniture:
    """Puts things into a random office.

    Attributes:
        rng: where all the chance comes from.
        segments: everything so far, x1, y1, x2, y2 in metres.
        passages: x of the walls between rooms that have a way through.
    """

    rng: Generator
    segments: list[tuple[float, float, float, float]] = field(default_factory=list)
    passages: list[float] = field(default_factory=list)

    def box(self, x1: float, y1: float, x2: float, y2: float) -> None:
        """A solid rectangle."""
        self.loop([(x1, y1), (x2, y1), (x2, y2), (x1, y2)])

    def loop(self, corners: Sequence[Point]) -> None:
        """A solid polygon."""
        self.line([*corners, corners[0]])

    def line(self, points: Sequence[Point]) -> None:
        """A polyline."""
        self.segments.extend((*a, *b) for a, b in pairwise(points))

    def chance(self, probability: float) -> bool:
        """Whether something happens."""
        return bool(self.rng.random() < probability)

    def pilasters(self, side: float, stretches: tuple[Span, ...], near: float) -> None:
        """Pilasters, radiators, bins and cabinets along the corridor's wall."""
        for low, high in stretches:
            if high - low > 0.6 and self.chance(0.4):
                width = self.rng.uniform(0.1, min(0.5, high - low))
                a = self.rng.uniform(low, high - width)
                self.box(a, side * near, a + width, side * (near - self.rng.uniform(0.04, 0.25)))

    def furnish(self, side: float, room: Span, deep: Span, way_in: Span) -> None:
        """Fill a room; the way in stays free.

        Args:
            side: 1 or -1, the sign of y in the room.
            room: its extent in x.
            deep: its extent in |y|, from its near wall to its far one.
            way_in: the extent of its door in x.
        """
        self.cabinets(side, room, deep, way_in)
        for x, sense in ((room[0], 1.0), (room[1], -1.0)):
            if x not in self.passages and self.chance(0.6):
                self.row(side, x, sense, deep)
        for _ in range(self.rng.integers(0, 3)):
            self.divider(side, room, deep, way_in)
        for _ in range(self.rng.integers(0, 7)):
            place = self.place(room, deep, way_in, 0.7)
            (self.table if self.chance(0.7) else self.chair)(place[0], side * place[1])
        for _ in range(self.rng.integers(0, 12)):
            x, y = self.place(room, deep, way_in)
            self.clutter(x, side * y)

    def place(self, room: Span, deep: Span, way_in: Span, margin: float = 0.1) -> Point:
        """Somewhere in a room but not right behind its door: x and |y|."""
        while True:
            x = self.rng.uniform(room[0] + margin, room[1] - margin)
            y = self.rng.uniform(deep[0] + margin, deep[1] - margin)
            if y > deep[0] + DOORWAY_CLEARANCE or abs(x - sum(way_in) / 2.0) > DOORWAY_CLEARANCE:
                return x, y

    def cabinets(self, side: float, room: Span, deep: Span, way_in: Span) -> None:
        """Along the wall of the corridor and the one across the room."""
        for y, sense in ((deep[0], 1.0), (deep[1], -1.0)):
            x = room[0] + 0.05
            while x < room[1] - 0.5:
                width = min(self.rng.uniform(0.4, 1.6), room[1] - 0.05 - x)
                near_door = y == deep[0] and x < way_in[1] + 0.1 and x + width > way_in[0] - 0.1
                if not near_door and self.chance(0.5):
                    edge = y + sense * self.rng.uniform(0.3, 0.6)
                    self.box(x, side * y, x + width, side * edge)
                x += width + self.rng.choice(CABINET_GAPS)

    def row(self, side: float, x: float, sense: float, deep: Span) -> None:
        """Cabinets along a wall between two rooms."""
        y = deep[0] + self.rng.uniform(DOORWAY_CLEARANCE, 1.6)
        while y < deep[1] - 0.9:
            width = self.rng.uniform(0.4, 1.2)
            if self.chance(0.6):
                edge = x + sense * self.rng.uniform(0.3, 0.6)
                self.box(x, side * y, edge, side * (y + width))
            y += width + self.rng.choice(CABINET_GAPS)

    def divider(self, side: float, room: Span, deep: Span, way_in: Span) -> None:
        """Screens or shelves in a line, square to the walls, with a gap or two in it."""
        thick = self.rng.choice((0.03, 0.06, 0.35, 0.8))
        x, y = self.place(room, deep, way_in, 0.1 + thick)
        along_x = self.chance(0.5)
        end = room[1] if along_x else deep[1]
        at = x if along_x else max(y, deep[0] + DOORWAY_CLEARANCE)
        for _ in range(self.rng.integers(1, 4)):
            stop = min(at + self.rng.uniform(0.4, 1.8), end)
            if stop - at > 0.1:
                corners = (at, y, stop, y + thick) if along_x else (x, at, x + thick, stop)
                self.box(corners[0], side * corners[1], corners[2], side * corners[3])
            at = stop + self.rng.uniform(0.6, 1.3)

    def clutter(self, x: float, y: float) -> None:
        """Something of no particular shape, 5 to 60 cm wide, or a round bin."""
        if self.chance(0.2):
            self.loop(_ring(x, y, self.rng.uniform(0.1, 0.3), 10, 0.0))
            return
        size, count = self.rng.uniform(0.03, 0.3), int(self.rng.integers(3, 7))
        turns = np.sort(self.rng.uniform(0.0, 2.0 * math.pi, count))
        radii = size * self.rng.uniform(0.5, 1.0, count)
        self.loop(
            [(x + r * math.cos(t), y + r * math.sin(t)) for r, t in zip(radii, turns, strict=True)]
        )

    def chair(self, x: float, y: float) -> None:
        """Five feet around a column."""
        size, leg = self.rng.uniform(0.2, 0.35), self.rng.uniform(0.015, 0.03)
        feet = _ring(x, y, size, 5, self.rng.uniform(0.0, math.pi))
        for a, b in [*feet, (x, y)]:
            self.box(a - leg, b - leg, a + leg, b + leg)

    def table(self, x: float, y: float) -> None:
        """Four legs, or a solid body; most stand square to the walls."""
        width, depth = self.rng.uniform(0.4, 1.6, 2)
        turn = self.rng.normal(0.0, 0.03) if self.chance(0.6) else self.rng.uniform(0.0, math.pi)
        c, s = math.cos(turn), math.sin(turn)
        corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
        placed = [
            (x + (c * width * a - s * depth * b) / 2, y + (s * width * a + c * depth * b) / 2)
            for a, b in corners
        ]
        if self.chance(0.4):
            self.loop(placed)
            return
        leg = self.rng.uniform(0.015, 0.04)
        for a, b in placed:
            self.box(a - leg, b - leg, a + leg, b + leg)


def _ring(x: float, y: float, radius: float, count: int, turn: float) -> list[Point]:
    """Corners of a regular polygon."""
    turns = [turn + 2.0 * math.pi * k / count for k in range(count)]
    return [(x + radius * math.cos(t), y + radius * math.sin(t)) for t in turns]
