"""What of the walls and doors of a scan stands: earlier views passed where somebody is now."""

from __future__ import annotations

import math
from typing import Any

from semnav_features.frames import Point
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.past_views import (
    FREE,
    HIDDEN,
    NO_RETURN,
    SOLID,
    UNSEEN,
    VIEWS,
    look_back,
    look_from,
    may_be_free,
)
from semnav_features.kernels.remembered import Ends

MAX_MOVING_LENGTH = 1.4
"""Length from which on a wall stands whatever earlier views tell, metres: people and leaves are
shorter."""

END_STEP, END_STEPS, TOUCHING_STEPS = 0.15, 4, 2
"""Length of the pieces at the ends of a long wall that are looked at, metres, and their number: as
long as a person is wide; and how many may touch another wall."""

MAX_CLEAR_DISTANCE = 5.0
"""Distance up to which a wall would have returned the beams of any lidar, metres."""

JAMB_DEPTH = 0.15
"""Distance from the opening at which a jamb is looked at, metres."""


@kernel
def stands(wall: Ends, count: int, views: Any) -> bool:
    """Whether earlier views leave room for a wall: some of it stood there, or it is long.

    Args:
        wall: in the memory's frame.
        count: of the views that were kept so far.
        views: `PAST_VIEWS`.
    """
    x, y, dx, dy = wall[0], wall[1], wall[2] - wall[0], wall[3] - wall[1]
    if dx * dx + dy * dy > MAX_MOVING_LENGTH**2:
        return True
    for share in (0.5, 0.2, 0.8):
        if may_stand(look_back(x + share * dx, y + share * dy, count, views)):
            return True
    return False


@kernel
def standing_part(wall: Ends, count: int, views: Any) -> Ends:
    """A long wall without what stands at its ends where earlier views passed: somebody in line.

    Args:
        wall: in the memory's frame.
        count: of the views that were kept so far.
        views: `PAST_VIEWS`.
    """
    x, y, dx, dy = wall[0], wall[1], wall[2] - wall[0], wall[3] - wall[1]
    length = math.hypot(dx, dy)
    if length <= MAX_MOVING_LENGTH:
        return wall
    step_x, step_y = END_STEP * dx / length, END_STEP * dy / length
    first = _free_steps(x, y, step_x, step_y, count, views)
    last = _free_steps(wall[2], wall[3], -step_x, -step_y, count, views)
    if (first + last + 1) * END_STEP > length:
        return wall
    x2, y2 = wall[2] - last * step_x, wall[3] - last * step_y
    return x + first * step_x, y + first * step_y, x2, y2


@kernel
def _free_steps(x: float, y: float, step_x: float, step_y: float, count: int, views: Any) -> int:
    """How many steps from an end of a wall lead to where no view passed.

    At most `END_STEPS` are looked at. The end itself may touch another wall, before which no view
    passes: then `TOUCHING_STEPS` are passed over, and more of what follows must be free.
    """
    for skipped, least in ((0, 1), (TOUCHING_STEPS, END_STEPS - 1)):
        steps = skipped
        while steps < skipped + END_STEPS and _is_free(
            x + (steps + 0.5) * step_x, y + (steps + 0.5) * step_y, count, views
        ):
            steps += 1
        if steps - skipped >= least:
            return steps
    return 0


@kernel
def _is_free(x: float, y: float, count: int, views: Any) -> bool:
    """Whether an earlier view passed a place.

    A view without return passed it, too, if a wall would have been near enough for one.
    """
    for v in range(min(count, VIEWS)):
        if not may_be_free(x, y, v, views):
            continue
        told = look_from(x, y, v, views)
        away = math.hypot(x - views.places[v, 0], y - views.places[v, 1])
        if told == FREE or (told == NO_RETURN and away < MAX_CLEAR_DISTANCE):
            return True
    return False


@kernel
def has_standing_jambs(door: Ends, count: int, views: Any) -> bool:
    """Whether earlier views leave room for both jambs of a door.

    Unlike a short wall, a jamb that was hidden until now counts: often a leaf hid it.
    """
    first, last = jambs_of(door)
    told_first = look_back(first[0], first[1], count, views)
    told_last = look_back(last[0], last[1], count, views)
    return bool(
        (may_stand(told_first) or told_first == HIDDEN)
        and (may_stand(told_last) or told_last == HIDDEN)
    )


@kernel
def may_stand(told: int) -> bool:
    """Whether something that is seen now may have stood there before.

    What was hidden before may have come with what hid it: a person who walks away. What did not
    return beams before may be a person before a far wall.
    """
    return told in (SOLID, UNSEEN)


@kernel
def jambs_of(door: Ends) -> tuple[Point, Point]:
    """A point in either jamb of a door."""
    x1, y1, x2, y2 = door
    share = JAMB_DEPTH / math.hypot(x2 - x1, y2 - y1)
    dx, dy = share * (x2 - x1), share * (y2 - y1)
    return (x1 - dx, y1 - dy), (x2 + dx, y2 + dy)
