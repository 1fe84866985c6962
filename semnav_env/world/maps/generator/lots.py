"""Rooms laid along the corridors of a generated office."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

from numpy.random import Generator

from semnav_env.world.maps.generator.boxes import Box, Span, box_of, is_free, without
from semnav_env.world.maps.generator.chance import centimetres, chance
from semnav_env.world.maps.generator.corridors import OfficeCorridor
from semnav_env.world.maps.generator.settings import OfficeSettings

LEAST_DEPTH = 280
"""Depth of the shallowest room, cm."""

MAX_ABSORBED_DEPTH = 220
"""Depth of the deepest strip behind a room that becomes part of it, cm."""

LEAST_FRONT = 150
"""Shortest border of a room on its corridor, cm: it must have space for a door."""

LEAST_WIDTH = 180
"""Width of the narrowest room, cm."""

SMALL_ROOM_CHANCE = 0.14
"""Probability of a room for storage or the like."""

BIG_ROOM_CHANCE = 0.12
"""Probability of a meeting room or an office of many desks."""

SMALL_WIDTHS = (1.8, 2.4)
"""Least and largest width of a small room, metres."""

BIG_WIDTHS = (5.6, 9.5)
"""Least and largest width of a big room, metres."""

CAP_DEPTHS = (3.6, 6.0)
"""Least and largest depth of a room at the end of a corridor, metres."""

AREA_WIDTHS = (3.4, 6.0)
"""Least and largest width of an area without a front wall, metres."""

CAP_CHANCE = 0.6
"""Probability that a dead end leads to a room."""


@dataclass(frozen=True)
class OfficeWall:
    """A part of a wall between a room and the area before it.

    Attributes:
        along_x: whether it runs along x, else along y.
        at: its coordinate across that direction, cm.
        span: its extent, cm.
        inward: 1 if the room lies towards higher coordinates, else -1.
    """

    along_x: bool
    at: int
    span: Span
    inward: int

    def transposed(self) -> OfficeWall:
        """The lot with x and y exchanged."""
        return replace(self, along_x=not self.along_x)

    def box(self, span: Span, depth: int) -> Box:
        """The box behind a part of its front, as deep as given; before it if negative."""
        return box_of(self.along_x, span, (self.at, self.at + self.inward * depth))


@dataclass(frozen=True)
class Lot:
    """A room, or an area that is open to its corridor.

    Attributes:
        box: its extent.
        front: the stretches where it borders on its corridor.
        corridor: index of that.
        open: it has no front wall.
    """

    box: Box
    front: OfficeWall
    corridor: int
    open: bool = False

    @property
    def width(self) -> int:
        """Width along the corridor, cm."""
        low, high = self.box.span(self.front.along_x)
        return high - low

    @property
    def area(self) -> float:
        """Floor area, square metres."""
        x, y = self.box.size
        return x * y / 1e4

    def transposed(self) -> Lot:
        """The lot with x and y exchanged."""
        return replace(self, box=self.box.transposed(), front=self.front.transposed())


def lay_rooms(
    rng: Generator, settings: OfficeSettings, corridors: Sequence[OfficeCorridor]
) -> tuple[Lot, ...]:
    """Lay rooms on both sides of the corridors and at their dead ends; none overlap."""
    taken = [corridor.box for corridor in corridors]
    lots: list[Lot] = []
    for index in range(len(corridors)):
        for side in (-1, 1):
            laid = list(_row(rng, settings, corridors, index, side, taken))
            taken += [lot.box for lot in laid]
            lots += laid
    for index, corridor in enumerate(corridors):
        for end in (-1, 1):
            if corridor.blind[end > 0] and chance(rng, CAP_CHANCE):
                cap = _cap(rng, corridor, index, end, taken)
                taken += [cap.box] if cap else []
                lots += [cap] if cap else []
    return tuple(lots)


def _row(
    rng: Generator,
    settings: OfficeSettings,
    corridors: Sequence[OfficeCorridor],
    index: int,
    side: int,
    taken: list[Box],
) -> Iterator[Lot]:
    """The rooms on one side of a corridor, in the gaps that are free."""
    corridor = corridors[index]
    depth = corridor.depths[side > 0]
    if depth == 0:
        return
    low, high = corridor.box.span(corridor.along_x)
    at = corridor.box.span(not corridor.along_x)[side > 0]
    band = OfficeWall(corridor.along_x, at, _with_corners(corridors, index), side)
    near = band.box(band.span, LEAST_DEPTH)
    holes = [box.span(corridor.along_x) for box in taken if box.overlaps(near)]
    for gap in without([band.span], holes):
        front = max(gap[0], low), min(gap[1], high)
        if front[1] - front[0] < max(LEAST_FRONT, LEAST_WIDTH):
            continue
        cuts = _cuts(rng, settings, gap, front)
        area = int(rng.integers(len(cuts) - 1)) if chance(rng, settings.open_areas) else -1
        for i, span in enumerate(pairwise(cuts)):
            wall = OfficeWall(band.along_x, at, (max(span[0], low), min(span[1], high)), side)
            box = band.box(span, _depth(band, span, depth, taken))
            is_area = i == area and span[1] - span[0] >= 100 * AREA_WIDTHS[0]
            yield Lot(box, wall, index, is_area)


def _with_corners(corridors: Sequence[OfficeCorridor], index: int) -> Span:
    """Extent of a corridor, with the rooms behind a corridor that crosses its end."""
    corridor = corridors[index]
    low, high = corridor.box.span(corridor.along_x)
    for other in corridors:
        if other.along_x != corridor.along_x and other.box.overlaps(corridor.box):
            left, right = other.box.span(corridor.along_x)
            if left == corridor.box.span(corridor.along_x)[0]:
                low = left - other.depths[0]
            if right == corridor.box.span(corridor.along_x)[1]:
                high = right + other.depths[1]
    return low, high


def _cuts(rng: Generator, settings: OfficeSettings, gap: Span, front: Span) -> list[int]:
    """Places of the walls between the rooms of a gap, its ends included, cm.

    Every room borders on the front for at least `LEAST_FRONT`.
    """
    cuts = [gap[0]]
    while gap[1] - cuts[-1] > 100 * settings.room_width[0]:
        cuts.append(max(cuts[-1] + _width(rng, settings), front[0] + LEAST_FRONT))
    cuts = [cut for cut in cuts if cut <= min(gap[1] - LEAST_WIDTH, front[1] - LEAST_FRONT)]
    return [*(cuts or [gap[0]]), gap[1]]


def _width(rng: Generator, settings: OfficeSettings) -> int:
    draw = float(rng.random())
    if draw < SMALL_ROOM_CHANCE:
        return centimetres(rng, SMALL_WIDTHS)
    return centimetres(rng, BIG_WIDTHS if draw > 1.0 - BIG_ROOM_CHANCE else settings.room_width)


def _depth(band: OfficeWall, span: Span, depth: int, taken: list[Box]) -> int:
    """Depth of a room: as planned, or more where a narrow strip would be left behind it."""
    behind = band.box(span, depth + MAX_ABSORBED_DEPTH)
    clear = depth + MAX_ABSORBED_DEPTH + 1
    for box in taken:
        if box.overlaps(behind):
            low, high = box.span(not band.along_x)
            clear = min(clear, low - band.at if band.inward > 0 else band.at - high)
    return clear if clear <= depth + MAX_ABSORBED_DEPTH else depth


def _cap(
    rng: Generator, corridor: OfficeCorridor, index: int, end: int, taken: list[Box]
) -> Lot | None:
    """A room behind the end of a corridor, as wide as its wing if there is space."""
    low, high = corridor.box.span(not corridor.along_x)
    at = corridor.box.span(corridor.along_x)[end > 0]
    front = OfficeWall(not corridor.along_x, at, (low, high), end)
    depth = centimetres(rng, CAP_DEPTHS)
    left, right = corridor.depths
    for span in ((low - left, high + right), (low - left, high), (low, high + right)):
        box = front.box(span, depth)
        if span[1] - span[0] >= 250 and is_free(box, taken):
            return Lot(box, front, index)
    return None
