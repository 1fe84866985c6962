"""Conditions that a scan decides, corrections, and the language of a command."""

from __future__ import annotations

import pickle
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_env.env import SemNavEnv
from semnav_env.judge import plan_goals
from semnav_env.language import (
    Command,
    CommandError,
    DoorReference,
    Follow,
    GoBack,
    GoToDoor,
    IfThere,
    Side,
    Stop,
    Turn,
    Turning,
    correct,
    encode,
    from_program,
    parse,
    to_program,
    token_mask,
)
from semnav_env.language.clauses import MAX_BRANCHES
from semnav_env.language.command import Link, links_of, room_of
from semnav_env.language.corpora.meanings import meaning_of, normal
from semnav_env.language.corpora.notation import notation_of, read_meaning
from semnav_env.language.translating.masking import masked
from semnav_env.language.translating.programs import command_of, symbols_of
from semnav_env.mind.grounding import PassGoal, SeekGoal, StopGoal
from semnav_env.mind.grounding.follower import Follower
from semnav_env.world.maps import load_floor_plan
from semnav_features.frames import Pose
from semnav_features.scene import Scene
from studies.translating.programs import command_of_meaning
from tests.support.command_strategies import commands
from tests.support.hand_made import X_JUNCTION, corridor

START: Pose = (0.0, 0.0, 0.0)
DOORS = corridor(left=(3.0, 6.0), right=(4.0,))
PLAN = load_floor_plan("office_cross")
WEST: Pose = (1.3, 9.1, 0.0)


def following(text: str, scene: Scene = DOORS, complete: bool = True) -> Follower:
    follower = Follower(parse(text), complete=complete)
    follower.start(scene, START)
    return follower


@pytest.mark.parametrize(
    ("text", "active", "because"),
    [
        ("if there is a door on the left, enter it, otherwise stop", 1, "first door on the left"),
        ("if you see a third door on the left, enter it, otherwise stop", 2, "stop"),
        ("if there is no second door on the right, stop", 1, "stop"),
        ("if there is a corner, turn left, otherwise turn around", 2, "turn around"),
        ("if you see the last door on the left, enter it, otherwise stop", 1, "last door"),
        ("if you see the other door on the right, enter it, otherwise stop", 1, "other door"),
        ("if you see the other door on the left, enter it, otherwise stop", 2, "stop"),
        ("if you see the end of the hallway, stop, otherwise turn left", 1, "stop"),
    ],
)
def test_a_condition_is_decided_by_what_is_there(text: str, active: int, because: str) -> None:
    follower = following(text)
    assert follower.active == active
    assert because in follower.goal.because


def test_a_turn_that_hangs_on_a_place_is_made_there() -> None:
    follower = following("if there is an intersection, turn left", X_JUNCTION)
    assert follower.goal.junction is not None
    assert following("if there is no corner, turn left", X_JUNCTION).goal.junction is None


def test_exactly_one_branch_is_carried_out() -> None:
    """The other branch is skipped; the clause "in any case" follows."""
    text = (
        "if you see the first door on the left, stop, otherwise turn around, in any case turn left"
    )
    follower = following(text)
    assert follower.active == 1
    assert follower.advance(lambda: DOORS, START, 0.0, 1 / 15)
    assert follower.active == 3
    assert "left" in follower.goal.because


def test_nothing_is_left_to_do_where_a_lone_condition_is_not_met() -> None:
    assert following("if there is a corner, turn left").done


def test_a_condition_is_decided_at_the_end_of_the_corridor() -> None:
    """The robot looks for what the condition names until then."""
    text = "if you see a third door on the left, enter it, otherwise stop"
    follower = following(text, complete=False)
    assert follower.active == 0
    assert isinstance(follower.goal, SeekGoal)
    follower.advance(lambda: DOORS, (14.0, 0.0, 0.0), 0.5, 1 / 15)
    follower.look(DOORS, (14.0, 0.0, 0.0))
    assert follower.active == 2
    assert isinstance(follower.goal, StopGoal)


def test_the_plan_decides_in_the_same_way() -> None:
    text = "if there is a {} door on the right, enter it, otherwise turn around"
    (entered,) = plan_goals(PLAN, parse(text.format("second")), WEST)
    assert isinstance(entered, PassGoal)
    assert entered.door.name == "west_south_2"
    (turned,) = plan_goals(PLAN, parse(text.format("ninth")), WEST)
    assert turned.because == "turn around here"


@pytest.mark.parametrize(
    ("text", "x", "met"),
    [
        ("if you see a door behind you, stop", 5.0, True),
        ("if you see a third door behind you, stop", 5.0, False),
        ("if there is no door behind you, stop", 0.0, True),
        ("if there is a door opposite, stop", 4.0, True),
        ("if there is a door opposite, stop", 5.0, False),
        ("if you see a second door opposite, stop", 4.0, False),
    ],
)
def test_conditions_speak_of_doors_behind_and_opposite(text: str, x: float, met: bool) -> None:
    follower = Follower(parse(text), complete=True)
    follower.start(DOORS, (x, 0.0, 0.0))
    assert follower.impossible is None
    assert follower.done is not met


DOOR = DoorReference(1, Side.LEFT)


@pytest.mark.parametrize(
    "clauses",
    [
        (IfThere(DOOR),),
        (IfThere(DOOR, otherwise=True), Stop()),
        (IfThere(DOOR), IfThere(DOOR), Stop()),
        (IfThere(DOOR, otherwise=True), Stop(), IfThere(DOOR)),
    ],
)
def test_a_condition_has_something_that_hangs_on_it(clauses: tuple[IfThere | Stop, ...]) -> None:
    with pytest.raises(ValueError, match="a condition"):
        Command(clauses)


@given(commands)
def test_after_what_hangs_on_a_condition_comes_what_does_not(command: Command) -> None:
    for clause, link in zip(command.clauses, links_of(command.clauses), strict=True):
        assert isinstance(clause, IfThere) <= (link in (Link.NEXT, Link.IN_ANY_CASE))
    assert token_mask(encode(command, _rooms(command))).sum() == len(command.clauses)


def _rooms(command: Command) -> list[str]:
    return [name for clause in command.clauses if (name := room_of(clause))]


@pytest.mark.parametrize(
    ("said", "correction", "meant"),
    [
        (
            "go through the first door on the left",
            "no, the right one",
            "the first door on the right",
        ),
        (
            "go through the first door on the left",
            "I mean the second",
            "the second door on the left",
        ),
        ("go to the second door on the left", "no, the third one", "the third door on the left"),
        (
            "turn left at the first intersection",
            "no, right",
            "turn right at the first intersection",
        ),
        ("turn left at the first intersection", "sorry, the second", "left at the second"),
        ("turn left", "no, go to the end of the hallway", "until the end of the hallway"),
    ],
)
def test_the_end_of_a_command_can_be_corrected(said: str, correction: str, meant: str) -> None:
    corrected = correct(parse(said), correction)
    assert len(corrected.clauses) == 1
    assert meant in str(corrected)


@pytest.mark.parametrize(
    ("text", "language", "hint"),
    [
        ("bieg links ab", "en", "--language german"),
        ("walk down the corridor", "de", "--language english"),
        ("nonsense", "de", None),
    ],
)
def test_a_command_in_another_language_is_named_as_such(
    text: str, language: str, hint: str
) -> None:
    with pytest.raises(CommandError) as caught:
        parse(text, language)
    assert (hint in str(caught.value)) if hint else ("--language" not in str(caught.value))


def test_a_language_goes_by_its_code_or_its_name() -> None:
    expected = Command((Follow(), Turn(Turning.LEFT)))
    for language in ("de", "german"):
        assert parse("fahr den Flur entlang und bieg links ab", language) == expected
    with pytest.raises(ValueError, match=r"en \(english\), de \(german\)"):
        parse("stop", "fr")


def test_an_episode_takes_a_command_in_german() -> None:
    env = SemNavEnv("spot", PLAN)
    options = {"command": "nimm die zweite Tür rechts", "language": "german", "pose": WEST}
    _, info = env.reset(seed=0, options=options)
    assert info["command"] == "go through the second door on the right"
    with pytest.raises(CommandError, match="--language german"):
        env.reset(seed=0, options={**options, "language": "en"})


RIGHT_DOOR = DoorReference(1, Side.RIGHT)
NINTH_DOOR = DoorReference(9, Side.LEFT)
LEFT_TURN, RIGHT_TURN = Turn(Turning.LEFT), Turn(Turning.RIGHT)


@pytest.mark.parametrize(
    ("condition", "done"),
    [
        (IfThere(RIGHT_DOOR, then=2, otherwise=1), [1, 2, 4, 5]),
        (IfThere(NINTH_DOOR, then=2, otherwise=1), [3, 4, 5]),
        (IfThere(RIGHT_DOOR, then=1, otherwise=2), [1, 4, 5]),
        (IfThere(NINTH_DOOR, then=1, otherwise=2), [2, 3, 4, 5]),
        (IfThere(NINTH_DOOR, then=3), [4, 5]),
        (IfThere(NINTH_DOOR, absent=True, then=3), [1, 2, 3, 4, 5]),
        (IfThere(NINTH_DOOR, then=5), []),
    ],
)
def test_so_many_clauses_are_for_each_case(condition: IfThere, done: list[int]) -> None:
    """Robot and judge go through the same clauses."""
    rest = (LEFT_TURN, RIGHT_TURN, LEFT_TURN, Turn(Turning.AROUND), Stop())
    follower = Follower(Command((condition, *rest)), complete=True)
    follower.start(DOORS, START)
    seen = []
    while not follower.done:
        seen.append(follower.active)
        follower.skip_to_next(DOORS)
    assert seen == done
    assert follower.skipped == frozenset(range(1, 6)) - frozenset(done)


def test_the_judge_skips_all_clauses_of_the_other_case() -> None:
    enter = GoToDoor(DoorReference(2, Side.RIGHT))
    for ordinal, names in ((2, ["west_south_2"]), (9, [])):
        there = IfThere(DoorReference(ordinal, Side.RIGHT), then=2, otherwise=2)
        command = Command((there, enter, Stop(), Turn(Turning.AROUND), Stop()))
        first, last = plan_goals(PLAN, command, WEST)
        assert isinstance(last, StopGoal)
        assert [first.door.name for _ in names if isinstance(first, PassGoal)] == names


def test_a_turn_within_a_case_completes_the_hallway_before_it() -> None:
    """The hallway before "otherwise" leads to its end; before a turn of its case, to that turn."""
    crossing = DoorReference(1, Side.LEFT)
    for then, turns in ((2, True), (1, False)):
        clauses = (IfThere(crossing, absent=True, then=then, otherwise=2 - then), Follow())
        follower = Follower(Command((*clauses, LEFT_TURN)), complete=True)
        follower.start(X_JUNCTION, START)
        assert (follower.goal.junction is not None) is turns


@pytest.mark.parametrize(
    "said",
    [
        "if you see the first door on the right, turn left and stop, otherwise turn right and "
        "turn left and wait for 2 seconds, in any case go back to the start",
        "falls du die erste Tür rechts siehst, bieg links ab und halt an, sonst bieg rechts ab und "
        "bieg links ab und warte 2 Sekunden, in jedem Fall fahr zurück zum Start",
    ],
)
def test_what_depends_on_a_condition_ends_where_the_next_case_is_said(said: str) -> None:
    condition = IfThere(RIGHT_DOOR, then=2, otherwise=3)
    then, otherwise = (LEFT_TURN, Stop()), (RIGHT_TURN, LEFT_TURN, Stop(2))
    command = Command((condition, *then, *otherwise, GoBack()))
    assert said in (command.say("en"), command.say("de"))


@given(
    st.booleans(), st.integers(1, MAX_BRANCHES), st.integers(0, MAX_BRANCHES - 1), st.integers(0, 9)
)
def test_a_condition_over_several_clauses_is_the_same_in_every_notation(
    absent: bool, then: int, otherwise: int, seconds: int
) -> None:
    otherwise = min(otherwise, MAX_BRANCHES - then)
    condition = IfThere(RIGHT_DOOR, absent, otherwise, then)
    rest = (LEFT_TURN, Stop(seconds), Follow(), RIGHT_TURN, GoBack(), Stop(), LEFT_TURN)
    command = Command((condition, *rest[: then + otherwise]))
    assert from_program(to_program(command)) == command
    assert pickle.loads(pickle.dumps(command)) == command
    assert meaning_of(command) == read_meaning(notation_of(command))
    text = masked(str(command), ())
    assert command_of(symbols_of(command, text), text) == command
    case = int(encode(command)[0, 1])
    assert case == int(
        encode(
            Command(
                (
                    replace(condition, then=1, otherwise=bool(otherwise)),
                    *rest[: 1 + bool(otherwise)],
                )
            )
        )[0, 1]
    )


def test_programs_of_old_still_load() -> None:
    what = {"kind": "DoorReference", "ordinal": 1, "side": "right"}
    program = [
        {"kind": "IfThere", "what": what, "absent": False, "otherwise": True},
        {"kind": "Stop"},
        {"kind": "GoBack"},
    ]
    assert from_program(program).clauses[0] == IfThere(RIGHT_DOOR, otherwise=1)
    assert to_program(from_program(program))[0]["otherwise"] == 1


@pytest.mark.parametrize(
    ("counts", "because"),
    [
        ({"then": 0}, "then is 1 to 7 clauses, not 0"),
        ({"otherwise": -1}, "otherwise is 0 to 7 clauses, not -1"),
        ({"then": 1.5}, r"then is 1 to 7 clauses, not 1\.5"),
        ({"then": 4, "otherwise": 4}, "at most 7 clauses depend"),
    ],
)
def test_a_number_of_clauses_that_cannot_be_is_refused(counts: dict, because: str) -> None:
    with pytest.raises(ValueError, match=because):
        IfThere(RIGHT_DOOR, **counts)


def test_too_few_clauses_and_a_condition_in_a_condition_are_refused() -> None:
    with pytest.raises(ValueError, match="followed by what to do then"):
        Command((IfThere(RIGHT_DOOR, then=2), Stop()))
    with pytest.raises(ValueError, match="cannot depend on another"):
        Command((IfThere(RIGHT_DOOR, then=3), Stop(), IfThere(RIGHT_DOOR), Stop()))


@pytest.mark.parametrize(
    "meaning",
    [
        "if door(1,left): through door(1,left); turn right; stop else: back; wait 3 end",
        "if closed door(1): back else: through door(1) end",
        "if closed door(2,left): to door(2,left); wait 30 else: through door(2,left) end",
        "if closed room(kitchen): stop else: room(kitchen) end",
        "if open door(1,at room(hall)): room(hall) else: back end",
    ],
)
def test_conditions_over_several_clauses_that_people_say_have_a_command(meaning: str) -> None:
    command = command_of_meaning(read_meaning(meaning))
    assert command is not None
    assert normal(meaning_of(command)) == normal(read_meaning(meaning))
