"""Finds all faults of a floor plan for one robot."""

from __future__ import annotations

from collections.abc import Iterator

from semnav_env.robots import WHEELCHAIR, RobotSpec
from semnav_env.world.maps.faults import faults
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_env.world.maps.gaps import gaps
from semnav_env.world.maps.plan_fault import PlanFault
from semnav_env.world.maps.reachability import unreachable_parts
from semnav_env.world.maps.rules import FloorPlanError, check_plan
from semnav_env.world.maps.units import unit_fault


def check(plan: FloorPlan, robot: RobotSpec = WHEELCHAIR) -> list[PlanFault]:
    """Find all faults of a plan; the list is empty if there are none.

    A plan that breaks a rule of floor plans gets only this fault. Otherwise it is searched for
    doors whose width suggests another unit than metres, for gaps (to the outside, and out of rooms
    other than through their doors), for parts that overlap or stand in doorways, and for open
    doors, rooms and ends of corridors that the robot cannot reach. The robot starts in the largest
    corridor as a rectangle that turns where it must.

    Args:
        plan: the plan.
        robot: the body, of which length and width count.
    """
    try:
        check_plan(plan)
    except FloorPlanError as error:
        return [PlanFault(plan.name, str(error))]
    return [*_unit(plan), *gaps(plan), *faults(plan), *unreachable_parts(plan, robot)]


def _unit(plan: FloorPlan) -> Iterator[PlanFault]:
    if fault := unit_fault(door.width for door in plan.doors):
        yield PlanFault(plan.name, fault)
