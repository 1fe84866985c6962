"""Keeps doors over time: sightings raise the odds of a door, looks that show none lower them."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.past_views import FREE, look_back
from semnav_features.kernels.remembered import Ends, place_for_new

REMEMBERED_DOOR = np.dtype(
    [(name, "f8") for name in ("start_x", "start_y", "end_x", "end_y", "log_odds")]
    + [("hits", "i8"), ("seen", "?")]
)
"""A remembered door: its ends, the logarithm of the odds that it is one, how often it was seen,
and whether the last scan showed it."""

MISSED_LOSS = 0.25
"""Taken from the log-odds where a scan looks through the opening but finds no door there. It is
little, because successive scans are taken from nearly the same place."""

FILLED_LOSS = 1.0
"""Taken from the log-odds where a scan finds the opening filled."""

MIN_COUNTING_LOG_ODDS = 1.4
"""Log-odds from which on a door counts: a probability of 0.8."""

MAX_LOG_ODDS = 6.0
"""Largest size of the log-odds, so that a door that gets closed is forgotten again."""

MAX_SIGHTING_CONFIDENCE = 0.8
"""Largest confidence that a single sighting is credited with: a door takes two of them."""

SAME_PLACE_DISTANCE = 0.5
"""Of two doors whose middles are nearer than this only one counts, metres."""

SAME_JAMB_DISTANCE = 0.4
"""Two sightings are one door if both jambs agree to this, metres."""

MAX_WEIGHING_SIGHTINGS = 10
"""Older sightings together weigh no more than this many: odometry drifts."""

MAX_LOOK_DISTANCE, MIN_LINE_DISTANCE = 4.0, 0.4
"""A scan can judge an opening up to this range, and from at least this far off its line, metres."""

MIN_INCIDENCE_COSINE = math.cos(math.radians(70.0))
"""Cosine of the flattest incidence at which a scan can judge an opening, 70 degrees from square."""

LOOK_BEAMS = 8
"""Number of beams across the opening that are looked at; with fewer nothing can be told."""

OPENING_DEPTH = 0.15
"""A beam that ends less than this before or behind the opening, along the beam, is stopped in it,
metres."""

JAMB_MARGIN = 0.2
"""A scan that misses a door tells something only if it sees this far beside both jambs, metres: a
door at the rim of its view, or half hidden, would not be found anyway."""

UNKNOWN, OPEN, FILLED = range(3)
"""What a scan can tell of an opening."""


@kernel
def door_counts(doors: Any, k: int, state: Any) -> bool:
    """Whether door `k` of the remembered ones is likely enough to be taken for a door.

    It must be as wide as a door, which each sighting is only within the spacing of the beams. Of
    two in the same place, such as a door and the gap to its leaf, only the likelier one counts.

    Args:
        doors: `REMEMBERED_DOOR` array.
        k: which of them.
        state: an entry of `memory.MEMORY_STATE`, for `narrowest` and `widest`.
    """
    door = doors[k]
    if door.log_odds < MIN_COUNTING_LOG_ODDS or not _has_width_of_a_door(door, state):
        return False
    for i in range(len(doors)):
        rival = doors[i]
        x = 0.5 * (rival.start_x + rival.end_x - door.start_x - door.end_x)
        y = 0.5 * (rival.start_y + rival.end_y - door.start_y - door.end_y)
        if x * x + y * y >= SAME_PLACE_DISTANCE**2 or not _comes_first(rival, i, door, k):
            continue
        if _has_width_of_a_door(rival, state):
            return False
    return True


@kernel
def _has_width_of_a_door(door: Any, state: Any) -> bool:
    """Whether the jambs, as all sightings together have them, are a door's width apart."""
    dx, dy = door.end_x - door.start_x, door.end_y - door.start_y
    square = dx * dx + dy * dy
    return bool(state.narrowest * state.narrowest <= square <= state.widest * state.widest)


@kernel
def _comes_first(rival: Any, i: int, door: Any, k: int) -> bool:
    """Whether a rival is likelier, or was seen more often, or at least earlier."""
    if rival.log_odds != door.log_odds:
        return bool(rival.log_odds > door.log_odds)
    return bool(rival.hits > door.hits or (rival.hits == door.hits and i < k))


@kernel
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
    likely = min(max(confidence, 1.0 - MAX_SIGHTING_CONFIDENCE), MAX_SIGHTING_CONFIDENCE)
    log_odds = math.log(likely / (1.0 - likely))
    turned = (door[2], door[3], door[0], door[1])
    best, nearest, swapped = -1, SAME_JAMB_DISTANCE, False
    for k in range(used):
        if not _may_be_same(memory[k], door):
            continue
        same, other = _apart(memory[k], door), _apart(memory[k], turned)
        if min(same, other) < nearest:
            best, nearest, swapped = k, min(same, other), other < same
    if best < 0:
        best, used = place_for_new(memory.hits, used)
        _set(memory[best], door, log_odds)
    else:
        _fuse(memory[best], turned if swapped else door, log_odds)
    memory[best].seen = True
    return used


@kernel
def _may_be_same(old: Any, door: Ends) -> bool:
    """Whether the middles of two doors are so near that their jambs may agree."""
    x = 0.5 * (door[0] + door[2] - old.start_x - old.end_x)
    y = 0.5 * (door[1] + door[3] - old.start_y - old.end_y)
    return bool(x * x + y * y <= 1.01 * SAME_JAMB_DISTANCE**2)


@kernel
def _set(new: Any, door: Ends, log_odds: float) -> None:
    new.start_x, new.start_y, new.end_x, new.end_y = door
    new.hits, new.log_odds = 1, log_odds


@kernel
def _fuse(old: Any, door: Ends, log_odds: float) -> None:
    x1, y1, x2, y2 = door
    share = 1.0 / min(old.hits + 1, MAX_WEIGHING_SIGHTINGS)
    old.start_x += share * (x1 - old.start_x)
    old.start_y += share * (y1 - old.start_y)
    old.end_x += share * (x2 - old.end_x)
    old.end_y += share * (y2 - old.end_y)
    old.hits += 1
    old.log_odds = min(old.log_odds + log_odds, MAX_LOG_ODDS)


@kernel
def _apart(old: Any, door: Ends) -> float:
    """The larger distance between the starts and between the ends of two doors, metres."""
    return max(
        math.hypot(door[0] - old.start_x, door[1] - old.start_y),
        math.hypot(door[2] - old.end_x, door[3] - old.end_y),
    )


@kernel
def doubt_unseen_doors(
    ranges: FloatArray,
    angle_min: float,
    angle_increment: float,
    pose: tuple[float, float, float],
    doors: Any,
    count: int,
    views: Any,
) -> None:
    """Lower the odds of the doors that a scan looks at without having shown them.

    A door that is filled where an earlier view passed was shut since, or somebody stands in it.

    Args:
        ranges: of the scan, metres, shape (n,).
        angle_min: of the scan, radians.
        angle_increment: of the scan, radians.
        pose: of the lidar in the memory's frame.
        doors: `REMEMBERED_DOOR`, changed in place; `seen` says which of them the scan showed, and
            is cleared.
        count: of the views that were kept so far.
        views: `past_views.PAST_VIEWS`.
    """
    for k in range(len(doors)):
        door = doors[k]
        if not door.seen:
            state = look_at(ranges, angle_min, angle_increment, pose, door)
            if state == FILLED and _was_open(door, count, views):
                state = UNKNOWN
            if state != UNKNOWN:
                loss = MISSED_LOSS if state == OPEN else FILLED_LOSS
                door.log_odds = max(door.log_odds - loss, -MAX_LOG_ODDS)
        door.seen = False


@kernel
def _was_open(door: Any, count: int, views: Any) -> bool:
    """Whether an earlier view passed the middle of a door."""
    x, y = 0.5 * (door.start_x + door.end_x), 0.5 * (door.start_y + door.end_y)
    return bool(look_back(x, y, count, views) == FREE)


@kernel
def look_at(
    ranges: FloatArray,
    angle_min: float,
    angle_increment: float,
    pose: tuple[float, float, float],
    door: Any,
) -> int:
    """What a scan tells of a door's opening: `OPEN`, `FILLED` or `UNKNOWN`.

    It is filled if three in four of the beams end in it. It is open if half of them end behind it
    and the scan also sees both flanks: only then would a door there have been found.
    """
    dx, dy = door.end_x - door.start_x, door.end_y - door.start_y
    x, y = door.start_x - pose[0], door.start_y - pose[1]
    width = math.hypot(dx, dy)
    away = math.hypot(x + 0.5 * dx, y + 0.5 * dy)
    distance = abs(x * dy - y * dx) / width
    if away > MAX_LOOK_DISTANCE or looks_along(door, pose[0], pose[1]):
        return UNKNOWN
    # The opening spans the angle width * distance / away^2: fewer beams than looks tell nothing.
    if width * distance < LOOK_BEAMS * angle_increment * away * away:
        return UNKNOWN
    through = filled = 0
    for k in range(LOOK_BEAMS):
        beyond = _beyond(ranges, angle_min, angle_increment, pose, door, (k + 0.5) / LOOK_BEAMS)
        if math.isnan(beyond):
            return UNKNOWN
        through += beyond > OPENING_DEPTH
        filled += abs(beyond) <= OPENING_DEPTH
    if 4 * filled >= 3 * LOOK_BEAMS:
        return FILLED
    if 2 * through < LOOK_BEAMS:
        return UNKNOWN
    for share in (-JAMB_MARGIN / width, 1.0 + JAMB_MARGIN / width):
        beyond = _beyond(ranges, angle_min, angle_increment, pose, door, share)
        if not beyond > -OPENING_DEPTH:
            return UNKNOWN
    return OPEN


@kernel
def looks_along(door: Any, x: float, y: float) -> bool:
    """Whether who stands at (x, y) looks along the wall of a door, and so cannot judge it."""
    dx, dy = door.end_x - door.start_x, door.end_y - door.start_y
    x, y = door.start_x - x, door.start_y - y
    away = math.hypot(x + 0.5 * dx, y + 0.5 * dy)
    distance = abs(x * dy - y * dx) / math.hypot(dx, dy)
    return bool(distance < max(MIN_LINE_DISTANCE, MIN_INCIDENCE_COSINE * away))


@kernel
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
    angle = math.atan2(y, x) - pose[2] - angle_min
    angle -= 2.0 * math.pi * math.floor(angle / (2.0 * math.pi))
    beam = int(angle / angle_increment + 0.5)
    return ranges[beam] - math.hypot(x, y) if beam < len(ranges) else math.nan
