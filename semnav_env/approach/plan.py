"""Point planning: the poses before a door from best to worst (Mes 2021, Algorithm 1)."""

from __future__ import annotations

import math
from dataclasses import dataclass

from shapely import Polygon
from shapely.geometry.base import BaseGeometry

from semnav_env.approach.door_side import DoorSide
from semnav_env.approach.poses import CandidatePose, body_at, candidates, free_square
from semnav_env.approach.settings import ApproachSettings
from semnav_env.approach.surroundings import Surroundings
from semnav_env.robots import SPOT, RobotSpec
from semnav_features.frames import Pose

AREA_TOLERANCE = 1e-6
"""Area of the square that may be cut off by rounding, square metres."""


@dataclass(frozen=True, eq=False)
class ApproachPlan:
    """The candidate poses before a door, and the result of point planning.

    Attributes:
        side: the door and the side before it.
        room: the free space before it, within reach.
        square: the free-space square (section 5.2).
        square_is_free: whether nothing solid cuts it; then `straight` is the best pose.
        straight: the pose `stand_off` before the door, facing it.
        straight_clear: whether the body touches nothing there.
        ranked: all candidates; the safe ones first, then those that are clear of walls, each from
            best to worst; each refused candidate has a reason.
        clear_count: number of candidates at a position that is clear of walls.
    """

    side: DoorSide
    room: BaseGeometry
    square: Polygon
    square_is_free: bool
    straight: Pose
    straight_clear: bool
    ranked: tuple[CandidatePose, ...]
    clear_count: int

    @property
    def clear_of_walls(self) -> tuple[CandidatePose, ...]:
        """The candidates at positions that keep the wall clearance, best first (Table 7.2)."""
        return self.ranked[: self.clear_count]

    @property
    def safe(self) -> tuple[CandidatePose, ...]:
        """The candidates whose ellipse is free, best first."""
        return tuple(each for each in self.ranked if each.is_safe)

    @property
    def usable(self) -> tuple[Pose, ...]:
        """The poses to try in turn; in none of them the body touches anything."""
        straight = (self.straight,) if self.square_is_free and self.straight_clear else ()
        return straight + tuple(each.pose for each in self.safe if each.body_clear)

    @property
    def best(self) -> Pose | None:
        """The pose to take; None if there is none."""
        return next(iter(self.usable), None)


def plan_approach(
    side: DoorSide,
    surroundings: Surroundings,
    robot: RobotSpec = SPOT,
    settings: ApproachSettings | None = None,
    start: Pose | None = None,
) -> ApproachPlan:
    """The poses before a door from which it can be passed, best first.

    Args:
        side: the door and the side before it.
        surroundings: walls, doors and obstacles, in the frame of the door.
        robot: the body.
        settings: the parameters; None for those of the body (`ApproachSettings.for_robot`).
        start: where the robot is; of poses that are equally good the nearer is better.

    Raises:
        ValueError: `start` is not finite, or the door is narrower than the body.
    """
    if side.width < robot.width:
        body = f"a {robot.name}, {robot.width:.2f} m wide,"
        raise ValueError(f"the door is {side.width:.2f} m wide; {body} does not fit through")
    if start is not None and not all(map(math.isfinite, start)):
        raise ValueError(f"start is {start}; it must be finite x, y and heading")
    settings = settings or ApproachSettings.for_robot(robot)
    room, solids = surroundings.room_before(side), surroundings.solids_near(side)
    square = free_square(side, settings)
    free = square.area - square.intersection(room).area < AREA_TOLERANCE
    x, y, through = side.frame
    back = settings.stand_off
    straight = (x - back * math.cos(through), y - back * math.sin(through), through)
    found = list(candidates(side, room, solids, robot, settings, start))
    clear = [each for each in found if each.wall_distance >= settings.wall_clearance - 1e-9]
    rest = [each for each in found if each.wall_distance < settings.wall_clearance - 1e-9]
    ranked = tuple(sorted(clear, key=lambda each: each.key) + sorted(rest, key=lambda e: e.key))
    straight_clear = not solids.intersects(body_at(straight, robot))
    return ApproachPlan(side, room, square, free, straight, straight_clear, ranked, len(clear))
