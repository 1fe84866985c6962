"""Surveys a corridor: puts an axis through it and follows its sides.

In the frame of the axis x runs along the corridor and y to its left; the robot is at x = 0.
"""

from __future__ import annotations

import math
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.corridor_rays import (
    DOORWAY_DEPTH,
    MAX_SIDE_DISTANCE,
    PROBE_SPACING,
    PROBED_BEHIND,
    farthest_way,
    in_frame,
    probe,
    shift,
    typical_distances,
    way_ahead,
    way_back,
)
from semnav_features.kernels.heading import prevailing_heading
from semnav_features.kernels.narrowings import is_narrowing, leads_into_arm
from semnav_features.kernels.rows import put_row
from semnav_features.kernels.selection import finite_values, value_of_rank
from semnav_features.kernels.side_openings import MAX_OPENINGS, OPENING, note_opening

PROBED_AHEAD = 40.0
"""How far ahead of the robot the sides are probed, metres."""

PROBE_COUNT = round((PROBED_BEHIND + PROBED_AHEAD) / PROBE_SPACING) + 1
"""Number of probes of a side."""

MAX_SIDE_STEP = 1.5
"""Farthest that a side may step back and still be the side, metres; more is an opening or a gap."""

MAX_LEVEL_STEP = 0.05
"""A side runs on if it steps back by less than this from one probe to the next, metres."""

RECENT_LENGTH = 2.0
"""Whether a side steps back is judged by where it lay on this length before, metres."""

Frame: TypeAlias = tuple[float, float, float]
"""Pose of an axis or a robot: x, y in metres and heading in radians."""


@kernel
def survey(
    walls: FloatArray,
    doors: FloatArray,
    certain: NDArray[np.bool_],
    x: float,
    y: float,
    heading: float,
) -> tuple[Frame, float, float, FloatArray, np.ndarray]:
    """Find axis, sides, openings and end of the corridor that a robot at (x, y, heading) stands in.

    Args:
        walls: x1, y1, x2, y2, metres, shape (n, 4).
        doors: the same, shape (m, 4). A door closes its gap, unless the robot stands in it, or it
            is not certain and the corridor only narrows there, or an arm of it begins.
        certain: which doors are known to be doors, shape (m,).
        x: of the robot, metres.
        y: the same.
        heading: of the robot, radians.

    Returns:
        The frame of the axis; half the typical width, metres; where the corridor ends along the
        axis; the distance of the left and of the right side at each probe, inf where there is
        none, shape (2, PROBE_COUNT); and the openings, dtype `OPENING`.
    """
    sides, openings = np.empty((2, PROBE_COUNT)), np.empty(MAX_OPENINGS, OPENING)
    pose = x, y, heading
    frame, half_width, end, count = write_survey(walls, doors, certain, pose, sides, openings, 0.0)
    return frame, half_width, end, sides, openings[:count]


@kernel
def write_survey(
    walls: FloatArray,
    doors: FloatArray,
    certain: NDArray[np.bool_],
    pose: Frame,
    sides: FloatArray,
    openings: np.ndarray,
    slack: float,
) -> tuple[Frame, float, float, int]:
    """As `survey`, into arrays; returns frame, half the width, end and the count of openings.

    The `slack` is added to the least lengths of openings, metres.
    """
    solid, axis = axis_heading(walls, doors, certain, pose)
    frame, back, end, left, right, local = axis_along(solid, pose[0], pose[1], axis)
    count, last = 0, PROBE_COUNT
    if math.isfinite(end):
        last = min(PROBE_COUNT, int((end + PROBED_BEHIND) / PROBE_SPACING) + 1)
    for row, sign, usual in ((0, 1.0, left), (1, -1.0, right)):
        raw, side = probe(local, sign, back, last), sides[row]
        count = _follow(raw, local, sign, usual, (back, end), side, openings, count, slack)
    return frame, 0.5 * (left + right), end, count


@kernel
def axis_heading(
    walls: FloatArray, doors: FloatArray, certain: NDArray[np.bool_], pose: Frame
) -> tuple[FloatArray, float]:
    """The walls and doors that bound a corridor, shape (k, 4), and the heading of its axis."""
    solid = _solid(walls, doors, certain, pose)
    return solid, prevailing_heading(solid, len(walls), *pose)


@kernel
def axis_along(
    solid: FloatArray, x: float, y: float, heading: float
) -> tuple[Frame, float, float, float, float, FloatArray]:
    """Find the axis and the end of a corridor, given what `axis_heading` tells.

    Returns:
        The frame of the axis; how far the corridor goes back, and where it ends; the typical
        distances of its left and its right side; and walls and doors in the frame of the axis.
    """
    local = in_frame(solid, x, y, heading)
    offset, straight = way_ahead(local)
    shift(local, offset)
    back = way_back(local)
    left, right = typical_distances(local, back, straight)
    if left < MAX_SIDE_DISTANCE and right < MAX_SIDE_DISTANCE:
        centre = 0.5 * (left - right)
        offset += centre
        shift(local, centre)
        left, right = typical_distances(local, back, straight)
    x, y = x - math.sin(heading) * offset, y + math.cos(heading) * offset
    return (x, y, heading), back, farthest_way(local, left, right), left, right, local


@kernel
def stands_in(door: FloatArray, x: float, y: float, heading: float) -> bool:
    """Whether a robot at (x, y, heading) stands in a doorway, shape (4,), to pass through it."""
    dx, dy = door[2] - door[0], door[3] - door[1]
    length = max(math.hypot(dx, dy), 1e-9)
    along = ((x - door[0]) * dx + (y - door[1]) * dy) / length
    beside = ((x - door[0]) * dy - (y - door[1]) * dx) / length
    across = abs(math.cos(heading) * dx + math.sin(heading) * dy) < math.sqrt(0.5) * length
    return bool(across and 0.0 < along < length and abs(beside) < DOORWAY_DEPTH)


@kernel
def _solid(
    walls: FloatArray, doors: FloatArray, certain: NDArray[np.bool_], pose: Frame
) -> FloatArray:
    """The walls, then the doors that close their gaps (see `survey`), shape (k, 4)."""
    count, room = len(walls), len(walls) + len(doors)
    known, solid = np.empty((room, 4)), np.empty((room, 4))
    for i in range(room):
        put_row(known, i, walls[i] if i < count else doors[i - count])
        put_row(solid, i, known[i])
    for i in range(len(doors)):
        if stands_in(doors[i], *pose):
            continue
        if not certain[i] and _is_hall(doors[i], pose, known):
            continue
        put_row(solid, count, doors[i])
        count += 1
    return solid[:count]


@kernel
def _is_hall(door: FloatArray, pose: Frame, known: FloatArray) -> bool:
    """Whether a perceived door is none: the corridor narrows there, or an arm of it begins."""
    if _is_across(door, pose[2]):
        return is_narrowing(door, known)
    return leads_into_arm(door, known, pose[0], pose[1])


@kernel
def _is_across(door: FloatArray, heading: float) -> bool:
    """Whether a doorway faces a robot with this heading, within 45 degrees."""
    dx, dy = door[2] - door[0], door[3] - door[1]
    along = abs(math.cos(heading) * dx + math.sin(heading) * dy)
    return bool(along < math.sqrt(0.5) * math.hypot(dx, dy))


@kernel
def _follow(
    raw: FloatArray,
    solid: FloatArray,
    sign: float,
    usual: float,
    stretch: tuple[float, float],
    side: FloatArray,
    openings: np.ndarray,
    count: int,
    slack: float,
) -> int:
    """Follow one side along the corridor; note the openings where it steps back.

    `first` is the probe at which the side stepped back, -1 while it is followed; `reference` is
    how far it lay before that.

    Args:
        raw: what the rays to that side met up to the end of the corridor, metres.
        solid: walls and doors in the frame of the axis.
        sign: 1 for the left side, -1 for the right.
        usual: distance of the side where it is not known better, metres.
        stretch: how far the corridor goes back, and where it ends, metres.
        side: written: its distance at each probe; inf where it is not seen, has a gap or an
            opening, and beyond the stretch.
        openings: written, from row `count` on.
        count: of openings so far.
        slack: added to the least lengths of openings, metres.

    Returns:
        How many openings there are now.
    """
    back, end = stretch
    side[:] = np.inf
    first, reference, last = -1, usual, len(raw)
    for k in range(max(0, math.ceil((PROBED_BEHIND - back) / PROBE_SPACING)), last):
        level = k > 0 and side[k - 1] < np.inf and raw[k] < side[k - 1] + MAX_LEVEL_STEP
        if first < 0 and not level:
            reference = _recent(side, k, usual)
        if level or raw[k] <= reference + MAX_SIDE_STEP:
            if first >= 0:
                count = note_opening(
                    solid, sign, first, k, reference, openings, count, False, slack
                )
            first = -1
            side[k] = raw[k]
        elif first < 0:
            first = k
    if first >= 0 and math.isfinite(end):
        count = note_opening(solid, sign, first, last, reference, openings, count, True, slack)
    return count


@kernel
def _recent(side: FloatArray, k: int, usual: float) -> float:
    """Distance of a side just before probe k, metres; `usual` where it was not seen.

    It is the upper quartile, because furniture stands before a side and makes distances too small,
    and because the last probes before an opening may meet the wall that leads out.
    """
    seen = finite_values(side[max(0, k - round(RECENT_LENGTH / PROBE_SPACING)) : k])
    return value_of_rank(seen, 3 * (len(seen) - 1) // 4) if len(seen) > 0 else usual
