"""All arrays of one simulated robot, its mind and its judge in one structure; many in a list."""

from __future__ import annotations

from typing import Any

from numba import types
from numba.experimental import structref
from numba.typed.typedlist import List

from semnav_env.belief.understand import Senses
from semnav_env.features.kernels.compiling import kernel
from semnav_env.simulator.sensing import SimulatorArrays
from semnav_env.verifier.judge_record import JudgeRecord


@structref.register
class RobotArraysType(types.StructRef):
    """How compiled code sees `RobotArrays`."""


class RobotArrays(structref.StructRefProxy):
    """The arrays of one robot.

    Attributes:
        simulator: `Simulator.arrays`.
        senses: `BeliefTracker.senses`.
        judge: `Verifier.record`.
    """

    simulator: SimulatorArrays
    senses: Senses
    judge: JudgeRecord


structref.define_proxy(RobotArrays, RobotArraysType, list(RobotArrays.__annotations__))


@kernel(counts_references=True)
def join_robot(simulator: SimulatorArrays, senses: Senses, judge: JudgeRecord) -> RobotArrays:
    """The structures as one; they are shared, not copied."""
    return RobotArrays(simulator, senses, judge)


@kernel(counts_references=True)
def list_of(robot: RobotArrays, count: int) -> Any:
    """A list that holds the same robot as often as said, to be replaced."""
    robots: Any = List()
    for _ in range(count):
        robots.append(robot)
    return robots


@kernel(counts_references=True)
def put(robots: Any, index: int, robot: RobotArrays) -> None:
    """Put another robot into a list."""
    robots[index] = robot
