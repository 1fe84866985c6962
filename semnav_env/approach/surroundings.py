"""The solid things around a door, from a floor plan, from a perceived scene, or both."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
import shapely
from shapely import Polygon
from shapely.geometry.base import BaseGeometry

from semnav_env.approach.door_side import DoorSide
from semnav_features.frames import FloatArray
from semnav_features.scene import Scene, ends_of

if TYPE_CHECKING:
    from semnav_env.world.maps import FloorPlan

WINDOW = 4.0
"""Distance from the middle of a door within which walls matter, metres: more than any pose and body
before it reach."""

SEED_DISTANCE = 0.02
"""Distance before the door of the place that says which side of it the room is, metres."""

THIN = 0.002
"""Thickness of a wall that ends in the open, metres: without thickness it would have no area."""

NOTHING = Polygon()
"""The empty area."""

POINT_RADIUS = 0.02
"""Radius of the disc around a scanned point that counts as solid, metres."""


@dataclass(frozen=True, eq=False)
class Surroundings:
    """Walls, doors and obstacles in one frame.

    Attributes:
        walls: x and y of both ends of everything that stops a body, metres, shape (n, 4).
        doors: the same of doorways, open or not, shape (m, 4): a room ends there.
        obstacles: other solid things, as areas.
    """

    walls: FloatArray
    doors: FloatArray
    obstacles: BaseGeometry = NOTHING

    @staticmethod
    def of_plan(plan: FloorPlan) -> Surroundings:
        """All walls, leaves and furniture of a floor plan, glass included."""
        return Surroundings(plan.segments, plan.door_ends)

    @staticmethod
    def of_scene(scene: Scene) -> Surroundings:
        """The walls and doors that were perceived or are remembered."""
        return Surroundings(ends_of(scene.walls), ends_of(scene.doors))

    def with_points(self, points: FloatArray, radius: float = POINT_RADIUS) -> Surroundings:
        """A copy with a small disc around each finite scanned point, shape (n, 2)."""
        finite = points[np.isfinite(points).all(axis=1)]
        return self.with_obstacles(shapely.MultiPoint(finite).buffer(radius, quad_segs=2))

    def with_obstacles(self, *areas: BaseGeometry) -> Surroundings:
        """A copy with further solid areas, such as a bin before the door."""
        return replace(self, obstacles=shapely.union_all([self.obstacles, *areas]))

    def room_before(self, side: DoorSide) -> BaseGeometry:
        """The part of the room before a door that is within `WINDOW`; every door is closed.

        Walls that end in the open, as perceived ones do, bound the room only where they are, so it
        goes on through the gaps between them.
        """
        frame = shapely.Point(side.middle).buffer(WINDOW, quad_segs=2)
        lines = np.vstack((self.walls, self.doors, (*side.right, *side.left)))
        near = _near(lines, frame)
        noded = shapely.union_all([frame.exterior, *near])
        faces, cuts, dangles, _ = shapely.polygonize_full([noded])
        seed = shapely.Point(*side.before(np.array([(SEED_DISTANCE, 0.0)])).flat)
        rooms = [face for face in faces.geoms if face.contains(seed)]
        if not rooms:
            return Polygon()
        own = shapely.LineString((side.right, side.left)).buffer(THIN)
        ends = shapely.union_all([cuts, dangles]).difference(own)
        loose = ends.buffer(THIN / 2, quad_segs=1)
        return rooms[0].difference(shapely.union_all([loose, self.obstacles]))

    def solids_near(self, side: DoorSide) -> BaseGeometry:
        """Walls and obstacles within `WINDOW` of a door, without the openings of doors."""
        frame = shapely.Point(side.middle).buffer(WINDOW, quad_segs=2)
        return shapely.union_all([*_near(self.walls, frame), self.obstacles.intersection(frame)])


def _near(segments: FloatArray, frame: BaseGeometry) -> list[BaseGeometry]:
    """The segments that meet an area, as lines."""
    lines = np.asarray(shapely.linestrings(segments.reshape(-1, 2, 2)))
    return list(lines[shapely.intersects(lines, frame)])
