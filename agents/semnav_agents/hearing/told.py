"""The way to a named room, or back, as elements of the network's set."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from semnav_agents.base import Observation
from semnav_agents.hearing.clause_state import ClauseState
from semnav_agents.hearing.openings import RowArrays, through_one
from semnav_env.mind.observations import table
from semnav_features.frames import FloatArray, Pose, points_to_local, to_local

AHEAD = (0, 1, 2, 3)
"""Places of the way that are elements, counted from the one nearest to the robot; and the last."""


@dataclass(frozen=True, eq=False)
class ToldRows:
    """The elements of a way, in the corridor's frame.

    Attributes:
        places: as elements.
        door: at its end, as elements; none or one.
        outward: direction through that door, shape (2,); zeros without one.
    """

    places: RowArrays
    door: RowArrays
    outward: FloatArray


def told_place_rows(
    observation: Observation, state: ClauseState, axis: Pose, pose: Pose
) -> ToldRows:
    """The way of the active clause: the told way, or the driven way.

    Args:
        observation: of the robot.
        state: of the agent.
        axis: frame of the corridor, in the robot frame.
        pose: of the robot, odometry frame.
    """
    ways, doors = table(observation, "told_ways"), table(observation, "told_doors")
    places = ways[ways[:, 0] == state.clause, 1:].astype(np.float64)
    jambs = doors[doors[:, 0] == state.clause, 1:].astype(np.float64)[:1]
    if state.way_back is not None:
        places = points_to_local(pose, state.way_back)
    places = points_to_local(axis, places)
    jambs = points_to_local(axis, jambs.reshape(-1, 2)).reshape(-1, 4)
    robot = points_to_local(axis, np.zeros((1, 2)))[0]
    return _rows(places, jambs, robot, _final_heading(state, pose, axis))


def _final_heading(state: ClauseState, pose: Pose, axis: Pose) -> float:
    """The heading with which the command began, in the corridor's frame."""
    return state.heading_at_start - pose[2] - axis[2]


def _rows(places: FloatArray, jambs: FloatArray, robot: FloatArray, final: float) -> ToldRows:
    none: RowArrays = np.zeros((0, 4)), np.zeros((0, 3)), np.zeros((0, 7))
    if len(places) < 2:
        return ToldRows(none, none, np.zeros(2))
    here = int(np.argmin(np.hypot(*(places - robot).T)))
    indices = np.minimum((*(here + k for k in AHEAD), len(places) - 1), len(places) - 1)
    bases = np.array([_stretch(places, index) for index in indices.tolist()])
    offset = to_local(tuple(_stretch(places, here)), (robot[0], robot[1]))[1]  # type: ignore[arg-type]
    left = len(places) - 1 - indices
    extras = np.column_stack(
        (
            (indices - here) / 4.0,
            left / 10.0,
            left == 0,
            np.full(len(indices), np.clip(offset, -2.0, 2.0)),
            np.full(len(indices), min(here, 4) / 4.0),
            np.full(len(indices), math.cos(final)),
            np.full(len(indices), math.sin(final)),
        )
    )
    where = np.concatenate((bases[:, :2], bases[:, :2]), axis=1)
    outward = np.zeros(2)
    if len(jambs):
        outward = outward_of(places, jambs[0])
    door: RowArrays = none
    if len(jambs):
        extra = np.zeros((1, 7))
        extra[0, :2] = left[0] / 10.0, float(left[0] <= 2)
        door = jambs, through_one(jambs, outward), extra
    return ToldRows((where, bases, extras), door, outward)


def outward_of(places: FloatArray, jambs: FloatArray) -> FloatArray:
    """The direction through the door at the end of a way, not normalised, shape (2,).

    A way ends in the middle of the door. The place before that lies in front of the door; but
    behind it, and near its middle, where the way there has led through the door.

    Args:
        places: of the way, shape (n, 2), two or more.
        jambs: of the door, shape (4,).
    """
    middle, half = (jambs[:2] + jambs[2:]) / 2, (jambs[2:] - jambs[:2]) / 2
    last, earlier = places[-2], places[max(0, len(places) - 3)]
    (x, y), (u, v) = last - middle, earlier - middle
    sides = (half[0] * y - half[1] * x) * (half[0] * v - half[1] * u)
    within = abs(half @ (x, y)) < half @ half
    outward: FloatArray = middle - (earlier if sides < 0.0 and within else last)
    return outward


def _stretch(places: FloatArray, index: int) -> tuple[float, float, float]:
    """A place and the direction of the way there."""
    first = min(index, len(places) - 2)
    dx, dy = places[first + 1] - places[first]
    return float(places[index, 0]), float(places[index, 1]), math.atan2(dy, dx)
