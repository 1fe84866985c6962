"""The walls of a generated office around its rooms and corridors, without the openings."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple, TypeAlias, cast

import shapely
from numpy.random import Generator
from shapely import Polygon

from semnav_env.world.maps.floor_plan import Material, Surface
from semnav_env.world.maps.generator.boxes import Box, Span, without
from semnav_env.world.maps.generator.chance import chance
from semnav_env.world.maps.generator.corridors import OfficeCorridor
from semnav_env.world.maps.generator.lots import Lot, OfficeWall
from semnav_env.world.maps.generator.openings import Doorway
from semnav_env.world.maps.generator.settings import OfficeSettings
from semnav_features.frames import Point

Line: TypeAlias = tuple[bool, int]
"""Whether a line runs along x, and its coordinate across that direction, cm."""

FRONT_WALL_LENGTH = 30
"""Length of wall beside the open front of an area, and between glass and the next wall or door,
cm."""

LEAST_PANE_WIDTH = 60
"""Width of the narrowest frameless pane, cm."""

WINDOW_WIDTH = 45
"""Width of a window in a framed glass front, cm: too narrow for a robot to take it for a
passage."""

PIER_WIDTH = 30
"""Least width of the wall between two windows, cm."""


def build_walls(
    rng: Generator,
    settings: OfficeSettings,
    corridors: Sequence[OfficeCorridor],
    lots: Sequence[Lot],
    doors: Sequence[Doorway],
) -> Iterator[Surface]:
    """Walls and panes, each a straight line."""
    solid: dict[Line, list[Span]] = defaultdict(list)
    for box in (lot.box for lot in lots):
        for along_x, at, span in _sides(box):
            solid[along_x, at].append(span)
    for along_x, at, span in _outline(corridor.box for corridor in corridors):
        solid[along_x, at].append(span)
    gaps: dict[Line, list[Span]] = defaultdict(list)
    for door in doors:
        gaps[door.wall.along_x, door.wall.at].append(door.span)
    for wall in (lot.front for lot in lots if lot.open):
        gaps[wall.along_x, wall.at].append(
            (wall.span[0] + FRONT_WALL_LENGTH, wall.span[1] - FRONT_WALL_LENGTH)
        )
    panes = _panes(rng, settings, corridors, lots)
    for line in sorted(solid):
        stretches = without(solid[line], gaps[line])
        glazed = [p for pane in panes[line] for s in stretches for p in _glazed(s, pane)]
        yield from (_surface(line, span, Material.GLASS) for span in glazed)
        yield from (_surface(line, s, Material.WALL) for s in without(stretches, glazed))


def outline(boxes: Iterable[Box]) -> Polygon:
    """The union of some boxes, metres."""
    union = shapely.union_all([shapely.box(*box) for box in boxes]).simplify(0.0).normalize()
    return cast(Polygon, shapely.transform(union, lambda centimetres: centimetres / 100.0))


def _outline(boxes: Iterable[Box]) -> Iterator[tuple[bool, int, Span]]:
    union = cast(Polygon, shapely.union_all([shapely.box(*box) for box in boxes]))
    for ring in (union.exterior, *union.interiors):
        for (x1, y1), (x2, y2) in pairwise(ring.coords):
            ends = sorted((int(x1), int(x2))) if y1 == y2 else sorted((int(y1), int(y2)))
            yield y1 == y2, int(y1 if y1 == y2 else x1), (ends[0], ends[1])


def _sides(box: Box) -> Iterator[tuple[bool, int, Span]]:
    yield from ((True, y, (box.west, box.east)) for y in (box.south, box.north))
    yield from ((False, x, (box.south, box.north)) for x in (box.west, box.east))


class Pane(NamedTuple):
    """A pane of glass that replaces a stretch of wall: its ends, and whether it is framed."""

    low: int
    high: int
    framed: bool


def _panes(
    rng: Generator,
    settings: OfficeSettings,
    corridors: Sequence[OfficeCorridor],
    lots: Sequence[Lot],
) -> dict[Line, list[Pane]]:
    """Fronts of rooms, and windows at the ends of corridors."""
    panes: dict[Line, list[Pane]] = defaultdict(list)

    def add(wall: OfficeWall) -> None:
        framed = not chance(rng, settings.frameless)
        panes[wall.along_x, wall.at].append(
            Pane(wall.span[0] + FRONT_WALL_LENGTH, wall.span[1] - FRONT_WALL_LENGTH, framed)
        )

    for lot in lots:
        if not lot.open and chance(rng, settings.glass):
            add(lot.front)
    for corridor in corridors:
        low, high = corridor.box.span(corridor.along_x)
        across = corridor.box.span(not corridor.along_x)
        for at, blind in zip((low, high), corridor.blind, strict=True):
            if blind and chance(rng, settings.glass):
                add(OfficeWall(not corridor.along_x, at, across, 1))
    return panes


def _glazed(stretch: Span, pane: Pane) -> Iterator[Span]:
    """The parts of a stretch of wall that a pane replaces."""
    nib = FRONT_WALL_LENGTH if pane.framed else 0
    low, high = max(stretch[0] + nib, pane.low), min(stretch[1] - nib, pane.high)
    if not pane.framed:
        yield from [(low, high)] if high - low >= LEAST_PANE_WIDTH else []
        return
    count = max(0, high - low) // (WINDOW_WIDTH + PIER_WIDTH)
    for k in range(count):
        middle = low + (2 * k + 1) * (high - low) // (2 * count)
        yield middle - WINDOW_WIDTH // 2, middle - WINDOW_WIDTH // 2 + WINDOW_WIDTH


def _surface(line: Line, span: Span, material: Material) -> Surface:
    along_x, at = line
    ends = (_point(along_x, at, span[0]), _point(along_x, at, span[1]))
    return Surface(ends, material)


def _point(along_x: bool, at: int, along: int) -> Point:
    return (along / 100, at / 100) if along_x else (at / 100, along / 100)
