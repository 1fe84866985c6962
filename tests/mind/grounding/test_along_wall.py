"""A robot keeps along the wall that it is told, and the judge sees whether it does."""

from __future__ import annotations

import math
import pickle
from itertools import pairwise

import numpy as np
import pytest

from semnav_agents.base import steps
from semnav_agents.registry import make_agent
from semnav_env import SemNavEnv
from semnav_env.judge import Judge, Motion, Verdict, plan_mission
from semnav_env.judge.metrics import Recording
from semnav_env.judge.recheck import recheck
from semnav_env.language import (
    Clause,
    Command,
    Distance,
    DoorReference,
    Follow,
    GoToDoor,
    Pace,
    Place,
    PlaceReference,
    Side,
    Speed,
    Turn,
    Turning,
)
from semnav_env.mind.grounding import ground
from semnav_env.mind.grounding.along_wall import lane_offset
from semnav_env.mind.grounding.clause_order import wall_beside
from semnav_env.rules import Rules
from semnav_env.world.maps import load_floor_plan
from semnav_env.world.maps.geodesic import Geodesic
from semnav_features.corridor import corridor_at
from semnav_features.frames import Pose
from semnav_features.scene import Door, Scene, Wall

PLAN = load_floor_plan("office_cross")
GEODESIC = Geodesic(PLAN)
WEST: Pose = (1.3, 9.1, 0.0)
END = PlaceReference(Place.END)
RULES = Rules()
SIGNS = {Side.LEFT: 1.0, Side.RIGHT: -1.0}


def hallway(half_width: float, *more: Wall) -> Scene:
    left = Wall((20.0, half_width), (-2.0, half_width))
    right = Wall((-2.0, -half_width), (20.0, -half_width))
    return Scene((left, right, Wall((20.0, -half_width), (20.0, half_width)), *more))


@pytest.mark.parametrize("wall", SIGNS)
@pytest.mark.parametrize("half_width", [0.5, 0.8, 1.2])
def test_the_lane_keeps_its_distance_from_the_wall(wall: Side, half_width: float) -> None:
    corridor = corridor_at(hallway(half_width), (0.0, 0.0, 0.0))
    offset = lane_offset(corridor, wall, 5.0, RULES.grounding)
    room = max(0.0, half_width - RULES.grounding.wall_distance)
    assert offset == pytest.approx(SIGNS[wall] * room)


def test_the_lane_goes_back_to_the_middle_before_what_stands_in_the_way() -> None:
    cupboard = (
        Wall((6.0, 0.5), (5.0, 0.5)),
        Wall((5.0, 0.5), (5.0, 1.2)),
        Wall((6.0, 1.2), (6.0, 0.5)),
    )
    corridor = corridor_at(hallway(1.2, *cupboard), (0.0, 0.0, 0.0))
    offsets = [lane_offset(corridor, Side.LEFT, x, RULES.grounding) for x in (3.0, 5.5, 8.0)]
    assert offsets == pytest.approx([0.6, 0.0, 0.6])


def test_an_open_door_does_not_move_the_lane() -> None:
    door = Door((5.0, 1.2), (4.0, 1.2), name="open")
    left = Wall((20.0, 1.2), (5.0, 1.2)), Wall((4.0, 1.2), (-2.0, 1.2))
    right, end = Wall((-2.0, -1.2), (20.0, -1.2)), Wall((20.0, -1.2), (20.0, 1.2))
    corridor = corridor_at(Scene((*left, right, end), (door,)), (0.0, 0.0, 0.0))
    offsets = [
        lane_offset(corridor, Side.LEFT, x, RULES.grounding) for x in np.arange(1.0, 9.0, 0.5)
    ]
    assert offsets == pytest.approx([0.6] * len(offsets))


def test_a_goal_along_a_wall_is_reached_anywhere_across_the_hallway() -> None:
    goal = ground(Follow(END, along=Side.LEFT), PLAN.scene, WEST, complete=True)
    middle = ground(Follow(END), PLAN.scene, WEST, complete=True)
    assert goal.next_begin == middle.pose
    corridor = goal.corridor
    along = corridor.along(goal.pose[:2])
    assert all(goal.reached_by(corridor.place(along, offset)) for offset in (-0.9, 0.0, 0.9))
    assert not goal.reached_by(corridor.place(along - 1.2))


@pytest.mark.parametrize(
    ("clauses", "walls"),
    [
        ((Follow(along=Side.LEFT), Turn(Turning.LEFT)), (Side.LEFT, Side.LEFT)),
        (
            (Follow(along=Side.LEFT), Pace(Speed.SLOW), Turn(Turning.LEFT)),
            (Side.LEFT, None, Side.LEFT),
        ),
        ((Follow(END, along=Side.LEFT), Turn(Turning.LEFT)), (Side.LEFT, None)),
        ((Follow(along=Side.LEFT), Follow(END, along=Side.RIGHT)), (Side.LEFT, Side.RIGHT)),
        ((Follow(), GoToDoor(DoorReference(1))), (None, None)),
    ],
)
def test_a_wall_is_kept_until_the_clause_that_says_how_far_is_done(
    clauses: tuple[Clause, ...], walls: tuple[Side | None, ...]
) -> None:
    found = [
        wall_beside(clauses, k) for k, each in enumerate(clauses) if not isinstance(each, Pace)
    ]
    assert found == [
        w for w, each in zip(walls, clauses, strict=True) if not isinstance(each, Pace)
    ]


def glide(wall: Side, *places: tuple[float, float]) -> tuple[Judge, Recording]:
    """A point that moves along straight lines through places, under a judge."""
    mission = plan_mission(PLAN, GEODESIC, Command((Follow(END, along=wall),)), WEST)
    judge, poses = Judge(mission), [WEST]
    for (ax, ay), (bx, by) in pairwise((WEST[:2], *places)):
        for share in np.linspace(0.0, 1.0, max(2, int(math.dist((ax, ay), (bx, by)) / 0.07)))[1:]:
            if judge.over:
                break
            heading = math.atan2(by - ay, bx - ax)
            poses.append((ax + share * (bx - ax), ay + share * (by - ay), heading))
            judge.update(Motion(poses[-1], 1.0, 0.0, in_contact=False, seconds=1 / 15))
    rows = len(poses)
    velocities = np.tile((1.0, 0.0, 0.0), (rows, 1))
    still = np.zeros(rows, np.int64), np.zeros(rows)
    return judge, Recording(np.array(poses), velocities, *still, 1 / 15)


@pytest.mark.parametrize("wall", SIGNS)
@pytest.mark.parametrize("side", [-1.0, 1.0])
def test_only_a_way_on_the_side_of_the_wall_is_carried_out(wall: Side, side: float) -> None:
    y = WEST[1] + 0.4 * side
    judge, recording = glide(wall, (3.0, y), (40.0, y))
    expected = Verdict.DONE if side == SIGNS[wall] else Verdict.INCOMPLETE
    assert judge.verdict is expected
    assert judge.verdicts == (expected,)
    assert recheck(recording, PLAN, judge.goals).verdict == expected


@pytest.mark.parametrize("share", [0.3, 0.7])
def test_most_of_the_way_decides(share: float) -> None:
    start, end = 3.3, 24.0
    turn = start + share * (end - start)
    y = WEST[1]
    judge, recording = glide(
        Side.LEFT, (3.3, y + 0.4), (turn, y + 0.4), (turn, y - 0.4), (40.0, y - 0.4)
    )
    assert (judge.verdict is Verdict.DONE) is (share > 0.5)
    assert recheck(recording, PLAN, judge.goals).verdict == judge.verdict


def test_a_short_way_is_not_judged_by_its_side() -> None:
    mission = plan_mission(PLAN, GEODESIC, Command((Follow(Distance(2.5), along=Side.LEFT),)), WEST)
    judge = Judge(mission)
    for x in np.arange(WEST[0], 4.0, 0.07):
        judge.update(
            Motion((float(x), WEST[1] - 0.4, 0.0), 1.0, 0.0, in_contact=False, seconds=1 / 15)
        )
    assert judge.verdict is Verdict.DONE


@pytest.mark.parametrize("robot", ["wheelchair", "spot"])
@pytest.mark.parametrize("wall", SIGNS)
@pytest.mark.parametrize("agent", ["scripted", "drive"])
def test_robots_keep_along_the_wall(robot: str, wall: Side, agent: str) -> None:
    driver = make_agent(agent)
    env = SemNavEnv(robot, "office_cross", observation=driver.observation)
    told = {"command": Command((Follow(END, along=wall),)), "pose": WEST}
    observation, info = env.reset(seed=0, options=told)
    offsets = []
    for step in steps(env, driver, observation, info):
        info = step.info
        offsets.append(env.world.pose[1] - WEST[1])
    assert info["is_success"], info["verdicts"]
    assert SIGNS[wall] * np.mean(offsets) > 0.2


def test_an_episode_along_a_wall_survives_pickling() -> None:
    env = SemNavEnv("spot", "office_cross", observation="all")
    env.reset(seed=0, options={"command": Command((Follow(END, along=Side.LEFT),)), "pose": WEST})
    for _ in range(60):
        env.step((1.0, 0.0, 0.0))
    copy = pickle.loads(pickle.dumps(env))
    for _ in range(60):
        one, other = (each.step((1.0, 0.0, 0.05))[0] for each in (env, copy))
        assert all(np.array_equal(one[name], other[name]) for name in one)
    assert copy.judge.period == env.judge.period
