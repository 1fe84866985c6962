"""What a robot estimates, as kernels take it: a record that is read and written at every scan."""

from __future__ import annotations

from struct import Struct

import numpy as np

from semnav_env.belief.belief import Belief
from semnav_env.grounding.clause_progress import GOAL_RECORD, goal_entry

ESTIMATE = np.dtype(
    [("odometry", "f8", 3), ("seconds", "f8"), ("velocity", "f8", 3), ("pose", "f8", 3)]
    + [(name, "f8", 3) for name in ("last_odometry", "last_pose", "look_pose")]
    + [(name, "i8") for name in ("scan", "clause", "look_scan", "look_walls", "look_doors")]
    + [("corrects_drift", "?"), ("target", GOAL_RECORD)]
)
"""A robot's estimate of its state; an array of shape (1,). Poses are (x, y, heading) in metres and
radians, odometry frame.

Given before each scan: `odometry`, the pose by dead reckoning; `seconds` since the scan before;
`velocity`, a `Twist`. Given at the beginning: `corrects_drift`, whether walls that are seen again
correct the odometry.

Written by `understand`: `pose`, the believed one; `last_pose`, that of the scan before;
`last_odometry`, the odometry that `pose` belongs to; `scan`, the number of the scan, from 0.

Written where an event calls for it: `clause` and `target` of `Belief`; the pose and the scan at
which the clause was last grounded (`look_`), and how many walls and doors counted then."""

SENSED = Struct("7d")
"""The first fields of an estimate: odometry, seconds and velocity."""

BELIEVED = Struct("6d")
"""The fields from `velocity` on: velocity and believed pose."""

BELIEVED_OFFSET = ESTIMATE.fields["velocity"][1] if ESTIMATE.fields else 0


def estimate_of(belief: Belief) -> np.ndarray:
    """The fields of an estimate that a belief tells: velocity, pose, clause and target."""
    estimate = np.zeros(1, ESTIMATE)
    estimate["velocity"], estimate["pose"] = belief.velocity, belief.pose
    estimate["clause"], estimate["target"] = belief.clause, goal_entry(belief.target)
    return estimate
