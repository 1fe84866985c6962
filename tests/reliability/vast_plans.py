"""Small files whose geometry asks for gigabytes, and everything that makes a grid or a table."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from shapely import box

from semnav_agents.oracle import OracleAgent
from semnav_agents.planning.obstacles import points_of_segments
from semnav_agents.searching.house_plan import HousePlan
from semnav_agents.searching.settings import SearchSettings
from semnav_env.env import SemNavEnv
from semnav_env.judge.routes.route_to import route_to
from semnav_env.rescue.environment import search_and_rescue
from semnav_env.robots import DepthRig
from semnav_env.world.depth import raise_plan, rig_hits
from semnav_env.world.dynamics import Dynamics
from semnav_env.world.lidar import Lidar
from semnav_env.world.maps import FloorPlan, Material, PlanDoor, Region, Surface
from semnav_env.world.maps.check import check
from semnav_env.world.maps.draw import save_picture
from semnav_env.world.maps.occupancy_export import export_map
from semnav_features.lidar_spec import LidarSpec

FAR = LidarSpec("far", 360, -math.pi, math.radians(1.0), range_max=1000.0)
"""A lidar that sees all of a plan."""

START = (0.0, 0.0, 0.0)
"""A free pose in every plan, metres and radians."""


def crossed(half_width: float, half_height: float, name: str) -> FloorPlan:
    """A building with a hallway of 2 m from west to east and a door to the south at (2.5, -1)."""
    w, h = half_width, half_height
    outline = ((-w, -h), (w, -h), (w, h), (-w, h), (-w, -h))
    walls = (outline, ((-w, -1.0), (2.0, -1.0)), ((3.0, -1.0), (w, -1.0)), ((-w, 1.0), (w, 1.0)))
    return FloorPlan(
        name,
        tuple(map(Surface, walls)),
        (PlanDoor("door", (2.0, -1.0), (3.0, -1.0)),),
        (Region("room", box(-w, -h, w, -1.0)),),
        (Region("hallway", box(-w, -1.0, w, 1.0)),),
        (),
        box(-w, -h, w, h),
    )


def vast() -> FloorPlan:
    """A square of two kilometres, as when another unit is taken for metres."""
    return crossed(1000.0, 1000.0, "vast")


def strip() -> FloorPlan:
    """Two kilometres of hallway."""
    return crossed(1000.0, 6.0, "strip")


def large() -> FloorPlan:
    """The largest square in which ways are still found."""
    return crossed(244.0, 244.0, "large")


def crowded() -> FloorPlan:
    """Ten thousand pieces of wall in the room of a large building."""
    rng = np.random.default_rng(3)
    ends = rng.uniform((-99.0, -99.0), (99.0, -4.0), (10_000, 2)).round(3)
    pieces = [Surface(((x, y), (x + 0.5, y + 0.5))) for x, y in ends.tolist()]
    plan = crossed(100.0, 100.0, "crowded")
    return replace(plan, surfaces=(*plan.surfaces, *pieces))


def heaped() -> FloorPlan:
    """Two thousand pieces of furniture of 90 m, one upon the other."""
    square = ((-99.0, -99.0), (-9.0, -99.0), (-9.0, -9.0), (-99.0, -9.0), (-99.0, -99.0))
    plan = crossed(100.0, 100.0, "heaped")
    return replace(plan, surfaces=(*plan.surfaces, *2000 * [Surface(square, Material.FURNITURE)]))


def slanted() -> FloorPlan:
    """Three thousand walls from end to end, across all cells of a grid."""
    plan = crossed(200.0, 200.0, "slanted")
    ways = [((-200.0, -200.0 + k / 20), (200.0, -150.0 + k / 100)) for k in range(3000)]
    return replace(plan, surfaces=(*plan.surfaces, *map(Surface, ways)))


PLANS = (vast, strip, large, crowded, heaped, slanted)
"""All of them."""


def begin_episode(plan: FloorPlan, folder: Path) -> Any:
    """Reset, with people who walk about, and step."""
    env = SemNavEnv(floor_plan=plan, dynamics=Dynamics(pedestrians=2), render_mode="rgb_array")
    env.reset(seed=0, options={"command": "go through the door on the right", "pose": START})
    env.step([0.0, 0.0])
    return env.render()


def search(plan: FloorPlan, folder: Path) -> Any:
    """Reset a search."""
    return search_and_rescue(floor_plan=plan).reset(seed=0, options={"pose": START})


def look_far(plan: FloorPlan, folder: Path) -> Any:
    """A scan of a lidar that sees everything."""
    return Lidar(plan, FAR).exact_ranges(START)


def look_in_depth(plan: FloorPlan, folder: Path) -> Any:
    """Pictures of depth cameras."""
    return rig_hits(DepthRig.spot(), raise_plan(plan), START, np.random.default_rng(0)).cloud


def find_faults(plan: FloorPlan, folder: Path) -> Any:
    """Everything that `semnav map check` finds."""
    return check(plan)


def export(plan: FloorPlan, folder: Path) -> Any:
    """A map of map_server."""
    return export_map(plan, folder / "map.yaml")


def draw(plan: FloorPlan, folder: Path) -> Any:
    """A picture."""
    return save_picture(plan, folder / "plan.png")


def follow_route(plan: FloorPlan, folder: Path) -> Any:
    """The way to a room."""
    return route_to(plan, START, "room")


def know_walls(plan: FloorPlan, folder: Path) -> Any:
    """The walls as agents that know the plan have them."""
    OracleAgent().read_plan(plan)
    return points_of_segments(plan.segments)


def chart(plan: FloorPlan, folder: Path) -> Any:
    """The map of a robot that searches a house it knows."""
    return HousePlan(plan, START).chart(SearchSettings())


USES: tuple[Callable[[FloorPlan, Path], Any], ...] = (
    *(begin_episode, search, look_far, look_in_depth, find_faults, export, draw, follow_route),
    *(know_walls, chart),
)
"""Everything that makes something of a size that follows from a plan's geometry."""
