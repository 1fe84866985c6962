"""Settings of what changes during and between episodes; everything is off by default."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

MODELS = ("social_force", "orca")
"""Models of how people avoid each other."""


MAX_SPEED_FACTOR = 1.3
"""Largest speed of a person as a multiple of the desired one (Helbing and Molnar 1995, below
equation (12))."""


@dataclass(frozen=True)
class Walking:
    """How people walk.

    Attributes:
        radius: radius of a person, a disc for lidar and physics, metres.
        speed: mean of the desired speeds, m/s (Helbing and Molnar 1995).
        spread: standard deviation of the desired speeds, m/s; cut off at two of them.
        patience: seconds without getting nearer after which somebody walks elsewhere.
        see_robot: whether people keep away from the robot by themselves. They never step into it
            either way.
    """

    radius: float = 0.25
    speed: float = 1.34
    spread: float = 0.26
    patience: float = 6.0
    see_robot: bool = True

    def __post_init__(self) -> None:
        """Check the numbers."""
        _check(0.1 <= self.radius <= 0.5, "radius", self.radius, "between 0.1 and 0.5 m")
        _check(0.0 < self.speed <= 2.0, "speed", self.speed, "positive and at most 2 m/s")
        _check(0.0 <= self.spread < self.speed / 2, "spread", self.spread, "below half the speed")
        _check(0.0 < self.patience < math.inf, "patience", self.patience, "positive, seconds")


@dataclass(frozen=True)
class Swinging:
    """How doors open and close.

    Attributes:
        open_for: shortest and longest time that a door stands open, seconds.
        closed_for: the same for closed; so a closed door always opens again.
        rate: angular speed of the leaf, rad/s.
    """

    open_for: tuple[float, float] = (4.0, 25.0)
    closed_for: tuple[float, float] = (4.0, 10.0)
    rate: float = 0.8

    def __post_init__(self) -> None:
        """Check the numbers."""
        for name in ("open_for", "closed_for"):
            least, most = getattr(self, name)
            _check(0.0 < least <= most < math.inf, name, (least, most), "0 < least <= most")
        _check(0.0 < self.rate <= 2.0, "rate", self.rate, "positive and at most 2 rad/s")


@dataclass(frozen=True)
class Dynamics:
    """People, doors that open and close, and furniture that was moved.

    Attributes:
        pedestrians: number of people who walk about.
        model: model of how they avoid each other, "social_force" or "orca".
        changing_doors: probability that a door with room to swing opens and closes in an episode.
            Every such door gets a leaf if the plan draws none.
        moved_furniture: probability that a piece of furniture of the plan is found elsewhere.
        added_boxes: number of boxes that are added to the plan in each episode.
        walking: how people walk.
        swinging: how doors move.
    """

    pedestrians: int = 0
    model: str = "social_force"
    changing_doors: float = 0.0
    moved_furniture: float = 0.0
    added_boxes: int = 0
    walking: Walking = field(default_factory=Walking)
    swinging: Swinging = field(default_factory=Swinging)

    def __post_init__(self) -> None:
        """Check the numbers."""
        _check(self.model in MODELS, "model", self.model, f"one of {', '.join(MODELS)}")
        for name, most in (("pedestrians", 200), ("added_boxes", 100)):
            value = getattr(self, name)
            whole = isinstance(value, int) and 0 <= value <= most
            _check(whole, name, value, f"a whole number from 0 to {most}")
        for name in ("changing_doors", "moved_furniture"):
            value = getattr(self, name)
            _check(0.0 <= value <= 1.0, name, value, "a probability in [0, 1]")

    @property
    def moves(self) -> bool:
        """Whether anything moves during an episode."""
        return self.pedestrians > 0 or self.changing_doors > 0.0

    @property
    def furnishes(self) -> bool:
        """Whether every episode has furniture of its own."""
        return self.moved_furniture > 0.0 or self.added_boxes > 0


def _check(holds: bool, name: str, value: object, right: str) -> None:
    if not holds:
        raise ValueError(f"{name} is {value!r}; it must be {right}")


NO_DYNAMICS = Dynamics()
"""Settings with which nothing moves but the robot."""
