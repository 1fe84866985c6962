"""Compiled checks: whether a goal is reached, a doorway crossed, a direction inspected."""

from __future__ import annotations

import math

from numba.extending import register_jitable

from semnav_env.mind.grounding.crossing import crossing_share
from semnav_features.frames import Point, Pose, to_local, wrap_angle
from semnav_features.kernels.compiling import kernel

DoorEnds = tuple[float, float, float, float]
"""X and y of the jambs of a door, metres."""


@register_jitable
def looks_along(pose: Pose, heading: float, most: float) -> bool:
    """Whether a pose's heading differs from another one by less than `most`, radians."""
    return math.cos(pose[2] - heading) > math.cos(most)


@kernel
def is_reached(
    goal: Pose, tolerances: tuple[float, float, float], pose: Pose, share: float
) -> bool:
    """Whether a pose lies within the tolerances of a goal, or within a share of them.

    Args:
        goal: pose of the goal.
        tolerances: of a `ReachGoal`: distance, heading and offset; NaN for no offset.
        pose: of the robot's centre, in the same frame.
        share: of the tolerances.
    """
    near, turned, beside = tolerances
    error = abs(wrap_angle(pose[2] - goal[2]))
    if turned < math.pi and error > share * turned:
        return False
    if not math.isnan(beside):
        along, offset = to_local(goal, (pose[0], pose[1]))
        return abs(along) <= share * near and abs(offset) <= beside
    return math.hypot(pose[0] - goal[0], pose[1] - goal[1]) <= share * near


@kernel
def is_crossed(
    before: Point, after: Point, door: DoorEnds, width: float, heading: float, margin: float
) -> bool:
    """Whether the step from one position to the next leads forward through a door.

    Args:
        before: a position of the robot's centre.
        after: the next position.
        door: the jambs of the door.
        width: width of the door, metres.
        heading: heading through the door, radians.
        margin: distance beside the jambs that still counts, and distance behind them that the step
            must reach, metres.
    """
    ax, ay, bx, by = door
    dx, dy = after[0] - before[0], after[1] - before[1]
    reach = abs(bx - ax) + abs(by - ay) + abs(dx) + abs(dy) + 2.0 * margin
    if abs(after[0] - ax) > reach or abs(after[1] - ay) > reach:
        return False  # too far away, as nearly always
    c, s = math.cos(heading), math.sin(heading)
    forward = dx * c + dy * s > 0
    share = crossing_share(
        ax + margin * c,
        ay + margin * s,
        bx + margin * c,
        by + margin * s,
        before[0],
        before[1],
        after[0],
        after[1],
    )
    slack = margin / width
    return forward and -slack <= share <= 1 + slack
