"""Past views: how far the scanner could see from places where it was a moment ago.

What stands where an earlier view passed is neither wall nor jamb: it is a person, or the leaf of a
door. So is what stood in the way of a view and does not stand there now. A view is kept for each
metre or so, and every two seconds where the robot is slow; the newest is widened while it stands.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from semnav_features.frames import FloatArray, Pose
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.heading import rough_angle

VIEWS = 4
"""Number of views that are kept; a new one replaces the oldest."""

SECTORS = 720
"""Sectors of a full turn into which a view is divided, half a degree each."""

SECTOR_ANGLE = 2.0 * math.pi / SECTORS

PAST_VIEWS = np.dtype([("places", "f8", (VIEWS, 2)), ("ranges", "f4", (VIEWS, SECTORS))])
"""Views; shape (1,). Where the lidar was, metres, and the shortest range in each sector, metres: 0
where no beam was, infinite where none came back. Places and directions are in the frame of the
memory."""

VIEW_SPACING = 0.7
"""Distance driven after which another view is kept, metres."""

STANDING_DISTANCE = 0.03
"""Distance from the place of a view within which scans widen it, metres."""

VIEW_PATIENCE = 30
"""Scans after which another view is kept where the robot has moved on less, but does not stand at
the newest: so that a robot that waits sees that somebody has gone."""

VIEW_PERIOD = 4
"""A robot that stands widens its view at each fourth scan: that spreads the work over scans."""

FREE_DEPTH = 0.3
"""Distance behind a place that a view must reach for the place to have been free, metres."""

FREE_HALF_WIDTH = 0.06
"""Half the width of what a view must reach past, around the place, metres; at least the sectors on
either side count as well. So neither drift nor noise opens the edge of a wall."""

UNSEEN, HIDDEN, NO_RETURN, SOLID, FREE = range(5)
"""What views tell of a place, the stronger the later: no beam went there; something stood before
it; beams went there and none came back, so it was free or did not reflect; a beam ended there; the
beams passed it, with some room around it."""


@kernel
def note_view(
    ranges: FloatArray, angle_min: float, angle_increment: float, pose: Pose, used: Any, views: Any
) -> bool:
    """Keep a scan as a view if the lidar has moved on, or widen the newest view if it stands.

    Returns:
        Whether it did either.

    Args:
        ranges: of the scan, metres, shape (n,); +inf for no return.
        angle_min: of the scan, radians.
        angle_increment: of the scan, radians.
        pose: of the lidar in the memory's frame.
        used: an entry of `memory.MEMORY_STATE`: `views` counts the views that were kept so far,
            and `viewed` is the scan of the newest.
        views: `PAST_VIEWS`, changed in place.
    """
    newest = (used.views - 1) % VIEWS
    moved = math.inf
    if used.views > 0:
        moved = math.hypot(pose[0] - views.places[newest, 0], pose[1] - views.places[newest, 1])
    is_late = moved > STANDING_DISTANCE and used.scans - used.viewed >= VIEW_PATIENCE
    if moved >= VIEW_SPACING or is_late:
        newest = used.views % VIEWS
        used.views += 1
        used.viewed = used.scans
        views.places[newest, 0], views.places[newest, 1] = pose[0], pose[1]
        views.ranges[newest, :] = 0.0
    elif moved > STANDING_DISTANCE or used.scans % VIEW_PERIOD != 0:
        return False
    _widen(ranges, pose[2] + angle_min, angle_increment, views.ranges[newest])
    return True


@kernel
def _widen(ranges: FloatArray, start: float, increment: float, view: FloatArray) -> None:
    """Let a view reach as far as a scan does, where the scan reaches farther.

    The shortest of the beams in a sector counts; each beam covers the sectors up to halfway to its
    neighbours.
    """
    sector, least = -1, math.inf
    for i in range(len(ranges)):
        first = math.floor((start + (i - 0.5) * increment) / SECTOR_ANGLE)
        last = math.floor((start + (i + 0.5) * increment) / SECTOR_ANGLE)
        if i == 0:
            sector = first
        for k in range(first, last + 1):
            if k > sector:
                view[sector % SECTORS] = max(view[sector % SECTORS], least)
                sector, least = k, math.inf
            least = min(least, ranges[i] if ranges[i] > 0.0 else 0.0)  # NaN is no view
    if sector >= 0:
        view[sector % SECTORS] = max(view[sector % SECTORS], least)


@kernel
def look_back(x: float, y: float, count: int, views: Any) -> int:
    """The strongest of what earlier views tell of a place, see `FREE`.

    Args:
        x: of the place in the memory's frame, metres.
        y: the same.
        count: of the views that were kept so far.
        views: `PAST_VIEWS`.
    """
    found = UNSEEN
    for v in range(min(count, VIEWS)):
        found = max(found, look_from(x, y, v, views))
        if found == FREE:
            break
    return found


@kernel
def mark_maybe_free(
    x: FloatArray, y: FloatArray, count: int, views: Any, maybe: NDArray[np.bool_]
) -> None:
    """Write of which places `look_back` may say `FREE`: a quick test of many at once.

    The sector at which it looks is one of those that the views must pass: an angle to a thirtieth
    of a sector names the sector of the place, or one beside it.

    Args:
        x: of the places in the memory's frame, to 1 micrometre, metres, shape (n,).
        y: the same.
        count: of the views that were kept so far.
        views: `PAST_VIEWS`.
        maybe: written, shape (n,).
    """
    maybe[:] = False
    squared, sectors = np.empty(len(maybe)), np.empty(len(maybe), np.int32)
    for v in range(min(count, VIEWS)):
        from_x, from_y, ranges = views.places[v, 0], views.places[v, 1], views.ranges[v]
        for i in range(len(maybe)):  # apart from the look-up, so that it takes many at once
            dx, dy = x[i] - from_x, y[i] - from_y
            sector: Any = np.int32(rough_angle(dx, dy) * (1.0 / SECTOR_ANGLE) + SECTORS) - SECTORS
            sector = sector + SECTORS if sector < 0 else sector
            sectors[i] = min(max(sector, 0), SECTORS - 1)  # also where x is not finite
            squared[i] = dx * dx + dy * dy
        for i in range(len(maybe)):
            least = ranges[sectors[i]] - (FREE_DEPTH - 1e-5)
            maybe[i] |= (least > 0.0) & (least * least > squared[i])


@kernel
def may_be_free(x: float, y: float, v: int, views: Any) -> bool:
    """Whether view `v` may have passed a place, a quick test; see `mark_maybe_free`."""
    dx, dy = x - views.places[v, 0], y - views.places[v, 1]
    sector = int(rough_angle(dx, dy) * (1.0 / SECTOR_ANGLE) + SECTORS) % SECTORS
    least = views.ranges[v, sector] - (FREE_DEPTH - 1e-5)
    return bool(least > 0.0 and least * least > dx * dx + dy * dy)


@kernel
def look_from(x: float, y: float, v: int, views: Any) -> int:
    """What view `v` tells of a place; see `look_back`."""
    dx, dy = x - views.places[v, 0], y - views.places[v, 1]
    distance, ranges = math.hypot(dx, dy), views.ranges[v]
    sector = math.floor(math.atan2(dy, dx) / SECTOR_ANGLE)
    if ranges[sector % SECTORS] == 0.0:
        return UNSEEN
    beside = 1 + int(FREE_HALF_WIDTH / (SECTOR_ANGLE * max(distance, FREE_HALF_WIDTH)))
    passed, ended, farthest = True, False, 0.0
    for k in range(sector - beside, sector + beside + 1):
        reach = ranges[k % SECTORS]
        passed &= reach > distance + FREE_DEPTH
        ended |= abs(reach - distance) <= FREE_DEPTH
        farthest = max(farthest, reach)
    if passed:
        return FREE if farthest < math.inf else NO_RETURN
    return SOLID if ended else HIDDEN
