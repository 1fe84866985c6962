"""Random starts: free poses in a corridor from which one would tell the way."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from semnav_env.robots import RobotSpec
from semnav_env.rules import Rules
from semnav_env.world.maps.box_room import HAS_ROOM, IS_DOUBTFUL, SolidEdges, box_room, is_inside
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_env.world.maps.placement import (
    MARGIN,
    MAX_DRAWS,
    area_to_start_in,
    exact_room,
    no_free_place,
)
from semnav_features.corridor import Corridor, corridor_at
from semnav_features.frames import FloatArray, Pose, wrap_angle
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.corridor_survey import axis_along, axis_heading, survey

START_TRIES = 200
"""Start poses that are drawn before any free pose is taken."""

LEAST_AHEAD, WIDEST_HALF = 3.0, 1.5
"""A random start has at least this length of corridor ahead, and the corridor is at most this half
width wide, metres, if there is any such place."""

OUTSIDE = 0.6
"""Least distance between a random start and a junction along the corridor, metres: half a body."""

ABEAM, ASIDE = 0.9, 2.0
"""No door's midpoint is within these distances of a random start, along its heading and across it,
metres."""

MAX_TURN = 0.2
"""Largest angle between a random start and the corridor, radians."""

FIRST_DRAWS = 512
"""Random numbers that are drawn at once: most starts take fewer."""

NOTHING_IN_DOUBT = np.empty(0, np.bool_)
"""Whether poses in doubt are free, where there is none."""

FOUND, IS_FULL, NEEDS_DRAWS, IN_DOUBT = 0, 1, 2, 3
"""How `_find_start` ends: with a start; without any free pose; for want of random numbers; at a
pose of which exact geometry must decide whether it is free."""


def sample_start(
    floor_plan: FloorPlan, robot: RobotSpec, rng: np.random.Generator, rules: Rules = Rules()
) -> Pose:
    """A free pose in a corridor, looking along it; not across it, in a junction or by a door.

    Raises:
        ValueError: there is no corridor, or no free pose in the one that was drawn.
    """
    corridors = floor_plan.corridors
    chosen = corridors[rng.integers(len(corridors))] if corridors else None
    region, scene = area_to_start_in(floor_plan, chosen), floor_plan.scene
    where = region.edges, region.bounds, floor_plan.derived(SolidEdges.of).arrays
    sizes = robot.length / 2, robot.width / 2
    sides = scene.wall_ends, scene.door_ends, scene.named_doors
    counted = floor_plan.scene_by(rules.door).door_ends
    before, draws, free = rng.bit_generator.state, rng.random(FIRST_DRAWS), NOTHING_IN_DOUBT
    used = attempts = 0
    while True:
        ending, pose, margin, *now = _find_start(
            draws, free, used, attempts, *where, sizes, sides, counted
        )
        if ending == NEEDS_DRAWS:
            draws = np.append(draws, rng.random(len(draws)))
        elif ending == IN_DOUBT:
            free = np.append(free, exact_room(floor_plan, robot, pose, margin))
        else:
            (used, attempts), free = now, NOTHING_IN_DOUBT
            if ending == IS_FULL or attempts > START_TRIES:
                break
            if not is_in_junction(corridor_at(scene, pose)):  # kept for the commands drawn there
                break
    rng.bit_generator.state = before
    rng.random(used)  # as if no more had been drawn than were needed
    if ending == IS_FULL:
        raise no_free_place(floor_plan, robot, region)
    start: Pose = pose
    return start


def is_in_junction(corridor: Corridor) -> bool:
    """Whether a junction of a corridor lies beside a robot at its frame.

    Its mouth can then be out of the lidar's sight, so that a robot counts it for nothing while who
    knows the plan takes it for the first.
    """
    return any(
        mouth.near < OUTSIDE and mouth.far > -OUTSIDE
        for junction in corridor.junctions
        for mouth in junction.openings
    )


@kernel
def _find_start(
    draws: FloatArray,
    free: NDArray[np.bool_],
    used: int,
    attempts: int,
    region: FloatArray,
    bounds: tuple[float, float, float, float],
    solid: tuple[FloatArray, FloatArray, FloatArray, NDArray[np.int64]],
    sizes: tuple[float, float],
    sides: tuple[FloatArray, FloatArray, NDArray[np.bool_]],
    counted: FloatArray,
) -> tuple[int, Pose, float, int, int]:
    """Find the next start among random poses; behind it a junction may still be.

    A call that ends for want of something is to be repeated with more of it.

    Args:
        draws: random numbers in [0, 1): three for each pose, and one for each that is free.
        free: whether there is room at each pose that is in doubt, in order, as far as known.
        used: how many of the draws were taken for starts before.
        attempts: how many free poses were looked at then.
        region: edges of the corridor, shape (n, 4), metres.
        bounds: of the region: least x, least y, greatest x and greatest y, metres.
        solid: `SolidEdges.arrays`.
        sizes: half the robot's length and half its width, metres.
        sides: what bounds corridors: walls, doors, and which of these are certain, as for `survey`.
        counted: the doors that count, shape (k, 4), metres.

    Returns:
        How it ends; the start, or the pose in doubt and the margin to keep free around it, metres;
        and `used` and `attempts` by then.
    """
    west, south, east, north = bounds
    doubts = misses = 0
    nowhere = 0.0, 0.0, 0.0
    while True:
        if used + 4 > len(draws):
            return NEEDS_DRAWS, nowhere, 0.0, used, attempts
        x, y = _between(west, east, draws[used]), _between(south, north, draws[used + 1])
        heading = _between(-math.pi, math.pi, draws[used + 2])
        used += 3
        has_room = False
        if is_inside(region, x, y):
            room = box_room(*solid, x, y, heading, sizes[0] + MARGIN, sizes[1] + MARGIN)
            if room == IS_DOUBTFUL:
                if doubts == len(free):
                    return IN_DOUBT, (x, y, heading), MARGIN, used, attempts
                doubts += 1
            has_room = room == HAS_ROOM or (room == IS_DOUBTFUL and free[doubts - 1])
        if not has_room:
            misses += 1
            if misses == MAX_DRAWS:
                return IS_FULL, nowhere, 0.0, used, attempts
            continue
        turn, misses = _between(-MAX_TURN, MAX_TURN, draws[used]), 0
        used += 1
        attempts += 1
        if attempts <= START_TRIES and _is_at_door(counted, x, y):
            continue
        solid_here, axis = axis_heading(*sides, (x, y, heading))
        start = x, y, wrap_angle(wrap_angle(axis) + turn)
        if attempts <= START_TRIES:
            if _is_beside_door(counted, start):  # asked first, for it rejects most
                continue
            _, _, end, left, right, _ = axis_along(solid_here, x, y, axis)
            if not leads_on(0.5 * (left + right), end):
                continue
            if _is_in_junction(survey(*sides, x, y, start[2] + math.pi)[-1]):
                continue
        room = box_room(*solid, *start, *sizes)
        if room == IS_DOUBTFUL:
            if doubts == len(free):
                return IN_DOUBT, start, 0.0, used, attempts
            doubts += 1
        if room == HAS_ROOM or (room == IS_DOUBTFUL and free[doubts - 1]):
            return FOUND, start, 0.0, used, attempts


@kernel
def _between(low: float, high: float, share: float) -> float:
    """What `Generator.uniform` makes of a random number in [0, 1)."""
    return low + (high - low) * share


@kernel
def leads_on(half_width: float, end: float) -> bool:
    """Whether a corridor is one that one would speak of, rather than the wall of one; metres."""
    return end > LEAST_AHEAD and half_width < WIDEST_HALF


@kernel
def _is_in_junction(openings: np.ndarray) -> bool:
    """As `is_in_junction`, of openings as `survey` gives them."""
    for k in range(len(openings)):
        if openings[k].near < OUTSIDE and openings[k].far > -OUTSIDE:
            return True
    return False


@kernel
def _is_at_door(doors: FloatArray, x: float, y: float) -> bool:
    """Whether a door lies beside a robot at a place whatever its heading, see `_is_beside_door`."""
    near = 0.999 * min(ABEAM, ASIDE)
    for x1, y1, x2, y2 in doors:
        if ((x1 + x2) / 2 - x) ** 2 + ((y1 + y2) / 2 - y) ** 2 < near * near:
            return True
    return False


@kernel
def _is_beside_door(doors: FloatArray, pose: Pose) -> bool:
    """Whether a door lies right beside a robot at a pose.

    One jamb can then be out of the lidar's sight, so that a robot does not make out what who knows
    the plan counts, or just does not count.
    """
    x, y, heading = pose
    c, s = math.cos(heading), math.sin(heading)
    for x1, y1, x2, y2 in doors:
        dx, dy = (x1 + x2) / 2 - x, (y1 + y2) / 2 - y
        if abs(c * dx + s * dy) < ABEAM and abs(c * dy - s * dx) < ASIDE:
            return True
    return False
