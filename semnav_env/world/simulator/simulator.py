"""World, robot, lidar and odometry behind one object; it knows nothing of commands."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from semnav_env.robots import WHEELCHAIR, RobotSpec
from semnav_env.world.dynamics import NO_DYNAMICS, Dynamics
from semnav_env.world.lidar.lidar import Lidar
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_env.world.physics import World
from semnav_env.world.simulator.odometry import Odometry, OdometrySettings
from semnav_env.world.simulator.sensed import Motion, Sensed
from semnav_env.world.simulator.sensing import (
    NUMBERS,
    SENSING,
    TOUCHED,
    SimulatorArrays,
    look,
    sense,
)
from semnav_features.checked_fields import check_fields
from semnav_features.frames import FloatArray, Pose, Twist
from semnav_features.lidar_spec import LidarSpec
from semnav_features.lidars import TIM561
from semnav_features.one_thread import ThreadDoor, for_one_thread

if TYPE_CHECKING:
    from semnav_env.robots import DepthRig
    from semnav_features.clouds import PointCloud


@dataclass(frozen=True)
class RobotSetup:
    """The body and the sensors of a simulated robot.

    Attributes:
        robot: the body.
        lidar: on the body's mount; its rate is the control rate.
        odometry: errors of dead reckoning.
        exact: whether the lidar has no error and odometry is the true pose, world frame.
    """

    robot: RobotSpec = WHEELCHAIR
    lidar: LidarSpec = TIM561
    odometry: OdometrySettings = OdometrySettings()
    exact: bool = False

    def __post_init__(self) -> None:
        check_fields(self)

    @property
    def control_hz(self) -> float:
        """Control periods per second: one scan in each."""
        return self.lidar.rate_hz

    @property
    def info(self) -> dict[str, Any]:
        """Entries of `info` of `reset` about body and lidar: their fields by name."""
        return {"robot": vars(self.robot).copy(), "lidar": vars(self.lidar).copy()}

    def with_changes(
        self,
        robot: RobotSpec | None = None,
        lidar: LidarSpec | None = None,
        odometry: OdometrySettings | None = None,
    ) -> RobotSetup:
        """The setup with another body, lidar or odometry; itself where nothing is given.

        Raises:
            ValueError: action or observation would have another shape or bounds, or the control
                rate would be another one.
        """
        if robot is not None and robot.action_size != self.robot.action_size:
            raise ValueError(
                f"{robot.name} takes {robot.action_size} values as an action; the environment's "
                f"{self.robot.name} takes {self.robot.action_size}"
            )
        for name in ("beams", "range_max", "rate_hz") if lidar is not None else ():
            if getattr(lidar, name) != getattr(self.lidar, name):
                raise ValueError(
                    f"the lidar has {name} {getattr(lidar, name)}; "
                    f"the environment's has {getattr(self.lidar, name)}"
                )
        changes = {"robot": robot, "lidar": lidar, "odometry": odometry}
        given: dict[str, Any] = {name: new for name, new in changes.items() if new is not None}
        return replace(self, **given) if given else self


class Simulator:
    """A robot that senses while it is driven through a floor plan.

    Args:
        floor_plan: the floor plan.
        setup: body and sensors of the robot.
        dynamics: people, doors and furniture that move.

    Attributes:
        world: the physics.
        lidar: on its mount.
        odometry: dead reckoning.
        last_ranges: of the last scan, metres, shape (beams,); always the same array.
        arrays: the arrays of the compiled `sense`; they are made again for a copy.
    """

    floor_plan: FloorPlan
    setup: RobotSetup
    world: World
    lidar: Lidar
    odometry: Odometry
    last_ranges: FloatArray
    arrays: SimulatorArrays
    thread_door: ThreadDoor

    def __init__(
        self,
        floor_plan: FloorPlan,
        setup: RobotSetup = RobotSetup(),
        dynamics: Dynamics = NO_DYNAMICS,
    ) -> None:
        self.floor_plan, self.setup, robot = floor_plan, setup, setup.robot
        self.world = World(floor_plan, robot, setup.control_hz, dynamics=dynamics)
        spec = setup.lidar
        if setup.exact:
            spec = replace(spec, sigma=0.0, dropout=0.0, systematic=0.0)
        self.lidar = Lidar(self.world.still, spec, robot.lidar_mount, self.world.moving_buffers)
        self.odometry = Odometry(setup.odometry)
        self._seconds = 1.0 / setup.control_hz
        self.last_ranges = np.zeros(spec.beams)
        self._record = np.zeros(1, SENSING)
        self._record["exact"] = setup.exact
        self.thread_door = ThreadDoor()
        self._join()

    def _join(self) -> None:
        x, y, heading = map(float, self.lidar.mount)
        self.arrays = SimulatorArrays.of(
            drive=self.world.record,
            solids=self.world.solids,
            odometry=self.odometry.record,
            sensing=self._record,
            lidar=self.lidar.arrays,
            mount=(x, y, heading),
            ranges=self.last_ranges,
        )
        self._numbers = self._record.view(np.float64)[:NUMBERS]

    def __getstate__(self) -> dict[str, Any]:
        made_anew = ("arrays", "_numbers")
        return {name: value for name, value in self.__dict__.items() if name not in made_anew}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        self._join()

    @property
    def steps(self) -> int:
        """Control periods since the reset."""
        return int(self._record["step"][0])

    @property
    def motion(self) -> Motion:
        """The true motion of the last control period."""
        return self.last.motion

    @property
    def last(self) -> Sensed:
        """The sensor data of the last control period."""
        return self._sensed(TOUCHED if self.world.in_contact else 0)

    @for_one_thread
    def reset(self, start: Pose, rng: np.random.Generator) -> Sensed:
        """Put the robot at rest at a pose, world frame; returns what it senses there.

        Args:
            start: pose of the robot's centre, world frame.
            rng: draws what moves, the drift and the noise of the episode.

        Raises:
            ValueError: the robot cannot stand there.
        """
        self.world.reset(start, rng)
        self.odometry.reset(start, rng)
        self._record["noise_seed"], self._record["step"] = rng.integers(2**62), 0
        return self._sensed(look(self.arrays))

    @for_one_thread
    def step(self, twist: Twist) -> Sensed:
        """Drive for one control period; returns what the robot senses at its end.

        It is `demand`, the compiled `sense`, which may run in another thread, and `sensed`.

        Args:
            twist: commanded velocity, cut to what the robot can do.

        Raises:
            ValueError: not three finite numbers.
            RuntimeError: before the first `reset`, or while another thread is in `reset` or `step`.
        """
        self.demand(twist)
        return self.sensed(sense(self.arrays))

    def see(self, rig: DepthRig) -> PointCloud:
        """The cloud of depth cameras at the robot's present pose; repeated calls give the same.

        Args:
            rig: the cameras.
        """
        from semnav_env.world.depth import raise_plan, rig_hits  # seldom asked for

        raised = self.world.still.derived(raise_plan)
        rng = np.random.default_rng((int(self._record["noise_seed"][0]), self.steps))
        return rig_hits(rig, raised, self.motion.pose, rng, self.world.moving_shapes).cloud

    def demand(self, twist: Twist) -> None:
        """Set the velocity of the robot for the next control period; raises errors of `step`."""
        self.world.demand(twist)

    def sensed(self, events: int) -> Sensed:
        """The sensor data, given the events that `sense` returned."""
        self.world.arrive()
        return self._sensed(events)

    def _sensed(self, events: int) -> Sensed:
        x, y, heading, forward, left, turn, odometry_x, odometry_y, odometry_heading, speed = (
            self._numbers.tolist()
        )
        touched = bool(events & TOUCHED)
        return Sensed(
            self.last_ranges,
            (odometry_x, odometry_y, odometry_heading),
            (forward, left, turn),
            self.world.touches if touched else [],
            Motion((x, y, heading), speed, turn, touched, self._seconds),
        )
