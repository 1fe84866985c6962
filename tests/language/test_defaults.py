"""A door that is only named is gone through; what says otherwise is obeyed."""

from __future__ import annotations

import pytest

from semnav_env.env import SemNavEnv
from semnav_env.language import (
    Command,
    CommandError,
    DoorReference,
    GoToDoor,
    Side,
    from_program,
    parse,
    to_program,
)
from semnav_env.language.corpora.meanings import key_of
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
    "stop at the second door on the right": "go to the second door on the right and stop",
    "halt an der zweiten Tür rechts": "go to the second door on the right and stop",
}
"""Texts that say something else."""


@pytest.mark.parametrize(("text", "meant"), (THROUGH | TO).items())
def test_a_door_is_approached_as_people_mean_it(text: str, meant: str) -> None:
    assert key_of(parse(text)) == key_of(parse(meant))


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
def test_what_forbids_a_stop_moves_nothing(text: str) -> None:
    try:
        command = parse(text)
    except CommandError:
        return
    assert str(command) == "stop"


def test_ground_says_where_a_bare_door_leads(capsys) -> None:
    pose = "--pose=-2.5,-0.3,0.24"
    assert main(["ground", "zweite Tür rechts", pose]) == 0
    row = capsys.readouterr().out.splitlines()[1]
    assert row.startswith("pass ")
    assert "die zweite Tür rechts, hindurch, da nichts anderes gesagt ist" in row
