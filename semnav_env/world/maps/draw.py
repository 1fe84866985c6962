"""Pictures of floor plans; the only file of the maps that imports matplotlib."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure, FigureBase
from matplotlib.patches import PathPatch
from matplotlib.path import Path as Outline
from matplotlib.patheffects import Normal, Stroke
from matplotlib.text import Text
from matplotlib.transforms import Bbox, ScaledTranslation
from shapely import Polygon, union_all

from semnav_env.world.maps.doorways import DRAWING_TOLERANCE
from semnav_env.world.maps.draw_faults import (
    LINE_HEIGHT,
    MARK_MARGIN,
    columns_of,
    mark,
    widen,
    write_columns,
)
from semnav_env.world.maps.floor_plan import FloorPlan, Material, PlanDoor, Region, Surface
from semnav_env.world.maps.plan_fault import PlanFault
from semnav_features.plot import check_suffix
from semnav_features.writing import replacing

MATERIAL_COLOURS = {
    Material.WALL: "black",
    Material.GLASS: "deepskyblue",
    Material.LEAF: "saddlebrown",
    Material.FURNITURE: "grey",
    Material.PERSON: "purple",
}
"""Colours of surfaces by their material."""

REGION_TINTS = {
    "rooms": "oldlace",
    "corridors": "lightsteelblue",
    "intersections": "plum",
    "areas": "honeydew",
}
"""Colours of regions by the attribute of `FloorPlan` that holds them."""

LONGEST_SIDE = 12.0
"""Longest side of a picture, inches."""
HALO = (Stroke(linewidth=2.0, foreground="white"), Normal())
"""Drawn around names, so that they can be read on walls."""

NAME_OFFSET = 0.3
"""Distance from a door to its name, metres."""


def draw_floor_plan(plan: FloorPlan, ax: Axes, names: bool = True) -> None:
    """Draw a plan in metres: walls black, glass blue, leaves brown, furniture grey.

    Assumed parts are dashed; open doors are green, closed ones red; regions are tinted.

    Args:
        plan: the plan.
        ax: axes to draw on.
        names: whether to write the names of doors and regions.
    """
    for group, tint in REGION_TINTS.items():
        for region in getattr(plan, group):
            ax.add_patch(PathPatch(_outline(region.polygon), facecolor=tint, alpha=0.6, lw=0))
    for surface in plan.surfaces:
        _draw_surface(surface, ax)
    for door in plan.doors:
        _draw_door(door, ax)
    if names:
        _write_names(plan, ax)
    ax.set_aspect("equal")
    ax.autoscale_view()
    ax.set_xlabel("x, m")
    ax.set_ylabel("y, m")


def leave_out_overlapping(ax: Axes) -> None:
    """Move names that lie on others by a line or hide them, so that the rest can be read.

    Rooms come before doors, doors before other regions.

    Args:
        ax: axes with a plan; the figure has its final size.
    """
    figure = ax.get_figure(root=True)
    assert figure is not None
    figure.draw_without_rendering()
    kept: list[Bbox] = []
    for text in (text for text in ax.texts if text.get_text()):
        box = _free_place(text, kept, figure)
        if box is None:
            text.set_visible(False)
        else:
            kept.append(box)


def _free_place(text: Text, kept: Sequence[Bbox], figure: Figure) -> Bbox | None:
    """Move a name that lies on another by a line; its box, or None if no place is free."""
    box = text.get_window_extent()
    for up in (0.0, box.height, -box.height):
        place = box.translated(0.0, up)
        if not place.count_overlaps(kept):
            inches = ScaledTranslation(0.0, up / figure.dpi, figure.dpi_scale_trans)
            text.set_transform(text.get_transform() + inches)
            return place
    return None


def save_picture(
    plan: FloorPlan, path: str | Path, dpi: int = 100, faults: Sequence[PlanFault] = ()
) -> None:
    """Write a picture of a plan; the suffix of `path` says the format (png, svg, pdf).

    Args:
        plan: the plan.
        path: file to write.
        dpi: dots per inch; the longest side is 12 inches.
        faults: faults of the plan, drawn as numbered circles with a list below.

    Raises:
        ValueError: another suffix, or a folder.
    """
    check_suffix(path)
    west, south, east, north = plan.boundary.bounds
    inch = LONGEST_SIDE / max(east - west, north - south)
    width, height = (east - west) * inch + 1.0, (north - south) * inch + 1.0
    columns = columns_of(faults, width)
    below = LINE_HEIGHT * (1 + max(map(len, columns), default=-1))
    figure = Figure(figsize=(width, height + below), layout="constrained")
    FigureCanvasAgg(figure)
    above: FigureBase = figure
    if faults:
        parts = figure.subfigures(2, 1, squeeze=False, height_ratios=(height, below))
        above, under = parts.flat
        write_columns(columns, under)
    ax = above.add_subplot()
    mark(faults, ax)
    draw_floor_plan(plan, ax)
    ax.set_title(plan.name)
    if faults:
        widen(ax, MARK_MARGIN / inch)
    leave_out_overlapping(ax)
    with replacing(path) as part:
        figure.savefig(part, dpi=dpi)


def _write_names(plan: FloorPlan, ax: Axes) -> None:
    """Write the names of rooms, then of doors, then of other regions: the first ones are kept."""
    for room in plan.rooms:
        _name_region(room, plan, ax)
    for door in plan.doors:
        _name_door(door, ax)
    for region in plan.regions:
        if region not in plan.rooms:
            _name_region(region, plan, ax)


def _name_region(region: Region, plan: FloorPlan, ax: Axes) -> None:
    """Write the name of a region where no other region lies, if there is such a place."""
    others = union_all([r.polygon for r in plan.regions if r is not region])
    own = region.polygon.difference(others)
    at = (region.polygon if own.area < DRAWING_TOLERANCE else own).representative_point()
    style = "italic" if region.assumed else "normal"
    ax.text(
        at.x,
        at.y,
        region.name,
        size=7,
        style=style,
        color="dimgrey",
        ha="center",
        path_effects=HALO,
    )


def _draw_surface(surface: Surface, ax: Axes) -> None:
    x, y = zip(*surface.points, strict=True)
    if surface.material is Material.FURNITURE:
        ax.fill(x, y, facecolor="lightgrey", edgecolor="none")
    dashes = "--" if surface.assumed else "-"
    ax.plot(x, y, dashes, color=MATERIAL_COLOURS[surface.material], linewidth=1.5)


def _draw_door(door: PlanDoor, ax: Axes) -> None:
    x, y = zip(door.start, door.end, strict=True)
    ax.plot(x, y, color=_colour(door), linewidth=3, alpha=0.6, solid_capstyle="butt")


def _name_door(door: PlanDoor, ax: Axes) -> None:
    """Write the name of a door behind it, as seen from its corridor."""
    (x1, y1), (x2, y2) = door.start, door.end
    right = (y2 - y1) / door.width, (x1 - x2) / door.width
    x, y = (m + NAME_OFFSET * r for m, r in zip(door.midpoint, right, strict=True))
    side = "center" if abs(right[0]) < 0.7 else "left" if right[0] > 0 else "right"
    ax.text(
        x,
        y,
        door.name,
        size=7,
        weight="bold",
        color=_colour(door),
        ha=side,
        va="center",
        path_effects=HALO,
    )


def _colour(door: PlanDoor) -> str:
    return "green" if door.open else "red"


def _outline(polygon: Polygon) -> Outline:
    rings = (polygon.exterior, *polygon.interiors)
    return Outline.make_compound_path(*(Outline(ring.coords, closed=True) for ring in rings))
