"""Ranges from which the parts of a generated office are drawn."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, TypeAlias

from semnav_features.checked_fields import Bounds, Share, check_fields, require_span

MAX_CROSSINGS = 8
"""Largest number of parallel lines of corridors."""

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
            nor the door; otherwise it is a row of windows.
    """

    rooms: Annotated[tuple[int, int], Bounds(2, 100)] = (16, 34)
    crossings: Annotated[tuple[tuple[int, int], tuple[int, int]], Bounds(1, MAX_CROSSINGS)] = (
        (1, 3),
        (1, 3),
    )
    bay: Annotated[Range, Bounds(6.0, 40.0, "m")] = (11.0, 17.0)
    wings: Share = 0.35
    wing: Annotated[Range, Bounds(4.0, 40.0, "m")] = (6.0, 11.0)
    corridor_width: Annotated[Range, Bounds(1.5, 4.0, "m")] = (1.7, 2.4)
    room_depth: Annotated[Range, Bounds(3.0, 9.0, "m")] = (4.0, 5.6)
    room_width: Annotated[Range, Bounds(2.4, 9.0, "m")] = (2.6, 5.0)
    loops: Share = 0.4
    single_loaded: Share = 0.15
    open_areas: Share = 0.15
    door_width: Annotated[Range, Bounds(0.8, 1.2, "m")] = (0.85, 1.2)
    closed: Share = 0.12
    half_open: Share = 0.12
    inner_doors: Share = 0.06
    columns: Share = 0.15
    furniture: Share = 0.55
    glass: Share = 0.08
    frameless: Share = 0.0

    def __post_init__(self) -> None:
        check_fields(self)
        for name in (
            "rooms",
            "bay",
            "wing",
            "corridor_width",
            "room_depth",
            "room_width",
            "door_width",
        ):
            require_span(name, getattr(self, name))
        for span in self.crossings:
            require_span("crossings", span)
