"""Widths of what counts as a door, for the extractor, for floor plans and for the judge."""

from __future__ import annotations

from dataclasses import dataclass

from semnav_features.checked_fields import Length, check_fields, require_order


@dataclass(frozen=True, slots=True)
class DoorRules:
    """Width of an opening between two jambs that counts as a door.

    Attributes:
        width_min: narrowest door, metres. Barbret 2021, section 3.1, has 0.8; measured room
            doors have a clear width of 0.76 to 0.83.
        width_max: widest door, metres (Barbret 2021, section 3.1).
        width_tolerance: added to both limits, metres: the error of a measured width.

    Raises:
        ValueError: a width is not a number, negative or too large, or the narrowest door exceeds
        the widest.
    """

    width_min: Length = 0.7
    width_max: Length = 1.2
    width_tolerance: Length = 0.05

    def __post_init__(self) -> None:
        check_fields(self)
        require_order(self, ("width_min", "width_max"))

    @property
    def widest(self) -> float:
        """The widest opening that counts, metres; a wider one is an opening of the wall."""
        return self.width_max + self.width_tolerance

    @property
    def narrowest(self) -> float:
        """The narrowest opening that counts, metres."""
        return self.width_min - self.width_tolerance
