"""The parameters of point planning: those of Mes 2021, and the same for other bodies."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, TypeAlias

from semnav_env.robots import RobotSpec
from semnav_features.checked_fields import Bounds, check_fields

Size: TypeAlias = Annotated[float, Bounds(0.001, 100.0, "m")]
Turn: TypeAlias = Annotated[float, Bounds(0.001, math.tau, "rad")]
Few: TypeAlias = Annotated[int, Bounds(1, 1000)]


@dataclass(frozen=True, slots=True)
class ApproachSettings:
    """The parameters of point planning; the defaults are those of the text of Mes 2021, for SPOT.

    Attributes:
        free_side: side of the square that must be free before the door, metres: the diagonal of
            1.21 m of SPOT's body and a buffer (section 5.2).
        stand_off: distance before the door of the pose that is taken if the square is free, metres
            (sections 2.1 and 5.2).
        radius: of the dodecagon of positions around the middle of the door, metres. Section 5.3 has
            half of `free_side`, 0.625 m; the positions of Table 7.2 need 0.63 m.
        corners: number of the dodecagon's corners (section 5.3).
        positions: the corners nearest to straight before the door (section 5.3).
        headings: number of headings at each position, around straight at the door (section 5.3).
        heading_step: angle between two of them, radians (section 5.3).
        wall_clearance: least distance from a position to the walls of the room, metres (5.3).
        ellipse_length: of the ellipse around a pose, along its heading, metres (section 5.4).
        ellipse_width: of that ellipse, metres (section 5.4).
        rounding: to which positions are rounded before they are measured, metres. The thesis does
            not say so, but Table 7.2 has the errors of rounded positions. A coordinate halfway
            between two steps stays: the table rounds some of these up and some down.
        wraps_at: what is taken off an angle error that exceeds pi, radians: a whole turn. Table 7.2
            needs half of one (`THESIS_SETTINGS`); errors then depend on how the map is turned.
    """

    free_side: Size = 1.25
    stand_off: Size = 1.0
    radius: Size = 0.63
    corners: Few = 12
    positions: Few = 5
    headings: Few = 5
    heading_step: Turn = math.pi / 4
    wall_clearance: Size = 0.30
    ellipse_length: Size = 1.2
    ellipse_width: Size = 0.6
    rounding: Annotated[float, Bounds(0.0, 1.0, "m")] = 0.01
    wraps_at: Turn = math.tau

    def __post_init__(self) -> None:
        check_fields(self)

    @staticmethod
    def for_robot(robot: RobotSpec) -> ApproachSettings:
        """The settings for a body; for SPOT's they are those of the thesis.

        Each length grows with the body as the thesis took it from SPOT's: the square is the
        diagonal, up to the next 5 cm; the ellipse is 10 cm longer and wider than the body; the
        clearance is half the ellipse's width. The radius is half the square, up to the next
        centimetre, or twice the clearance if that is more: the outermost positions, which are half
        a radius off the wall, would not be clear otherwise.
        """
        free_side = math.ceil(math.hypot(robot.length, robot.width) / 0.05 - 1e-9) * 0.05
        width = robot.width + 0.10
        return ApproachSettings(
            free_side=free_side,
            radius=math.ceil(max(free_side / 2, width) * 100 - 1e-9) / 100,
            wall_clearance=width / 2,
            ellipse_length=robot.length + 0.10,
            ellipse_width=width,
        )


THESIS_SETTINGS = ApproachSettings(wraps_at=math.pi)
"""Settings that reproduce Table 7.2 of Mes 2021, for SPOT in her hall; plan with the default
ones."""
