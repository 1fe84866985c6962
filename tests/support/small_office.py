"""A small office to draw."""

from __future__ import annotations

from shapely import box

from semnav_env.rendering.frame import Frame
from semnav_env.robots import WHEELCHAIR
from semnav_env.world.maps.floor_plan import FloorPlan, Material, PlanDoor, Region, Surface
from semnav_features.scene import Door

DOOR = Door((4.0, 0.0), (5.0, 0.0))


def office(width: float = 10.0, height: float = 6.0) -> FloorPlan:
    """A room with a door below, a pane of glass, a cabinet and a pillar."""
    outline = ((4.0, 0.0), (0.0, 0.0), (0.0, height), (width, height), (width, 0.0), (5.0, 0.0))
    cabinet = ((1.0, 5.0), (2.0, 5.0), (2.0, 5.5), (1.0, 5.5), (1.0, 5.0))
    return FloorPlan(
        name="small_office",
        surfaces=(
            Surface(outline),
            Surface(((6.0, 4.0), (8.0, 4.0)), Material.GLASS),
            Surface(((4.0, 0.0), (3.6, -0.8)), Material.LEAF),
            Surface(cabinet, Material.FURNITURE),
            Surface(((0.0, -2.0), (width, -2.0)), assumed=True),
        ),
        doors=(PlanDoor("south", DOOR.start, DOOR.end),),
        rooms=(Region("hall", box(0, 0, width, height)),),
        corridors=(Region("walk", box(0, -2, width, 0)),),
        intersections=(),
        boundary=box(0, -2, width, height),
    )


PLAN = office()
PLAIN = Frame(PLAN, WHEELCHAIR, (3.0, 3.0, 0.3))
