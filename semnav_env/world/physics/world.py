"""A robot that drives through a floor plan and is stopped by solid things."""

from __future__ import annotations

import math
from array import array
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
import pymunk
from numpy.typing import NDArray

from semnav_env.robots import RobotSpec
from semnav_env.world.dynamics import NO_DYNAMICS, Dynamics
from semnav_env.world.dynamics.boxes import box_corners
from semnav_env.world.lidar.moving import NO_MOVING_THINGS
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_env.world.maps.placement import clearance, has_room, placement_error
from semnav_env.world.physics.bodies import driving_joints, put_body, robot_body, vacant_space
from semnav_env.world.physics.chipmunk import (
    chipmunk_can_be_called,
    note_following,
    read_motion,
    run_substeps_by_pymunk,
)
from semnav_env.world.physics.chipmunk_functions import address
from semnav_env.world.physics.contacts import Contacts, note_contacts
from semnav_env.world.physics.drive import demand_velocity, drive, settle
from semnav_env.world.physics.drive_record import drive_record
from semnav_env.world.physics.free_motion import culling_around
from semnav_env.world.physics.spare_spaces import SPARE_SPACES
from semnav_features.frames import Contact, FloatArray, Point, Pose, Twist
from semnav_features.validation import finite_floats, shown

if TYPE_CHECKING:
    from semnav_env.world.dynamics.moving import Moving

SUBSTEPS_AMONG_MOVERS = 20
"""Number of substeps if something else moves: a robot's corner then overlaps a person by less than
a centimetre before the contact acts."""

LONGEST_JUMP = 0.25
"""Longest motion in a substep, as a share of the body's shorter side: a body that jumps to the
other side of a wall is not stopped by it."""

ByHand: TypeAlias = tuple[int, str, tuple[Any, ...]]
"""What was done by hand: after how many numbers of the journal, by which method, with what."""


class World:
    """One robot in a floor plan.

    A pivot and a gear joint of bounded force hold the robot to a kinematic body that moves as
    commanded, so that contacts are real. The body's centre of gravity is put on its axle: there
    the pivot keeps a differential drive from moving sideways.

    The same commands after the same `reset` give the same poses, bit for bit. Pymunk's own
    pickles lose cached contacts, so a world is pickled as its start pose, the commands since and
    what was done by hand, which are carried out again when it is loaded.

    Args:
        floor_plan: all of its segments are solid, glass too.
        robot: body and limits.
        control_hz: commands per second.
        substeps: of the physics for each command, at least; more where the robot is fast or the
            rate low (`LONGEST_JUMP`), and `SUBSTEPS_AMONG_MOVERS` where something else moves.
        dynamics: people, doors and furniture that move.

    Attributes:
        moving: people, leaves and boxes put down by hand; None where only the robot moves.
        still: the floor plan without moving things.
        record: the robot and its motion as compiled code takes them, dtype `DRIVE`; always the
            same array.
        solids: what a robot may touch, see `culling_around`.
    """

    floor_plan: FloorPlan
    robot: RobotSpec
    control_hz: float
    substeps: int
    moving: Moving | None
    still: FloorPlan
    record: np.ndarray
    solids: tuple[np.ndarray, NDArray[np.int64], FloatArray]

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
        period_way = math.hypot(robot.max_speed, robot.max_sideways_speed) * self._period
        least = math.ceil(period_way / (LONGEST_JUMP * min(robot.length, robot.width)))
        substeps = max(substeps, least, 0 if self.moving is None else SUBSTEPS_AMONG_MOVERS)
        self.control_hz, self.substeps = control_hz, substeps
        self._at_rest()
        self._start: Pose | None = None
        self._journal, self._by_hand = array("d"), list[ByHand]()
        self._seed = 0

    def _at_rest(self) -> None:
        self.record = drive_record(self.robot, self._period, self.substeps)
        if self.moving is not None:  # somebody may be near
            self.record["joint_change"] = 0.0
        self._culling = culling_around(self.still, self.robot, self._period)
        self.solids = self._culling.arrays
        self._command, self._contacts = self.record["command"], self.record["contacts"][0]

    def _moving(self, dynamics: Dynamics) -> Moving:
        from semnav_env.world.dynamics.moving import Moving  # most worlds stand still

        return Moving(self.floor_plan, self.robot, dynamics, self._period)

    def reset(self, pose: Pose, rng: np.random.Generator | None = None) -> None:
        """Put the robot at rest with its centre at `pose`, world frame, in an untouched world.

        Args:
            pose: of the robot.
            rng: for people and doors; without it they do the same every time. Nothing is drawn from
                it if only the robot moves.

        Raises:
            ValueError: the pose is not three finite numbers, lies outside the boundary, or the
                footprint would touch something solid; or there is no room for all people.
        """
        drawn = self.moving is not None and rng is not None
        self._begin(pose, int(rng.integers(2**62)) if drawn and rng is not None else 0)

    def _begin(self, pose: Pose, seed: int) -> None:
        start = _finite(pose, "pose", "(x, y, heading)")
        problem = placement_error(self.floor_plan, self.robot, start)
        if problem is not None:
            raise ValueError(problem)
        self._start, self._seed = start, seed
        self._journal, self._by_hand = array("d"), []
        self._build(start)
        self._come_to_rest()

    def _come_to_rest(self) -> None:
        """Let the robot's body stand where it is now."""
        self._body.velocity, self._body.angular_velocity = (0.0, 0.0), 0.0
        read_motion(self.record, self._body)
        self.record["demand"] = 0.0, 0.0, 0.0
        self.record["touches"] = self.record["impulse"] = self.record["contact_count"] = 0
        note_following(self.record)
        settle(self.record)

    def step(self, velocity: Twist) -> None:
        """Drive for one control period: `demand`, the compiled `drive`, `arrive`.

        Raises:
            ValueError: not three finite numbers.
            RuntimeError: before the first `reset`.
        """
        self.demand(velocity)
        drive(self.record, self.solids)
        self.arrive()

    def demand(self, velocity: Twist) -> None:
        """Set the velocity of the robot for the next control period, and move everything else.

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
        self._command[0] = command
        if self.moving is not None:
            self.moving.step(self.pose, self.velocity)
            self._movers.go()
        if not self._compiled:
            record = self.record
            if not demand_velocity(record, self.solids):
                run_substeps_by_pymunk(record, self._space, self._control, self._body)

    @property
    def needs_python(self) -> bool:
        """Whether `demand` and `arrive` have to be called, and not the compiled `drive` alone."""
        return self.moving is not None or not self._compiled

    def note_command(self, velocity: Twist) -> None:
        """Note a command that is carried out without `demand`."""
        self._journal.extend(velocity)

    def note_commands(self, commands: FloatArray) -> None:
        """Note the commands that were carried out without `demand`, shape (k, 3), in order."""
        self._journal.extend(commands.ravel().tolist())

    def arrive(self) -> None:
        """End a control period for everything that moves besides the robot."""
        if self.moving is not None:
            self._movers.arrive()
            self.moving.note(self.pose, self.velocity)

    @property
    def pose(self) -> Pose:
        """Of the footprint's centre, world frame; the heading is in [-pi, pi]."""
        return self._of_record("pose")

    @property
    def velocity(self) -> Twist:
        """Of the footprint's centre, robot frame: forward, left (m/s) and turn (rad/s)."""
        return self._of_record("velocity")

    @property
    def contacts(self) -> Contacts:
        """The contacts of the robot during the last step."""
        self._require_reset()
        return Contacts(int(self.record["touches"][0]), float(self.record["impulse"][0]))

    @property
    def in_contact(self) -> bool:
        """Whether the robot touched anything during the last step."""
        self._require_reset()
        return bool(self.record["touches"][0])

    @property
    def touches(self) -> list[Contact]:
        """Contact points with things that cannot move during the last step, robot frame."""
        count = int(self.record["contact_count"][0])
        return [(x, y, inward) for x, y, inward in self._contacts[:count].tolist()]

    def add_person(self, place: Point) -> None:
        """Let one more person walk about from a place, until the next `reset`.

        Args:
            place: x and y, metres, world frame.

        Raises:
            ValueError: no two finite numbers, the place is not free, or there are as many as
                `Dynamics.by_hand` allows.
            RuntimeError: before the first `reset`.
        """
        place = _point(place, "person")
        self._where_things_move("added", "by_hand=8").add_person(place, self.pose)
        self._movers.add_person()
        self._note_by_hand("add_person", place)

    def add_box(self, middle: Point) -> None:
        """Put down a box, a square of `BOX_SIDE` along the axes, which stays until `reset`.

        Args:
            middle: x and y, metres, world frame.

        Raises:
            ValueError: no two finite numbers; a wall, furniture, somebody, the robot, another box
                or a leaf that swings is in its way; or there are as many as `Dynamics.by_hand`
                allows.
            RuntimeError: before the first `reset`.
        """
        middle = _point(middle, "box")
        self._where_things_move("added", "by_hand=8").add_box(middle, self.pose)
        self._movers.add_box(box_corners(middle))
        self._note_by_hand("add_box", middle)

    def hold_door(self, door: str, shut: bool) -> None:
        """Shut a door by hand, or open it; it stays so until the next `reset`.

        Args:
            door: name of a door with a leaf that can swing.
            shut: whether it is to be shut.

        Raises:
            ValueError: no such leaf.
            RuntimeError: before the first `reset`.
        """
        self._where_things_move("shut", "changing_doors=0.3").doors.hold(door, shut)
        self._note_by_hand("hold_door", door, shut)

    def place_robot(self, pose: Pose) -> None:
        """Carry the robot to another place by hand, where it stands at rest.

        Odometry feels it, as visual odometry would, so that what the robot remembers stays true:
        the next control period adds the way there, as if it were driven straight. Judge and belief
        take it so, too.

        Args:
            pose: of the footprint's centre, world frame.

        Raises:
            ValueError: not three finite numbers, outside the boundary, or the footprint would touch
                a wall, furniture, somebody, a leaf or a box.
            RuntimeError: before the first `reset`.
        """
        self._require_reset()
        pose = _finite(pose, "pose", "(x, y, heading)")
        problem = placement_error(self.still, self.robot, pose)
        if problem is not None:
            raise ValueError(problem)
        if self.moving is not None:
            self.moving.check_robot(pose)
        put_body(self.robot, self._body, pose)
        self._come_to_rest()
        self._note_by_hand("place_robot", pose)

    def _where_things_move(self, done: str, setting: str) -> Moving:
        self._require_reset()
        if self.moving is None:
            raise ValueError(
                f"nothing can be {done} in this world, where only the robot moves; "
                f"give dynamics=Dynamics({setting})"
            )
        return self.moving

    def _note_by_hand(self, method: str, *values: Any) -> None:
        self._by_hand.append((len(self._journal), method, values))

    @property
    def moving_buffers(self) -> tuple[FloatArray, FloatArray]:
        """As `moving_shapes`, with rows for what is added by hand; always the same arrays."""
        return NO_MOVING_THINGS if self.moving is None else self.moving.buffers

    @property
    def moving_shapes(self) -> tuple[FloatArray, FloatArray]:
        """Discs of people, shape (n, 3), and leaves and sides of added boxes, shape (m, 4)."""
        moving = self.moving
        return NO_MOVING_THINGS if moving is None else (moving.discs, moving.segments)

    def social(self) -> dict[str, Any]:
        """Gaps between people and robot since the reset; empty if only the robot moves."""
        return {} if self.moving is None else self.moving.record.outcome()

    def clearance(self) -> float:
        """Distance between the footprint and the nearest solid thing, metres; 0 if they touch.

        Infinite in a plan without segments. Takes some 50 us: for evaluation.
        """
        still = clearance(self.still, self.robot, self.pose)
        return still if self.moving is None else min(still, self.moving.clearance(self.pose))

    def fits(self, pose: Pose) -> bool:
        """Whether the robot could stand at `pose`: inside the boundary, touching nothing."""
        return has_room(self.floor_plan, self.robot, pose)

    def _of_record(self, name: str) -> tuple[float, float, float]:
        self._require_reset()
        first, second, third = self.record[name].item()
        return first, second, third

    def _require_reset(self) -> None:
        if self._start is None:
            raise RuntimeError("call reset(pose) first")

    def _build(self, start: Pose) -> None:
        """A space like a new one: episodes cannot influence each other."""
        last = self.__dict__.get("_space") if self.moving is None else None
        if last is None and self.moving is None:
            last = SPARE_SPACES.take(self.still)
        space = vacant_space(self.still.segments, last)
        if self.moving is None and "_space" not in self.__dict__:
            SPARE_SPACES.give_when_gone(self, self.still, space)
        self._space = space
        self._body, shape = robot_body(self.robot, start)
        self._control = pymunk.Body(body_type=pymunk.Body.KINEMATIC)
        joints = driving_joints(self.robot, self._control, self._body)
        self._space.add(self._body, shape, self._control, *joints)
        self._compiled = chipmunk_can_be_called()
        self.record["space"] = address(self._space._space) if self._compiled else 0
        self.record["control"] = address(self._control._body)
        self.record["body"] = address(self._body._body)
        note_contacts(self._space, self.record, self._compiled)
        if self.moving is not None:
            self.moving.begin(start, self._seed)
            from semnav_env.world.physics.movers import Movers  # in most worlds nothing moves

            self._movers = Movers(self._space, self.moving, self._period)

    def __getstate__(self) -> dict[str, Any]:
        kept = (
            "floor_plan",
            "robot",
            "control_hz",
            "substeps",
            "moving",
            "still",
            "_period",
        )
        journal = "_start", "_seed", "_journal", "_by_hand"
        return {name: getattr(self, name) for name in (*kept, *journal)}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        self._at_rest()
        commands, by_hand, start = state["_journal"], state["_by_hand"], state["_start"]
        self._journal, self._by_hand = array("d"), []
        if start is not None:
            self._begin(start, state["_seed"])
            for until, method, values in by_hand:
                self._step_again(commands[len(self._journal) : until])
                getattr(self, method)(*values)
            self._step_again(commands[len(self._journal) :])

    def _step_again(self, commands: array[float]) -> None:
        for i in range(0, len(commands), 3):
            self.step((commands[i], commands[i + 1], commands[i + 2]))


def _finite(values: Any, name: str, parts: str) -> tuple[float, float, float]:
    numbers = finite_floats(values)
    if numbers is None or len(numbers) != 3:
        raise ValueError(f"{name} is {shown(values)}; it must be three finite numbers: {parts}")
    return numbers[0], numbers[1], numbers[2]


def _point(values: Any, name: str) -> Point:
    numbers = finite_floats(values)
    if numbers is None or len(numbers) != 2:
        raise ValueError(f"{name} is {shown(values)}; it must be two finite numbers: (x, y)")
    return numbers[0], numbers[1]
