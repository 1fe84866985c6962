"""The arrays of many robots in a list, as compiled loops take them."""

from __future__ import annotations

from typing import Any

from numba.typed.typedlist import List

from semnav_env.control_period import RobotArrays
from semnav_features.kernels.compiling import kernel


@kernel
def list_of(robot: RobotArrays, count: int) -> Any:
    """A list that holds the same robot as often as said, to be replaced."""
    robots: Any = List()
    for _ in range(count):
        robots.append(robot)
    return robots


@kernel
def put(robots: Any, index: int, robot: RobotArrays) -> None:
    """Put another robot into a list."""
    robots[index] = robot
