"""One control period of many robots, and their observations, in compiled calls.

Each robot is driven, understands and is judged by the kernels that a single environment calls, one
robot after the other; robots share nothing, so any part of the list can run in any thread.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from semnav_env.features.frames import FloatArray
from semnav_env.features.kernels.compiling import kernel
from semnav_env.observations.memory_row import write_command_row
from semnav_env.observations.row import write_row
from semnav_env.robot_loop import RobotArrays, run_period

PERIOD = np.dtype(
    [(name, "i8") for name in ("understood", "judged", "steps", "collisions")]
    + [("pose", "f8", 3), ("path_length", "f8"), ("progress", "f8"), ("in_contact", "?")]
)
"""What became of one robot in one control period.

The events of `understand` and `judge_motion`; control periods since the reset; contacts
begun since then; the true pose, world frame; metres driven since the reset; metres by which the
way to the goal got shorter; whether the body touches anything.
"""


@kernel(counts_references=True)
def tick(
    robots: Any,
    first: int,
    last: int,
    twists: FloatArray,
    driven: NDArray[np.bool_],
    seconds: float,
    periods: np.ndarray,
) -> None:
    """Drive some of the robots for one control period, let them understand, and judge them.

    Args:
        robots: list of `RobotArrays`.
        first: index of the first one to drive.
        last: index behind the last one.
        twists: demanded velocities of all robots, shape (n, 3).
        driven: which robots are to be driven at all, shape (n,).
        seconds: duration of a control period.
        periods: dtype `PERIOD`, shape (n,); written for those that are driven.
    """
    for k in range(first, last):
        if driven[k]:
            _tick_robot(robots[k], twists[k], seconds, periods[k])


@kernel(counts_references=True)
def write_rows(robots: Any, first: int, last: int, rows: NDArray[np.float32]) -> None:
    """Write the observations of some of the robots, see `write_row`; rows has one for each."""
    for k in range(first, last):
        write_row(rows[k], robots[k].senses)


@kernel(counts_references=True)
def write_command_rows(robots: Any, first: int, last: int, rows: NDArray[np.float32]) -> None:
    """As `write_rows`, with what is remembered and was told, see `write_command_row`."""
    for k in range(first, last):
        write_command_row(rows[k], robots[k].senses)


@kernel(borrows=True)
def _tick_robot(robot: RobotArrays, twist: FloatArray, seconds: float, period: Any) -> None:
    events = run_period(robot, True, twist[0], twist[1], twist[2], seconds)
    period.understood, period.judged = events
    motion, judged = robot.simulator.sensing[0], robot.judge.state[0]
    period.pose[0], period.pose[1], period.pose[2] = judged.x, judged.y, judged.heading
    period.steps, period.in_contact = motion.step, judged.in_contact != 0
    period.collisions, period.path_length = judged.collisions, judged.path_length
    period.progress = judged.progress
