"""Doors over time: every sighting speaks for a door, every look that shows none against it."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numba import njit

from semnav_env.features.frames import FloatArray
from semnav_env.features.kernels.remembered import Ends, place_for_new

REMEMBERED_DOOR = np.dtype(
    [(name, "f8") for name in ("start_x", "start_y", "end_x", "end_y", "odds")]
    + [("hits", "i8"), ("seen", "?")]
)
"""A remembered door: its ends, the logarithm of the odds that it is one, how often it was seen,
and whether the last scan showed it."""

MISSED = 0.25
"""Taken from the log-odds where a scan looks through the opening but finds no door there: little,
as successive scans are taken from nearly the same place."""
FILLED = 1.0
"""Taken where a scan finds the opening filled."""
CERTAIN = 1.4
"""Log-odds from which a door counts: 0.8 likely."""
BOUND = 6.0
"""The log-odds stay within this, so that a door that gets closed is forgotten again."""
SUREST = 0.8
"""No single scan is believed more than this: a door takes two."""

SAME_PLACE = 0.5
"""Of two doors whose middles are nearer than this only one counts, metres."""
SAME_JAMB = 0.4
"""Two sightings are one door if both jambs agree to this, metres."""
RECENT_HITS = 10
"""Older sightings together weigh no more than so many: odometry drifts."""

REACH, NEAREST = 4.0, 0.4
"""A scan tells whether an opening so far off is open, and so far from its line, metres."""
FLATTEST = math.cos(math.radians(70.0))
"""Cosine of the flattest incidence at which it does."""
LOOKS = 8
"""So many beams across the opening are looked at, and fewer do not tell."""
DEPTH = 0.15
"""A beam that ends nearer than this to the opening, along the beam, is stopped there, metres."""
BESIDE = 0.2
"""A scan that misses a door tells only if it looks so far beside both jambs, metres: what is at
the rim of its view, or half hidden, it would not take for a door either."""
NOTHING, OPEN, STOPPED = range(3)
"""What a scan tells of an opening."""


@njit(cache=True, error_model="numpy")
def door_counts(doors: Any, k: int) -> bool:
    """Whether door `k` of the remembered ones is likely enough to be taken for a door.

    Of two in the same place, such as a door and the gap to its leaf, only the likelier one counts.
    """
    door = doors[k]
    if door.odds < CERTAIN:
        return False
    for i in range(len(doors)):
        rival = doors[i]
        x = 0.5 * (rival.start_x + rival.end_x - door.start_x - door.end_x)
        y = 0.5 * (rival.start_y + rival.end_y - door.start_y - door.end_y)
        if x * x + y * y < SAME_PLACE**2 and _comes_first(rival, i, door, k):
            return False
    return True


@njit(cache=True, error_model="numpy")
def _comes_first(rival: Any, i: int, door: Any, k: int) -> bool:
    """Whether a rival is likelier, or was seen more often, or at least earlier."""
    if rival.odds != door.odds:
        return bool(rival.odds > door.odds)
    return bool(rival.hits > door.hits or (rival.hits == door.hits and i < k))


@njit(cache=True, error_model="numpy")
def remember_door(door: Ends, confidence: float, memory: Any, used: int) -> int:
    """Fuse a door with the remembered one that it repeats, or add it.

    Both jambs must agree, whichever side the door is seen from; they become the mean of the
    last sightings.

    Args:
        door: in the memory's frame.
        confidence: of the sighting, 0 to 1.
        memory: `REMEMBERED_DOOR` array, changed in place.
        used: entries used before.

    Returns:
        Entries used afterwards.
    """
    likely = min(max(confidence, 1.0 - SUREST), SUREST)
    speaks = math.log(likely / (1.0 - likely))
    turned = (door[2], door[3], door[0], door[1])
    best, nearest, swapped = -1, SAME_JAMB, False
    for k in range(used):
        same, other = _apart(memory[k], door), _apart(memory[k], turned)
        if min(same, other) < nearest:
            best, nearest, swapped = k, min(same, other), other < same
    if best < 0:
        best, used = place_for_new(memory, used)
        _set(memory[best], door, speaks)
    else:
        _fuse(memory[best], turned if swapped else door, speaks)
    memory[best].seen = True
    return used


@njit(cache=True, error_model="numpy")
def _set(new: Any, door: Ends, speaks: float) -> None:
    new.start_x, new.start_y, new.end_x, new.end_y = door
    new.hits, new.odds = 1, speaks


@njit(cache=True, error_model="numpy")
def _fuse(old: Any, door: Ends, speaks: float) -> None:
    x1, y1, x2, y2 = door
    share = 1.0 / min(old.hits + 1, RECENT_HITS)
    old.start_x += share * (x1 - old.start_x)
    old.start_y += share * (y1 - old.start_y)
    old.end_x += share * (x2 - old.end_x)
    old.end_y += share * (y2 - old.end_y)
    old.hits += 1
    old.odds = min(old.odds + speaks, BOUND)


@njit(cache=True, error_model="numpy")
def _apart(old: Any, door: Ends) -> float:
    """The larger distance between the starts and between the ends of two doors, metres."""
    return max(
        math.hypot(door[0] - old.start_x, door[1] - old.start_y),
        math.hypot(door[2] - old.end_x, door[3] - old.end_y),
    )


@njit(cache=True, error_model="numpy")
def doubt_doors(
    ranges: FloatArray,
    angle_min: float,
    angle_increment: float,
    pose: tuple[float, float, float],
    doors: Any,
) -> None:
    """Let a scan speak against the doors that it looks at and that were not seen in it.

    Args:
        ranges: of the scan, metres, shape (n,).
        angle_min: of the scan, radians.
        angle_increment: of the scan, radians.
        pose: of the lidar in the memory's frame.
        doors: `REMEMBERED_DOOR`, changed in place; `seen` says which the scan showed, and is
            cleared.
    """
    for k in range(len(doors)):
        door = doors[k]
        if not door.seen:
            told = look_at(ranges, angle_min, angle_increment, pose, door)
            if told != NOTHING:
                loss = MISSED if told == OPEN else FILLED
                door.odds = max(door.odds - loss, -BOUND)
        door.seen = False


@njit(cache=True, error_model="numpy")
def look_at(
    ranges: FloatArray,
    angle_min: float,
    angle_increment: float,
    pose: tuple[float, float, float],
    door: Any,
) -> int:
    """What a scan tells of a door's opening: `OPEN`, `STOPPED` in it, or `NOTHING`."""
    dx, dy = door.end_x - door.start_x, door.end_y - door.start_y
    x, y = door.start_x - pose[0], door.start_y - pose[1]
    width = math.hypot(dx, dy)
    away = math.hypot(x + 0.5 * dx, y + 0.5 * dy)
    distance = abs(x * dy - y * dx) / width
    if away > REACH or distance < max(NEAREST, FLATTEST * away):
        return NOTHING
    if width * distance < LOOKS * angle_increment * away * away:
        return NOTHING
    through = stopped = 0
    for k in range(LOOKS):
        beyond = _beyond(ranges, angle_min, angle_increment, pose, door, (k + 0.5) / LOOKS)
        if math.isnan(beyond):
            return NOTHING
        through += beyond > DEPTH
        stopped += abs(beyond) <= DEPTH
    if 4 * stopped >= 3 * LOOKS:
        return STOPPED
    if 2 * through < LOOKS:
        return NOTHING
    for share in (-BESIDE / width, 1.0 + BESIDE / width):
        beyond = _beyond(ranges, angle_min, angle_increment, pose, door, share)
        if not beyond > -DEPTH:
            return NOTHING
    return OPEN


@njit(cache=True, error_model="numpy")
def _beyond(
    ranges: FloatArray,
    angle_min: float,
    angle_increment: float,
    pose: tuple[float, float, float],
    door: Any,
    share: float,
) -> float:
    """How far behind a point of a door's line the beam there ends, metres; NaN without a beam."""
    x = door.start_x + share * (door.end_x - door.start_x) - pose[0]
    y = door.start_y + share * (door.end_y - door.start_y) - pose[1]
    turn = math.atan2(y, x) - pose[2] - angle_min
    turn -= 2.0 * math.pi * math.floor(turn / (2.0 * math.pi))
    beam = int(turn / angle_increment + 0.5)
    return ranges[beam] - math.hypot(x, y) if beam < len(ranges) else math.nan
