"""Small scenes made by hand: straight corridors along x, with doors, arms and what stands in them.

The corridors begin at x = -3 and run to x = `length`; the left side lies at y = `half`. Behind
every side lie rooms, 4 m deep; arms are as long.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from semnav_features.frames import Point
from semnav_features.scene import Door, Scene, Wall

BACK = -3.0
DOOR_WIDTH = 0.9
DEPTH = 4.0


def polyline(*points: Point) -> list[Wall]:
    return [Wall(a, b) for a, b in pairwise(points)]


def box(x1: float, y1: float, x2: float, y2: float) -> list[Wall]:
    """A pillar or a cabinet."""
    return polyline((x1, y1), (x2, y1), (x2, y2), (x1, y2), (x1, y1))


def side(y: float, gaps: Sequence[tuple[float, float]], start: float, stop: float) -> list[Wall]:
    """A wall along x with gaps."""
    edges = [start, *(x for gap in sorted(gaps) for x in gap), stop]
    return [
        Wall((a, y), (b, y)) for a, b in zip(edges[::2], edges[1::2], strict=True) if b - a > 1e-9
    ]


def corridor(
    left: Sequence[float] = (),
    right: Sequence[float] = (),
    left_arms: Sequence[tuple[float, float]] = (),
    right_arms: Sequence[tuple[float, float]] = (),
    length: float = 14.0,
    half: float = 1.0,
    end_door: bool = False,
    extra: Sequence[Wall] = (),
) -> Scene:
    """A corridor along x.

    Args:
        left: where the middles of the doors on the left lie, metres.
        right: the same on the right.
        left_arms: where corridors lead off to the left (from, to), metres.
        right_arms: the same to the right.
        length: where the corridor ends.
        half: half its width.
        end_door: whether there is a door in its end.
        extra: further walls.
    """
    walls, doors = list(extra), []
    for y, places, arms in ((half, left, left_arms), (-half, right, right_arms)):
        gaps = [(x - DOOR_WIDTH / 2, x + DOOR_WIDTH / 2) for x in places]
        walls += side(y, [*gaps, *arms], BACK, length)
        doors += [Door((a, y), (b, y)) for a, b in gaps]
        deep = DEPTH if y > 0 else -DEPTH
        walls.append(Wall((BACK, y + deep), (length, y + deep)))  # the backs of rooms and arms
        for x in {x for arm in arms for x in arm}:
            walls.append(Wall((x, y), (x, y + deep)))
    walls.append(Wall((BACK, -half), (BACK, half)))
    if end_door:
        walls += [Wall((length, -half), (length, -0.45)), Wall((length, 0.45), (length, half))]
        doors.append(Door((length, -0.45), (length, 0.45)))
        walls.append(Wall((length + DEPTH, -3.0), (length + DEPTH, 3.0)))
    else:
        walls.append(Wall((length, -half), (length, half)))
    return Scene(tuple(walls), tuple(doors))


T_JUNCTION = corridor(left_arms=[(12.0, 14.0)], right_arms=[(12.0, 14.0)])
L_LEFT = corridor(left_arms=[(12.0, 14.0)])
L_RIGHT = corridor(right_arms=[(12.0, 14.0)])
X_JUNCTION = corridor(left_arms=[(6.0, 8.0)], right_arms=[(6.0, 8.0)])
SIDE_ARMS = corridor(left_arms=[(3.0, 5.0)], right_arms=[(8.0, 10.0)])
"""An arm to the left, then one to the right."""
ROOM = Scene(
    tuple(polyline((-2, -2), (4, -2), (4, -0.5)) + polyline((4, 0.5), (4, 2), (-2, 2), (-2, -2))),
    (Door((4, -0.5), (4, 0.5)),),
)
