"""A door that is only named is gone through; what says otherwise is obeyed."""

from __future__ import annotations

import pytest

from semnav_env.env import SemNavEnv
from semnav_env.language import (
    AmbiguousCommandError,
    Approach,
    Command,
    DoorReference,
    GoToDoor,
    GrammarInterpreter,
    Side,
    from_program,
    parse,
    read,
    readings,
    to_program,
)
from semnav_env.language.translating.interpreter import LearnedInterpreter
from semnav_env.mind.grounding import ground
from semnav_env.world.maps import load_floor_plan
from semnav_scripts.main import main

THROUGH = {
    "second door on the right": "go through the second door on the right",
    "the second door on your right": "go through the second door on the right",
    "zweite Tür rechts": "go through the second door on the right",
    "die zweite Tür rechts, bitte": "go through the second door on the right",
    "it's the second door on the right": "go through the second door on the right",
    "es ist die zweite Tür rechts": "go through the second door on the right",
    "take the second door on the right": "go through the second door on the right",
    "nimm die zweite Tür rechts": "go through the second door on the right",
    "the door": "go through the first door",
    "die Tür": "go through the first door",
    "second room on the left": "go through the second door on the left",
    "go down the hallway, then the second door on the right": (
        "go down the hallway and go through the second door on the right"
    ),
    "fahr den Flur entlang, dann die zweite Tür rechts": (
        "go down the hallway and go through the second door on the right"
    ),
}
"""Texts that say nothing of how to approach the door, with their commands."""

TO = {
    "to the second door on the right": "go to the second door on the right",
    "zur zweiten Tür rechts": "go to the second door on the right",
    "in front of the second door on the right": "go to the second door on the right",
    "vor die zweite Tür rechts": "go to the second door on the right",
    "at the second door": "go down the hallway until the second door",
    "second door on the right and stop": "go to the second door on the right and stop",
    "zweite Tür rechts, dann halt an": "go to the second door on the right and stop",
    "stop at the second door on the right": "go to the second door on the right and stop",
    "halt an der zweiten Tür rechts": "go to the second door on the right and stop",
}
"""Texts that say something else."""


@pytest.mark.parametrize(("text", "meant"), THROUGH.items())
@pytest.mark.parametrize("reader", [parse, read], ids=["parse", "read"])
def test_a_door_that_is_only_named_is_gone_through(reader, text: str, meant: str) -> None:
    assert reader(text) == parse(meant)


IN_A_CASE = {
    "if there is a door on the left, turn left, otherwise the second door": (
        "if you see the first door on the left, turn left, otherwise go through the second door"
    ),
    "if there is a corner, the second door, otherwise stop": (
        "if you see the first corner, go through the second door, otherwise stop"
    ),
}


@pytest.mark.parametrize(("text", "meant"), IN_A_CASE.items())
def test_a_stop_in_another_case_does_not_stop_before_the_door(text: str, meant: str) -> None:
    assert str(read(text)) == meant


@pytest.mark.parametrize(("text", "meant"), TO.items())
def test_only_what_says_so_leads_in_front_of_a_door(text: str, meant: str) -> None:
    assert str(read(text)) == meant


@pytest.mark.parametrize(
    "text",
    [
        "there should be a door on your left, that's the one I want you to go through",
        "after the fork there's two doors on the right, take the second one",
        "never mind the doors, just go on to the end",
        "second door on the right, then turn left",
    ],
)
def test_a_door_before_other_clauses_is_asked_about(text: str) -> None:
    with pytest.raises(AmbiguousCommandError):
        read(text)


def test_both_readings_are_still_told_to_who_asks_for_all() -> None:
    both = readings("the second door on the right")
    assert [clause.approach for (clause,) in (each.clauses for each in both)] == [  # type: ignore[union-attr]
        Approach.TO,
        Approach.THROUGH,
    ]
    assert GrammarInterpreter().interpret("the second door on the right").command == both[1]


def test_a_misspelt_bare_door_is_asked_about_as_one_reading() -> None:
    with pytest.raises(AmbiguousCommandError) as asked:
        read("secnd door on the right")
    assert [str(each) for each in asked.value.readings] == [
        "go through the second door on the right"
    ]


def test_how_an_approach_was_found_out_is_no_part_of_the_command() -> None:
    door = GoToDoor(DoorReference(2, Side.RIGHT))
    (found,) = parse("the second door on the right").clauses
    assert found == door
    assert hash(found) == hash(door)
    assert repr(found) == repr(door)
    assert to_program(Command((found,))) == to_program(Command((door,)))
    with pytest.raises(ValueError, match="has no 'by_default'"):
        from_program([{**to_program(Command((door,)))[0], "by_default": True}])


@pytest.mark.parametrize(
    ("text", "because"),
    [
        (
            "the second door on the right",
            "the second door on the right, through it, as nothing else was said",
        ),
        ("go through the second door on the right", "the second door on the right"),
        ("to the second door on the right", "the second door on the right"),
    ],
)
def test_the_reasons_say_what_was_not_said(text: str, because: str) -> None:
    (clause,) = parse(text).clauses
    plan = load_floor_plan("office_cross")
    goal = ground(clause, plan.scene, begin=(1.3, 9.1, 0.0), complete=True)
    assert goal.because == because


def test_an_episode_is_begun_with_a_bare_door() -> None:
    env = SemNavEnv()
    options = {
        "floor_plan": "office_cross",
        "pose": (1.3, 9.1, 0.0),
        "command": "the second door on your right",
    }
    _, info = env.reset(seed=1, options=options)
    assert info["command"] == "go through the second door on the right"
    env.close()


def test_a_stop_alone_is_never_doubted() -> None:
    for text in ("das reicht", "stop stop stop", "that's enough", "hör auf"):
        command = LearnedInterpreter().interpret(text).command
        assert set(map(str, command.clauses)) == {"stop"}


STOPS = {
    "en": ("emergency stop", "Emergency stop!", "e-stop", "halt an", "halt", "stop", "stop now"),
    "de": (
        *("Notstopp", "Nothalt!", "Not-Halt", "hör auf", "hören Sie auf", "das reicht"),
        *("halt an", "Halt an!", "halte an", "halten Sie an", "anhalten", "halt", "stop"),
        *("emergency stop", "es reicht", "Stopp!"),
    ),
}
SAID_STOPS = [(code, text) for code, texts in STOPS.items() for text in texts]


@pytest.mark.parametrize(("code", "text"), SAID_STOPS)
def test_whoever_calls_for_a_stop_is_heard(code: str, text: str) -> None:
    assert str(parse(text, code)) == "stop"
    if text != "Not-Halt":  # in English, "not halt" forbids
        assert str(parse(text)) == "stop"


@pytest.mark.parametrize(
    "text",
    ["do not stop", "nicht anhalten", "hör nicht auf", "not halt"],
)
def test_what_forbids_a_stop_is_no_stop(text: str) -> None:
    with pytest.raises(ValueError, match="not understood"):
        parse(text)


def test_ground_says_where_a_bare_door_leads(capsys) -> None:
    pose = "--pose=-2.5,-0.3,0.24"
    assert main(["ground", "zweite Tür rechts", pose]) == 0
    row = capsys.readouterr().out.splitlines()[1]
    assert row.startswith("pass ")
    assert "fahr durch die zweite Tür rechts, da nichts anderes gesagt ist" in row
