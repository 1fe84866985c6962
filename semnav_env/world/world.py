"""A robot that is driven through a floor plan and stopped by what is solid."""

from __future__ import annotations

import math
from array import array
from typing import TYPE_CHECKING, Any

import numpy as np
import pymunk

from semnav_env.dynamics import NO_DYNAMICS, Dynamics
from semnav_env.features.frames import Contact, FloatArray, Pose, wrap_angle
from semnav_env.lidar.moving import NO_MOVING_THINGS
from semnav_env.maps.floor_plan import FloorPlan
from semnav_env.robots import RobotSpec
from semnav_env.world.bodies import driving_joints, robot_body, solid_space
from semnav_env.world.contacts import ContactLog, Contacts
from semnav_env.world.movers import Movers
from semnav_env.world.standing import clearance, standing_error

if TYPE_CHECKING:
    from semnav_env.dynamics.moving import Moving

FINE = 20
"""Substeps where something else moves: a robot's corner then gets less than a centimetre into
somebody before the contact is felt."""


class World:
    """One robot in a floor plan.

    A pivot and a gear joint of bounded force hold the robot to a kinematic body that moves as
    commanded, so that contacts are real. The body's centre of gravity is put on its axle: there
    the pivot keeps a differential drive from moving sideways.

    The same commands after the same `reset` give the same poses, bit for bit. Pymunk's own
    pickles lose cached contacts, so a world is pickled as its start pose and the commands since,
    which are carried out again when it is loaded.

    Args:
        floor_plan: all of its segments are solid, glass too.
        robot: body and limits.
        control_hz: commands per second.
        substeps: of the physics for each command; `FINE` at least where something else moves.
        dynamics: what else moves.

    Attributes:
        moving: people and leaves; None where only the robot moves.
        still: the floor plan without what can move.
    """

    def __init__(
        self,
        floor_plan: FloorPlan,
        robot: RobotSpec,
        control_hz: float = 15.0,
        substeps: int = 4,
        dynamics: Dynamics = NO_DYNAMICS,
    ) -> None:
        if not 0 < control_hz < math.inf or substeps < 1:
            raise ValueError(
                f"control_hz is {control_hz} and substeps {substeps}; both must be positive"
            )
        self.floor_plan, self.robot = floor_plan, robot
        self._period = 1.0 / control_hz
        self.moving = self._moving(dynamics) if dynamics.moves else None
        self.still = floor_plan if self.moving is None else self.moving.still
        substeps = substeps if self.moving is None else max(substeps, FINE)
        self.control_hz, self.substeps = control_hz, substeps
        self._dt = self._period / substeps
        self._start: Pose | None = None
        self._journal = array("d")
        self._seed = 0

    def _moving(self, dynamics: Dynamics) -> Moving:
        from semnav_env.dynamics.moving import Moving  # most worlds stand still

        return Moving(self.floor_plan, self.robot, dynamics, self._period)

    def reset(self, pose: Pose, rng: np.random.Generator | None = None) -> None:
        """Put the robot at rest with its centre at `pose`, world frame, in an untouched world.

        Args:
            pose: of the robot.
            rng: of what people and doors do; the same every time without it. Nothing is drawn
                from it where only the robot moves.

        Raises:
            ValueError: the pose is not three finite numbers, lies outside the boundary, or the
                footprint would touch something solid; or people find no room.
        """
        drawn = self.moving is not None and rng is not None
        self._begin(pose, int(rng.integers(2**62)) if drawn and rng is not None else 0)

    def _begin(self, pose: Pose, seed: int) -> None:
        start = _finite(pose, "pose", "(x, y, heading)")
        problem = standing_error(self.floor_plan, self.robot, start)
        if problem is not None:
            raise ValueError(problem)
        self._start, self._seed, self._journal = start, seed, array("d")
        self._build(start)
        self._settle()

    def step(self, velocity: tuple[float, float, float]) -> None:
        """Drive for one control period.

        Args:
            velocity: forward (m/s), left (m/s) and turn (rad/s) as commanded, robot frame, of the
                axle's middle; cut to the robot's limits and approached no faster than its
                accelerations allow.

        Raises:
            ValueError: not three finite numbers.
            RuntimeError: before the first `reset`.
        """
        command = _finite(velocity, "velocity", "(forward, left, turn)")
        self._require_reset()
        self._journal.extend(command)
        self._log.clear()
        if self.moving is None:
            self._drive(command)
            self._settle()
        else:
            self._step_among(self.moving, command)

    def _step_among(self, moving: Moving, command: tuple[float, float, float]) -> None:
        """`step` where others move: they choose their steps, then all go at once."""
        moving.step(self._pose, self.velocity)
        self._movers.go()
        self._drive(command)
        self._movers.arrive()
        self._settle()
        moving.note(self._pose, self.velocity)

    @property
    def pose(self) -> Pose:
        """Of the footprint's centre, world frame; the heading is in [-pi, pi]."""
        self._require_reset()
        return self._pose

    @property
    def velocity(self) -> tuple[float, float, float]:
        """Of the footprint's centre, robot frame: forward, left (m/s) and turn (rad/s)."""
        self._require_reset()
        forward, left, turn = self._axle_velocity
        return forward, left - self.robot.axle * turn, turn

    @property
    def contacts(self) -> Contacts:
        """What the robot touched during the last step."""
        self._require_reset()
        return self._log.contacts

    @property
    def in_contact(self) -> bool:
        """Whether the robot touched anything during the last step."""
        self._require_reset()
        return bool(self._log.impulses)

    @property
    def touches(self) -> list[Contact]:
        """Where the robot touched what cannot move during the last step, robot frame."""
        return self._log.touches(self.pose)

    @property
    def moving_shapes(self) -> tuple[FloatArray, FloatArray]:
        """Discs of people, shape (n, 3), and leaves, shape (m, 4), as a lidar takes them."""
        return NO_MOVING_THINGS if self.moving is None else self.moving.shapes

    def social(self) -> dict[str, Any]:
        """How near people and robot came since the reset; empty where only the robot moves."""
        return {} if self.moving is None else self.moving.record.outcome()

    def clearance(self) -> float:
        """Distance between the footprint and what is solid and nearest, metres; 0 if they touch.

        Infinite in a plan without segments. Takes some 50 us: for evaluation.
        """
        still = clearance(self.still, self.robot, self.pose)
        return still if self.moving is None else min(still, self.moving.clearance(self.pose))

    def fits(self, pose: Pose) -> bool:
        """Whether the robot could stand at `pose`: inside the boundary, touching nothing."""
        return standing_error(self.floor_plan, self.robot, pose) is None

    def _require_reset(self) -> None:
        if self._start is None:
            raise RuntimeError("call reset(pose) first")

    def _build(self, start: Pose) -> None:
        """A new space: episodes cannot influence each other."""
        self._space = solid_space(self.still.segments)
        self._body, shape = robot_body(self.robot, start)
        self._control = pymunk.Body(body_type=pymunk.Body.KINEMATIC)
        joints = driving_joints(self.robot, self._control, self._body)
        self._space.add(self._body, shape, self._control, *joints)
        self._log = ContactLog(self._body)
        self._space.on_collision(post_solve=self._log.note)
        if self.moving is not None:
            self.moving.begin(start, self._seed)
            self._movers = Movers(self._space, self.moving, self._period)

    def _drive(self, command: tuple[float, float, float]) -> None:
        """Demand one velocity for a control period.

        A substep of Pymunk moves the body with the velocity it has and then finds the next one,
        so what is demanded now holds from the second substep to the first of the next period. It
        is demanded in the heading that the robot will have in the middle of that time; this makes
        arcs exact to second order.
        """
        body, control, step, dt = self._body, self._control, self._space.step, self._dt
        forward, left, turn = self._approach(command)
        middle = body.angle + self._axle_velocity[2] * dt + 0.5 * turn * self._period
        c, s = math.cos(middle), math.sin(middle)
        control.velocity = c * forward - s * left, s * forward + c * left
        control.angular_velocity = turn
        for _ in range(self.substeps):
            step(dt)

    def _approach(self, command: tuple[float, float, float]) -> tuple[float, float, float]:
        """The velocity nearest to the commanded one that the limits allow in one period."""
        robot = self.robot
        forward, left, turn = self._axle_velocity
        left = left if robot.holonomic else 0.0
        change = robot.max_acceleration * self._period
        turn_change = robot.max_turn_acceleration * self._period
        return (
            forward + _cut(_cut(command[0], robot.max_speed) - forward, change),
            left + _cut(_cut(command[1], robot.max_sideways_speed) - left, change),
            turn + _cut(_cut(command[2], robot.max_turn_rate) - turn, turn_change),
        )

    def _settle(self) -> None:
        """Read where the body is and how fast its axle moves.

        The velocity is in the heading for which it was demanded, see `_drive`.
        """
        body, axle = self._body, self.robot.axle
        (x, y), heading, turn = body.position, body.angle, body.angular_velocity
        c, s = math.cos(heading), math.sin(heading)
        self._pose = x - axle * c, y - axle * s, wrap_angle(heading)
        (vx, vy), middle = body.velocity, heading + turn * (self._dt - 0.5 * self._period)
        c, s = math.cos(middle), math.sin(middle)
        self._axle_velocity = c * vx + s * vy, c * vy - s * vx, turn

    def __getstate__(self) -> dict[str, Any]:
        kept = (
            "floor_plan",
            "robot",
            "control_hz",
            "substeps",
            "moving",
            "still",
            "_period",
            "_dt",
        )
        return {name: getattr(self, name) for name in (*kept, "_start", "_seed", "_journal")}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        commands, start = state["_journal"], state["_start"]
        self._journal = array("d")
        if start is not None:
            self._begin(start, state["_seed"])
            for i in range(0, len(commands), 3):
                self.step(tuple(commands[i : i + 3]))


def _finite(values: Any, name: str, parts: str) -> tuple[float, float, float]:
    try:
        first, second, third = values
        first, second, third = float(first), float(second), float(third)
    except (TypeError, ValueError):
        raise ValueError(f"{name} is {values!r}; it must be three numbers: {parts}") from None
    if not (math.isfinite(first) and math.isfinite(second) and math.isfinite(third)):
        raise ValueError(f"{name} is {(first, second, third)}; it must be finite: {parts}")
    return first, second, third


def _cut(value: float, limit: float) -> float:
    return limit if value > limit else -limit if value < -limit else value
