"""What the robot believes, for people and other nodes: in the robot's odometry frame."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from semnav_env.mind.belief import Belief
from semnav_features.frames import (
    ORIGIN,
    FloatArray,
    Pose,
    compose,
    points_to_parent,
    relative,
)
from semnav_features.scene import Door, Wall
from semnav_ros.messages import BeliefMessage, MarkerMessage

GREY, GREEN, ORANGE = (0.5, 0.5, 0.5), (0.1, 0.6, 0.2), (0.9, 0.5, 0.1)

GOAL_ARROW = ((0.0, 0.0), (0.5, 0.0), (0.5, 0.0), (0.3, 0.15), (0.5, 0.0), (0.3, -0.15))
"""Ends of the lines of an arrow, in the frame of the goal, metres."""


def shown_belief(belief: Belief, centre: Pose, base: Pose) -> BeliefMessage:
    """A belief in the odometry frame.

    Drift is corrected in a belief and not in odometry. So everything is placed as the robot sees it
    from where odometry says that it is now.

    Args:
        belief: to show.
        centre: pose of the robot's centre by odometry, at the same moment.
        base: pose of the base frame in the robot frame.
    """
    frame, scene = _frame_of(belief, centre), belief.scene
    return BeliefMessage(
        compose(centre, base),
        _ends(frame, scene.walls),
        _ends(frame, scene.doors),
        np.array([door.confidence for door in scene.doors], np.float64),
        goal_pose(belief, centre, base),
    )


def goal_pose(belief: Belief, centre: Pose, base: Pose) -> Pose:
    """Where the base frame shall go, odometry frame; arguments as of `shown_belief`."""
    return compose(compose(_frame_of(belief, centre), belief.target.pose), base)


def _frame_of(belief: Belief, centre: Pose) -> Pose:
    """The frame of a belief in the odometry frame."""
    return compose(centre, relative(belief.pose, ORIGIN))


def markers_of(belief: BeliefMessage) -> tuple[MarkerMessage, ...]:
    """The lines that show a belief."""
    shown = [
        MarkerMessage("walls", belief.walls.reshape(-1, 2), GREY, 0.05),
        MarkerMessage("doors", belief.doors.reshape(-1, 2), GREEN, 0.1),
    ]
    if belief.goal is not None:
        arrow = points_to_parent(belief.goal, np.array(GOAL_ARROW))
        shown.append(MarkerMessage("goal", arrow, ORANGE, 0.06))
    return tuple(shown)


def _ends(frame: Pose, items: Sequence[Wall] | Sequence[Door]) -> FloatArray:
    """X and y of both ends in the parent of a frame, shape (n, 4)."""
    ends = np.array([(*item.start, *item.end) for item in items], np.float64).reshape(-1, 2)
    return points_to_parent(frame, ends).reshape(-1, 4)
