"""Decides when to ground a clause again, because grounding at every scan would cost too much."""

from __future__ import annotations

from typing import Any

from semnav_features.frames import wrap_angle
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.memory import how_many_count

MAX_TRAVEL, MAX_HEADING_CHANGE = 1.5, 0.5
"""Motion since the last grounding after which a clause is grounded again, metres and radians."""

DOOR_CHECK_PERIOD = 5
"""Period of re-grounding when the doors that count have changed, scans."""

REST_CHECK_SCANS, LEAST_TRAVEL = 30, 0.2
"""Period of re-grounding when the walls that count have changed or the robot has moved, scans, and
the least distance that counts as moved, metres."""

FIRST_COUNTING_SCAN = 3
"""Number of the scan from which on the first features count, see `SceneMemory`."""


@kernel
def is_look_due(estimate: Any, remembered: Any) -> bool:
    """Whether to ground the clause again.

    Counting the remembered features takes time, so this is done only where it matters.

    Args:
        estimate: an entry of dtype `ESTIMATE`.
        remembered: `SceneMemory.arrays`.
    """
    pose, look = estimate.pose, estimate.look_pose
    moved = (pose[0] - look[0]) ** 2 + (pose[1] - look[1]) ** 2
    if moved > MAX_TRAVEL**2 or abs(wrap_angle(pose[2] - look[2])) > MAX_HEADING_CHANGE:
        return True
    since = estimate.scan - estimate.look_scan
    first = estimate.scan == FIRST_COUNTING_SCAN
    if since % DOOR_CHECK_PERIOD and not first:
        return False
    walls, doors = how_many_count(remembered)
    differs = walls != estimate.look_walls or moved > LEAST_TRAVEL**2
    rested = since >= REST_CHECK_SCANS or first
    return bool(doors != estimate.look_doors or (differs and rested))
