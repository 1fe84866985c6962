"""A door beside or before something is counted from there, and looked for until it is sure."""

import pickle

import pytest

from semnav_agents.base import steps
from semnav_agents.registry import make_agent
from semnav_env import SemNavEnv
from semnav_env.judge import plan_goals
from semnav_env.language import (
    ENTRY,
    OTHER,
    Approach,
    Command,
    Distance,
    DoorReference,
    DoorRelation,
    Follow,
    GoToDoor,
    GoToRoom,
    IfThere,
    Leave,
    Place,
    PlaceOffset,
    PlaceReference,
    Relation,
    RoomReference,
    Side,
    Stop,
    decode,
    encode,
    from_program,
    to_program,
)
from semnav_env.language.corpora.meanings import meaning_of, normal
from semnav_env.language.corpora.notation import notation_of, read_meaning
from semnav_env.language.translating.masking import masked
from semnav_env.language.translating.programs import command_of, symbols_of
from semnav_env.mind.grounding import GroundingError, PassGoal, SeekGoal, UnclearError, ground
from semnav_env.mind.grounding.follower import Follower
from semnav_env.world.maps import load_floor_plan
from semnav_features.frames import ORIGIN
from semnav_features.scene import Scene, Wall
from studies.translating.programs import command_of_meaning
from tests.support.grounded import middle
from tests.support.hand_made import corridor

AT, BEFORE = DoorRelation.AT, DoorRelation.BEFORE
LEFT, RIGHT = Side.LEFT, Side.RIGHT
CROSSING = PlaceReference(Place.INTERSECTION)
CORNER = PlaceReference(Place.CORNER)
END = PlaceReference(Place.END)
KITCHEN = RoomReference("kitchen")
SCENE = corridor(
    left=(2.0, 5.0, 11.5), right=(3.5, 10.0), left_arms=[(7.0, 9.0)], right_arms=[(7.0, 9.0)]
)
"""Doors on the left at 2, 5 and 11.5 m, on the right at 3.5 and 10 m; a crossing from 7 to 9 m."""
PLAN = load_floor_plan("office_cross")
WEST = (1.3, 9.1, 0.0)


@pytest.mark.parametrize(
    ("door", "along"),
    [
        (DoorReference(-1, None, BEFORE, CROSSING), 5.0),
        (DoorReference(-2, None, BEFORE, CROSSING), 3.5),
        (DoorReference(-1, RIGHT, BEFORE, CROSSING), 3.5),
        (DoorReference(1, None, BEFORE, CROSSING), 2.0),
        (DoorReference(2, LEFT, BEFORE, CROSSING), 5.0),
        (DoorReference(-1, None, BEFORE, DoorReference(2, LEFT)), 3.5),
        (DoorReference(-1, LEFT, BEFORE, DoorReference(-1)), 5.0),
        (DoorReference(-1, None, BEFORE, END), 11.5),
        (DoorReference(1, None, AT, CROSSING), 10.0),
        (DoorReference(1, LEFT, AT, CROSSING), 5.0),
        (DoorReference(2, None, AT, CROSSING), 5.0),
        (DoorReference(2, LEFT, AT, CROSSING), 11.5),
        (DoorReference(1, None, AT, END), 11.5),
        (DoorReference(1, RIGHT, AT, DoorReference(1, LEFT)), 3.5),
        (DoorReference(1, None, AT, DoorReference(2, LEFT)), 2.0),
    ],
)
def test_a_door_is_counted_from_what_it_is_beside_or_before(
    door: DoorReference, along: float
) -> None:
    """On a scene that is wholly known, and by a robot that has driven to its end."""
    clause = GoToDoor(door)
    assert middle(ground(clause, SCENE, ORIGIN, complete=True)) == pytest.approx(along)
    assert middle(ground(clause, SCENE, ORIGIN, (12.9, 0.0, 0.0))) == pytest.approx(along)


@pytest.mark.parametrize(
    ("door", "error", "because"),
    [
        (DoorReference(4, None, BEFORE, CROSSING), GroundingError, "there are 3"),
        (DoorReference(-2, RIGHT, BEFORE, CROSSING), GroundingError, "there is 1"),
        (DoorReference(5, None, AT, CROSSING), GroundingError, "there are 4"),
        (DoorReference(1, None, BEFORE, CORNER), GroundingError, "no first corner"),
        (DoorReference(1, None, AT, DoorReference(1, RIGHT)), GroundingError, "there are 0"),
        (DoorReference(1, None, AT, KITCHEN), GroundingError, "not been told the way"),
    ],
)
def test_what_is_not_there_or_not_clear_is_refused(
    door: DoorReference, error: type[GroundingError], because: str
) -> None:
    with pytest.raises(error, match=because):
        ground(GoToDoor(door), SCENE, ORIGIN, complete=True)


def test_doors_on_both_sides_that_are_equally_near_are_refused() -> None:
    scene = corridor(left=(5.0,), right=(5.0,), left_arms=[(7.0, 9.0)])
    with pytest.raises(UnclearError, match="one left and right there; say on which side"):
        ground(GoToDoor(DoorReference(1, None, AT, CROSSING)), scene, ORIGIN, complete=True)


def test_of_two_doors_of_a_side_that_are_equally_near_neither_is_taken() -> None:
    scene = corridor(left=(2.0, 5.0, 8.0))
    beside = GoToDoor(DoorReference(1, None, AT, DoorReference(2, LEFT)))
    with pytest.raises(UnclearError, match="equally near; say before it or after it"):
        ground(beside, scene, ORIGIN, complete=True)


def test_a_door_that_is_far_from_a_place_is_not_beside_it() -> None:
    scene = corridor(left=(1.0,), left_arms=[(7.0, 9.0)])
    with pytest.raises(GroundingError, match="there are 0"):
        ground(GoToDoor(DoorReference(1, None, AT, CROSSING)), scene, ORIGIN, complete=True)


def seen_until(x: float) -> Scene:
    """What a robot knows that has seen the scene up to x."""
    walls = [
        Wall((min(a[0], x), a[1]), (min(b[0], x), b[1]))
        for a, b in ((wall.start, wall.end) for wall in SCENE.walls)
        if min(a[0], b[0]) < x
    ]
    return Scene(tuple(walls), tuple(d for d in SCENE.doors if d.end[0] < x))


@pytest.mark.parametrize("relation", DoorRelation)
def test_a_robot_goes_on_looking_until_it_has_seen_the_place(relation: DoorRelation) -> None:
    clause = GoToDoor(DoorReference(1, LEFT, relation, PlaceReference(Place.INTERSECTION)))
    assert isinstance(ground(clause, seen_until(6.0), ORIGIN), SeekGoal)


def test_no_door_is_beside_a_place_until_no_nearer_one_can_be_hidden() -> None:
    """The door 2 m before the crossing is taken once 2 m behind it have been seen, too."""
    beside = GoToDoor(DoorReference(1, LEFT, AT, CROSSING))
    before = GoToDoor(DoorReference(-1, LEFT, BEFORE, CROSSING))
    assert isinstance(ground(beside, seen_until(9.8), ORIGIN), SeekGoal)
    assert middle(ground(before, seen_until(9.8), ORIGIN)) == pytest.approx(5.0)
    assert middle(ground(beside, seen_until(11.2), ORIGIN)) == pytest.approx(5.0)


@pytest.mark.parametrize(
    ("what", "met"),
    [
        (DoorReference(-1, RIGHT, BEFORE, CROSSING), True),
        (DoorReference(2, RIGHT, BEFORE, CROSSING), False),
        (DoorReference(1, None, AT, CORNER), False),
        (DoorReference(1, None, AT, DoorReference(2, LEFT)), True),
    ],
)
def test_a_condition_may_be_on_such_a_door(what: DoorReference, met: bool) -> None:
    follower = Follower(Command((IfThere(what, otherwise=1), Stop(1), Stop(2))), complete=True)
    follower.start(SCENE, ORIGIN)
    assert follower.active == (1 if met else 2)


@pytest.mark.parametrize(
    ("change", "because"),
    [
        ({"to": None}, "both relation and to"),
        ({"relation": None}, "both relation and to"),
        ({"side": Side.BEHIND}, "left or right, not behind"),
        ({"ordinal": OTHER}, "the nth, not 0"),
        ({"ordinal": ENTRY}, "the nth, not -100"),
        ({"ordinal": -1, "relation": AT}, "the nth, not -1"),
        ({"to": DoorReference(1, Side.BEHIND)}, "not along the way"),
        ({"to": DoorReference(1, None, AT, CROSSING)}, "not along the way"),
    ],
)
def test_what_cannot_be_counted_is_one_clear_error(change: dict, because: str) -> None:
    right = {"ordinal": 1, "relation": BEFORE, "to": CROSSING}
    with pytest.raises(ValueError, match=because):
        DoorReference(**right | change)


DOORS = [
    DoorReference(-1, None, BEFORE, CROSSING),
    DoorReference(2, LEFT, BEFORE, DoorReference(3, RIGHT)),
    DoorReference(1, RIGHT, AT, CORNER),
    DoorReference(1, None, AT, KITCHEN),
    DoorReference(1, None, BEFORE, PlaceReference(Place.T_JUNCTION, 2)),
]


@pytest.mark.parametrize("door", DOORS)
def test_such_a_door_is_the_same_in_programs_notation_symbols_and_pickles(
    door: DoorReference,
) -> None:
    off = Follow(PlaceOffset(Distance(1.0), Relation.BEFORE, door))
    for clause in (GoToDoor(door), GoToDoor(door, Approach.TO), Follow(door), off):
        command = Command((clause,))
        assert from_program(to_program(command)) == command
        assert pickle.loads(pickle.dumps(command)) == command
        assert meaning_of(command) == read_meaning(notation_of(command))
        text = masked(str(command), ("kitchen",))
        assert command_of(symbols_of(command, text), text) == command


@pytest.mark.parametrize("door", DOORS)
def test_the_token_of_such_a_door_is_that_of_the_door_alone(door: DoorReference) -> None:
    alone = Command((GoToDoor(DoorReference(door.ordinal, door.side)),))
    assert decode(encode(Command((GoToDoor(door),)))) == alone


def test_such_a_door_is_said_in_both_languages() -> None:
    command = Command((GoToDoor(DoorReference(-1, LEFT, BEFORE, CROSSING), Approach.TO),))
    assert command.say("en") == "go to the last door on the left before the first intersection"
    assert command.say("de") == "fahr zur letzten Tür links vor der ersten Kreuzung"
    command = Command((GoToDoor(DoorReference(1, None, AT, KITCHEN)),))
    assert command.say("en") == 'go through the first door beside room "kitchen"'
    assert command.say("de") == 'fahr durch die erste Tür neben Raum "kitchen"'


@pytest.mark.parametrize(
    "meaning",
    [
        "through door(-1,before intersection)",
        "to door(1,left,at room(kitchen)); wait 5",
        "hallway until 1 m before door(1,right,at intersection#2)",
        "face door(1,at corner)",
        "if door(1,at corner): stop end",
        "through door(1,opposite room(kitchen))",
        "leave door(entry)",
    ],
)
def test_what_people_say_of_doors_beside_something_has_a_command(meaning: str) -> None:
    command = command_of_meaning(read_meaning(meaning))
    assert command is not None
    assert normal(meaning_of(command)) == normal(read_meaning(meaning))


def test_the_door_opposite_a_room_faces_its_door() -> None:
    steps_there = read_meaning("through door(1,opposite room(room_west_1))")
    command = command_of_meaning(steps_there)
    room = PLAN.room_names[0]
    assert command is not None
    named = Command((Follow(RoomReference(room)), *command.clauses[1:]))
    *_, across = plan_goals(PLAN, named, WEST)
    (into,) = plan_goals(PLAN, Command((GoToRoom(room),)), WEST)
    assert isinstance(across, PassGoal)
    assert isinstance(into, PassGoal)
    assert across.door != into.door
    assert across.door.midpoint[0] == pytest.approx(into.door.midpoint[0], abs=1.0)


@pytest.mark.parametrize(
    ("door", "name"),
    [
        (DoorReference(1, None, AT, RoomReference("room_west_south_1")), "west_south_2"),
        (DoorReference(1, LEFT, AT, RoomReference("room_west_south_3")), "west_north_3"),
        (DoorReference(-1, LEFT, BEFORE, RoomReference("room_west_north_3")), "west_north_2"),
        (DoorReference(1, None, AT, RoomReference("room_bend_north_3")), "bend_north_2"),
    ],
)
def test_a_door_beside_a_room_is_in_the_hallway_at_that_room(
    door: DoorReference, name: str
) -> None:
    """On its side if none is said; the way there may lead through other hallways."""
    (goal,) = plan_goals(PLAN, Command((GoToDoor(door),)), WEST)
    assert isinstance(goal, PassGoal)
    assert goal.door.name == name


def test_a_robot_in_a_room_has_to_leave_it_first() -> None:
    inside = next(room for room in PLAN.rooms if room.name == "room_bend_north_3").polygon
    x, y = inside.representative_point().coords[0]
    beside = GoToDoor(DoorReference(1, None, AT, RoomReference("room_bend_north_3")))
    with pytest.raises(GroundingError, match="in that room; leave it first"):
        plan_goals(PLAN, Command((beside,)), (x, y, 0.0))


def test_the_agent_finds_such_doors_and_does_all_clauses_of_a_case() -> None:
    """In a generated office; the room lies in another hallway than the robot."""
    agent = make_agent("scripted")
    env = SemNavEnv("wheelchair", "office:small:5", observation=agent.observation)
    beside = DoorReference(1, None, AT, RoomReference("1.01"))
    clauses = (
        IfThere(beside, then=2, otherwise=1),
        GoToDoor(beside, Approach.TO),
        Stop(1),
        Leave(),
    )
    for command in (Command((GoToDoor(beside),)), Command(clauses)):
        observation, info = env.reset(seed=3, options={"command": command})
        for step in steps(env, agent, observation, info):
            info = step.info
        assert info["is_success"], (str(command), info["verdicts"])
    env.close()
