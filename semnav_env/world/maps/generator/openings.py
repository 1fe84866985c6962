"""Doors of a generated office, their leaves, and the areas that stay clear before them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from numpy.random import Generator

from semnav_env.world.maps.generator.boxes import Box, Span
from semnav_env.world.maps.generator.chance import centimetres, chance
from semnav_env.world.maps.generator.lots import Lot, OfficeWall
from semnav_env.world.maps.generator.settings import OfficeSettings
from semnav_features.frames import Point

CORNER_DISTANCE = 15
"""Least distance from a door to the nearest corner, cm."""

HALF_OPEN_CLEARANCE = 0.87
"""Clear width that a half-open door leaves, metres: a wheelchair passes."""

MAX_HALF_OPEN_DEGREES = 72.0
"""Largest angle of a leaf that narrows its door, degrees."""

LEAF_CHANCE = 0.7
"""Probability that an open door has a leaf which the lidar sees; the others fold back to the
wall."""

LANDING_DEPTH = 170
"""Distance behind a door within which nothing stands, cm."""

LEAST_HALF_OPEN_WIDTH = 0.92
"""Width of the narrowest door that may be half open, metres."""

HALF_OPEN_SIDE_SPACE = 110
"""Extra space beside a half-open door, away from its hinge, cm: a robot comes in at an angle."""

INNER_DOOR_DISTANCE = 200
"""Least distance of a door between two rooms from the corridor, cm."""

TWO_DOOR_WIDTH = 750
"""Width above which a room may have two doors, cm."""


@dataclass(frozen=True)
class Doorway:
    """An opening in a wall.

    Attributes:
        wall: the stretch of wall it is in; its room lies inward of it.
        span: the opening from jamb to jamb, cm.
        open: whether one may pass.
        leaf: hinge and tip, metres; None if no leaf is drawn.
        way: span along the wall that a robot needs to get in past the leaf, cm.
        lots: indices of the rooms it leads to.
    """

    wall: OfficeWall
    span: Span
    open: bool
    leaf: tuple[Point, Point] | None
    way: Span
    lots: tuple[int, ...]

    @property
    def jambs(self) -> tuple[Point, Point]:
        """Start and end, metres; the room lies to the right of the line from start to end."""
        low, high = (_point(self.wall, along, 0.0) for along in self.span)
        return (high, low) if self.wall.along_x == (self.wall.inward > 0) else (low, high)

    @property
    def landings(self) -> tuple[Box, Box]:
        """Boxes that stay free behind the door and before it."""
        span, way = (
            (low - CORNER_DISTANCE, high + CORNER_DISTANCE) for low, high in (self.span, self.way)
        )
        return self.wall.box(way, LANDING_DEPTH), self.wall.box(span, -LANDING_DEPTH)


def hang_doors(
    rng: Generator, settings: OfficeSettings, lots: Sequence[Lot]
) -> tuple[Doorway, ...]:
    """One or two doors from each room to its corridor, and some between rooms."""
    doors = []
    for index, lot in enumerate(lots):
        if not lot.open:
            room = lot.box.span(lot.front.along_x)
            doors += [_door(rng, settings, wall, room, (index,)) for wall in _fronts(rng, lot)]
    entered = {index for door in doors if door.open for index in door.lots}
    return (*doors, *_inner_doors(rng, settings, lots, entered))


def lanes(door: Doorway, lots: Sequence[Lot]) -> Iterator[Box]:
    """Boxes that stay free so that a door between two rooms can be reached from the corridor."""
    for index in door.lots if len(door.lots) == 2 else ():
        lot = lots[index]
        low, high = lot.box.span(lot.front.along_x)
        beside = (low, low + 150) if low == door.wall.at else (high - 150, high)
        deepest = max(abs(end - lot.front.at) for end in door.span)
        yield lot.front.box(beside, deepest + CORNER_DISTANCE)
        yield lot.front.box((low, high), LANDING_DEPTH)


def _fronts(rng: Generator, lot: Lot) -> list[OfficeWall]:
    """Stretches of the front of a room; each gets a door."""
    wall, (low, high) = lot.front, lot.front.span
    if high - low < TWO_DOOR_WIDTH or chance(rng, 0.4):
        return [wall]
    middle = (low + high) // 2
    halves = (low, middle - CORNER_DISTANCE), (middle + CORNER_DISTANCE, high)
    return [OfficeWall(wall.along_x, wall.at, half, wall.inward) for half in halves]


def _door(
    rng: Generator, settings: OfficeSettings, wall: OfficeWall, room: Span, lots: tuple[int, ...]
) -> Doorway:
    """Draw a door in a wall; its leaf hangs on the jamb nearer to a corner of the room."""
    span = _place(rng, settings, wall)
    draw = float(rng.random())
    if draw < settings.closed:
        return Doorway(wall, span, False, _leaf(wall, span, True, 0.0), span, lots)
    at_low = span[0] - wall.span[0] < wall.span[1] - span[1]
    beside = (
        (span[0], span[1] + HALF_OPEN_SIDE_SPACE)
        if at_low
        else (span[0] - HALF_OPEN_SIDE_SPACE, span[1])
    )
    fits = (
        room[0] <= beside[0]
        and beside[1] <= room[1]
        and span[1] - span[0] >= 100 * LEAST_HALF_OPEN_WIDTH
    )
    if fits and draw < settings.closed + settings.half_open:
        leaf = _leaf(wall, span, at_low, _half_open(rng, span[1] - span[0]))
        return Doorway(wall, span, True, leaf, beside, lots)
    seen = chance(rng, LEAF_CHANCE)
    leaf = _leaf(wall, span, at_low, float(rng.uniform(80.0, 96.0)))
    return Doorway(wall, span, True, leaf if seen else None, span, lots)


def _place(rng: Generator, settings: OfficeSettings, wall: OfficeWall) -> Span:
    """A span for a door in a wall, near one of its ends or anywhere."""
    low, high = wall.span[0] + CORNER_DISTANCE, wall.span[1] - CORNER_DISTANCE
    width = min(centimetres(rng, settings.door_width), high - low)
    spare = high - low - width
    near = min(centimetres(rng, (0.0, 0.3)), spare)
    anywhere = 5 * int(rng.integers(0, spare // 5 + 1))
    start = low + (near, near, spare - near, spare - near, anywhere)[int(rng.integers(5))]
    return start, start + width


def _half_open(rng: Generator, width: int) -> float:
    """An angle in degrees at which a leaf leaves `HALF_OPEN_CLEARANCE`."""
    least = math.degrees(math.asin(HALF_OPEN_CLEARANCE * 100 / width))
    return float(rng.uniform(max(least, 45.0), MAX_HALF_OPEN_DEGREES))


def _leaf(wall: OfficeWall, span: Span, at_low: bool, degrees: float) -> tuple[Point, Point]:
    """A leaf from hinge to tip, at an angle to its closed position."""
    hinge, sense = (span[0], 1.0) if at_low else (span[1], -1.0)
    width, angle = span[1] - span[0], math.radians(degrees)
    along, inward = sense * math.cos(angle) * width, math.sin(angle) * width
    return _point(wall, hinge, 0.0), _point(wall, hinge + along, inward)


def _point(wall: OfficeWall, along: float, inward: float) -> Point:
    """A point in metres, rounded to millimetres."""
    a, b = round(along / 100, 3), round((wall.at + wall.inward * inward) / 100, 3)
    return (a, b) if wall.along_x else (b, a)


def _inner_doors(
    rng: Generator, settings: OfficeSettings, lots: Sequence[Lot], entered: set[int]
) -> Iterator[Doorway]:
    """Doors in walls that two neighbours on one side of a corridor share; one for each room.

    At least one of the two is `entered` from the corridor.
    """
    used: set[int] = set()
    for index in range(len(lots) - 1):
        first, second = lots[index : index + 2]
        wall = _shared(first, second)
        pair = {index, index + 1}
        if wall is None or used & pair or not entered & pair or first.open or second.open:
            continue
        if chance(rng, settings.inner_doors):
            used |= pair
            room = second.box.span(wall.along_x)
            yield _door(rng, settings, wall, room, (index, index + 1))


def _shared(first: Lot, second: Lot) -> OfficeWall | None:
    """The part of the wall between two rooms that may hold a door."""
    front = first.front
    along = front.along_x
    if (front.at, front.inward, along) != (
        second.front.at,
        second.front.inward,
        second.front.along_x,
    ) or first.box.span(along)[1] != second.box.span(along)[0]:
        return None
    depth = min(lot.box.size[along] for lot in (first, second))
    ends = (
        front.at + front.inward * INNER_DOOR_DISTANCE,
        front.at + front.inward * (depth - CORNER_DISTANCE),
    )
    low, high = min(ends), max(ends)
    if depth - CORNER_DISTANCE - INNER_DOOR_DISTANCE < 130 or min(first.width, second.width) < 240:
        return None
    return OfficeWall(not along, first.box.span(along)[1], (low, high), 1)
