"""The scripted agent drives through the door at the back of a niche."""

from __future__ import annotations

import pytest
from shapely import box

from semnav_agents import make_agent
from semnav_agents.evaluation.drive import drive
from semnav_env import SemNavEnv
from semnav_env.world.maps.floor_plan import FloorPlan, PlanDoor, Region, Surface

WEST, EAST, FRONT, BACK = 5.0, 6.1, 1.8, 2.7
DOOR = PlanDoor("at the back", (WEST + 0.1, BACK), (EAST - 0.1, BACK))


def hallway_with_a_niche() -> FloorPlan:
    """A hallway along x, and on its north side a niche 0.9 m deep with the door of a room."""
    jambs = (DOOR.start, (WEST, BACK), (WEST, FRONT)), (DOOR.end, (EAST, BACK), (EAST, FRONT))
    hall = (jambs[0][-1], (0.0, FRONT), (0.0, 0.0), (10.0, 0.0), (10.0, FRONT), jambs[1][-1])
    room = ((3.0, BACK), (3.0, 6.0), (8.0, 6.0), (8.0, BACK))
    return FloorPlan(
        name="niche",
        surfaces=(
            *(Surface(side) for side in (*jambs, hall)),
            Surface((DOOR.start, *room, DOOR.end)),
        ),
        doors=(DOOR,),
        rooms=(Region("room", box(3, BACK, 8, 6)),),
        corridors=(Region("hall", box(0, 0, 10, FRONT).union(box(WEST, FRONT, EAST, BACK))),),
        intersections=(),
        boundary=box(0, 0, 10, 6),
    )


@pytest.mark.parametrize("robot", ["wheelchair", "spot"])
def test_it_does_not_stop_in_the_niche(robot: str) -> None:
    agent = make_agent("scripted")
    env = SemNavEnv(robot, hallway_with_a_niche(), agent.observation)
    said = {"command": "go through the first door on the left", "pose": (1.5, 0.9, 0.0)}
    driven = drive(env, agent, 0, said)
    assert driven.metrics.success, driven.cause
    assert driven.judge.crossed == ["at the back"]
