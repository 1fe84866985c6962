"""Settings of people, doors and furniture that change; everything is off by default."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Annotated, TypeAlias

from semnav_features.checked_fields import Bounds, OneOf, Share, check_fields, require_span
from semnav_features.validation import require

StaySeconds: TypeAlias = Annotated[float, Bounds(0.1, 10_000.0, "s")]

MODELS = ("social_force", "orca")
"""Models of how people avoid each other."""


MAX_SPEED_FACTOR = 1.3
"""Largest speed of a person as a multiple of the desired one (Helbing and Molnar 1995, below
equation (12))."""

AWAY = 1e6
"""Both coordinates of what is not there yet, metres: out of reach of every lidar."""


@dataclass(frozen=True)
class Walking:
    """Settings of the walk of people.

    Attributes:
        radius: radius of a person, a disc for lidar and physics, metres.
        speed: mean of the desired speeds, m/s (Helbing and Molnar 1995).
        spread: standard deviation of the desired speeds, m/s; cut off at two of them.
        patience: time without progress after which a person chooses another place, seconds.
        see_robot: whether people evade the robot. In both cases they never step into it.
    """

    radius: Annotated[float, Bounds(0.1, 0.5, "m")] = 0.25
    speed: Annotated[float, Bounds(0.01, 2.0, "m/s")] = 1.34
    spread: Annotated[float, Bounds(0.0, 1.0, "m/s")] = 0.26
    patience: StaySeconds = 6.0
    see_robot: bool = True

    def __post_init__(self) -> None:
        check_fields(self)
        require(self.spread < self.speed / 2, "spread", self.spread, "below half the speed")


@dataclass(frozen=True)
class Swinging:
    """Settings of the motion of doors.

    Attributes:
        open_for: shortest and longest time that a door stands open, seconds.
        closed_for: the same for a closed door, so a closed door always opens again.
        rate: angular speed of the leaf, rad/s.
    """

    open_for: tuple[StaySeconds, StaySeconds] = (4.0, 25.0)
    closed_for: tuple[StaySeconds, StaySeconds] = (4.0, 10.0)
    rate: Annotated[float, Bounds(0.01, 2.0, "rad/s")] = 0.8

    def __post_init__(self) -> None:
        check_fields(self)
        for name in ("open_for", "closed_for"):
            require_span(name, getattr(self, name))


@dataclass(frozen=True)
class Dynamics:
    """People, doors that open and close, and furniture that was moved.

    Attributes:
        pedestrians: number of people who walk about.
        model: model of how they avoid each other, "social_force" or "orca".
        changing_doors: probability that a door with room to swing opens and closes in an episode.
            Every such door gets a leaf if the plan draws none.
        moved_furniture: probability that a piece of furniture of the plan is moved.
        added_boxes: number of boxes that are added to the plan in each episode.
        victims: number of people who lie or sit on the floor of rooms, at other places in each
            episode.
        walking: how people walk.
        swinging: how doors move.
        by_hand: largest number of boxes, and of people, that can be added while an episode runs
            (`World.add_box`, `World.add_person`).
    """

    pedestrians: Annotated[int, Bounds(0, 200)] = 0
    model: Annotated[str, OneOf(MODELS)] = "social_force"
    changing_doors: Share = 0.0
    moved_furniture: Share = 0.0
    added_boxes: Annotated[int, Bounds(0, 100)] = 0
    victims: Annotated[int, Bounds(0, 20)] = 0
    walking: Walking = field(default_factory=Walking)
    swinging: Swinging = field(default_factory=Swinging)
    by_hand: Annotated[int, Bounds(0, 20)] = 0

    def __post_init__(self) -> None:
        check_fields(self)

    @property
    def moves(self) -> bool:
        """Whether anything moves during an episode."""
        return self.pedestrians > 0 or self.changing_doors > 0.0 or self.by_hand > 0

    @property
    def furnishes(self) -> bool:
        """Whether every episode has furniture, or people on the floor, of its own."""
        return self.moved_furniture > 0.0 or self.added_boxes > 0 or self.victims > 0

    @property
    def changes_plan(self) -> bool:
        """Whether an episode's doors or furniture can differ from those of the plan as drawn."""
        return self.furnishes or self.changing_doors > 0.0


NO_DYNAMICS = Dynamics()
"""Settings with which nothing moves but the robot."""
