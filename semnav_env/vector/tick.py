"""One control period of many robots, and their observations, in compiled calls.

Each robot is driven, understands and is judged by the kernels that a single environment calls.
Robots share nothing, so any thread can take any of them.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from semnav_env.control_period import RobotArrays, run_period
from semnav_env.mind.belief.understand import Workbench
from semnav_env.mind.observations.memory_row import write_command_row
from semnav_env.mind.observations.row import write_row
from semnav_env.vector.marks import Marks, is_set, set_mark
from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.rows import put_row
from semnav_features.kernels.structures import Structure, numba_type

Flags = NDArray[np.bool_]


class TeamArrays(Structure):
    """The arrays of many robots, and how far a control period has come.

    Attributes:
        robots: list of `RobotArrays`.
        periods: what became of each robot, dtype `PERIOD`, shape (n,).
        events: of `understand` and of `judge_motion` for each robot, shape (n, 2).
        thoughtful: whose minds think in every control period, shape (n,).
        taken: which robots a thread has taken, or are not driven in this control period; `Marks`.
        done: which robots are done with it; `Marks`.
        reported: which of these Python knows of, shape (n,).
        written: whose observation has been written, shape (n,).
    """

    robots: Any
    periods: np.ndarray
    events: NDArray[np.int64]
    thoughtful: Flags
    taken: Marks
    done: Marks
    reported: Flags
    written: Flags


TeamArraysType = numba_type(TeamArrays)


@kernel
def begin_period(team: TeamArrays, driven: Flags) -> None:
    """Make the robots that are driven ready to be taken."""
    for k in range(len(driven)):
        team.taken[k] = team.reported[k] = not driven[k]
        team.done[k] = 0


@kernel
def tick(
    team: TeamArrays,
    workbench: Workbench,
    first: int,
    step: int,
    most: int,
    twists: FloatArray,
    seconds: float,
    rows: NDArray[np.float32],
) -> int:
    """Take robots that no other thread has taken, and drive them for one control period.

    They understand and are judged. Where nothing calls for thinking they are observed as well.

    Args:
        team: the robots.
        workbench: of this thread.
        first: the robot to begin with.
        step: 1 to go on with the next one, -1 with the one before, around until all are taken.
        most: how many to take.
        twists: demanded velocities of all robots, shape (n, 3).
        seconds: duration of a control period.
        rows: of the observations, see `write_row`, shape (n, columns); nothing is written without
            columns.

    Returns:
        How many were taken.
    """
    count, taken, k = len(team.robots), 0, first
    for _ in range(count):
        if taken < most and set_mark(team.taken, k):
            robot, twist = team.robots[k], twists[k]
            own = robot.senses.workbench
            robot.senses.workbench = workbench
            events = run_period(robot, True, twist[0], twist[1], twist[2], seconds)
            team.events[k, 0], team.events[k, 1] = events
            _keep_period(robot, team.periods, k)
            robot.senses.workbench = own
            team.written[k] = rows.shape[1] > 0 and not _thinks(team, k)
            if team.written[k]:
                write_row(rows[k], robot.senses)
            set_mark(team.done, k)
            taken += 1
        k = (k + step) % count
    return taken


@kernel
def report(team: TeamArrays, rows: NDArray[np.float32], who: NDArray[np.int64]) -> int:
    """Write which robots are done and think, and were not reported before; returns how many.

    Robots that were reported before have thought, and are observed.

    Args:
        team: the robots.
        rows: of the observations, see `write_row`.
        who: written: number of the robot, and its events of `understand` and of `judge_motion`,
            shape (n, 3).
    """
    count = 0
    for k in range(len(team.robots)):
        if team.reported[k] and not team.written[k] and rows.shape[1] > 0:
            write_row(rows[k], team.robots[k].senses)
            team.written[k] = True
        elif not team.reported[k] and is_set(team.done, k):
            team.reported[k] = True
            if _thinks(team, k):
                put_row(who, count, (k, team.events[k, 0], team.events[k, 1]))
                count += 1
    return count


@kernel
def _thinks(team: TeamArrays, k: int) -> bool:
    """Whether something calls for thinking."""
    return bool(team.thoughtful[k] or (team.events[k, 0] | team.events[k, 1]) != 0)


@kernel
def write_others(team: TeamArrays, rows: NDArray[np.float32]) -> None:
    """Write the observations, see `write_row`, that have not been written."""
    for k in range(len(team.robots)):
        if not team.written[k]:
            write_row(rows[k], team.robots[k].senses)


@kernel
def write_command_rows(team: TeamArrays, first: int, last: int, rows: NDArray[np.float32]) -> None:
    """Write what some robots observe, remember and were told, see `write_command_row`."""
    for k in range(first, last):
        write_command_row(rows[k], team.robots[k].senses)


@kernel
def _keep_period(robot: RobotArrays, periods: np.ndarray, k: int) -> None:
    """Write what became of a robot in its row, beside the other robots'."""
    periods[k] = robot.judge.state[0].period


@kernel
def write_twists(shares: FloatArray, speeds: FloatArray, twists: FloatArray) -> bool:
    """Write shares of the largest speeds, cut to [-1, 1], as velocities; whether all are finite.

    Args:
        shares: (forward, turn) or (forward, left, turn), shape (n, 2) or (n, 3).
        speeds: the largest ones: forward, left and turn, shape (n, 3).
        twists: written, zeros before, shape (n, 3).
    """
    step = 2 if shares.shape[1] == 2 else 1
    for k in range(len(shares)):
        for i in range(shares.shape[1]):
            if not math.isfinite(shares[k, i]):
                return False
            twists[k, step * i] = min(max(shares[k, i], -1.0), 1.0) * speeds[k, step * i]
    return True
