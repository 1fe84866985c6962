"""The input of the network: a set of elements around the pose at which the clause began.

All elements are in the frame of the corridor that the robot faced when the clause began, found on
the walls that are remembered now: x runs along the corridor, y to its left. In this frame "the
second door on the right" only requires sorting, wherever the robot is. Each element has a base
pose, relative to which the network gives the goal.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from semnav_agents.base import Observation
from semnav_agents.hearing.clause_state import ClauseState
from semnav_agents.hearing.openings import describe_doors, describe_openings
from semnav_agents.hearing.tokens import describe_clauses
from semnav_agents.hearing.told import told_place_rows
from semnav_env.mind.observations import read_odometry, table
from semnav_features.corridor import Corridor, corridor_along
from semnav_features.frames import Pose, points_to_local, relative, to_local
from semnav_features.lidar_spec import LidarSpec

Array = NDArray[np.float32]


class ElementKind(IntEnum):
    """The kind of an element of the set."""

    ROBOT = 0
    AXIS = 1
    END = 2
    BEGIN = 3
    DOOR = 4
    OPENING = 5
    PLACE = 6
    TOLD_DOOR = 7


EXTRAS = 7
"""Numbers of an element beside its kind, its two ends and its base."""

ELEMENT_SIZE = len(ElementKind) + 2 * 4 + 6 + EXTRAS
"""Numbers that describe an element."""

MOST_ELEMENTS = 40
"""Largest number of elements of a set; of more elements the last ones are left out."""

FAR = 30.0
"""Value of an unknown distance, metres."""

LEAST_GAP = 0.6
"""Length of an unseen part of a side from which on it may hide a door, metres."""


@dataclass(frozen=True, eq=False)
class Description:
    """The input of the network.

    Attributes:
        elements: shape (MOST_ELEMENTS, ELEMENT_SIZE); unused rows are zero.
        mask: which rows count, shape (MOST_ELEMENTS,).
        bases: base poses, x and y in metres and heading, shape (MOST_ELEMENTS, 3).
        command: the clause and the one before it, shape (COMMAND_SIZE,).
        jambs: x and y of both jambs of the elements that are doors, else 0; (MOST_ELEMENTS, 4).
        frame: of all these, in the odometry frame.
        robot: pose of the robot in that frame.
    """

    elements: Array
    mask: NDArray[np.bool_]
    bases: Array
    command: Array
    jambs: Array
    frame: Pose
    robot: Pose


@dataclass(frozen=True)
class Rows:
    """Elements of one kind: two ends (n, 4), base poses (n, 3) and extras (n, EXTRAS)."""

    kind: ElementKind
    ends: NDArray[np.float64]
    bases: NDArray[np.float64]
    extras: NDArray[np.float64]


def describe(
    observation: Observation, state: ClauseState, lidar: LidarSpec, mount: Pose
) -> Description:
    """Make the set of elements for the agent's active clause.

    Args:
        observation: of an environment with `observation="command"`.
        state: the agent's own; its command is not done.
        lidar: of the robot.
        mount: pose of the lidar in the robot frame.
    """
    pose, _ = read_odometry(observation)
    begin = relative(pose, state.begin)
    doors = table(observation, "remembered_doors").astype(np.float64)
    walls = np.concatenate(
        (table(observation, "remembered_walls"), table(observation, "bumps")), dtype=np.float64
    )
    corridor = corridor_along(walls, doors, np.zeros(len(doors), np.bool_), begin)
    axis = corridor.frame
    robot, begin = relative(axis, (0.0, 0.0, 0.0)), relative(axis, begin)
    told = told_place_rows(observation, state, axis, pose)
    depths = _depths(observation["scan"], doors, lidar, mount)
    walls, doors = (
        points_to_local(axis, each.reshape(-1, 2)).reshape(-1, 4) for each in (walls, doors)
    )
    parts = (
        *_single_rows(corridor, robot, begin, state, relative(pose, (*state.farthest, 0.0)), axis),
        Rows(ElementKind.TOLD_DOOR, *told.door),
        Rows(ElementKind.PLACE, *told.places),
        Rows(
            ElementKind.DOOR,
            *describe_doors(doors, walls, corridor, begin, depths, told.door[0], told.outward),
        ),
        Rows(ElementKind.OPENING, *describe_openings(corridor)),
    )
    return _joined(parts, describe_clauses(state.tokens, state.clause), _placed(pose, axis), robot)


def _placed(pose: Pose, axis: Pose) -> Pose:
    """The pose of the axis in the odometry frame."""
    x, y = _to_parent(pose, axis)
    return x, y, math.remainder(pose[2] + axis[2], math.tau)


def _to_parent(frame: Pose, pose: Pose) -> tuple[float, float]:
    c, s = math.cos(frame[2]), math.sin(frame[2])
    return frame[0] + c * pose[0] - s * pose[1], frame[1] + s * pose[0] + c * pose[1]


def _single_rows(
    corridor: Corridor, robot: Pose, begin: Pose, state: ClauseState, farthest: Pose, axis: Pose
) -> tuple[Rows, ...]:
    """Robot, axis, end and begin: one row each."""
    progress = to_local(axis, farthest[:2])[0]
    known = math.isfinite(corridor.end)
    end = corridor.end if known else FAR
    start = max(0.0, progress)
    gaps = [min(corridor.unseen(left, start, end, LEAST_GAP), FAR) / 10.0 for left in (True, False)]
    come = (progress / 10.0, (progress - end) / 10.0 if known else -2.0)
    shape = (corridor.half_width, end / 10.0, float(known), *gaps, *come)
    bases = {
        ElementKind.ROBOT: robot,
        ElementKind.AXIS: (progress, 0.0, 0.0),
        ElementKind.END: (end, 0.0, 0.0),
        ElementKind.BEGIN: begin,
    }
    driven = math.dist(robot[:2], begin[:2]) / 10.0
    own = (min(state.still, 20.0) / 10.0, driven, *come, 0.0, 0.0, 0.0)
    extras = {ElementKind.ROBOT: own}
    return tuple(
        Rows(
            kind,
            np.array([[*base[:2], *base[:2]]]),
            np.array([base]),
            np.array([extras.get(kind, shape)]),
        )
        for kind, base in bases.items()
        if known or kind is not ElementKind.END
    )


def _depths(
    scan: Array, doors: NDArray[np.float64], lidar: LidarSpec, mount: Pose
) -> NDArray[np.float64]:
    """Depth behind each door that a beam through its middle reaches, metres; NaN out of view.

    Args:
        scan: ranges, metres.
        doors: in the robot frame, shape (n, 4).
        lidar: of the robot.
        mount: pose of the lidar in the robot frame.
    """
    middles = points_to_local(mount, (doors[:, :2] + doors[:, 2:]) / 2)
    angles = np.arctan2(middles[:, 1], middles[:, 0]) - lidar.angle_min
    beams = np.rint((angles % math.tau) / lidar.angle_increment).astype(int)
    seen = beams < lidar.beams
    ranges = scan[np.where(seen, beams, 0)]
    depths: NDArray[np.float64] = np.where(seen, ranges - np.hypot(*middles.T), np.nan)
    return depths


def _joined(parts: tuple[Rows, ...], command: Array, frame: Pose, robot: Pose) -> Description:
    kinds = np.concatenate([np.full(len(part.bases), part.kind) for part in parts])
    ends = np.concatenate([part.ends for part in parts])
    bases = np.concatenate([part.bases for part in parts])
    extras = np.concatenate([part.extras for part in parts])
    n = min(len(kinds), MOST_ELEMENTS)
    values = np.zeros((MOST_ELEMENTS, ELEMENT_SIZE), np.float32)
    values[np.arange(n), kinds[:n]] = 1.0
    numbers = np.concatenate((_scaled(ends), _scaled_poses(bases), extras), axis=1)
    values[:n, len(ElementKind) :] = np.clip(numbers[:n], -4.0, 4.0)
    placed, jambs = (
        np.zeros((MOST_ELEMENTS, 3), np.float32),
        np.zeros((MOST_ELEMENTS, 4), np.float32),
    )
    placed[:n] = bases[:n]
    is_door = np.isin(kinds, (ElementKind.DOOR, ElementKind.TOLD_DOOR))[:n, None]
    jambs[:n] = np.where(is_door, ends[:n], 0.0)
    return Description(values, np.arange(MOST_ELEMENTS) < n, placed, command, jambs, frame, robot)


def _scaled(ends: NDArray[np.float64]) -> NDArray[np.float64]:
    """Both ends twice: unchanged, and scaled so that near things are resolved more finely."""
    near = ends / (1.0 + np.abs(ends))
    return np.concatenate((ends / 10.0, near), axis=1)


def _scaled_poses(poses: NDArray[np.float64]) -> NDArray[np.float64]:
    places, headings = poses[:, :2], poses[:, 2]
    near = places / (1.0 + np.abs(places))
    return np.column_stack((places / 10.0, near, np.cos(headings), np.sin(headings)))
