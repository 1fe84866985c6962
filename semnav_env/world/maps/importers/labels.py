"""Hand-made labels beside an occupancy map: `doors.yaml` and `locations.yaml` (BWI's format)."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from semnav_env.world.maps.importers.documents import finite, read_yaml
from semnav_env.world.maps.rules import FloorPlanError
from semnav_features.frames import FloatArray, Point

DOORS_FILE = "doors.yaml"
"""Name of the file with the labels of doors, beside the YAML file of the map."""

PLACES_FILE = "locations.yaml"
"""Name of the file with the labels of places, beside the YAML file of the map."""


ALL_DOORS = "all_doors"
"""Entry of `locations.yaml`: whether `doors.yaml` has every door there is."""

PLACE_KINDS = ("room", "corridor", "intersection", "area")
"""What a place may be, in the list `kinds` of `locations.yaml`."""

T = TypeVar("T")


@dataclass(frozen=True)
class DoorLabel:
    """A doorway that was marked by hand, open or closed, exact to some decimetres.

    Attributes:
        name: name of the door.
        start: one jamb, (x, y) in metres, world frame.
        end: the other jamb.
    """

    name: str
    start: Point
    end: Point


@dataclass(frozen=True, eq=False)
class PlaceLabel:
    """A room or a corridor that was outlined by hand.

    Attributes:
        name: name of the place.
        ring: its corners (column, row) in pixels of the map, shape (n, 2); row 0 is at the top.
        kind: one of `PLACE_KINDS`, if the file says so.
    """

    name: str
    ring: FloatArray
    kind: str | None = None


def read_door_labels(path: Path) -> tuple[DoorLabel, ...]:
    """The doors of a `doors.yaml`: a list of name, door_corner_pt_1 and door_corner_pt_2.

    Empty if there is no such file.

    Raises:
        FloorPlanError: not such a file; names what is wrong with which door.
    """
    if not path.exists():
        return ()
    rows = read_yaml(path)
    if not isinstance(rows, list):
        raise FloorPlanError(f"{path}: no list of doors; each has {', '.join(_DOOR)}")
    return tuple([_read(path, f"door {k}", _door, row, _DOOR) for k, row in enumerate(rows, 1)])


def read_place_labels(path: Path) -> tuple[PlaceLabel, ...]:
    """The places of a `locations.yaml`: names in `locations`, as many rings in `polygons`.

    An extension of this project is the list `kinds`, one of `PLACE_KINDS` for each place. The
    result is empty if there is no such file.

    Raises:
        FloorPlanError: not such a file; names what is wrong with which place.
    """
    if not path.exists():
        return ()
    fields = read_yaml(path)
    names, rings = [fields.get(k) for k in _PLACES] if isinstance(fields, dict) else (None, None)
    if not isinstance(names, list) or not isinstance(rings, list):
        raise FloorPlanError(f"{path}: no places; give the lists {' and '.join(_PLACES)}")
    if len(names) != len(rings):
        raise FloorPlanError(
            f"{path}: {len(names)} locations but {len(rings)} polygons; give one for each"
        )
    kinds = fields.get("kinds", [None] * len(names))
    if not isinstance(kinds, list) or len(kinds) != len(names):
        raise FloorPlanError(f"{path}: kinds is no list with one of {_KINDS} for each location")
    rows = zip(names, rings, kinds, strict=True)
    return tuple([_read(path, f"place {k}", _place, row, _RING) for k, row in enumerate(rows, 1)])


def has_all_doors(path: Path) -> bool:
    """Whether a `locations.yaml` says that `doors.yaml` has every door there is."""
    fields = read_yaml(path) if path.exists() else None
    return isinstance(fields, dict) and fields.get(ALL_DOORS) is True


_DOOR = ("name", "door_corner_pt_1: [x, y]", "door_corner_pt_2: [x, y]")
_PLACES = ("locations", "polygons")
_KINDS = ", ".join(PLACE_KINDS)
_RING = (
    "a name",
    "at least three corners: [column, row, column, row, ...] in pixels",
    f"a kind, if any, of {_KINDS}",
)


def _read(path: Path, what: str, reader: Callable[[Any], T], row: Any, needs: tuple[str, ...]) -> T:
    try:
        return reader(row)
    except (KeyError, TypeError, ValueError) as error:
        raise FloorPlanError(
            f"{path}: {what}: {type(error).__name__} {error}; it has {', '.join(needs)}"
        ) from None


def _door(row: Any) -> DoorLabel:
    a, b = (_point(row[f"door_corner_pt_{k}"]) for k in (1, 2))
    if math.dist(a, b) == 0.0:
        raise ValueError("both corners are the same")
    return DoorLabel(str(row["name"]).strip(), a, b)


def _point(values: Any) -> Point:
    x, y, *_ = map(finite, values)
    return x, y


def _place(row: Any) -> PlaceLabel:
    name, values, kind = row
    ring = np.array([finite(value) for value in values]).reshape(-1, 2)
    if len(ring) < 3:
        raise ValueError(f"{len(ring)} corners")
    if kind is not None and kind not in PLACE_KINDS:
        raise ValueError(f"kind {kind!r}")
    return PlaceLabel(str(name).strip(), ring, kind)
