"""What counts as a door: one rule for the extractor, for a floor plan and for the judge."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class DoorRules:
    """How wide the opening between two jambs is that counts as a door.

    Attributes:
        width_min: narrowest door, metres. Barbret 2021, section 3.1, has 0.8; room doors that were
            measured are 0.76 to 0.83 clear.
        width_max: widest door, metres (Barbret 2021, section 3.1).
        width_tolerance: added to both limits, metres: the error of a measured width.

    Raises:
        ValueError: a width is negative or not finite, or the narrowest door exceeds the widest.
    """

    width_min: float = 0.7
    width_max: float = 1.2
    width_tolerance: float = 0.05

    def __post_init__(self) -> None:
        values = self.width_min, self.width_max, self.width_tolerance
        if not all(math.isfinite(value) and value >= 0.0 for value in values):
            raise ValueError(f"{self} has a width that is negative or not finite")
        if self.width_min > self.width_max:
            raise ValueError(f"{self}: width_min must not exceed width_max")

    @property
    def widest(self) -> float:
        """The widest opening that counts, metres; a wider one is an opening of the wall."""
        return self.width_max + self.width_tolerance

    @property
    def narrowest(self) -> float:
        """The narrowest opening that counts, metres."""
        return self.width_min - self.width_tolerance
