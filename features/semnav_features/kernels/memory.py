"""Joins the walls and doors of many scans in one frame."""

from __future__ import annotations

import math
from typing import Any, TypeAlias

import numpy as np

from semnav_features.frames import FloatArray, Pose
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.door_memory import (
    door_counts,
    doubt_unseen_doors,
    looks_along,
    remember_door,
)
from semnav_features.kernels.drift import PRIOR, corrected, with_sighting
from semnav_features.kernels.lanes import WIDTH, bits, first_lanes
from semnav_features.kernels.layout import DOORS, WALLS
from semnav_features.kernels.pass_through import is_passed_by_beams
from semnav_features.kernels.past_views import FREE, VIEWS, look_from, note_view
from semnav_features.kernels.remembered import (
    HITS,
    VARIANCE,
    Ends,
    ends_of_wall,
    ends_of_walls,
    lowest_bit,
    place_for_new,
    write_ends,
)
from semnav_features.kernels.rows import put_row
from semnav_features.kernels.standing import (
    MAX_MOVING_LENGTH,
    has_standing_jambs,
    jambs_of,
    standing_part,
    stands,
)

COUNTERS = ("walls", "doors", "scans", "views", "viewed")
"""Fields of `MEMORY_STATE` that are zero while nothing is remembered."""

MEMORY_STATE = np.dtype(
    [(name, "i8") for name in COUNTERS] + [("narrowest", "f8"), ("widest", "f8")]
)
"""How many entries of the walls and of the doors are used, how many scans were added, how many of
them were kept as views, the scan of the newest view, and the least and the largest width of a door,
metres; shape (1,)."""

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


Memory: TypeAlias = tuple[Any, Any, Any, Any]
"""`SceneMemory.arrays`."""


@kernel
def remember(
    walls: Any,
    doors: Any,
    counts: Any,
    ranges: FloatArray,
    angle_min: float,
    angle_increment: float,
    pose: tuple[float, float, float],
    memory: Memory,
) -> None:
    """Add one scan to the memory, without what stands where earlier views passed.

    Args:
        walls: the scan's walls (`layout.WALL`), lidar frame.
        doors: its doors (`layout.DOOR`).
        counts: entries used, by kind.
        ranges: of the scan, metres.
        angle_min: of the scan, radians.
        angle_increment: of the scan, radians.
        pose: of the lidar in the memory's frame.
        memory: `SceneMemory.arrays`, changed in place.
    """
    known_walls, known_doors, state, views = memory
    used, seen, frame = state[0], views[0], frame_of(pose)
    for i in range(counts[WALLS]):
        wall = placed(walls[i], frame)
        if stands(wall, used.views, seen):
            wall = standing_part(wall, used.views, seen)
            used.walls = remember_wall(wall, known_walls, used.walls)
    for i in range(counts[DOORS]):
        door = placed(doors[i], frame)
        if has_standing_jambs(door, used.views, seen):
            confidence = doors[i].confidence
            used.doors = remember_door(door, confidence, known_doors, used.doors)
    doubt_unseen_doors(
        ranges, angle_min, angle_increment, pose, known_doors[: used.doors], used.views, seen
    )
    first = used.scans % WALL_CHECK_PERIOD  # each scan looks at another eighth of the walls
    for k in range(first, used.walls, WALL_CHECK_PERIOD):
        doubt_passed_wall(ranges, angle_min, angle_increment, pose, known_walls, k)
    if note_view(ranges, angle_min, angle_increment, pose, used, seen):
        forget_passed(memory)
    used.scans += 1


@kernel
def relocate(walls: Any, counts: Any, pose: Pose, memory: Memory) -> Pose:
    """The pose of the lidar, corrected by the remembered walls that the scan shows again.

    Args:
        walls: the scan's walls (`layout.WALL`), lidar frame.
        counts: entries used, by kind.
        pose: of the lidar by odometry, in the memory's frame.
        memory: as in `remember`.
    """
    known, _, state, _ = memory
    used, sums, frame = state[0].walls, PRIOR, frame_of(pose)
    for i in range(counts[WALLS]):
        sums = with_sighting(placed(walls[i], frame), known, used, pose, sums)
    return corrected(pose, sums)


@kernel
def forget_passed(memory: Memory) -> None:
    """Forget short walls and doors where the newest view passes, and ends of long walls.

    A view along the wall of a door tells nothing of its jambs: it grazes them.
    """
    walls, doors, state, views = memory
    used, seen = state[0], views[0]
    newest = (used.views - 1) % VIEWS
    for k in range(used.walls):
        x, y, x2, y2 = ends_of_wall(walls, k)
        dx, dy = x2 - x, y2 - y
        if walls[HITS, k] == 0.0:
            continue
        if dx * dx + dy * dy > MAX_MOVING_LENGTH**2:
            write_ends(walls, k, standing_part((x, y, x2, y2), used.views, seen))
            continue
        passed = True
        for share in (0.5, 0.2, 0.8):
            passed &= look_from(x + share * dx, y + share * dy, newest, seen) == FREE
        if passed:
            walls[HITS, k] = 0.0
    for k in range(used.doors):
        door = doors[k]
        place = seen.places[newest]
        if door.log_odds <= 0.0 or looks_along(door, place[0], place[1]):
            continue
        first, last = jambs_of((door.start_x, door.start_y, door.end_x, door.end_y))
        if (
            look_from(first[0], first[1], newest, seen) == FREE
            or look_from(last[0], last[1], newest, seen) == FREE
        ):
            door.log_odds = 0.0


@kernel
def doubt_passed_wall(
    ranges: FloatArray,
    angle_min: float,
    angle_increment: float,
    pose: tuple[float, float, float],
    walls: FloatArray,
    k: int,
) -> None:
    """Take sightings from a wall that the beams of a scan pass through.

    Such a wall was a person who walked on, or lies where odometry has drifted since.

    Args:
        ranges: of the scan, metres, shape (n,).
        angle_min: of the scan, radians.
        angle_increment: of the scan, radians.
        pose: of the lidar in the memory's frame.
        walls: the remembered walls, shape (`WALL_ROWS`, room), changed in place.
        k: which of them.
    """
    hits, ends = walls[HITS, k], ends_of_wall(walls, k)
    if hits > 0.0 and is_passed_by_beams(ranges, angle_min, angle_increment, pose, ends):
        walls[HITS, k] = max(min(hits, MAX_WEIGHING_SIGHTINGS) - PASSED_WALL_LOSS, 0.0)


@kernel
def how_many_count(memory: Memory) -> tuple[int, int]:
    """How many of the remembered walls and doors count."""
    walls, doors, state, _ = memory
    used = state[0]
    wall_total, door_total = 0, 0
    for k in range(used.walls):
        wall_total += walls[HITS, k] >= MIN_WALL_SIGHTINGS
    for k in range(used.doors):
        door_total += door_counts(doors[: used.doors], k, used)
    return wall_total, door_total


@kernel
def what_counts(memory: Memory) -> tuple[FloatArray, FloatArray, FloatArray]:
    """The remembered walls and doors that count.

    Returns:
        Ends of the walls, shape (n, 4), and of the doors, shape (m, 4), metres; and of each door
        the log-odds that it is one and how often it was seen, shape (m, 2).
    """
    walls, doors, state, _ = memory
    used = state[0]
    wall_ends, door_ends = np.empty((used.walls, 4)), np.empty((used.doors, 4))
    beliefs = np.empty((used.doors, 2))
    n = m = 0
    for k in range(used.walls):
        if walls[HITS, k] >= MIN_WALL_SIGHTINGS:
            put_row(wall_ends, n, ends_of_wall(walls, k))
            n += 1
    for k in range(used.doors):
        if door_counts(doors[: used.doors], k, used):
            door = doors[k]
            put_row(door_ends, m, (door.start_x, door.start_y, door.end_x, door.end_y))
            put_row(beliefs, m, (door.log_odds, float(door.hits)))
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
def remember_wall(wall: Ends, known: FloatArray, used: int) -> int:
    """Fuse a wall with the first remembered one that it continues or repeats, or add it.

    Such a wall faces the same side, lies on the same line, and overlaps it or ends just beside it.

    Args:
        wall: in the memory's frame.
        known: the remembered walls, shape (`WALL_ROWS`, room), changed in place.
        used: how many of its columns were used before.

    Returns:
        Columns used afterwards.
    """
    x1, y1, x2, y2 = wall
    length = math.hypot(x2 - x1, y2 - y1)
    if length < 1e-6:
        return used
    along = (x2 - x1) / length, (y2 - y1) / length
    for start in range(0, used, WIDTH):
        candidates = _nearly_in_line(wall, along, known, start, used)
        while candidates != 0:
            k = start + int(np.int64(lowest_bit(candidates)))
            candidates &= candidates - np.uint64(1)
            old = ends_of_wall(known, k)
            if _on_one_line(old, wall):
                _fuse(wall, known, k)
                return used
    place, used = place_for_new(known[HITS], used)
    write_ends(known, place, wall)
    known[HITS, place], known[VARIANCE, place] = 1.0, 0.0
    return used


@kernel
def _nearly_in_line(
    wall: Ends, along: tuple[float, float], known: FloatArray, start: int, used: int
) -> np.uint64:
    """Which of the eight remembered walls from `start` on may be on one line with a wall.

    Returns:
        Bit i is set if wall `start + i` has nearly the direction `along`, is not too far to one
        side of the wall, and overlaps it, or nearly so.
    """
    x1, y1, x2, y2 = wall
    ux, uy = along
    start_x, start_y, end_x, end_y = ends_of_walls(known, start)
    dx, dy = end_x - start_x, end_y - start_y
    dot, square = dx * ux + dy * uy, dx * dx + dy * dy
    aligned = (dot > 0.0) & (dot * dot > SAME_DIRECTION_COSINE**2 * square)
    first = (x1 - start_x) * dy - (y1 - start_y) * dx
    last = (x2 - start_x) * dy - (y2 - start_y) * dx
    nearest = MAX_END_OFFSET**2 * square
    beside = (first * last > 0.0) & (first * first > nearest) & (last * last > nearest)
    # A gap along the line, times the length; the length is at most half of 1 + its square.
    gap = 0.55 * SAME_LINE_GAP * (1.0 + square)
    before = (x2 - start_x) * dx + (y2 - start_y) * dy + gap < 0.0
    behind = (x1 - start_x) * dx + (y1 - start_y) * dy > square + gap
    aside = bits(beside | before | behind)
    return np.uint64(bits(aligned & first_lanes(used - start)) & ~aside)


@kernel
def _on_one_line(old: Ends, wall: Ends) -> bool:
    """Whether two nearly parallel walls meet, and lie on one line where they do.

    `first` and `last` are the ends of the new wall along the old one, and `middle` is the centre of
    what they share, or of the gap between them; there the distance across is measured.
    """
    x1, y1, x2, y2 = wall
    start_x, start_y, end_x, end_y = old
    dx, dy = end_x - start_x, end_y - start_y
    length = math.hypot(dx, dy)
    first = ((x1 - start_x) * dx + (y1 - start_y) * dy) / length
    last = ((x2 - start_x) * dx + (y2 - start_y) * dy) / length
    if first > length + SAME_LINE_GAP or last < -SAME_LINE_GAP:
        return False
    middle = 0.5 * (max(first, 0.0) + min(last, length))
    share = (middle - first) / max(last - first, 1e-9)
    x, y = x1 + share * (x2 - x1), y1 + share * (y2 - y1)
    return bool(abs((x - start_x) * dy - (y - start_y) * dx) < SAME_LINE_OFFSET * length)


@kernel
def _fuse(wall: Ends, known: FloatArray, k: int) -> None:
    """Fuse a wall with remembered wall `k`, and note how far it lies from what they became."""
    hits = min(known[HITS, k], MAX_WEIGHING_SIGHTINGS)
    fused = _fused(ends_of_wall(known, k), hits, wall)
    write_ends(known, k, fused)
    known[HITS, k] += 1.0
    known[VARIANCE, k] += (_square_distance(wall, fused) - known[VARIANCE, k]) / (hits + 1.0)


@kernel
def _square_distance(wall: Ends, line: Ends) -> float:
    """Mean square distance of both ends of a wall from the line of another, m^2."""
    x1, y1, x2, y2 = wall
    start_x, start_y, end_x, end_y = line
    dx, dy = end_x - start_x, end_y - start_y
    first = (x1 - start_x) * dy - (y1 - start_y) * dx
    last = (x2 - start_x) * dy - (y2 - start_y) * dx
    return 0.5 * (first * first + last * last) / (dx * dx + dy * dy)


@kernel
def _fused(old: Ends, hits: float, wall: Ends) -> Ends:
    """A wall fused with an old one: their mean line by length and sightings, over both extents.

    (ux, uy) is the mean direction and (x, y) the mean of the midpoints; the ends of both walls are
    projected on that line and the outermost ones kept.
    """
    x1, y1, x2, y2 = wall
    start_x, start_y, end_x, end_y = old
    dx, dy = end_x - start_x, end_y - start_y
    weight = hits * math.hypot(dx, dy)
    share = weight / (weight + math.hypot(x2 - x1, y2 - y1))
    ux, uy = hits * dx + x2 - x1, hits * dy + y2 - y1
    norm = math.hypot(ux, uy)
    ux, uy = ux / norm, uy / norm
    x = 0.5 * (share * (start_x + end_x) + (1.0 - share) * (x1 + x2))
    y = 0.5 * (share * (start_y + end_y) + (1.0 - share) * (y1 + y2))
    first = min((start_x - x) * ux + (start_y - y) * uy, (x1 - x) * ux + (y1 - y) * uy)
    last = max((end_x - x) * ux + (end_y - y) * uy, (x2 - x) * ux + (y2 - y) * uy)
    return x + first * ux, y + first * uy, x + last * ux, y + last * uy
