"""Small floors in the format of the KTH data set: a corridor 10 m by 2 m, rooms to its north."""

from __future__ import annotations

from collections.abc import Sequence

from tests.support.paths import DATA

UNITS = 100
"""Units of the file in a metre."""

Line = tuple[float, float, float, float] | tuple[float, float, float, float, str]
"""x1, y1, x2, y2 in metres, with a type behind it if it is no wall."""


def space(name: str, kind: str, *lines: Line) -> str:
    rows = "".join(
        '<linesegment x1="{}" y1="{}" x2="{}" y2="{}" type="{}" target=""/>'.format(
            *(UNITS * float(value) for value in line[:4]), line[4] if len(line) > 4 else "Wall"
        )
        for line in lines
    )
    return f'<space name="B_{name}" type="{kind}"><contour>{rows}</contour></space>'


def floor(*spaces: str, scale: str = f'PixelDistance="{UNITS}" RealDistance="1"') -> str:
    return f'<?xml version="1.0"?><floor><Scale {scale}/>{"".join(spaces)}</floor>'


def hall(
    doors: Sequence[tuple[float, float]] = ((2, 3),), kind: str = "KORRIDOR", length: float = 10
) -> str:
    """A corridor whose north side has doors between the given x."""
    north: list[Line] = []
    x = length
    for low, high in sorted(doors, reverse=True):
        north += [(x, 2, high, 2), (high, 2, low, 2, "Portal")]
        x = low
    north.append((x, 2, 0, 2))
    around: list[Line] = [(0, 0, length, 0), (length, 0, length, 2, "Window")]
    return space("1", kind, *around, *north, (0, 2, 0, 0))


def room(
    name: str = "2",
    kind: str = "",
    door: tuple[float, float] = (2, 2.9),
    west: float = 0,
    thickness: float = 0.3,
) -> str:
    """A room 4 m square behind a wall to the north of the corridor."""
    y, east = 2 + thickness, west + 4
    a, b = door
    south: list[Line] = [(west, y, a, y), (a, y, b, y, "Portal"), (b, y, east, y)]
    return space(
        name,
        kind,
        *south,
        (east, y, east, y + 4),
        (east, y + 4, west, y + 4),
        (west, y + 4, west, y),
    )


def long_floor(width: float = 0.9) -> str:
    """A corridor 40 m long with nine rooms."""
    doors = [(4.2 * k + 1.5, 4.2 * k + 1.5 + width) for k in range(9)]
    rooms = [room(f"R{k + 2}", "", door, 4.2 * k) for k, door in enumerate(doors)]
    return floor(hall(doors, length=40), *rooms)


real_floors = sorted((DATA / "kth_floors").glob("*/*.xml"))
"""The drawn floors, where they are there."""
