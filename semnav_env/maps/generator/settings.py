"""Ranges from which the parts of a generated office are drawn."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from typing import TypeAlias

Range: TypeAlias = tuple[float, float]
"""Least and most."""


@dataclass(frozen=True)
class OfficeSettings:
    """Settings of generated offices: ranges are uniform, chances are probabilities.

    Attributes:
        rooms: number of rooms.
        crossings: numbers of lines of corridors along the building and across it.
        bay: between two corridors across the building, metres.
        wings: chance of each corridor that could leave the grid of lines to do so.
        wing: length of that part, metres.
        corridor_width: metres.
        room_depth: distance from the corridor to the far wall, metres.
        room_width: width of a usual room along the corridor, metres.
        loops: chance of each corridor that closes a loop.
        single_loaded: chance of each side of a corridor to have no rooms.
        open_areas: chance of each stretch of rooms to hold an area without a front wall.
        door_width: metres.
        closed: chance of a door.
        half_open: chance of a door that is wide enough.
        inner_doors: chance of a door between two neighbouring rooms.
        columns: chance of a column in each place for one.
        furniture: chance of a piece in each place for one.
        glass: chance of a room to have a glass front.
        frameless: chance of a glass front to be one pane, in which a lidar sees neither the glass
            nor where the door is; otherwise it is a row of windows.
    """

    rooms: tuple[int, int] = (16, 34)
    crossings: tuple[tuple[int, int], tuple[int, int]] = ((1, 3), (1, 3))
    bay: Range = (11.0, 17.0)
    wings: float = 0.35
    wing: Range = (6.0, 11.0)
    corridor_width: Range = (1.7, 2.4)
    room_depth: Range = (4.0, 5.6)
    room_width: Range = (2.6, 5.0)
    loops: float = 0.4
    single_loaded: float = 0.15
    open_areas: float = 0.15
    door_width: Range = (0.85, 1.2)
    closed: float = 0.12
    half_open: float = 0.12
    inner_doors: float = 0.06
    columns: float = 0.15
    furniture: float = 0.55
    glass: float = 0.08
    frameless: float = 0.0

    def __post_init__(self) -> None:
        for field in fields(self):
            value = getattr(self, field.name)
            if isinstance(value, float | int):
                _check_chance(field.name, value)
            elif field.name != "crossings":
                _check_range(field.name, value)
        for fewest, many in self.crossings:
            if not 1 <= fewest <= many <= MAX_CROSSINGS:
                raise ValueError(
                    f"crossings are {self.crossings}; each must lie within 1 and {MAX_CROSSINGS}"
                )
        for name, least, most in SETTING_LIMITS:
            low, high = getattr(self, name)
            if not least <= low <= high <= most:
                raise ValueError(f"{name} is {(low, high)}; it must lie within {least} and {most}")


MAX_CROSSINGS = 8
"""Largest number of parallel lines of corridors."""

SETTING_LIMITS: tuple[tuple[str, float, float], ...] = (
    ("rooms", 2, 100),
    ("bay", 6.0, 40.0),
    ("wing", 4.0, 40.0),
    ("corridor_width", 1.5, 4.0),
    ("room_depth", 3.0, 9.0),
    ("room_width", 2.4, 9.0),
    ("door_width", 0.8, 1.2),
)
"""Least and largest value of each setting: narrower corridors and doors would not let every robot
through."""


def _check_chance(name: str, value: float) -> None:
    if not 0.0 <= value <= 1.0:
        raise ValueError(f"{name} is {value}; it is a chance, between 0 and 1")


def _check_range(name: str, value: Range) -> None:
    low, high = value
    if not (math.isfinite(low) and math.isfinite(high) and 0 < low <= high):
        raise ValueError(f"{name} is {value}; give the least and the most, both positive")
