"""The goal of driving backwards."""

from __future__ import annotations

import math

import numpy as np

from semnav_env.language.clauses import BackUp
from semnav_env.language.references import SOME
from semnav_env.language.told import Told, told
from semnav_env.mind.grounding.errors import GroundingError
from semnav_env.mind.grounding.goal import ReachGoal
from semnav_env.mind.grounding.situation import Situation
from semnav_features.frames import Pose, compose
from semnav_features.scene import Scene, known_ends

BODY = 0.7
"""Room that a body needs behind its centre, metres: of both robots, and 0.1 m more."""

LANE = 0.3
"""Half the width of the lane behind the robot's centre in which a wall is in its way, metres."""

PARALLEL = 1e-9
"""A wall whose ends differ less in their distance from the lane runs along it, metres."""

LEAST = 0.5
"""The shortest way back that is worth driving, metres."""

TOLERANCE, SHARE = 0.5, 0.6
"""What the distance may be off by: metres, or a share of a shorter one."""


def backing_up_goal(clause: BackUp, situation: Situation) -> ReachGoal:
    """Be so far behind where the clause began, with the same heading.

    What is not known behind the robot is taken for free. "A bit" is less where there is less room.

    Raises:
        GroundingError: a wall is in the way.
    """
    begin, accepted = situation.begin, situation.rules.success
    asked, free = situation.metres(clause.distance), room_behind(situation.scene, begin)
    if clause.distance == SOME and free > BODY + LEAST:
        asked = min(asked, free - BODY)
    if asked > free - BODY:
        raise GroundingError(
            Told(
                "{distance} back: there is a wall {free:.1f} m behind",
                distance=clause.distance,
                free=free,
            )
        )
    pose = compose(begin, (-asked, 0.0, 0.0))
    return ReachGoal(
        pose,
        min(TOLERANCE, SHARE * asked),
        accepted.turn_heading,
        told(clause),
        places=(begin[:2], pose[:2]),
        backwards=True,
    )


def room_behind(scene: Scene, pose: Pose) -> float:
    """Distance to the nearest wall in the robot's lane behind a pose, metres; inf if none."""
    ends = known_ends(scene.walls)
    dx, dy = ends[:, 0::2] - pose[0], ends[:, 1::2] - pose[1]
    c, s = math.cos(pose[2]), math.sin(pose[2])
    back, beside = -(c * dx + s * dy), c * dy - s * dx
    rise = beside[:, 1] - beside[:, 0]
    is_parallel = np.abs(rise) < PARALLEL
    shares = (np.array([[-LANE], [LANE]]) - beside[:, 0]) / np.where(is_parallel, 1.0, rise)
    shares = np.clip(np.where(is_parallel, [[0.0], [1.0]], shares), 0.0, 1.0)
    is_in_lane = np.abs(beside[:, 0] + shares.mean(axis=0) * rise) <= LANE
    distances = (back[:, 0] + shares * (back[:, 1] - back[:, 0]))[:, is_in_lane]
    return float(distances[distances > 0.0].min(initial=math.inf))
