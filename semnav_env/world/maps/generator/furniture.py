"""Desks, cabinets, tables and columns of a generated office, outside the areas that stay clear."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from numpy.random import Generator

from semnav_env.world.maps.floor_plan import Material, Surface
from semnav_env.world.maps.generator.boxes import Box, Span, box_of, is_free
from semnav_env.world.maps.generator.chance import centimetres, chance
from semnav_env.world.maps.generator.corridors import OfficeCorridor, OfficeJunction
from semnav_env.world.maps.generator.lots import Lot, OfficeWall
from semnav_env.world.maps.generator.openings import CORNER_DISTANCE, Doorway, lanes
from semnav_env.world.maps.generator.settings import OfficeSettings

WALL_GAP = 3
"""Gap between a wall and furniture along it, cm."""

AISLE_WIDTH = 90
"""Gap between a table in the middle of a room and everything else, cm: a wheelchair passes."""

FREE_CORRIDOR_WIDTH = 130
"""Free width of a corridor beside furniture in it, cm."""

DOOR_DISTANCE = 110
"""Least distance from a door to furniture in a corridor, cm."""

JUNCTION_DISTANCE = 130
"""Least distance from a junction to furniture in a corridor, cm."""

CABINET_SIZES = ((80, 180), (40, 50))
"""Least and largest side of a cabinet along the wall, and the same out from it, cm."""

DESK_SIZES = ((140, 180), (70, 80))
"""Least and largest side of a desk along the wall, and the same out from it, cm."""

TABLE_SIZES = ((160, 320), (90, 120))
"""Least and largest length and width of a table, cm."""

LEAST_TABLE_ROOM = 18.0
"""Area of the smallest room with a table in its middle, square metres."""

COLUMN_SIDES = (30, 45)
"""Least and largest side of a column, cm."""

COLUMN_SPACING = 540
"""Distance between the columns of a big room, cm."""


def furnish(
    rng: Generator,
    settings: OfficeSettings,
    lots: Sequence[Lot],
    doors: Sequence[Doorway],
) -> Iterator[Surface]:
    """Surfaces of the furniture of all rooms."""
    clear = [_kept_clear(index, lots, doors) for index in range(len(lots))]
    for lot, kept in zip(lots, clear, strict=True):
        columns = list(_columns(rng, settings, lot, kept))
        pieces = list(_pieces(rng, settings, lot, [*kept, *columns]))
        yield from (_surface(box, Material.WALL) for box in columns)
        yield from (_surface(box, Material.FURNITURE) for box in pieces)


def _kept_clear(index: int, lots: Sequence[Lot], doors: Sequence[Doorway]) -> list[Box]:
    own = [door for door in doors if index in door.lots]
    kept = [box for door in own for box in (*door.landings, *lanes(door, lots))]
    if lots[index].open:
        kept.append(lots[index].front.box(lots[index].front.span, 100))
    return kept


def _columns(
    rng: Generator, settings: OfficeSettings, lot: Lot, kept: Sequence[Box]
) -> Iterator[Box]:
    """Columns on a grid in big rooms, all of one size."""
    side = int(rng.integers(*COLUMN_SIDES, endpoint=True))
    if min(lot.box.size) < COLUMN_SPACING or not chance(rng, settings.columns):
        return
    for x in _places(lot.box.span(True)):
        for y in _places(lot.box.span(False)):
            box = Box(x - side // 2, y - side // 2, x + side - side // 2, y + side - side // 2)
            if is_free(box.grown(AISLE_WIDTH), kept):
                yield box


def _places(span: Span) -> list[int]:
    """Places spaced evenly between two ends, without the ends."""
    count = (span[1] - span[0]) // COLUMN_SPACING
    return [span[0] + (i + 1) * (span[1] - span[0]) // (count + 1) for i in range(count)]


def _pieces(
    rng: Generator, settings: OfficeSettings, lot: Lot, kept: Sequence[Box]
) -> Iterator[Box]:
    """Furniture along the walls of a room, and a table in its middle if there is space."""
    placed = list(kept)
    for wall in _inner_walls(lot):
        for box in _along(rng, settings, wall):
            if is_free(box, placed):
                placed.append(box.grown(WALL_GAP))
                yield box
    table = _table(rng, lot.box)
    around = table.grown(AISLE_WIDTH)
    fits = lot.area > LEAST_TABLE_ROOM and is_free(around, placed) and _inside(around, lot.box)
    if fits and chance(rng, settings.furniture):
        yield table


def _inner_walls(lot: Lot) -> Iterator[OfficeWall]:
    """The walls of a room as seen from inside, without the open front of an area."""
    for along_x in (True, False):
        low, high = lot.box.span(not along_x)
        for at, inward in ((low, 1), (high, -1)):
            is_front = along_x == lot.front.along_x and at == lot.front.at
            if not (is_front and lot.open):
                yield OfficeWall(along_x, at, lot.box.span(along_x), inward)


def _along(rng: Generator, settings: OfficeSettings, wall: OfficeWall) -> Iterator[Box]:
    """Pieces in a row along a wall, with gaps between them."""
    along = wall.span[0] + WALL_GAP
    while along < wall.span[1]:
        kind = DESK_SIZES if chance(rng, 0.5) else CABINET_SIZES
        (least, most), (shallowest, deepest) = kind
        length = 5 * int(rng.integers(least // 5, most // 5 + 1))
        depth = 5 * int(rng.integers(shallowest // 5, deepest // 5 + 1))
        if kind is DESK_SIZES and chance(rng, 0.5):
            length, depth = depth, length
        end = along + length
        if end > wall.span[1] - WALL_GAP:
            return
        if chance(rng, settings.furniture):
            at = wall.at + wall.inward * WALL_GAP
            yield box_of(wall.along_x, (along, end), (at, at + wall.inward * depth))
        along = end + WALL_GAP + (5 * int(rng.integers(0, 21)) if chance(rng, 0.6) else 0)


def _table(rng: Generator, room: Box) -> Box:
    """A table in the middle of a room, along its longer side."""
    length, width = (int(rng.integers(a, b + 1)) for a, b in TABLE_SIZES)
    x, y = room.size
    size = (length, width) if x > y else (width, length)
    west, south = room.west + (x - size[0]) // 2, room.south + (y - size[1]) // 2
    return Box(west, south, west + size[0], south + size[1])


def _inside(inner: Box, outer: Box) -> bool:
    return (
        outer.west <= inner.west
        and outer.south <= inner.south
        and inner.east <= outer.east
        and inner.north <= outer.north
    )


def line_corridors(
    rng: Generator,
    settings: OfficeSettings,
    corridors: Sequence[OfficeCorridor],
    junctions: Sequence[OfficeJunction],
    lots: Sequence[Lot],
    doors: Sequence[Doorway],
) -> Iterator[Surface]:
    """Columns and cabinets along the walls of corridors, away from doors and junctions."""
    kept = [junction.box.grown(JUNCTION_DISTANCE) for junction in junctions]
    for door in doors:
        span = door.span[0] - DOOR_DISTANCE, door.span[1] + DOOR_DISTANCE
        kept += [door.wall.box(span, -400)]
    kept += [
        lot.front.box(
            (lot.front.span[0] - CORNER_DISTANCE, lot.front.span[1] + CORNER_DISTANCE), -400
        )
        for lot in lots
        if lot.open
    ]
    for corridor in corridors:
        width = corridor.box.size[corridor.along_x]
        low, high = corridor.box.span(corridor.along_x)
        for along in range(low + 100, high - 200, 250):
            box, material = _beside(rng, corridor, along + int(rng.integers(0, 100)), width)
            share = settings.columns if material is Material.WALL else settings.furniture / 4
            if box and chance(rng, share) and is_free(box, kept):
                kept.append(box.grown(FREE_CORRIDOR_WIDTH))
                yield _surface(box, material)


def _beside(
    rng: Generator, corridor: OfficeCorridor, along: int, width: int
) -> tuple[Box | None, Material]:
    """A column, or in a wide corridor a cabinet, at one of the walls."""
    low, high = corridor.box.span(not corridor.along_x)
    at, inward = ((low, 1), (high, -1))[int(rng.integers(2))]
    side = int(rng.integers(*COLUMN_SIDES, endpoint=True))
    length, depth = centimetres(rng, (0.8, 1.2)), 40
    is_column = chance(rng, 0.5)
    length, depth = (side, min(side, width - FREE_CORRIDOR_WIDTH)) if is_column else (length, depth)
    material = Material.WALL if is_column else Material.FURNITURE
    if depth < 15 or width - depth < FREE_CORRIDOR_WIDTH:
        return None, material
    start = at + inward * (0 if is_column else WALL_GAP)
    span = along, along + length
    return box_of(corridor.along_x, span, (start, at + inward * depth)), material


def _surface(box: Box, material: Material) -> Surface:
    west, south, east, north = (value / 100 for value in box)
    corners = ((west, south), (east, south), (east, north), (west, north), (west, south))
    return Surface(corners, material)
