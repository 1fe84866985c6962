"""The robots' bodies and limits."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, TypeAlias

from semnav_features.checked_fields import Bounds, check_fields
from semnav_features.validation import by_name, require

Extent: TypeAlias = Annotated[float, Bounds(0.02, 5.0, "m")]
Offset: TypeAlias = Annotated[float, Bounds(-2.5, 2.5, "m")]


@dataclass(frozen=True)
class RobotSpec:
    """A rectangular robot. The robot frame's origin is the centre of the footprint.

    Attributes:
        name: as in `robot=`.
        length: extent along x, metres.
        width: extent along y, metres.
        mass: kilograms.
        max_speed: forward and backward, m/s.
        max_sideways_speed: m/s; 0 for a differential drive.
        max_turn_rate: rad/s.
        max_acceleration: m/s^2, forward and sideways; the floor's grip allows no more than 6.87.
        max_turn_acceleration: rad/s^2; the floor's grip allows about 13 with the wheelchair's body.
        axle: x of the point that a turn on the spot turns about, metres in the robot frame.
        lidar_mount: pose of the lidar in the robot frame.
        source: where the numbers come from.

    Raises:
        ValueError: a field has another type or is out of its bounds, or the axle or the lidar is
            not on the body; names it.
    """

    name: str
    length: Extent
    width: Extent
    mass: Annotated[float, Bounds(0.01, 10_000.0, "kg")]
    max_speed: Annotated[float, Bounds(0.01, 10.0, "m/s")]
    max_sideways_speed: Annotated[float, Bounds(0.0, 10.0, "m/s")]
    max_turn_rate: Annotated[float, Bounds(0.01, 20.0, "rad/s")]
    max_acceleration: Annotated[float, Bounds(0.01, 100.0, "m/s^2")]
    max_turn_acceleration: Annotated[float, Bounds(0.01, 200.0, "rad/s^2")]
    axle: Offset
    lidar_mount: tuple[Offset, Offset, Annotated[float, Bounds(-math.tau, math.tau, "rad")]]
    source: str

    def __post_init__(self) -> None:
        check_fields(self)
        front, side = self.length / 2, self.width / 2
        x, y, _ = self.lidar_mount
        on_body = f"on the body: x from {-front:g} to {front:g} m"
        require(abs(self.axle) <= front, "axle", self.axle, on_body)
        on_body += f", y from {-side:g} to {side:g} m"
        require(abs(x) <= front and abs(y) <= side, "lidar_mount", self.lidar_mount, on_body)

    @property
    def holonomic(self) -> bool:
        """Whether it can move sideways."""
        return self.max_sideways_speed > 0

    @property
    def action_size(self) -> int:
        """3 (forward, left, turn) for a holonomic robot, else 2 (forward, turn)."""
        return 3 if self.holonomic else 2


WHEELCHAIR = RobotSpec(
    name="wheelchair",
    length=1.10,
    width=0.65,
    mass=120.0,
    max_speed=1.5,
    max_sideways_speed=0.0,
    max_turn_rate=1.5,
    max_acceleration=1.0,
    max_turn_acceleration=3.0,
    axle=-1.10 / 2 + 1.10 / 3,
    lidar_mount=(0.45, 0.0, 0.0),
    source="a powered wheelchair inside the maximum overall dimensions of ISO 7193 "
    "(1.20 m x 0.70 m), driven at the rear third of its length; lidar at "
    "the front as in Barbret 2021",
)
"""A powered wheelchair with a lidar in front, as in Barbret 2021."""

SPOT = RobotSpec(
    name="spot",
    length=1.10,
    width=0.50,
    mass=32.5,
    max_speed=1.6,
    max_sideways_speed=0.5,
    max_turn_rate=1.5,
    max_acceleration=2.0,
    max_turn_acceleration=4.0,
    axle=0.0,
    lidar_mount=(0.30, 0.0, 0.0),
    source="Boston Dynamics' SPOT specification: 1.10 m x 0.50 m, 1.6 m/s; the robot of Mes 2021",
)
"""The four-legged robot SPOT as a box that can also move sideways."""

ROBOTS = {spec.name: spec for spec in (WHEELCHAIR, SPOT)}
"""The bodies of the package by their names."""


def robot_spec(name_or_spec: str | RobotSpec) -> RobotSpec:
    """The robot of that name, or the spec itself.

    Raises:
        ValueError: no such robot; lists those there are.
    """
    return by_name("robot", name_or_spec, RobotSpec, ROBOTS)
