"""People are found as told: what the payload decides, where the clauses lead, and an agent."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from shapely import box

from semnav_agents.base import steps
from semnav_agents.searching.finder import Finder
from semnav_env.env import SemNavEnv
from semnav_env.judge.goals import plan_goals
from semnav_env.judge.payload import Payload
from semnav_env.judge.routes.room_guide import RoomGuide
from semnav_env.language import (
    AskName,
    CallOut,
    Clause,
    Command,
    GoToPerson,
    Leave,
    LookAround,
    RoomReference,
    SearchRoom,
)
from semnav_env.mind.grounding.follower import Follower
from semnav_env.mind.grounding.goal import PassGoal, StopGoal
from semnav_env.mind.grounding.visible_doors import doors_around
from semnav_env.rescue import MicrophoneSettings, PersonFinder
from semnav_env.rescue.microphones import MicrophoneArray
from semnav_env.robots import WHEELCHAIR
from semnav_env.world.maps import FloorPlan, Material, Surface, load_floor_plan
from semnav_features.frames import Pose, wrap_angle

VILLA = load_floor_plan("villa_hall")
HALL: Pose = (1.2, 2.0, math.pi / 2)
KITCHEN, LIVING_ROOM = (SearchRoom(RoomReference(each)) for each in ("kitchen", "living room"))
STILL = np.zeros(3)


def with_person(x: float, y: float) -> FloorPlan:
    """The villa with somebody on the floor."""
    corners = np.array(box(x - 0.2, y - 0.2, x + 0.2, y + 0.2).exterior.coords).tolist()
    body = Surface(tuple(map(tuple, corners)), Material.PERSON)
    return replace(VILLA, surfaces=(*VILLA.surfaces, body))


def driven(
    clause: Clause, *actions: tuple[np.ndarray, int], plan: FloorPlan = VILLA, pose: Pose = HALL
) -> tuple[SemNavEnv, dict[str, Any]]:
    """Give a command of one clause, and drive with each action for some control periods."""
    payload = PersonFinder(microphones=MicrophoneSettings(answers=1.0))
    env = SemNavEnv("spot", plan, payload=payload, odometry="exact", observation="raw")
    _, info = env.reset(seed=0, options={"command": Command((clause,)), "pose": pose})
    for action, count in actions:
        for _ in range(count):
            *_, terminated, _, info = env.step(action)
            if terminated:
                return env, info
    return env, info


def test_it_is_a_payload() -> None:
    assert isinstance(PersonFinder(), Payload)


@pytest.mark.parametrize("clause", [LookAround(), KITCHEN, CallOut(), GoToPerson(), AskName()])
def test_without_a_payload_nobody_is_found(clause: Clause) -> None:
    env = SemNavEnv("spot", VILLA)
    with pytest.raises(ValueError, match="needs a person detector"):
        env.reset(seed=0, options={"command": Command((clause,)), "pose": HALL})


def test_a_robot_that_stands_still_calls_once_as_told() -> None:
    _, info = driven(CallOut(), (STILL, 200))
    assert info["verdicts"] == ("done",)
    assert info["found"]["calls"] == 1


def test_a_robot_that_does_not_turn_has_not_looked_around() -> None:
    _, info = driven(LookAround(), (STILL, 200))
    assert info["verdicts"] == ("incomplete",)


def test_a_robot_that_turns_once_has_looked_around() -> None:
    turning = np.array([0.0, 0.0, 0.6])
    _, info = driven(LookAround(), (turning, 110), (STILL, 200))
    assert info["verdicts"] == ("done",)


def test_nobody_is_no_person_to_go_to() -> None:
    _, info = driven(GoToPerson(), (STILL, 200))
    assert info["verdicts"] == ("incomplete",)


def test_a_person_beside_the_robot_says_the_name() -> None:
    _, info = driven(AskName(), (STILL, 200), plan=with_person(1.2, 3.4))
    assert info["verdicts"] == ("done",)
    [person] = info["found"]["people"]
    assert isinstance(person["name"], str)
    assert math.dist(person["place"], (1.2, 3.4)) <= 1.0


def test_a_person_behind_a_wall_is_not_asked() -> None:
    """The robot stands in the hall, 1 m from somebody in the living room."""
    _, info = driven(AskName(), (STILL, 200), plan=with_person(2.9, 3.0), pose=(1.6, 3.0, 0.0))
    assert info["verdicts"] == ("incomplete",)


def test_those_to_whom_one_can_talk_are_in_the_same_room_and_near() -> None:
    array = MicrophoneArray(with_person(1.2, 3.4), MicrophoneSettings(), np.random.default_rng(0))
    assert array.near((1.2, 2.0, 0.0), 2.0) == [0]
    assert array.near((1.2, 2.0, 0.0), 1.0) == []
    assert array.near((2.9, 3.4, 0.0), 2.0) == []


def test_a_robot_before_a_person_has_come_to_that_person_once() -> None:
    env, _ = driven(GoToPerson(), (STILL, 60), plan=with_person(1.2, 3.4))
    finder = env.payload
    assert isinstance(finder, PersonFinder)
    assert finder.fulfils(GoToPerson())
    assert finder.fulfils(GoToPerson())  # as another judge asks in the same control period
    env.step(STILL)
    assert not finder.fulfils(GoToPerson())


def test_the_share_of_a_room_that_was_seen_is_that_of_its_outline() -> None:
    env, _ = driven(LookAround(), (np.array([0.0, 0.0, 0.6]), 60), pose=(1.35, -2.0, 0.0))
    coverage = env.payload.coverage  # type: ignore[union-attr]
    kitchen = coverage.names.index("kitchen")
    outline = next(room.polygon for room in VILLA.rooms if room.name == "kitchen")
    assert 0.0 < coverage.shares[kitchen] < 1.0
    assert coverage.share_in(outline) == pytest.approx(coverage.shares[kitchen], abs=0.02)


def test_a_named_room_is_gone_into_and_then_searched() -> None:
    command = Command((KITCHEN, Leave()))
    follower = Follower(command, complete=True, guide=RoomGuide(VILLA, command))
    follower.start(VILLA.scene, HALL)
    assert isinstance(follower.goal, PassGoal)
    assert follower.goal.door.name == "kitchen"
    at_door: Pose = (1.35, 0.1, -math.pi / 2)
    follower.advance(lambda: VILLA.scene, at_door, 0.5, 0.1)
    inside: Pose = (1.35, -0.1, -math.pi / 2)
    assert not follower.advance(lambda: VILLA.scene, inside, 0.5, 0.1)  # no clause is completed
    assert follower.active == 0
    assert isinstance(follower.goal, StopGoal)
    assert follower.goal.roams
    waits = int(follower.goal.wait / 0.1) + 2
    there: Pose = (1.0, -2.0, 0.0)
    assert any(follower.advance(lambda: VILLA.scene, there, 0.0, 0.1) for _ in range(waits))
    assert follower.active == 1
    assert follower.begin == there


def test_a_searched_room_is_left_by_its_door_even_where_that_is_hidden() -> None:
    """Somebody lies between the robot and the only door of the living room."""
    scene, command = with_person(4.65, 3.64).scene, Command((LIVING_ROOM, Leave()))
    follower = Follower(command, complete=True, guide=RoomGuide(VILLA, command))
    follower.start(scene, HALL)
    for pose in ((2.3, 1.65, 0.0), (2.5, 1.65, 0.0)):
        follower.advance(lambda: scene, pose, 0.5, 0.1)
    there: Pose = (4.89, 3.85, 3.0)
    assert doors_around(scene, there) == []
    while follower.active == 0:
        follower.advance(lambda: scene, there, 0.0, 0.1)
    assert isinstance(follower.goal, PassGoal)
    assert follower.goal.door.name == "living"


def test_a_mission_has_one_goal_for_each_clause_to_find_people() -> None:
    command = Command((KITCHEN, LookAround(), GoToPerson(), Leave()))
    goals = plan_goals(VILLA, command, HALL)
    assert len(goals) == 4
    assert [isinstance(goal, StopGoal) for goal in goals] == [True, True, True, False]


def test_who_is_in_the_named_room_searches_it_at_once() -> None:
    command = Command((KITCHEN,))
    follower = Follower(command, complete=True, guide=RoomGuide(VILLA, command))
    follower.start(VILLA.scene, (1.0, -2.0, 0.0))
    assert isinstance(follower.goal, StopGoal)


def agent_info(command: Command, robot: str, plan: FloorPlan, pose: Pose) -> dict[str, Any]:
    """How an episode of the agent that finds people ends."""
    agent = Finder()
    payload = PersonFinder(microphones=MicrophoneSettings(answers=1.0))
    env = SemNavEnv(robot, plan, observation=agent.observation, payload=payload, max_seconds=400.0)
    start = env.reset(seed=3, options={"command": command, "pose": pose})
    *_, last = steps(env, agent, *start)
    return last.info


def test_the_agent_looks_around_and_calls() -> None:
    info = agent_info(Command((LookAround(), CallOut())), "spot", VILLA, HALL)
    assert info["is_success"]
    assert info["collisions"] == 0


@pytest.mark.slow
@pytest.mark.parametrize("robot", ["spot", "wheelchair"])
def test_the_agent_finds_a_person_and_learns_the_name(robot: str) -> None:
    command = Command((KITCHEN, GoToPerson(), AskName()))
    info = agent_info(command, robot, with_person(-0.6, -2.8), HALL)
    assert info["is_success"]
    [person] = [each for each in info["found"]["people"] if each["reported"]]
    assert math.dist(person["place"], (-0.6, -2.8)) <= 1.0
    assert person["name"] is not None


def finder_in(pose: Pose, command: str) -> tuple[Finder, SemNavEnv, dict[str, Any]]:
    """A wheelchair at the beginning of an episode in the villa, and what it sees."""
    agent = Finder()
    env = SemNavEnv(
        "wheelchair", VILLA, payload=PersonFinder(), observation=agent.observation, odometry="exact"
    )
    agent.read_plan(VILLA)
    observation, info = env.reset(seed=0, options={"command": command, "pose": pose})
    agent.reset(info)
    agent.act(observation)
    return agent, env, observation


def clearance_to(points: np.ndarray, place: tuple[float, float]) -> float:
    """Distance of the nearest of some points from a place, metres."""
    return float(np.hypot(*(points - place).T).min())


@pytest.mark.parametrize(
    ("pose", "corner"),
    [
        ((-1.46, 4.5, -3.0), (-WHEELCHAIR.length / 2, -WHEELCHAIR.width / 2)),
        ((-4.83, 4.63, -1.99), (-0.44, WHEELCHAIR.width / 2)),
    ],
)
def test_a_wall_behind_that_was_never_hit_is_an_obstacle(
    pose: Pose, corner: tuple[float, float]
) -> None:
    """The lidar sees 270 degrees; the wall almost touches the body, behind it."""
    agent, _, observation = finder_in(pose, "go down the hallway")
    near = agent.obstacles(observation).near((0.0, 0.0, 0.0), 2.0)
    assert clearance_to(near, corner) < 0.08


def test_a_wheelchair_goes_forward_into_a_room_in_which_somebody_may_lie() -> None:
    """It looks away from the door of the kitchen, and its lidar sees nothing behind."""
    agent, env, observation = finder_in((0.95, 0.88, 1.4), 'search room "kitchen"')
    while env.judge.crossed == []:
        observation, *_ = env.step(agent.act(observation))
    heading = float(env.judge.row["pose"][0][2])
    assert abs(wrap_angle(heading + math.pi / 2)) < math.pi / 3


def test_a_wall_that_was_passed_in_a_search_is_an_obstacle_of_the_way_back() -> None:
    """Among the obstacles of recent scans, which are updated in a search, too."""
    agent, env, observation = finder_in((1.5, -1.2, -math.pi / 2), "search this room")
    for _ in range(40):
        observation, *_ = env.step(agent.act(observation))
    seen = agent.recent.points()
    assert len(seen) > 100
    assert clearance_to(agent.obstacles(observation).points(), seen[0]) < 0.01


def test_a_robot_that_looks_around_does_not_turn_into_what_stands_beside_it() -> None:
    """Its rear would sweep through a person behind it."""
    agent = Finder()
    x, y, _ = pose = (4.8, 2.4, 0.0)
    plan = with_person(x - 0.9, y + 0.62)
    env = SemNavEnv("wheelchair", plan, payload=PersonFinder(), observation=agent.observation)
    agent.read_plan(VILLA)
    observation, info = env.reset(seed=0, options={"command": "look around", "pose": pose})
    for step in steps(env, agent, observation, info):
        info = step.info
    assert info["collisions"] == 0


def test_a_person_who_is_heard_alone_is_gone_to_and_seen() -> None:
    """From the hall nobody in the living room is in view."""
    agent = Finder()
    payload = PersonFinder(microphones=MicrophoneSettings(answers=1.0))
    plan = with_person(5.8, 1.2)
    env = SemNavEnv("spot", plan, payload=payload, observation=agent.observation)
    agent.read_plan(VILLA)
    told = {"command": "call and listen and go to the person you found", "pose": HALL}
    observation, info = env.reset(seed=1, options=told)
    for step in steps(env, agent, observation, info):
        info = step.info
    assert info["verdicts"] == ("done", "done")
    assert info["found"]["calls"] >= 2
    [person] = [each for each in info["found"]["people"] if each["reported"]]
    assert math.dist(person["place"], (5.8, 1.2)) < 0.5


def test_who_is_behind_a_closed_door_is_placed_by_voice_alone() -> None:
    """Where the directions cross, with a standard deviation that agrees with the error."""
    agent = Finder()
    payload = PersonFinder(microphones=MicrophoneSettings(answers=1.0))
    door = VILLA.door("living")
    closed = Surface((door.start, door.end), Material.LEAF)
    plan = with_person(4.0, 1.2)
    doors = tuple(replace(each, open=each is not door) for each in plan.doors)
    plan = replace(plan, surfaces=(*plan.surfaces, closed), doors=doors)
    env = SemNavEnv("spot", plan, payload=payload, observation=agent.observation)
    agent.read_plan(VILLA)
    told = {"command": "call and listen and go to the person you found", "pose": HALL}
    observation, info = env.reset(seed=2, options=told)
    for step in steps(env, agent, observation, info):
        info = step.info
    assert info["verdicts"] == ("done", "incomplete")
    assert not any(each["reported"] for each in info["found"]["people"])
    [heard] = info["found"]["voices"].values()
    assert math.dist(heard["place"], (4.0, 1.2)) < 3.0 * heard["std"]
