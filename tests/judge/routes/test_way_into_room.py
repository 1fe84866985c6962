"""Told ways into rooms lead through the doors between corridors."""

from __future__ import annotations

import shapely

from semnav_env.judge.routes.way_into_room import way_into
from semnav_env.world.maps import FloorPlan
from semnav_env.world.maps.floor_plan import PlanDoor, Region, Surface
from semnav_env.world.maps.geodesic import Geodesic
from semnav_features.frames import Pose


def crossed(plan: FloorPlan, way: object) -> set[str]:
    """The open doors that a way leads through."""
    line = shapely.LineString(way)
    return {
        door.name
        for door in plan.doors
        if door.open and shapely.LineString([door.start, door.end]).intersects(line)
    }


def assert_told_as_it_leads(plan: FloorPlan, room: Region, pose: Pose) -> None:
    geodesic = plan.derived(Geodesic)
    told = way_into(plan, geodesic, room, pose, room.name).places
    assert crossed(plan, geodesic.to(told[-1]).way(pose[:2])) <= crossed(plan, told)


def test_a_way_passes_a_door_between_two_corridors_that_is_not_in_their_middle() -> None:
    """Corridors of 3 m and 2 m with a door at the side of the wall between them."""
    outline = (
        (0, 0),
        (20, 0),
        (20, 2),
        (17, 2),
        (17, 5),
        (14, 5),
        (14, 2),
        (10, 2),
        (10, 3),
        (0, 3),
    )
    walls = [
        *(Surface((a, b)) for a, b in zip(outline, (*outline[1:], outline[0]), strict=True)),
        *(Surface(((10.0, low), (10.0, high))) for low, high in ((0.0, 0.1), (1.0, 3.0))),
        *(Surface(((low, 2.0), (high, 2.0))) for low, high in ((14.0, 15.0), (15.9, 17.0))),
    ]
    room = Region("R", shapely.box(14, 2, 17, 5))
    plan = FloorPlan(
        "two corridors",
        tuple(walls),
        (PlanDoor("between", (10.0, 0.1), (10.0, 1.0)), PlanDoor("R", (15.9, 2.0), (15.0, 2.0))),
        (room,),
        (Region("wide", shapely.box(0, 0, 10, 3)), Region("narrow", shapely.box(10, 0, 20, 2))),
        (),
        shapely.box(-1, -1, 21, 6),
    )
    for x, y in ((2.0, 2.5), (5.0, 1.5), (9.0, 2.5)):
        assert_told_as_it_leads(plan, room, (x, y, 0.0))
