"""Rooms by name, the way back, and waiting: told and driven ways."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from shapely import Point

from semnav_agents.registry import make_agent
from semnav_env.env import SemNavEnv
from semnav_env.judge import Judge, Motion, Verdict, plan_goals, plan_mission
from semnav_env.judge.routes.room_guide import RoomGuide
from semnav_env.language import (
    Command,
    CommandError,
    DoorReference,
    GoToDoor,
    GoToRoom,
    Leave,
    Side,
    Turn,
    Turning,
    encode,
    parse,
)
from semnav_env.language.rooms import plain_name, spoken_names
from semnav_env.mind.grounding import GroundingError, PassGoal, ReachGoal, SeekGoal, ground
from semnav_env.mind.grounding.crossing import first_crossed
from semnav_env.mind.grounding.follower import Follower
from semnav_env.mind.grounding.known_way import next_on_way
from semnav_env.mind.grounding.ways import WAY_SPACING, Trail, Way, paced
from semnav_env.rules import GroundingRules
from semnav_env.world.maps import load_floor_plan
from semnav_env.world.maps.geodesic import Geodesic
from semnav_features.frames import Pose, compose, to_local, wrap_angle
from semnav_features.scene import Door, Scene
from tests.support.hand_made import corridor

PLAN = load_floor_plan("office_cross")
GEODESIC = Geodesic(PLAN)
WEST: Pose = (1.3, 9.1, 0.0)
DOORS = corridor(left=(3.0, 6.0), right=(4.0,))


def told(name: str, begin: Pose = WEST) -> Way:
    way = RoomGuide(PLAN, Command((GoToRoom(name),)), GEODESIC)(0, begin)
    assert way is not None
    return way


@pytest.mark.parametrize(
    ("name", "plain"),
    [
        ("Küche", "kueche"),
        (" Room 3.508 ", "room 3.508"),
        ("l3_508", "l3_508"),
        ("A & B", "a b"),
        ("Café", "cafe"),
        ("Cafe\u0301", "cafe"),
        ("Sało Ærø", "salo aero"),
        ("Anna's room", "annas room"),
        ("parents\u2019 bedroom", "parents bedroom"),
    ],
)
def test_names_are_plain_letters_and_digits(name: str, plain: str) -> None:
    assert plain_name(name) == plain
    assert GoToRoom(plain).name == plain


@given(st.text(max_size=60))
def test_every_plain_name_is_one_that_a_command_can_hold(name: str) -> None:
    plain = plain_name(name)
    assert plain_name(plain) == plain
    assert not plain or GoToRoom(plain).name == plain


@pytest.mark.parametrize("said", ["café", "cafe", "CAFÉ", "cafe\u0301"])
@pytest.mark.parametrize("words", ["go to the {}", "geh zum {}"])
def test_a_room_is_named_with_its_accents_or_without(said: str, words: str) -> None:
    assert parse(words.format(said), rooms=("Café", "Foyer")) == Command((GoToRoom("cafe"),))


def test_an_unknown_room_is_answered_with_known_ones() -> None:
    with pytest.raises(CommandError, match="the rooms here are: kitchen, lab 2"):
        parse("go to the ballroom", rooms=("kitchen", "lab 2"))
    with pytest.raises(CommandError, match=r"are: 1\.00, .*, 1\.11, \.\.\."):
        parse("go to the ballroom", rooms=[f"1.{k:02}" for k in range(99)])
    with pytest.raises(CommandError) as nowhere:
        parse("go to the ballroom")
    assert "rooms here" not in str(nowhere.value)


def test_a_misspelt_room_is_the_nearest_one() -> None:
    command = parse("go to the libary", rooms=("library", "kitchen"))
    assert command == Command((GoToRoom("library"),))


@pytest.mark.parametrize(
    ("said", "name"),
    [
        ("the living room", "living room"),
        ("the kitchen", "kitchen"),
        ("the parents' bedroom", "parents bedroom"),
        ("the parents\u2019 room", "parents bedroom"),
        ("the daughter's bedroom", "daughters bedroom"),
        ("the daughter\u2019s room", "daughters bedroom"),
        ("the daughters bedroom", "daughters bedroom"),
    ],
)
def test_the_rooms_of_the_villa_are_called_as_in_the_thesis(said: str, name: str) -> None:
    rooms = load_floor_plan("villa_hall").room_names
    for text in (f"go to {said}", f"go into {said}", f"enter {said}"):
        assert parse(text, rooms=rooms).clauses == (GoToRoom(name),)


def test_room_numbers_may_be_short_where_they_are_unique() -> None:
    rooms = ("l3_508", "l3_414a", "l2_414a", "room_west_1", "Kitchen")
    for text, name in (
        ("go to room 3.508", "l3_508"),
        ("take me to 508", "l3_508"),
        ("go to l3 508", "l3_508"),
        ("go to l3_508", "l3_508"),
        ("go to room room_west_1", "room_west_1"),
        ("go to room 2.414a", "l2_414a"),
        ("go to west 1", "room_west_1"),
        ("go to the kitchen", "kitchen"),
    ):
        assert parse(text, rooms=rooms) == Command((GoToRoom(name),))
    assert "414 a" not in spoken_names(rooms)
    assert encode(parse("go to the kitchen", rooms=rooms), rooms)[0, 3] == 5


def test_every_way_leads_through_the_door_of_its_room() -> None:
    for room in PLAN.room_names:
        outline = PLAN.region(room).polygon
        leading_in = [door for door in PLAN.doors if outline.distance(Point(door.midpoint)) < 0.3]
        if not any(door.open for door in leading_in):
            with pytest.raises(GroundingError, match=f'there: the door of "{room}" is shut'):
                told(room)
            continue
        way = told(room)
        assert way.door in [door.as_door() for door in leading_in]
        assert way.places[0] == WEST[:2]
        assert way.places[-1] == pytest.approx(way.door.midpoint)
        inside = compose((*way.door.midpoint, way.heading), (0.5, 0.0, 0.0))
        assert outline.contains(Point(inside[:2]))


def test_a_way_keeps_to_the_middle_of_its_hallways() -> None:
    way = told("room_south_east")
    main = [y for x, y in way.places if 3.0 < x < 13.0]
    assert main == pytest.approx([9.1] * len(main), abs=0.3)


def test_a_robot_inside_the_room_has_arrived() -> None:
    """A clause that names the room is done at once."""
    inside = PLAN.region("room_west_south_2").polygon.centroid
    begin = (inside.x, inside.y, 0.0)
    (goal,) = plan_goals(PLAN, Command((GoToRoom("room_west_south_2"),)), begin)
    assert goal.reached_by(begin)


@pytest.mark.parametrize("heading", [0.0, 1.0, -2.5])
def test_inside_the_room_the_next_clause_begins_where_one_stands(heading: float) -> None:
    inside = PLAN.region("room_west_south_2").polygon.centroid
    command = Command((GoToRoom("room_west_south_2"), Turn(Turning.LEFT)))
    _, turn = plan_goals(PLAN, command, (inside.x, inside.y, heading))
    assert turn.pose == pytest.approx((inside.x, inside.y, wrap_angle(heading + math.pi / 2)))


def test_crossing_a_door_decides_whether_one_is_in_the_room() -> None:
    """Going in counts as being in the room; coming out does not."""
    second = GoToDoor(DoorReference(2, Side.RIGHT))
    room = GoToRoom("room_west_south_2")
    through, there = plan_goals(PLAN, Command((second, room)), WEST)
    assert isinstance(there, ReachGoal)
    assert there.reached_by(through.pose)
    back = plan_goals(PLAN, Command((second, Leave(), room)), WEST)[-1]
    assert isinstance(back, PassGoal)
    assert back.door == through.door


def test_a_room_that_is_not_there_is_named_with_those_that_are() -> None:
    with pytest.raises(GroundingError, match='"attic": office_cross has room_west_north_1, '):
        told("attic")


@given(st.floats(-0.8, 0.8), st.floats(-1.2, 1.2), st.floats(-0.3, 0.3))
def test_the_seen_door_is_passed_however_inexact_the_told_one(
    along: float, through: float, turned: float
) -> None:
    seen = DOORS.doors[0]
    x, y = seen.midpoint
    middle = compose((x, y, math.pi / 2), (through, along, turned))
    door = Door(
        compose(middle, (0.0, 0.5, 0.0))[:2],
        compose(middle, (0.0, -0.5, 0.0))[:2],
    )
    way = Way(paced(((0.0, 0.0), middle[:2])), door, middle[2])
    (clause,) = parse('go to room "kitchen"').clauses
    goal = ground(clause, DOORS, (0.0, 0.0, 0.0), (x - 1.0, 0.0, 0.0), way=way)
    assert isinstance(goal, PassGoal)
    assert goal.door == seen
    assert goal.pose[2] == pytest.approx(math.pi / 2, abs=1e-9)
    unseen = ground(clause, Scene((), ()), (0.0, 0.0, 0.0), way=way)
    assert unseen.door == door


def test_without_a_way_a_room_is_refused() -> None:
    (clause,) = parse('go to room "kitchen"').clauses
    with pytest.raises(GroundingError, match="has not been told the way"):
        ground(clause, DOORS, (0.0, 0.0, 0.0))


def judged(command: str, *walk: tuple[float, float], start: Pose = WEST) -> Judge:
    judge = Judge(plan_mission(PLAN, GEODESIC, parse(command, rooms=PLAN.room_names), start))
    x, y = start[:2]
    for bx, by in walk:
        for share in np.linspace(0.0, 1.0, max(2, int(math.dist((x, y), (bx, by)) / 0.1)))[1:]:
            pose = (x + share * (bx - x), y + share * (by - y), math.atan2(by - y, bx - x))
            judge.update(Motion(pose, 1.0, 0.0, in_contact=False, seconds=1 / 15))
        x, y = bx, by
    return judge


def test_only_the_doors_on_the_way_may_be_crossed() -> None:
    door = PLAN.door("west_south_1").midpoint
    before, inside = (door[0], 9.1), (door[0], 7.0)
    assert judged("go to room west south 1", before, inside).success
    wrong = judged("go to room west south 2", before, inside)
    assert wrong.failure is Verdict.WRONG_DOOR
    out = judged("go to room west south 2", before, start=(*inside, math.pi / 2))
    assert out.failure is None
    assert out.crossed == ["west_south_1"]


def test_coming_back_is_done_at_the_start() -> None:
    door = PLAN.door("west_south_1").midpoint
    there = [(door[0], 9.1), (door[0], 7.0)]
    assert not judged("enter the first door on the right and come back", *there).over
    judge = judged("enter the first door on the right and come back", *there, there[0], WEST[:2])
    assert judge.success
    assert judge.crossed == ["west_south_1", "west_south_1"]


def test_after_coming_back_counting_begins_as_at_the_start() -> None:
    first, _, again = plan_goals(
        PLAN,
        parse("enter the first door on the right, come back and enter the first door on the right"),
        WEST,
    )
    assert first.door == again.door


@pytest.mark.parametrize("seconds", [1, 12, 40])
def test_waiting_takes_its_time_and_is_not_stopping_short(seconds: int) -> None:
    judge = Judge(plan_mission(PLAN, GEODESIC, parse(f"wait for {seconds} seconds"), WEST))
    steps = 0
    while not judge.over:
        judge.update(Motion(WEST, 0.0, 0.0, in_contact=False, seconds=1 / 15))
        steps += 1
    assert judge.success
    assert steps == pytest.approx(15 * seconds, abs=2)


def test_whoever_moves_begins_to_wait_anew() -> None:
    follower = Follower(parse("wait for 2 seconds"), complete=True)
    follower.start(DOORS, (0.0, 0.0, 0.0))
    speeds = [0.0] * 25 + [0.5] + [0.0] * 25
    assert not any(
        follower.advance(lambda: DOORS, (0.0, 0.0, 0.0), speed, 1 / 15) for speed in speeds
    )


@given(st.lists(st.tuples(st.floats(-20, 20), st.floats(-20, 20)), min_size=1, max_size=12))
def test_a_trail_leads_back_to_its_start_without_loops(corners: list[tuple[float, float]]) -> None:
    trail = Trail((0.0, 0.0, 0.3))
    line = [(0.0, 0.0), *corners]
    for (ax, ay), (bx, by) in pairwise(line):
        for share in np.linspace(0.0, 1.0, 200):
            trail.note((ax + share * (bx - ax), ay + share * (by - ay), 0.0))
    back = trail.back((*line[-1], 0.0))
    assert back.places[-1] == (0.0, 0.0)
    assert back.heading == 0.3
    steps = np.hypot(*np.diff(back.places, axis=0).T)
    assert (steps <= 1.5 * WAY_SPACING).all()
    kept = np.array(back.places[1:])
    for k, place in enumerate(kept):
        assert (np.hypot(*(kept[k + 1 :] - place).T) >= WAY_SPACING / 2 - 1e-9).all()


@given(st.floats(-2.0, 2.0), st.floats(-3.0, 3.0), st.floats(0.0, 1.5))
def test_a_trail_through_a_door_leads_back_through_it(
    begin: float, aside: float, phase: float
) -> None:
    """Its places are so far apart that the line between two of them may cross the wall beside."""
    door = np.array([[-0.45, 0.0, 0.45, 0.0]])
    trail = Trail((begin, -0.6 - phase, 0.0))
    line = [(begin, -0.6 - phase), (0.0, -0.6), (0.0, 0.3), (aside, 0.7), (aside, 2.0)]
    for (ax, ay), (bx, by) in pairwise(line):
        for share in np.linspace(0.0, 1.0, 50):
            pose = (ax + share * (bx - ax), ay + share * (by - ay), 0.0)
            last = (ax + (share - 0.02) * (bx - ax), ay + (share - 0.02) * (by - ay))
            if (ax, bx) == (0.0, 0.0) and last[1] <= 0.0 < pose[1]:
                trail.note_doorway(pose)
            trail.note(pose)
    places = trail.back((*line[-1], 0.0)).places
    assert any(first_crossed(door, *a, *b) == 0 for a, b in pairwise(places))


def test_a_way_is_driven_place_by_place_despite_drift() -> None:
    way = Way(paced(((0.0, 0.0), (20.0, 0.0))))
    (clause,) = parse("go back to the start").clauses
    goal = ground(clause, DOORS, (0.0, 0.0, 0.0), way=way)
    for x in np.arange(0.0, 19.0, 0.5):
        towards = next_on_way(goal, (float(x), 0.8, 0.0), GroundingRules())
        assert isinstance(towards, SeekGoal)
        ahead, beside = to_local((float(x), 0.8, 0.0), towards.pose[:2])
        assert beside == pytest.approx(0.0, abs=1e-9)
        assert 0.0 < ahead < 3 * WAY_SPACING
    assert goal.reached_by((19.6, 0.8, 0.0), 0.5)
    assert not goal.reached_by((19.0, 0.8, 0.0), 0.5)


def test_a_way_that_bends_a_little_leads_to_no_place_beside_it() -> None:
    """A place lies as far beside the way as the robot does here, not off its later direction."""
    way = Way(((0.0, 0.0), (1.5, 0.0), (3.0, 0.0), (4.5, -0.7), (6.0, -1.4), (7.5, -2.1)))
    (clause,) = parse("go back to the start").clauses
    goal = ground(clause, DOORS, (0.0, 0.0, 0.0), way=way)
    for beside in (-0.4, 0.0, 0.4):
        towards = next_on_way(goal, (0.2, beside, 0.0), GroundingRules())
        assert math.dist(towards.pose[:2], (3.0, 0.0)) == pytest.approx(abs(beside), abs=1e-6)


def test_an_offset_at_a_bend_of_a_way_is_no_drift() -> None:
    """Who was pushed past a bend comes back into the corridor, not into the room beside it."""
    way = Way(((0.0, 0.0), (1.5, 0.0), (3.0, 0.0), (3.0, -1.5), (3.0, -3.0), (3.0, -4.5)))
    (clause,) = parse("go back to the start").clauses
    goal = ground(clause, DOORS, (0.0, 0.0, 0.0), way=way)
    for beyond in (0.5, 1.0):
        towards = next_on_way(goal, (3.0 + beyond, 0.5, 0.0), GroundingRules())
        assert towards.pose[:2] == pytest.approx((3.0, -3.0), abs=1e-9)


@pytest.mark.parametrize("agent", ["oracle", "scripted"])
def test_agents_go_to_a_named_room_wait_and_come_back(agent: str) -> None:
    driver = make_agent(agent)
    env = SemNavEnv("spot", PLAN, observation=driver.observation)
    options = {"command": "go to room west south 1, wait 2 seconds and come back", "pose": WEST}
    observation, info = env.reset(seed=1, options=options)
    driver.reset(info)
    over = False
    while not over:
        observation, _, terminated, truncated, info = env.step(driver.act(observation))
        over = terminated or truncated
    assert info["is_success"], info["verdicts"]
    assert info["crossed_doors"] == ("west_south_1", "west_south_1")
