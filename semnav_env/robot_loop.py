"""One control period of one robot as one compiled call: drive, sense, understand, judge."""

from __future__ import annotations

from typing import Any

from numba import types
from numba.experimental import structref

from semnav_env.judge.verifier import Verifier
from semnav_env.judge.verifier.judge_record import JudgeRecord, judge_motion
from semnav_env.mind.belief import BeliefTracker
from semnav_env.mind.belief.understand import Senses, understand
from semnav_env.world.simulator import Simulator
from semnav_env.world.simulator.sensing import TOUCHED, SimulatorArrays, sense
from semnav_features.frames import Twist
from semnav_features.kernels.compiling import kernel


@structref.register
class RobotArraysType(types.StructRef):
    """How compiled code sees `RobotArrays`."""


class RobotArrays(structref.StructRefProxy):
    """The arrays of one simulated robot, its mind and its judge.

    Attributes:
        simulator: `Simulator.arrays`.
        senses: `BeliefTracker.senses`.
        judge: `Verifier.record`.
    """

    simulator: SimulatorArrays
    senses: Senses
    judge: JudgeRecord


structref.define_proxy(RobotArrays, RobotArraysType, list(RobotArrays.__annotations__))


class RobotLoop:
    """Drives one robot and lets it understand and be judged; what events call for, others do.

    Args:
        simulator: that has been reset.
        tracker: that follows a command.
        verifier: of the robot's mission.
    """

    def __init__(self, simulator: Simulator, tracker: BeliefTracker, verifier: Verifier) -> None:
        self._parts = simulator, tracker, verifier
        self._seconds = 1.0 / simulator.setup.control_hz
        self.__setstate__((self._parts, self._seconds))

    def __getstate__(self) -> Any:
        return self._parts, self._seconds

    def __setstate__(self, state: Any) -> None:
        self._parts, self._seconds = state
        simulator, tracker, verifier = self._parts
        self._tracker, self._world = tracker, simulator.world
        tracker.read_ranges_in(simulator.last_ranges)
        self._arrays = join_robot(simulator.arrays, tracker.senses, verifier.record)

    def look(self) -> int:
        """Understand what is sensed at the start of an episode; returns events of `understand`."""
        return int(run_period(self._arrays, False, 0.0, 0.0, 0.0, self._seconds)[0])

    def drive(self, twist: Twist) -> tuple[int, int]:
        """Drive for one control period.

        Args:
            twist: demanded velocity.

        Returns:
            The events of `understand` and of `judge_motion`.
        """
        self._tracker.let_go()
        world = self._world
        if not world.needs_python:
            world.note_command(twist)
            return run_period(self._arrays, True, *twist, self._seconds)
        world.demand(twist)
        events = run_period(self._arrays, True, *twist, self._seconds)
        world.arrive()
        return events


@kernel(counts_references=True)
def join_robot(simulator: SimulatorArrays, senses: Senses, judge: JudgeRecord) -> RobotArrays:
    """The structures as one; they are shared, not copied."""
    return RobotArrays(simulator, senses, judge)


@kernel(borrows=True)
def run_period(
    robot: RobotArrays, drives: bool, forward: float, left: float, turn: float, seconds: float
) -> tuple[int, int]:
    """Drive a robot for one control period, let it understand, and judge it.

    Args:
        robot: its arrays.
        drives: whether it drives and is judged; otherwise it understands what it has sensed.
        forward: demanded velocity, m/s, like the next.
        left: the same.
        turn: rad/s.
        seconds: duration of a control period.

    Returns:
        The events of `understand` and of `judge_motion`.
    """
    touched = 0
    if drives:
        command = robot.simulator.drive[0].command
        command.forward, command.left, command.turn = forward, left, turn
        touched = sense(robot.simulator) & TOUCHED
    _tell_mind(robot, seconds)
    understood = understand(robot.senses)
    if not drives:
        return understood, 0
    _tell_judge(robot, touched, seconds)
    return understood, judge_motion(robot.judge)


@kernel(borrows=True)
def _tell_mind(robot: RobotArrays, seconds: float) -> None:
    """Give what was sensed to the robot's mind, which reads the ranges where they are."""
    sensing, estimate = robot.simulator.sensing[0], robot.senses.estimate[0]
    driven = robot.simulator.drive[0]
    estimate.contact_count = driven.contact_count
    for k in range(driven.contact_count):
        for i in range(3):
            estimate.contacts[k, i] = driven.contacts[k, i]
    velocity, odometry = sensing.velocity, sensing.odometry
    estimate.odometry[0], estimate.odometry[1] = odometry.x, odometry.y
    estimate.odometry[2], estimate.seconds = odometry.heading, seconds
    estimate.velocity[0], estimate.velocity[1] = velocity.forward, velocity.left
    estimate.velocity[2] = velocity.turn


@kernel(borrows=True)
def _tell_judge(robot: RobotArrays, in_contact: int, seconds: float) -> None:
    """Give the true motion to the robot's judge."""
    sensing, state = robot.simulator.sensing[0], robot.judge.state[0]
    pose = sensing.pose
    state.x, state.y, state.heading = pose.x, pose.y, pose.heading
    state.speed, state.yaw_rate = sensing.speed, sensing.velocity.turn
    state.in_contact, state.seconds = in_contact, seconds
