"""What a step is made of: drive, sense, understand, judge; then reward, end and info.

Of one robot, `SemNavEnv.step` is this from top to bottom. Of many, the vector environment calls
`run_period` in threads, `RobotLoop.think` where it reports events, and the same functions for
rewards, ends and infos, with arrays in place of numbers:

1. `run_period`: the robot drives, senses and understands, and its motion is judged, compiled.
2. `RobotLoop.think`: belief, payload and judge do what its events call for.
3. `RobotLoop.terms`: what the control period is worth; of many, `weigh` where it serves.
4. `ends`: whether the episode is over; `SemNavEnv.conclude` says what is known then.
5. `info_of`: what is known after each step.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from semnav_env.judge.judge_record import JudgeRecord, judge_motion
from semnav_env.judge.tasks.rewards import Rewards, RewardWeights, Tick, terms_of, weigh
from semnav_env.mind.belief.understand import Senses, understand
from semnav_env.world.simulator.sensing import TOUCHED, SimulatorArrays, sense
from semnav_features.frames import Twist
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.structures import Structure, numba_type

if TYPE_CHECKING:
    from semnav_env.judge import Judge, Period
    from semnav_env.judge.payload import Payload
    from semnav_env.mind.belief import BeliefTracker
    from semnav_env.world.simulator import Simulator

    _Parts = tuple[Simulator, BeliefTracker, Judge, Payload | None]


class RobotArrays(Structure):
    """The arrays of one simulated robot, its mind and its judge.

    Attributes:
        simulator: `Simulator.arrays`.
        senses: `BeliefTracker.senses`.
        judge: `Judge.record`.
    """

    simulator: SimulatorArrays
    senses: Senses
    judge: JudgeRecord


RobotArraysType = numba_type(RobotArrays)


@kernel(shared=True)
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


@kernel
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


@kernel
def _tell_judge(robot: RobotArrays, in_contact: int, seconds: float) -> None:
    """Give the true motion to the robot's judge."""
    sensing, state = robot.simulator.sensing[0], robot.judge.state[0]
    pose = sensing.pose
    state.x, state.y, state.heading = pose.x, pose.y, pose.heading
    state.speed, state.yaw_rate = sensing.speed, sensing.velocity.turn
    state.in_contact, state.seconds = in_contact, seconds


class RobotLoop:
    """Drives one robot for one control period after the other, until its episode ends.

    Args:
        simulator: that has been reset.
        tracker: that follows a command.
        judge: of the robot's mission.
        payload: that the robot carries.

    Attributes:
        arrays: of the robot, for `run_period`.
    """

    def __init__(
        self,
        simulator: Simulator,
        tracker: BeliefTracker,
        judge: Judge,
        payload: Payload | None = None,
    ) -> None:
        self.__setstate__((simulator, tracker, judge, payload))

    def __getstate__(self) -> _Parts:
        return self._simulator, self._tracker, self._judge, self._payload

    def __setstate__(self, state: _Parts) -> None:
        simulator, tracker, judge, self._payload = state
        self._simulator, self._tracker, self._judge = simulator, tracker, judge
        self._seconds = 1.0 / simulator.setup.control_hz
        tracker.read_ranges_in(simulator.last_ranges)
        self.arrays = RobotArrays.of(
            simulator=simulator.arrays, senses=tracker.senses, judge=judge.record
        )

    def look(self) -> None:
        """Understand what is sensed at the start of an episode."""
        self._tracker.think(run_period(self.arrays, False, 0.0, 0.0, 0.0, self._seconds)[0])

    def drive(self, twist: Twist) -> Period:
        """Drive for one control period, think, and say what became of it.

        Args:
            twist: demanded velocity.
        """
        self._tracker.let_go()
        world = self._simulator.world
        if world.needs_python:
            world.demand(twist)
            events = run_period(self.arrays, True, *twist, self._seconds)
            world.arrive()
        else:
            world.note_command(twist)
            events = run_period(self.arrays, True, *twist, self._seconds)
        self.think(*events)
        return self._judge.period

    def think(self, understood: int, judged: int) -> None:
        """Do what the events of `run_period` call for, and let the payload see.

        Args:
            understood: events of `understand`.
            judged: events of `judge_motion`.
        """
        if understood:
            self._tracker.think(understood)
        if self._payload is not None:
            self._payload.update(self._simulator.motion, self._tracker)
        if judged:
            self._judge.think(judged)

    def terms(self, rewards: Rewards, period: Period, action: ArrayLike) -> dict[str, float]:
        """What a control period is worth, by name; the reward is the sum.

        Args:
            rewards: say what it is worth.
            period: the last one.
            action: that the agent gave, as it gave it.
        """
        if type(rewards) is RewardWeights:  # the usual ones need no belief
            return weigh(rewards.each, *period.judged, period.in_contact)
        sensed = self._simulator.motion, self._tracker.belief, np.asarray(action)
        return terms_of(rewards, Tick(*period.judged, *sensed, self._payload))


def ends(period: Period, max_steps: Any) -> tuple[Any, Any]:
    """Whether the episode is terminated, and whether it is truncated.

    Args:
        period: of one robot; or of many, for arrays.
        max_steps: control periods after which an episode that is not over is truncated.
    """
    terminated = period.over
    return terminated, (period.steps >= max_steps) > terminated  # true and not terminated


def info_of(period: Period, verdicts: Any) -> dict[str, Any]:
    """What is known after each step, for `info`.

    Args:
        period: of one robot; or of many, for arrays.
        verdicts: of its judge; of many, an array of them.
    """
    return {
        "verdicts": verdicts,
        "collisions": period.collisions,
        "path_length": period.path_length,
        "in_contact": period.in_contact,
        "pose": period.pose,
    }
