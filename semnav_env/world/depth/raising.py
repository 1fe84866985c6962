"""Raises a floor plan to its ceiling: walls, door frames, lintels, leaves, windows and closets."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated, TypeAlias, assert_never

import numpy as np
import shapely

from semnav_env.world.depth.faces import box, prism, upright
from semnav_env.world.depth.raised_plan import Closet, FaceKind, PlanWindow, RaisedFace, RaisedPlan
from semnav_env.world.maps.doorways import DRAWING_TOLERANCE
from semnav_env.world.maps.floor_plan import FloorPlan, Material, PlanDoor, Surface
from semnav_features.checked_fields import Bounds, check_fields
from semnav_features.frames import Point
from semnav_features.rules import DoorRules
from semnav_features.validation import require

Height: TypeAlias = Annotated[float, Bounds(0.001, 100.0, "m")]


@dataclass(frozen=True)
class RaiseSettings:
    """Heights, and the sizes of door frames, which a plan does not contain.

    Attributes:
        ceiling: of the ceiling above the floor, metres.
        lintel: of the lower edge of the lintel, metres; also of leaves.
        jamb_width: width of a jamb along the wall, metres; it lies outside the opening, so that
            the body passes as in the plan. Mes 2021, 6.3.5: jambs are about 0.10 m wide.
        jamb_depth: of the frame across the wall, metres, half of it on each side.
        furniture: height of the furniture of the plan, metres: a desk.
        person: height of people on the floor, metres. A person who lies on the back is as high as
            the depth of the chest, about 0.25 m, with clothes; the plan does not mark who sits.
    """

    ceiling: Height = 2.5
    lintel: Height = 2.0
    jamb_width: Height = 0.10
    jamb_depth: Height = 0.12
    furniture: Height = 0.75
    person: Height = 0.3

    def __post_init__(self) -> None:
        """Refuse sizes that cannot be built."""
        check_fields(self)
        for name in ("lintel", "furniture", "person", "jamb_width", "jamb_depth"):
            value = getattr(self, name)
            require(value < self.ceiling, name, value, f"less than the ceiling, {self.ceiling} m")


def raise_plan(
    plan: FloorPlan,
    settings: RaiseSettings = RaiseSettings(),
    windows: tuple[PlanWindow, ...] = (),
    closets: tuple[Closet, ...] = (),
) -> RaisedPlan:
    """Build the plan up to its ceiling.

    Args:
        plan: walls, leaves, furniture, people on the floor and doors; its glass is
            invisible, as to the lidar.
        settings: heights and frames.
        windows: in walls of the plan.
        closets: besides the furniture of the plan.

    Raises:
        ValueError: a window that lies on no wall.
    """
    faces = [
        *_surfaces(plan, settings, windows),
        *(face for i, door in enumerate(plan.doors) for face in _doorway(i, door, settings)),
        *(RaisedFace(f, FaceKind.FURNITURE) for c in closets for f in prism(c.corners, c.height)),
    ]
    corners = np.array([face.corners for face in faces]).reshape(-1, 4, 3)
    kinds = np.array([face.kind for face in faces], dtype=np.int64)
    jambs = np.array([face.jamb for face in faces], dtype=np.int64)
    return RaisedPlan(plan, corners, kinds, jambs, settings.ceiling, settings.lintel)


def _surfaces(
    plan: FloorPlan, settings: RaiseSettings, windows: tuple[PlanWindow, ...]
) -> Iterator[RaisedFace]:
    _check_windows(plan, windows)
    for surface in plan.surfaces:
        match surface.material:
            case Material.WALL:
                yield from _wall(surface, settings, windows)
            case Material.LEAF:
                for a, b in _segments(surface):
                    yield RaisedFace(upright(a, b, 0.0, settings.lintel), FaceKind.LEAF)
            case Material.FURNITURE:
                yield from _outlined(surface, settings.furniture, FaceKind.FURNITURE)
            case Material.PERSON:
                yield from _outlined(surface, settings.person, FaceKind.PERSON)
            case Material.GLASS:
                pass  # cameras see through it
            case other:
                assert_never(other)


def _segments(surface: Surface) -> Iterator[tuple[Point, Point]]:
    return zip(surface.points, surface.points[1:], strict=False)


def _outlined(surface: Surface, height: float, kind: FaceKind) -> Iterator[RaisedFace]:
    if surface.is_closed:
        for corners in prism(surface.points[:-1], height):
            yield RaisedFace(corners, kind)
    else:
        for a, b in _segments(surface):
            yield RaisedFace(upright(a, b, 0.0, height), kind)


def _wall(
    surface: Surface, settings: RaiseSettings, windows: tuple[PlanWindow, ...]
) -> Iterator[RaisedFace]:
    """A wall with windows: full height beside a window, and the parts below and above it."""
    for a, b in _segments(surface):
        line = shapely.LineString((a, b))
        holes = [window for window in windows if _lies_on(window, line)]
        spans = sorted((*sorted(map(line.project, _ends(w))), w.sill, w.head) for w in holes)
        reached = 0.0
        for low, high, sill, head in spans:
            yield _piece(line, reached, low, 0.0, settings.ceiling)
            yield _piece(line, low, high, 0.0, sill)
            yield _piece(line, low, high, head, settings.ceiling)
            reached = high
        yield _piece(line, reached, line.length, 0.0, settings.ceiling)


def _piece(
    line: shapely.LineString, start: float, end: float, low: float, high: float
) -> RaisedFace:
    (a,), (b,) = line.interpolate(start).coords, line.interpolate(end).coords
    return RaisedFace(upright(a, b, low, high), FaceKind.WALL)


def _ends(window: PlanWindow) -> tuple[shapely.Point, shapely.Point]:
    return shapely.Point(window.start), shapely.Point(window.end)


def _lies_on(window: PlanWindow, line: shapely.LineString) -> bool:
    return all(line.distance(end) < DRAWING_TOLERANCE for end in _ends(window))


def _check_windows(plan: FloorPlan, windows: tuple[PlanWindow, ...]) -> None:
    walls = [
        shapely.LineString(ends)
        for surface in plan.surfaces
        if surface.material is Material.WALL
        for ends in _segments(surface)
    ]
    for window in windows:
        if not any(_lies_on(window, wall) for wall in walls):
            raise ValueError(f"{window} lies on no straight wall of {plan.name}")


def _doorway(index: int, door: PlanDoor, settings: RaiseSettings) -> Iterator[RaisedFace]:
    """The frame of a door and the wall above it; nothing at an opening that is wider."""
    if door.is_opening(DoorRules()) or door.width <= 0.0:
        return
    start, end = np.array(door.start), np.array(door.end)
    along = (end - start) / door.width
    out = settings.jamb_width * along
    for side, (inner, outer) in enumerate(((start, start - out), (end, end + out))):
        for corners in box(inner, outer, settings.jamb_depth, 0.0, settings.lintel):
            yield RaisedFace(corners, FaceKind.FRAME, 2 * index + side)
    top = settings.lintel + min(settings.jamb_width, settings.ceiling - settings.lintel)
    for corners in box(start - out, end + out, settings.jamb_depth, settings.lintel, top):
        yield RaisedFace(corners, FaceKind.FRAME)
    yield RaisedFace(upright(door.start, door.end, top, settings.ceiling), FaceKind.WALL)
