"""What a maker of plans should know: all that is wrong with a plan, for one robot."""

from __future__ import annotations

from semnav_env.maps.faults import faults
from semnav_env.maps.floor_plan import FloorPlan
from semnav_env.maps.gaps import leaks
from semnav_env.maps.plan_fault import PlanFault
from semnav_env.maps.reachability import broken_promises
from semnav_env.maps.rules import FloorPlanError, check_plan
from semnav_env.robots import WHEELCHAIR, RobotSpec


def check(plan: FloorPlan, robot: RobotSpec = WHEELCHAIR) -> list[PlanFault]:
    """Everything found wrong with a plan; an empty list if nothing.

    A plan that breaks a rule gets that one finding. Else it is searched for leaks (to the outside,
    and out of rooms other than through their doors), for parts that overlap or stand in doorways,
    and for open doors, rooms and ends of corridors that the robot cannot reach: its rectangle has
    to get there from the largest corridor, turning where it must.

    Args:
        plan: the plan.
        robot: whose length and width count.
    """
    try:
        check_plan(plan)
    except FloorPlanError as error:
        return [PlanFault(plan.name, str(error))]
    return [*leaks(plan), *faults(plan), *broken_promises(plan, robot)]
