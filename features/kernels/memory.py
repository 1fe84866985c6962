"""Joins the walls and doors of many scans in one frame."""

from __future__ import annotations

import math
from typing import Any, TypeAlias

import numpy as np

from semnav_env.features.frames import FloatArray, Pose
from semnav_env.features.kernels.compiling import kernel
from semnav_env.features.kernels.door_memory import door_counts, doubt_unseen_doors, remember_door
from semnav_env.features.kernels.drift import PRIOR, corrected, with_sighting
from semnav_env.features.kernels.layout import DOORS, WALLS
from semnav_env.features.kernels.pass_through import is_passed_by_beams
from semnav_env.features.kernels.remembered import Ends, place_for_new

REMEMBERED_WALL = np.dtype(
    [(name, "f8") for name in ("start_x", "start_y", "end_x", "end_y")] + [("hits", "i8")]
)
"""A remembered wall: its ends, and how often it was seen."""

COUNTERS = np.dtype([("walls", "i8"), ("doors", "i8"), ("scans", "i8")])
"""How many entries of the walls and of the doors are used, and how many scans were added; an array
of shape (1,)."""

MIN_WALL_SIGHTINGS = 2
"""A wall counts from this many sightings on."""

MAX_WEIGHING_SIGHTINGS = 10
"""Older sightings together weigh no more than this many: odometry drifts."""

WALL_CHECK_PERIOD = 8
"""Each scan asks an eighth of the walls, in turn, whether its beams pass through them: that spreads
the work over scans."""

PASSED_WALL_LOSS = 3
"""Sightings that a wall loses when the beams of a scan pass through it."""

SAME_DIRECTION_COSINE = math.cos(math.radians(8.0))
"""Cosine of the largest angle between two sightings of one wall."""

SAME_LINE_OFFSET = 0.15
"""Largest distance across the line between two sightings of one wall, metres."""

SAME_LINE_GAP = 0.3
"""Largest gap along the line between two sightings of one wall, metres: nothing passes through."""

MAX_END_OFFSET = SAME_LINE_OFFSET + 0.1 * SAME_LINE_GAP
"""A wall is not on a line if both of its ends lie farther than this to one side of it, metres. The
middle of the gap, where the offset counts, may lie half the gap beyond an end, at 8 degrees."""

Frame: TypeAlias = tuple[float, float, float, float]
"""Where a frame is in its parent: x, y in metres, cosine and sine of its heading."""


@kernel
def remember(
    walls: Any,
    doors: Any,
    counts: Any,
    ranges: FloatArray,
    angle_min: float,
    angle_increment: float,
    pose: tuple[float, float, float],
    memory: tuple[Any, Any, Any],
) -> None:
    """Add one scan to the memory.

    Args:
        walls: the scan's walls (`layout.WALL`), lidar frame.
        doors: its doors (`layout.DOOR`).
        counts: entries used, by kind.
        ranges: of the scan, metres.
        angle_min: of the scan, radians.
        angle_increment: of the scan, radians.
        pose: of the lidar in the memory's frame.
        memory: arrays of `REMEMBERED_WALL`, `REMEMBERED_DOOR` and `COUNTERS`, changed in place.
    """
    known_walls, known_doors, counters = memory
    used, frame = counters[0], frame_of(pose)
    for i in range(counts[WALLS]):
        used.walls = remember_wall(placed(walls[i], frame), known_walls, used.walls)
    for i in range(counts[DOORS]):
        door = doors[i]
        used.doors = remember_door(placed(door, frame), door.confidence, known_doors, used.doors)
    doubt_unseen_doors(ranges, angle_min, angle_increment, pose, known_doors[: used.doors])
    first = used.scans % WALL_CHECK_PERIOD  # each scan looks at another eighth of the walls
    doubt_passed_walls(
        ranges,
        angle_min,
        angle_increment,
        pose,
        known_walls[first : used.walls : WALL_CHECK_PERIOD],
    )
    used.scans += 1


@kernel
def relocate(walls: Any, counts: Any, pose: Pose, memory: tuple[Any, Any, Any]) -> Pose:
    """The pose of the lidar, corrected by the remembered walls that the scan shows again.

    Args:
        walls: the scan's walls (`layout.WALL`), lidar frame.
        counts: entries used, by kind.
        pose: of the lidar by odometry, in the memory's frame.
        memory: as in `remember`.
    """
    known, _, counters = memory
    known, sums, frame = known[: counters[0].walls], PRIOR, frame_of(pose)
    for i in range(counts[WALLS]):
        sums = with_sighting(placed(walls[i], frame), known, pose, sums)
    return corrected(pose, sums)


@kernel
def doubt_passed_walls(
    ranges: FloatArray,
    angle_min: float,
    angle_increment: float,
    pose: tuple[float, float, float],
    walls: Any,
) -> None:
    """Take sightings from walls that the beams of a scan pass through.

    Such walls were people who walked on, or lie where odometry has drifted since.

    Args:
        ranges: of the scan, metres, shape (n,).
        angle_min: of the scan, radians.
        angle_increment: of the scan, radians.
        pose: of the lidar in the memory's frame.
        walls: `REMEMBERED_WALL`, changed in place.
    """
    for k in range(len(walls)):
        wall = walls[k]
        if wall.hits > 0 and is_passed_by_beams(ranges, angle_min, angle_increment, pose, wall):
            wall.hits = max(min(wall.hits, MAX_WEIGHING_SIGHTINGS) - PASSED_WALL_LOSS, 0)


@kernel
def wall_counts(walls: Any, k: int) -> bool:
    """Whether wall `k` of the remembered ones was seen often enough."""
    return bool(walls[k].hits >= MIN_WALL_SIGHTINGS)


@kernel
def how_many_count(walls: Any, doors: Any, counters: Any) -> tuple[int, int]:
    """How many of the remembered walls and doors count."""
    used = counters[0]
    wall_total, door_total = 0, 0
    for k in range(used.walls):
        wall_total += wall_counts(walls, k)
    for k in range(used.doors):
        door_total += door_counts(doors[: used.doors], k)
    return wall_total, door_total


@kernel(counts_references=True)
def what_counts(walls: Any, doors: Any, counters: Any) -> tuple[FloatArray, FloatArray, FloatArray]:
    """The remembered walls and doors that count.

    Returns:
        Ends of the walls, shape (n, 4), and of the doors, shape (m, 4), metres; and of each door
        the log-odds that it is one and how often it was seen, shape (m, 2).
    """
    used = counters[0]
    wall_ends, door_ends = np.empty((used.walls, 4)), np.empty((used.doors, 4))
    beliefs = np.empty((used.doors, 2))
    n = m = 0
    for k in range(used.walls):
        if wall_counts(walls, k):
            wall = walls[k]
            wall_ends[n] = wall.start_x, wall.start_y, wall.end_x, wall.end_y
            n += 1
    for k in range(used.doors):
        if door_counts(doors[: used.doors], k):
            door = doors[k]
            door_ends[m] = door.start_x, door.start_y, door.end_x, door.end_y
            beliefs[m] = door.log_odds, float(door.hits)
            m += 1
    return wall_ends[:n], door_ends[:m], beliefs[:m]


@kernel
def frame_of(pose: Pose) -> Frame:
    """A pose with cosine and sine in place of its heading."""
    return pose[0], pose[1], math.cos(pose[2]), math.sin(pose[2])


@kernel
def placed(item: Any, frame: Frame) -> Ends:
    """The ends of a wall or door, moved from a frame to the frame's parent."""
    x, y, c, s = frame
    x1, y1, x2, y2 = item.start_x, item.start_y, item.end_x, item.end_y
    return x + c * x1 - s * y1, y + s * x1 + c * y1, x + c * x2 - s * y2, y + s * x2 + c * y2


@kernel
def remember_wall(wall: Ends, memory: Any, used: int) -> int:
    """Fuse a wall with the first remembered one that it continues or repeats, or add it.

    Such a wall faces the same side, lies on the same line, and overlaps it or ends just beside it.

    Args:
        wall: in the memory's frame.
        memory: `REMEMBERED_WALL` array, changed in place.
        used: entries used before.

    Returns:
        Entries used afterwards.
    """
    x1, y1, x2, y2 = wall
    length = math.hypot(x2 - x1, y2 - y1)
    if length < 1e-6:
        return used
    ux, uy = (x2 - x1) / length, (y2 - y1) / length
    for k in range(used):
        old = memory[k]
        dx, dy = old.end_x - old.start_x, old.end_y - old.start_y
        dot, square = dx * ux + dy * uy, dx * dx + dy * dy
        aligned = (dot > 0.0) & (dot * dot > SAME_DIRECTION_COSINE**2 * square)
        first = (x1 - old.start_x) * dy - (y1 - old.start_y) * dx
        last = (x2 - old.start_x) * dy - (y2 - old.start_y) * dx
        nearest = MAX_END_OFFSET**2 * square
        beside = (first * last > 0.0) & (first * first > nearest) & (last * last > nearest)
        # One branch, which is seldom taken: each of these tests alone would be hard to predict.
        if (aligned & (not beside)) and _on_one_line(old, wall):
            _fuse_wall(old, wall)
            return used
    place, used = place_for_new(memory, used)
    new = memory[place]
    new.start_x, new.start_y, new.end_x, new.end_y = wall
    new.hits = 1
    return used


@kernel
def _on_one_line(old: Any, wall: Ends) -> bool:
    """Whether two nearly parallel walls meet, and lie on one line where they do.

    `first` and `last` are the ends of the new wall along the old one, and `middle` is the centre of
    what they share, or of the gap between them; there the distance across is measured.
    """
    x1, y1, x2, y2 = wall
    dx, dy = old.end_x - old.start_x, old.end_y - old.start_y
    length = math.hypot(dx, dy)
    first = ((x1 - old.start_x) * dx + (y1 - old.start_y) * dy) / length
    last = ((x2 - old.start_x) * dx + (y2 - old.start_y) * dy) / length
    if first > length + SAME_LINE_GAP or last < -SAME_LINE_GAP:
        return False
    middle = 0.5 * (max(first, 0.0) + min(last, length))
    share = (middle - first) / max(last - first, 1e-9)
    x, y = x1 + share * (x2 - x1), y1 + share * (y2 - y1)
    return bool(abs((x - old.start_x) * dy - (y - old.start_y) * dx) < SAME_LINE_OFFSET * length)


@kernel
def _fuse_wall(old: Any, wall: Ends) -> None:
    """Fuse a wall with an old one: their mean line by length and sightings, over both extents.

    (ux, uy) is the mean direction and (x, y) the mean of the midpoints; the ends of both walls are
    projected on that line and the outermost ones kept.
    """
    x1, y1, x2, y2 = wall
    dx, dy = old.end_x - old.start_x, old.end_y - old.start_y
    hits = min(old.hits, MAX_WEIGHING_SIGHTINGS)
    weight = hits * math.hypot(dx, dy)
    share = weight / (weight + math.hypot(x2 - x1, y2 - y1))
    ux, uy = hits * dx + x2 - x1, hits * dy + y2 - y1
    norm = math.hypot(ux, uy)
    ux, uy = ux / norm, uy / norm
    x = 0.5 * (share * (old.start_x + old.end_x) + (1.0 - share) * (x1 + x2))
    y = 0.5 * (share * (old.start_y + old.end_y) + (1.0 - share) * (y1 + y2))
    first = min((old.start_x - x) * ux + (old.start_y - y) * uy, (x1 - x) * ux + (y1 - y) * uy)
    last = max((old.end_x - x) * ux + (old.end_y - y) * uy, (x2 - x) * ux + (y2 - y) * uy)
    old.start_x, old.start_y = x + first * ux, y + first * uy
    old.end_x, old.end_y = x + last * ux, y + last * uy
    old.hits += 1
