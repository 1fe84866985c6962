"""Moves furniture from its place in the plan, and adds boxes that the plan does not have."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import TypeAlias

import numpy as np
import shapely
from shapely import Polygon
from shapely.affinity import rotate, translate
from shapely.geometry.base import BaseGeometry

from semnav_env.robots import RobotSpec
from semnav_env.world.dynamics.settings import Dynamics
from semnav_env.world.maps.floor_plan import FloorPlan, Material, Surface
from semnav_features.frames import Point

POSITION_STD = 0.6
"""Standard deviation of the displacement of a piece of furniture along x and along y, metres."""

HEADING_STD = math.radians(20.0)
"""Standard deviation of the angle by which a piece of furniture is rotated, radians."""

BOX_SIDES = (0.3, 0.8)
"""Shortest and longest side of an added box, metres."""

DOOR_CLEARANCE = 1.0
"""Radius around the middle of a doorway in which nothing is put, metres."""

LANE_WIDTH = 1.0
"""Width of the wide passages, metres: a passage of this width still exists after a piece was put
down. The same holds for passages of the width of the robot."""

LANE_MARGIN = 0.1
"""Margin added to the robot's width for the narrow ways, metres."""

FURNITURE_GAP = 0.05
"""Least distance between furniture and everything else, metres."""

LEAST_WAY_AREA = 0.2
"""Area from which a connected free region counts as a way, square metres."""

LEAST_PIECE_AREA = 0.01
"""Area from which a part that is cut off a way counts as a second one, square metres; less is a
matter of rounding."""

MAX_DRAWS = 30
"""Largest number of places drawn for a piece before it stays where it is or is left out."""


def with_moved_furniture(
    plan: FloorPlan,
    dynamics: Dynamics,
    robot: RobotSpec,
    rng: np.random.Generator,
    keep: Point | None,
) -> FloorPlan:
    """The plan with some pieces of furniture moved and boxes added, and no way blocked.

    Args:
        plan: the plan as drawn.
        dynamics: share of the furniture that moves, and number of boxes.
        robot: everything stays reachable for it.
        rng: source of randomness.
        keep: start of the robot; nothing is put near it. None if it is not known.
    """
    room = FurnitureMover(plan, robot, keep)
    for index, surface in enumerate(plan.surfaces):
        if _is_piece(surface) and rng.random() < dynamics.moved_furniture:
            room.move(index, rng)
    for _ in range(dynamics.added_boxes):
        room.add(rng)
    return room.plan


Ways: TypeAlias = list[list[Polygon]]
"""For each half width of a lane, the connected regions in which the middle of a lane may lie."""


class FurnitureMover:
    """Moves and adds furniture in a plan, one piece after the other.

    Args:
        plan: the plan as drawn.
        robot: everything stays reachable for it.
        keep: place near which nothing is put.

    Attributes:
        plan: the plan with the pieces moved so far.
        half_lane: half the width of the narrow ways, metres.
    """

    def __init__(self, plan: FloorPlan, robot: RobotSpec, keep: Point | None) -> None:
        self.plan = plan
        around = [(door.midpoint, DOOR_CLEARANCE) for door in plan.doors]
        around += [(keep, DOOR_CLEARANCE + robot.length / 2)] if keep is not None else []
        discs = [shapely.Point(point).buffer(reach) for point, reach in around]
        self._kept_free = shapely.union_all(discs)
        self._half_lanes = LANE_WIDTH / 2, (robot.width + LANE_MARGIN) / 2
        self.half_lane = self._half_lanes[1]
        self._ways: Ways | None = None
        self._bare: list[BaseGeometry] | None = None

    def move(self, index: int, rng: np.random.Generator) -> None:
        """Move a piece, if a free place is found."""
        surfaces = self.plan.surfaces
        others = (*surfaces[:index], *surfaces[index + 1 :])
        outline = Polygon(surfaces[index].points)

        def draw() -> Polygon:
            turned = rotate(outline, rng.normal(0.0, HEADING_STD), use_radians=True)
            return translate(turned, *rng.normal(0.0, POSITION_STD, 2))

        self._ways = None
        piece = self._placed(draw, replace(self.plan, surfaces=others))
        if piece is None:
            self._ways = None
        else:
            self.plan = replace(self.plan, surfaces=(*others[:index], piece, *others[index:]))

    def add(self, rng: np.random.Generator) -> None:
        """Add a box, if a free place is found."""
        west, south, east, north = self.plan.boundary.bounds

        def draw() -> Polygon:
            x, y = rng.uniform((west, south), (east, north))
            half_x, half_y = rng.uniform(*BOX_SIDES, 2) / 2
            upright = shapely.box(x - half_x, y - half_y, x + half_x, y + half_y)
            return rotate(upright, rng.uniform(0.0, 180.0))

        self.put(draw)

    def put(self, draw: Callable[[], Polygon], material: Material = Material.FURNITURE) -> bool:
        """Put something solid into the plan, if a free place is found; returns whether it was.

        Args:
            draw: draws its outline, at another place each time.
            material: of it.
        """
        piece = self._placed(draw, self.plan)
        if piece is not None:
            thing = replace(piece, material=material)
            self.plan = replace(self.plan, surfaces=(*self.plan.surfaces, thing))
        return piece is not None

    def _placed(self, draw: Callable[[], Polygon], plan: FloorPlan) -> Surface | None:
        """The first drawn piece that stands free, at no door, and divides no passage."""
        for _ in range(MAX_DRAWS):
            piece = draw()
            if piece.intersects(self._kept_free) or len(plan.furniture.query(piece, "intersects")):
                continue
            if not plan.boundary.contains(piece) or len(
                plan.solids.query(piece, "dwithin", FURNITURE_GAP)
            ):
                continue
            ways = self._ways or self._ways_of(plan)
            self._ways = ways
            left = _ways_beside(piece, ways, self._half_lanes)
            if left is not None:
                self._ways = left
                return _outline(piece)
        return None

    def _ways_of(self, plan: FloorPlan) -> Ways:
        """`free_ways` of the plan with the pieces as they stand now.

        What cannot move takes nearly all of the time, and is worked out once.
        """
        if self._bare is None:
            fixed = tuple(s for s in self.plan.surfaces if not _is_piece(s))
            bare = replace(self.plan, surfaces=fixed)
            self._bare = [_lanes(bare, half) for half in self._half_lanes]
        outlines = [shapely.LineString(s.points) for s in plan.surfaces if _is_piece(s)]
        taken = (shapely.buffer(outlines, half, quad_segs=16) for half in self._half_lanes)
        return [
            list(shapely.get_parts(lanes.difference(shapely.union_all(buffers))))
            for lanes, buffers in zip(self._bare, taken, strict=True)
        ]


def free_ways(plan: FloorPlan, half: float) -> list[Polygon]:
    """Connected regions in which the middle of a lane of some half width may lie."""
    return list(shapely.get_parts(_lanes(plan, half)))


def _lanes(plan: FloorPlan, half: float) -> BaseGeometry:
    """Where the middle of a lane may lie, as one shape."""
    lines = shapely.multilinestrings(plan.segments.reshape(-1, 2, 2))
    return plan.boundary.difference(shapely.buffer(lines, half, quad_segs=16))


def _ways_beside(piece: Polygon, ways: Ways, half_lanes: tuple[float, ...]) -> Ways | None:
    """The passages beside a piece; None if it divides one of them."""
    left: Ways = []
    for half, parts in zip(half_lanes, ways, strict=True):
        whole = _whole_without(piece.buffer(half), parts)
        if whole is None:
            return None
        left.append(whole)
    return left


def _whole_without(piece: Polygon, parts: list[Polygon]) -> list[Polygon] | None:
    """The regions without the area of a piece; None if one falls into two."""
    left: list[Polygon] = []
    for part in parts:
        if not part.intersects(piece):
            left.append(part)
            continue
        rest = list(shapely.get_parts(part.difference(piece)))
        if part.area > LEAST_WAY_AREA and sum(r.area > LEAST_PIECE_AREA for r in rest) != 1:
            return None
        left += rest
    return left


def _is_piece(surface: Surface) -> bool:
    return surface.is_closed and surface.material is Material.FURNITURE


def _outline(piece: Polygon) -> Surface:
    points = tuple((float(x), float(y)) for x, y in piece.exterior.coords)
    return Surface(points, Material.FURNITURE)
