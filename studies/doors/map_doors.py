"""Doors of a map that was built from a whole log, against labelled openings."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import islice
from pathlib import Path
from typing import NamedTuple

import numpy as np

from semnav_features import Door, ExtractorSettings, extract
from semnav_features.frames import FloatArray
from semnav_features.mapping import LineMap
from semnav_features.readers import open_log
from studies.doors.door_sightings import MAX_JAMB_ERROR, jambs_apart
from studies.doors.openings import LabelledOpening
from studies.sheets import Cell, ResultSheet

EXACT_JAMB_ERROR = 0.05
"""A door of the map is exact if both jambs are within this of those labelled, metres."""

MAX_DOOR_LINE_OFFSET = 0.3
"""A door this near to the line of a side's doors stands in that wall of the corridor, metres."""

MAX_DOOR_ANGLE = math.radians(20.0)
"""Greatest angle between the wall of the corridor and a door that stands in it, radians."""


def mapped(path: Path, settings: ExtractorSettings, every: int = 1) -> Iterator[LineMap]:
    """The map of every Nth scan of a log after each of them, one growing object.

    Raises:
        ValueError: the log tells no poses.
        OSError: it cannot be opened.
    """
    line_map = LineMap()
    with open_log(path) as log:
        for record in islice(log, 0, None, every):
            if record.pose is None:
                raise ValueError(f"{path} tells no poses; give a log with corrected ones")
            line_map.add(extract(record.scan, settings), record.scan, record.pose)
            yield line_map


class MapFinding(NamedTuple):
    """A labelled opening with the door of the map that it is, or one of them alone.

    Attributes:
        opening: None for a door where nothing is labelled.
        door: None for an opening that was not found.
        off: between their jambs, at most, metres; infinite for one alone.
    """

    opening: LabelledOpening | None
    door: Door | None
    off: float


def findings(doors: Sequence[Door], openings: Sequence[LabelledOpening]) -> list[MapFinding]:
    """The openings, each with the nearest door within `MAX_JAMB_ERROR`, then the other doors."""
    found: list[MapFinding] = []
    for opening in openings:
        nearest = min(doors, key=lambda door: _apart(door, opening), default=None)
        off = math.inf if nearest is None else _apart(nearest, opening)
        found.append(
            MapFinding(opening, nearest, off) if off <= MAX_JAMB_ERROR else _missed(opening)
        )
    rest = [door for door in doors if all(door is not each.door for each in found)]
    return found + [MapFinding(None, door, math.inf) for door in rest]


def map_sheets(doors: Sequence[Door], openings: Sequence[LabelledOpening]) -> list[ResultSheet]:
    """How many of the openings are doors of the map, and each of both."""
    found = findings(doors, openings)
    walls = [wall for group in ("north", "south") if (wall := _wall(group, openings)) is not None]
    groups = [
        ("north, certain", [f for f in found if f.opening and _is(f.opening, "north")]),
        ("north, all", [f for f in found if f.opening and f.opening.group == "north"]),
        ("all certain", [f for f in found if f.opening and f.opening.certain]),
        ("all undecided", [f for f in found if f.opening and not f.opening.certain]),
    ]
    extra = [f.door for f in found if f.opening is None and f.door]
    standing = sum(any(_stands_in(door, wall) for wall in walls) for door in extra)
    rows: list[tuple[Cell, ...]] = [(name, *_summary(group)) for name, group in groups]
    rows.append(("not labelled", math.nan, len(extra), math.nan, math.nan))
    rows.append(("of them in the corridor's walls", math.nan, standing, math.nan, math.nan))
    columns = "openings", "number", "in the map", "both jambs within 5 cm", "worst jamb, cm"
    each = [_row(finding) for finding in found]
    return [
        ResultSheet("Doors in the map of the whole log, freiburg-079", columns, rows),
        ResultSheet("Doors in that map one by one", _EACH, each),
    ]


def _summary(group: Sequence[MapFinding]) -> tuple[Cell, ...]:
    off = [finding.off for finding in group if finding.door]
    worst = 100.0 * max(off, default=math.nan)
    return len(group), len(off), sum(each <= EXACT_JAMB_ERROR for each in off), worst


_EACH = (
    *("opening", "group", "certain", "x, m", "y, m", "width, m", "width in the map, m"),
    *("worst jamb, cm", "sightings", "confidence"),
)


def _row(finding: MapFinding) -> tuple[Cell, ...]:
    opening, door, off = finding
    label: tuple[Cell, ...] = ("-", "-", "-")
    told: tuple[Cell, ...] = (math.nan,) * 4
    if opening is not None:
        label = str(opening.door.name), opening.group, "yes" if opening.certain else "no"
    if door is not None:
        worst = 100.0 * off if opening else math.nan
        told = door.width, worst, door.sightings, door.confidence
    width = opening.door.width if opening else math.nan
    return *label, *_place(finding), width, *told


def _place(finding: MapFinding) -> tuple[float, float]:
    shown = finding.opening.door if finding.opening else finding.door
    return shown.midpoint if shown else (math.nan, math.nan)


def _missed(opening: LabelledOpening) -> MapFinding:
    return MapFinding(opening, None, math.inf)


def _apart(door: Door, opening: LabelledOpening) -> float:
    return jambs_apart(door, opening.door.start, opening.door.end)


def _is(opening: LabelledOpening, group: str) -> bool:
    return opening.group == group and opening.certain


def _wall(group: str, openings: Sequence[LabelledOpening]) -> tuple[FloatArray, FloatArray] | None:
    """The wall that a side's certain doors stand in, from its first jamb to its last."""
    doors = [opening.door for opening in openings if _is(opening, group)]
    jambs = np.array([point for door in doors for point in (door.start, door.end)])
    if len(doors) < 2:
        return None
    middle = jambs.mean(axis=0)
    along = np.linalg.svd(jambs - middle)[2][0]
    places = (jambs - middle) @ along
    return middle + places.min() * along, middle + places.max() * along


def _stands_in(door: Door, wall: tuple[FloatArray, FloatArray]) -> bool:
    start, end = wall
    length = float(np.hypot(*(end - start)))
    along = (end - start) / length
    place = np.array(door.midpoint) - start
    chord = (np.array(door.end) - door.start) / door.width
    return bool(
        -MAX_DOOR_LINE_OFFSET <= place @ along <= length + MAX_DOOR_LINE_OFFSET
        and abs(along[0] * place[1] - along[1] * place[0]) <= MAX_DOOR_LINE_OFFSET
        and abs(chord @ along) >= math.cos(MAX_DOOR_ANGLE)
    )
