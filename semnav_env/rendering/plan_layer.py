"""The floor plan as a quiet background, drawn once and pasted into every picture."""

from __future__ import annotations

import functools
import math

import numpy as np
from shapely import Polygon

from semnav_env.rendering import marks, palette
from semnav_env.rendering.camera import Camera, Viewport
from semnav_env.rendering.canvas import Canvas, ShapeCanvas
from semnav_env.world.maps.floor_plan import FloorPlan, Material, Region, Surface

TILE_SIZE = 512
"""Side of the squares that a plan is drawn in, fine pixels."""

MAX_PILLAR_AREA = 2.0
"""Area up to which a closed wall is a pillar and not the outline of a room, square metres."""

WALL_WIDTH = 0.07
"""Width of a wall's line, metres, where that is more than two units of the page."""


class PlanLayer:
    """A plan at one scale, drawn tile by tile as they come into view.

    Args:
        floor_plan: the plan to draw.
        scale: units of the page per metre.
        zoom: fine pixels per unit.
    """

    def __init__(self, floor_plan: FloorPlan, scale: float, zoom: float) -> None:
        self.floor_plan, self.scale, self.zoom = floor_plan, scale, zoom
        self._tile = functools.lru_cache(64)(self._drawn_tile)

    def paste_onto(self, canvas: Canvas, camera: Camera, view: Viewport) -> None:
        """Paste the plan into the view; the origin of the camera must lie on a fine pixel."""
        origin = round(camera.origin[0] * self.zoom), round(camera.origin[1] * self.zoom)
        spans = (view.left, view.width), (view.top, view.height)
        columns, rows = (
            range(
                math.floor((start * self.zoom - offset) / TILE_SIZE),
                math.ceil(((start + length) * self.zoom - offset) / TILE_SIZE),
            )
            for (start, length), offset in zip(spans, origin, strict=True)
        )
        for column in columns:
            for row in rows:
                at = origin[0] + column * TILE_SIZE, origin[1] + row * TILE_SIZE
                canvas.paste(self._tile(column, row), at)

    def _drawn_tile(self, column: int, row: int) -> ShapeCanvas:
        canvas = ShapeCanvas((TILE_SIZE, TILE_SIZE), self.zoom)
        side = TILE_SIZE / self.zoom
        camera = Camera(self.scale, (-column * side, -row * side))
        draw_plan(canvas, camera, self.floor_plan)
        draw_names(canvas, camera, self.floor_plan)
        return canvas


def draw_plan(canvas: ShapeCanvas, camera: Camera, plan: FloorPlan) -> None:
    """Draw regions, doorways and everything solid."""
    canvas.fill(palette.OUTSIDE)
    _draw_area(canvas, camera, plan.boundary, palette.FLOOR)
    tints = (
        ((*plan.rooms, *plan.areas), palette.ROOM),
        (plan.corridors, palette.CORRIDOR),
        (plan.intersections, palette.INTERSECTION),
    )
    for regions, tint in tints:
        for region in regions:
            _draw_area(canvas, camera, region.polygon, tint)
    for door in plan.doors:
        line = camera.pixels([door.start, door.end])
        if door.open:
            canvas.dashes(line, palette.THRESHOLD, 1.2, dash=3.0, gap=3.0)
        else:
            canvas.stroke(line, palette.LEAF, 3.0)
    for surface in sorted(plan.surfaces, key=_drawing_order):
        _draw_surface(canvas, camera, surface)


def draw_names(canvas: ShapeCanvas, camera: Camera, plan: FloorPlan) -> None:
    """Write the names of the rooms, areas and corridors that are large enough for them."""
    for region in (*plan.rooms, *plan.areas, *plan.corridors):
        name = region.name.replace("_", " ")
        x1, _, x2, _ = region.polygon.bounds
        if canvas.text_width(name, 10.5) < 0.8 * camera.scale * (x2 - x1):
            canvas.engrave(camera.pixel(_label_point(region)), name, palette.NAME, 10.5)


def _label_point(region: Region) -> tuple[float, float]:
    point = region.polygon.representative_point()
    return float(point.x), float(point.y)


def _draw_area(canvas: ShapeCanvas, camera: Camera, area: Polygon, colour: palette.Colour) -> None:
    if not area.is_empty:
        canvas.polygon(camera.pixels(np.asarray(area.exterior.coords)[:, :2]), colour)


def _drawing_order(surface: Surface) -> tuple[bool, bool]:
    return surface.material is not Material.FURNITURE, not surface.assumed


def _draw_surface(canvas: ShapeCanvas, camera: Camera, surface: Surface) -> None:
    line = camera.pixels(surface.points)
    thick = max(2.2, WALL_WIDTH * camera.scale)
    match surface.material:
        case Material.WALL if surface.assumed:
            marks.wall_assumed(canvas, line)
        case Material.WALL:
            if _is_solid(surface):
                canvas.polygon(line, palette.ASSUMED)
            canvas.stroke(line, palette.WALL, thick)
        case Material.GLASS:
            marks.glass(canvas, line, thick)
        case Material.LEAF:
            canvas.stroke(line, palette.LEAF, thick)
        case Material.FURNITURE:
            marks.furniture(canvas, line)
        case Material.PERSON:
            canvas.polygon(line, palette.PERSON)


def _is_solid(surface: Surface) -> bool:
    closed = len(surface.points) >= 4 and surface.points[0] == surface.points[-1]
    return closed and Polygon(surface.points).area <= MAX_PILLAR_AREA
