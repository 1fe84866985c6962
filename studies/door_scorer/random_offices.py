"""Random furnished offices along a corridor, with the things that make real doors hard to see.

Walls are thick or thin; doors have frames, stand open at any angle or are closed in their recess;
there are pilasters, niches, mouths of side corridors, and furniture (`random_furniture`).

Only the training of the scorer of doors uses these offices: the weights that come with the package
were learned in them, and in offices of `semnav_env.world.maps.generator` they would be others.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
import shapely
from numpy.random import Generator

from semnav_env.world.maps.floor_plan import FloorPlan, Surface
from semnav_features.frames import FloatArray, Pose, to_local
from semnav_features.scene import Door
from studies.door_scorer.random_furniture import TrainingFurniture

SCANNER_CLEARANCE = 0.3
"""Least distance from the scanner to anything, metres."""


@dataclass(frozen=True)
class TrainingOffice:
    """A random office floor, world frame.

    Attributes:
        segments: everything that stops a beam, shape (n, 4), metres.
        doors: the openings one may pass, in the middle of the wall's thickness.
        corridor: half its length and half its width, metres; it lies about the origin along x.
        depth: of the rooms to both sides, metres.
    """

    segments: FloatArray
    doors: tuple[Door, ...]
    corridor: tuple[float, float]
    depth: float

    @property
    def floor_plan(self) -> FloorPlan:
        """Its walls and furniture as a floor plan, without names."""
        surfaces = tuple([Surface(((a, b), (c, d))) for a, b, c, d in self.segments.tolist()])
        return FloorPlan("random_office", surfaces, (), (), (), (), shapely.box(*self._bounds))

    @property
    def _bounds(self) -> tuple[float, float, float, float]:
        points = self.segments.reshape(-1, 2)
        return (*points.min(axis=0).tolist(), *points.max(axis=0).tolist())

    def doors_from(self, pose: Pose) -> tuple[Door, ...]:
        """The doors in the frame of `pose`."""
        return tuple(
            [Door(to_local(pose, door.start), to_local(pose, door.end)) for door in self.doors]
        )

    def corridor_pose(self, rng: Generator) -> Pose:
        """A free pose in the corridor."""
        return self._free_pose(rng, self.corridor[0], self.corridor[1])

    def any_pose(self, rng: Generator) -> Pose:
        """A free pose in the corridor or in a room."""
        return self._free_pose(rng, self.corridor[0], self.corridor[1] + self.depth)

    def _free_pose(self, rng: Generator, half_x: float, half_y: float) -> Pose:
        while True:
            x, y = rng.uniform(-half_x, half_x), rng.uniform(-half_y, half_y)
            if _distance(self.segments, x, y) >= SCANNER_CLEARANCE:
                return x, y, rng.uniform(-math.pi, math.pi)


def _distance(segments: FloatArray, x: float, y: float) -> float:
    start, along = segments[:, :2], segments[:, 2:] - segments[:, :2]
    square = np.maximum((along**2).sum(axis=1), 1e-12)
    share = ((np.array((x, y)) - start) * along).sum(axis=1) / square
    nearest = start + np.clip(share, 0.0, 1.0)[:, None] * along
    return float(np.hypot(*(nearest - (x, y)).T).min())


def random_office(rng: Generator, furnished: bool = True) -> TrainingOffice:
    """A corridor with rooms on both sides.

    Args:
        rng: where all the chance comes from.
        furnished: with furniture and pilasters.
    """
    builder = _Builder(rng, furnished=furnished)
    half_length, half_width = rng.uniform(5.0, 9.0), rng.uniform(0.75, 1.3)
    depth, thickness = rng.uniform(3.0, 5.5), rng.choice((0.02, 0.1, 0.15, 0.3))
    for side in (-1.0, 1.0):
        builder.side(side, half_length, half_width, depth, thickness)
    for end in (-1.0, 1.0):
        builder.end(end * half_length, half_width)
    segments = np.array(builder.segments)
    return TrainingOffice(segments, tuple(builder.doors), (half_length, half_width), depth)


@dataclass
class _Builder(TrainingFurniture):
    furnished: bool = True
    doors: list[Door] = field(default_factory=list)

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
        width = (
            self.rng.triangular(0.72, 0.85, 1.22)
            if self.chance(0.7)
            else self.rng.uniform(0.72, 1.22)
        )
        edge = self.rng.choice((0.06, 0.12, 0.25, 0.4))
        low = self.rng.uniform(x1 + edge, max(x2 - edge - width, x1 + edge + 0.01))
        wall = self.rng.uniform(-0.02, 0.02)
        inset = self.rng.uniform(0.1, 0.4) if self.chance(0.12) else 0.0
        near, back = y0 + wall, y0 + wall + thick
        margin = self.rng.uniform(0.05, 0.3) if inset else 0.0
        for a, b in ((x1, low - margin), (low + width + margin, x2)):
            if b - a > 0.01:
                self.wall(side, a, b, near, back + inset)
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
            self.furnish(side, (x1, x2), (back + inset, far), (low, low + width))

    def wall(self, side: float, x1: float, x2: float, near: float, back: float) -> None:
        """A stretch of the corridor's wall, some with a niche as wide as a door."""
        width, depth = self.rng.uniform(0.6, 1.2), self.rng.uniform(0.2, 0.8)
        if not self.chance(0.2) or x2 - x1 < width + 0.3:
            self.box(x1, side * near, x2, side * back)
            return
        low = self.rng.uniform(x1 + 0.1, x2 - width - 0.1)
        high, deep = low + width, side * (near + depth)
        self.box(x1, side * near, low, side * back)
        self.box(high, side * near, x2, side * back)
        self.line([(low, side * near), (low, deep), (high, deep), (high, side * near)])

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
        self.passages.append(x)

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
        self.line([(x, -y), (beyond, -y), (beyond, y), (x, y)])
        if self.chance(0.6):
            self.corridor_leaf(x, low, low + width, math.copysign(1.0, beyond - x))

    def corridor_leaf(self, x: float, y1: float, y2: float, away: float) -> None:
        angle = math.radians(self.rng.uniform(60.0, 120.0))
        hinge, sense = (y1, 1.0) if self.chance(0.5) else (y2, -1.0)
        along, out = sense * math.cos(angle) * (y2 - y1), away * math.sin(angle) * (y2 - y1)
        start = x + 0.05 * away
        self.segments.append((start, hinge, start + out, hinge + along))
