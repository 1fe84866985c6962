"""What is a door and what is none: a table of situations, each seen from three places."""

from __future__ import annotations

import math

import numpy as np
import pytest

from semnav_features import extract
from semnav_features.frames import FloatArray, Pose
from semnav_features.scene import Door
from studies.doors.door_sightings import matches
from tests.support.raycaster import polygon, polyline, scan_of

SIDE = 1.0
"""The wall in question lies at y = 1; the scanner stands below it."""
PLACES: tuple[Pose, ...] = ((-0.3, -0.4, 1.6), (0.4, -0.5, 1.5), (-1.2, -0.5, 1.2))
REST = (polyline((-6, -1.2), (6, -1.2)), polyline((-6, 5), (6, 5)))
"""The other side of the corridor, and the back of the rooms."""


def box(x1: float, y1: float, x2: float, y2: float) -> FloatArray:
    return polygon((x1, y1), (x2, y1), (x2, y2), (x1, y2))


def walls(low: float, high: float, thick: float = 0.12, near: float = SIDE) -> list[FloatArray]:
    """A wall along x with one gap."""
    return [box(-6, near, low, near + thick), box(high, near, 6, near + thick)]


def leaf(hinge: float, y: float, degrees: float, length: float) -> FloatArray:
    """An open leaf, its angle against the x axis."""
    turn = math.radians(degrees)
    return polyline((hinge, y), (hinge + length * math.cos(turn), y + length * math.sin(turn)))


ROOM_DOOR = walls(-0.4, 0.45)
DOORS = {
    "in a wall": (ROOM_DOOR, (-0.4, 0.45)),
    "1.15 m wide in a thin wall": (walls(-0.55, 0.6, 0.02), (-0.55, 0.6)),
    "narrow": (walls(-0.38, 0.38), (-0.38, 0.38)),
    "leaf square to the wall": ([*ROOM_DOOR, leaf(-0.4, 1.12, 90, 0.85)], (-0.4, 0.45)),
    "leaf half open": ([*ROOM_DOOR, leaf(0.45, 1.12, 120, 0.85)], (-0.4, 0.45)),
    "frame stands out": (
        [*ROOM_DOOR, box(-0.46, 0.97, -0.4, 1.15), box(0.45, 0.97, 0.51, 1.15)],
        (-0.4, 0.45),
    ),
    "at the end of a wall": (
        [box(-6, 1, -0.4, 1.12), box(0.45, 1, 0.55, 1.12), polyline((0.55, -1.2), (0.55, 5))],
        (-0.4, 0.45),
    ),
    "one jamb is the wall of the room": (
        [box(-6, 1, -0.4, 1.12), box(0.45, 1, 0.57, 5), box(0.57, 1, 6, 1.12)],
        (-0.4, 0.45),
    ),
    "recessed by 0.15 m": (
        [*walls(-0.6, 0.65), box(-0.6, 1.15, -0.4, 1.27), box(0.45, 1.15, 0.65, 1.27)],
        (-0.4, 0.45),
    ),
}
NO_DOORS = {
    "a whole wall": [box(-6, 1, 6, 1.12)],
    "a closed door in its frame": [*ROOM_DOOR, polyline((-0.4, 1.08), (0.45, 1.08))],
    "beside a pillar": [box(-6, 2.2, 6, 2.32), box(-0.2, 0.6, 0.2, 1.0)],
    "the mouth of a corridor": [box(-6, 1, -0.9, 5), box(0.9, 1, 6, 5)],
    "a slit": walls(-0.2, 0.2),
    "a wide opening": walls(-0.9, 0.9),
    "legs of a table": [
        box(-6, 2.2, 6, 2.32),
        *(box(x - 0.02, y - 0.02, x + 0.02, y + 0.02) for x in (-0.4, 0.4) for y in (0.9, 1.5)),
    ],
}


def seen(segments: list[FloatArray], place: Pose, seed: int) -> tuple[Door, ...]:
    """The doors in a scan with 10 mm of noise, world frame."""
    scene = np.concatenate([*segments, *REST])
    scan = scan_of(scene, place, sigma=0.01, rng=np.random.default_rng(seed))
    return extract(scan).placed(place).doors


@pytest.mark.parametrize("name", DOORS)
def test_is_a_door(name: str) -> None:
    """In ten of twelve scans or more."""
    segments, (low, high) = DOORS[name]
    found = sum(
        any(matches(door, (low, SIDE), (high, SIDE)) for door in seen(segments, place, seed))
        for place in PLACES
        for seed in range(4)
    )
    assert found >= 10


@pytest.mark.parametrize("name", NO_DOORS)
def test_is_no_door(name: str) -> None:
    """In eleven of twelve scans or more."""
    found = [seen(NO_DOORS[name], place, seed) for place in PLACES for seed in range(4)]
    near = [d for doors in found for d in doors if abs(d.midpoint[0]) < 1.5 and d.midpoint[1] < 2.0]
    assert len(near) <= 1


def test_from_the_doorway_the_door_one_stands_in_does_no_harm() -> None:
    """Its jambs lie to both sides, too near its line to be told; nothing else may be one."""
    for seed in range(4):
        doors = seen(ROOM_DOOR, (0.0, SIDE + 0.06, math.pi / 2), seed)
        assert all(matches(door, (-0.4, SIDE), (0.45, SIDE)) for door in doors)


@pytest.mark.parametrize("degrees", [45.0, 60.0, 75.0])
@pytest.mark.parametrize("at_start", [True, False])
def test_the_leaf_hangs_where_it_does_and_at_its_angle(degrees: float, at_start: bool) -> None:
    """Seen from below, the door runs from right to left: its start is the right jamb."""
    hinge, turn = (0.45, 180.0 - degrees) if at_start else (-0.4, degrees)
    doors = seen([*ROOM_DOOR, leaf(hinge, 1.1, turn, 0.85)], (0.0, -0.4, 1.57), 0)
    leaves = [d.leaf for d in doors if matches(d, (-0.4, SIDE), (0.45, SIDE))]
    assert leaves
    assert leaves[0] is not None
    assert leaves[0].hinge_at_start == at_start
    assert math.degrees(leaves[0].angle) == pytest.approx(degrees, abs=8.0)
