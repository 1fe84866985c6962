"""Random furnished offices along a corridor, with the things that make real doors hard to see.

Walls are thick; doors have frames, stand open at any angle or are closed in their recess; there
are pilasters, niches, mouths of side corridors, cabinets with gaps of door width, tables and
chairs of which a lidar sees the legs.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.random import Generator

from semnav_env.features.frames import FloatArray, Pose
from semnav_env.features.scene import Door

CLEARANCE = 0.3
"""A scanner stands at least this far from everything, metres."""


@dataclass(frozen=True)
class Office:
    """A random office floor, world frame.

    Attributes:
        segments: everything that stops a beam, shape (n, 4), metres.
        doors: the openings one may pass.
        corridor: half its length and half its width, metres; it lies about the origin along x.
        depth: of the rooms to both sides, metres.
    """

    segments: FloatArray
    doors: tuple[Door, ...]
    corridor: tuple[float, float]
    depth: float

    def corridor_pose(self, rng: Generator) -> Pose:
        """A free pose in the corridor."""
        return self._free_pose(rng, self.corridor[0], self.corridor[1])

    def any_pose(self, rng: Generator) -> Pose:
        """A free pose in the corridor or in a room."""
        return self._free_pose(rng, self.corridor[0], self.corridor[1] + self.depth)

    def _free_pose(self, rng: Generator, half_x: float, half_y: float) -> Pose:
        while True:
            x, y = rng.uniform(-half_x, half_x), rng.uniform(-half_y, half_y)
            if _distance(self.segments, x, y) >= CLEARANCE:
                return x, y, rng.uniform(-math.pi, math.pi)


def _distance(segments: FloatArray, x: float, y: float) -> float:
    start, along = segments[:, :2], segments[:, 2:] - segments[:, :2]
    square = np.maximum((along**2).sum(axis=1), 1e-12)
    share = ((np.array((x, y)) - start) * along).sum(axis=1) / square
    nearest = start + np.clip(share, 0.0, 1.0)[:, None] * along
    return float(np.hypot(*(nearest - (x, y)).T).min())


def random_office(rng: Generator, furnished: bool = True) -> Office:
    """A corridor with rooms on both sides.

    Args:
        rng: where all the chance comes from.
        furnished: with furniture and pilasters.
    """
    builder = _Builder(rng, furnished)
    half_length, half_width = rng.uniform(5.0, 9.0), rng.uniform(0.75, 1.3)
    depth, thickness = rng.uniform(3.0, 5.5), rng.uniform(0.06, 0.2)
    for side in (-1.0, 1.0):
        builder.side(side, half_length, half_width, depth, thickness)
    for end in (-1.0, 1.0):
        builder.end(end * half_length, half_width)
    segments = np.array(builder.segments)
    return Office(segments, tuple(builder.doors), (half_length, half_width), depth)


@dataclass
class _Builder:
    rng: Generator
    furnished: bool
    segments: list[tuple[float, float, float, float]] = field(default_factory=list)
    doors: list[Door] = field(default_factory=list)

    def box(self, x1: float, y1: float, x2: float, y2: float) -> None:
        corners = [(x1, y1), (x2, y1), (x2, y2), (x1, y2)]
        self.loop(corners)

    def loop(self, corners: list[tuple[float, float]]) -> None:
        pairs = zip(corners, corners[1:] + corners[:1], strict=True)
        self.segments.extend((*a, *b) for a, b in pairs)

    def chance(self, probability: float) -> bool:
        return bool(self.rng.random() < probability)

    def side(self, side: float, half_length: float, y0: float, depth: float, thick: float) -> None:
        """One side of the corridor: rooms from left to right, each with a way in."""
        x = -half_length
        far = y0 + thick + depth
        self.segments.append((x, side * y0, x, side * far))
        while x < half_length:
            stop = min(x + self.rng.uniform(2.6, 5.5), half_length)
            if half_length - stop < 2.0:
                stop = half_length
            if self.chance(0.1) and stop - x < 4.0:
                self.mouth(side, x, stop, y0, far)
            else:
                self.room(side, x, stop, y0, thick, far, half_length)
            x = stop

    def mouth(self, side: float, x1: float, x2: float, y0: float, far: float) -> None:
        """A side corridor instead of a room."""
        width = self.rng.uniform(1.5, 2.2)
        low = x1 + self.rng.uniform(0.1, max(x2 - x1 - width - 0.1, 0.11))
        self.box(x1, side * y0, low, side * far)
        self.box(min(low + width, x2), side * y0, x2, side * far)
        self.segments.append((x1, side * far, x2, side * far))

    def room(
        self,
        side: float,
        x1: float,
        x2: float,
        y0: float,
        thick: float,
        far: float,
        half_length: float,
    ) -> None:
        width = self.rng.triangular(0.72, 0.85, 1.22)
        edge = self.rng.choice((0.06, 0.12, 0.25, 0.4))
        low = self.rng.uniform(x1 + edge, max(x2 - edge - width, x1 + edge + 0.01))
        wall = self.rng.uniform(-0.02, 0.02)
        inset = self.rng.uniform(0.1, 0.4) if self.chance(0.12) else 0.0
        near, back = y0 + wall, y0 + wall + thick
        margin = self.rng.uniform(0.05, 0.3) if inset else 0.0
        for a, b in ((x1, low - margin), (low + width + margin, x2)):
            if b - a > 0.01:
                self.box(a, side * near, b, side * (back + inset))
        if inset:
            for a, b in ((low - margin, low), (low + width, low + width + margin)):
                self.box(a, side * (near + inset), b, side * (back + inset))
        self.door(side, low, low + width, near + inset, back + inset)
        self.partition(side, x2, back, far, self.chance(0.2) and x2 < half_length)
        for jamb in (low - 0.05, low + width):
            if self.chance(0.1):
                self.box(jamb, side * (back + inset), jamb + 0.05, side * far)
        self.segments.append((x1, side * far, x2, side * far))
        if self.furnished:
            self.pilasters(side, ((x1, low - 0.1), (low + width + 0.1, x2)), near)
            self.furniture(side, x1, x2, back + inset, far, (low, low + width))

    def door(self, side: float, x1: float, x2: float, near: float, back: float) -> None:
        """Frame and leaf; open, half-open or closed."""
        if self.chance(0.6):
            post, out = self.rng.uniform(0.02, 0.08), self.rng.uniform(0.0, 0.04)
            for a, b in ((x1 - post, x1), (x2, x2 + post)):
                self.box(a, side * (near - out), b, side * (back + out))
        middle = side * (near + back) / 2
        if self.chance(0.35):
            leaf = side * self.rng.uniform(near, back)
            self.segments.append((x1, leaf, x2, leaf))
            return
        self.doors.append(Door((x1, middle), (x2, middle)))
        if self.chance(0.2):
            return
        inward = 1.0 if self.chance(0.85) else -1.0
        self.leaf(side * inward, x1, x2, side * (back if inward > 0 else near))

    def leaf(self, away: float, x1: float, x2: float, y: float) -> None:
        """A leaf 4 cm thick at 35 to 175 degrees to its closed place."""
        square = self.rng.uniform(75.0, 110.0)
        angle = math.radians(square if self.chance(0.6) else self.rng.uniform(35.0, 175.0))
        hinge, sense = (x1, 1.0) if self.chance(0.5) else (x2, -1.0)
        length, thick = x2 - x1, 0.04
        dx, dy = sense * math.cos(angle), away * math.sin(angle)
        nx, ny = -sense * math.sin(angle) * thick, away * math.cos(angle) * thick
        tip = (hinge + length * dx, y + length * dy)
        self.loop([(hinge, y), tip, (tip[0] + nx, tip[1] + ny), (hinge + nx, y + ny)])

    def partition(self, side: float, x: float, back: float, far: float, opens: bool) -> None:
        """The wall to the next room, some with a door or a wider opening."""
        low, high = sorted((side * back, side * far))
        if not opens:
            self.box(x - 0.05, low, x + 0.05, high)
            return
        width = self.rng.uniform(0.75, 1.22)
        start = self.rng.uniform(low + 0.3, high - 0.3 - width)
        self.box(x - 0.05, low, x + 0.05, start)
        self.box(x - 0.05, start + width, x + 0.05, high)
        self.doors.append(Door((x, start), (x, start + width)))

    def end(self, x: float, half_width: float) -> None:
        """An end of the corridor: a wall, or a door across it and more corridor behind."""
        y, width = half_width + 0.2, self.rng.uniform(0.8, 1.2)
        beyond = x + math.copysign(self.rng.uniform(2.0, 4.0), x)
        if self.chance(0.5):
            self.segments.append((x, -y, x, y))
            return
        low = self.rng.uniform(-half_width + 0.05, half_width - width - 0.05)
        for a, b in ((-y, low), (low + width, y)):
            self.box(x - 0.05, a, x + 0.05, b)
        self.doors.append(Door((x, low), (x, low + width)))
        self.loop([(x, -y), (beyond, -y), (beyond, y), (x, y)][:4])
        self.segments.pop()
        if self.chance(0.6):
            self.corridor_leaf(x, low, low + width, math.copysign(1.0, beyond - x))

    def corridor_leaf(self, x: float, y1: float, y2: float, away: float) -> None:
        angle = math.radians(self.rng.uniform(60.0, 120.0))
        hinge, sense = (y1, 1.0) if self.chance(0.5) else (y2, -1.0)
        along, out = sense * math.cos(angle) * (y2 - y1), away * math.sin(angle) * (y2 - y1)
        start = x + 0.05 * away
        self.segments.append((start, hinge, start + out, hinge + along))

    def pilasters(
        self, side: float, stretches: tuple[tuple[float, float], ...], near: float
    ) -> None:
        """Pilasters, radiators, bins and cabinets along the corridor's wall."""
        for low, high in stretches:
            if high - low > 0.6 and self.chance(0.4):
                width = self.rng.uniform(0.1, min(0.5, high - low))
                a = self.rng.uniform(low, high - width)
                self.box(a, side * near, a + width, side * (near - self.rng.uniform(0.04, 0.25)))

    def furniture(
        self,
        side: float,
        x1: float,
        x2: float,
        back: float,
        far: float,
        way_in: tuple[float, float],
    ) -> None:
        """Cabinets along the walls, tables and chairs; the way in stays free."""
        for y, sense in ((back, 1.0), (far, -1.0)):
            x = x1 + 0.05
            while x < x2 - 0.5:
                width = min(self.rng.uniform(0.4, 1.6), x2 - 0.05 - x)
                near_door = y == back and x < way_in[1] + 0.1 and x + width > way_in[0] - 0.1
                if not near_door and self.chance(0.5):
                    edge = y + sense * self.rng.uniform(0.3, 0.6)
                    self.box(x, side * y, x + width, side * edge)
                x += width + self.rng.choice((0.0, 0.05, 0.5, 0.8, 1.0))
        for _ in range(self.rng.integers(0, 7)):
            x = self.rng.uniform(x1 + 0.5, x2 - 0.5)
            self.table(x, side * self.rng.uniform(back + 1.2, max(far - 0.6, back + 1.3)))
        for _ in range(self.rng.integers(0, 12)):
            x, y = self.rng.uniform(x1 + 0.1, x2 - 0.1), self.rng.uniform(back + 0.3, far - 0.1)
            if abs(x - sum(way_in) / 2) > 0.9 or y > back + 1.0:
                self.clutter(x, side * y)

    def clutter(self, x: float, y: float) -> None:
        """Something of no particular shape, 5 to 60 cm wide."""
        size, count = self.rng.uniform(0.03, 0.3), int(self.rng.integers(3, 7))
        turns = np.sort(self.rng.uniform(0.0, 2.0 * math.pi, count))
        radii = size * self.rng.uniform(0.5, 1.0, count)
        self.loop(
            [(x + r * math.cos(t), y + r * math.sin(t)) for r, t in zip(radii, turns, strict=True)]
        )

    def table(self, x: float, y: float) -> None:
        """Four legs, or a solid body."""
        width, depth, turn = *self.rng.uniform(0.4, 1.6, 2), self.rng.uniform(0.0, math.pi)
        c, s = math.cos(turn), math.sin(turn)
        corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
        placed = [
            (x + (c * width * a - s * depth * b) / 2, y + (s * width * a + c * depth * b) / 2)
            for a, b in corners
        ]
        if self.chance(0.3):
            self.loop(placed)
            return
        leg = self.rng.uniform(0.015, 0.04)
        for a, b in placed:
            self.box(a - leg, b - leg, a + leg, b + leg)
