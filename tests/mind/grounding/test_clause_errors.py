"""Errors of commands of several clauses name the clause that cannot be carried out."""

import pickle

import pytest

from semnav_env.env import SemNavEnv
from semnav_env.judge import plan_goals
from semnav_env.language import Command, GoToRoom, Leave, Stop, parse
from semnav_env.mind.grounding import GroundingError
from semnav_env.mind.grounding.clause_error import ClauseError
from semnav_env.world.maps import load_floor_plan
from tests.support.command_line import run

PLAN = load_floor_plan("office_cross")
WEST = (1.3, 9.1, 0.0)
POSE = "--pose=1.3,9.1,0"

NO_THIRD = "no third intersection that leads left: the hallway ended after 1"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            "go down the hallway, turn left at the third intersection and stop",
            f'clause 2 of 3, "turn left at the third intersection", cannot be carried out: '
            f"{NO_THIRD}",
        ),
        ("turn left at the third intersection", NO_THIRD),
        (
            "stop and go through the ninth door on the right",
            'clause 2 of 2, "go through the ninth door on the right", cannot be carried out: '
            "no ninth door on the right: the hallway ended after 5",
        ),
    ],
)
def test_the_error_of_one_clause_of_several_names_it_in_one_sentence(
    text: str, message: str
) -> None:
    with pytest.raises(GroundingError) as caught:
        plan_goals(PLAN, parse(text), WEST)
    assert str(caught.value) == message
    env = SemNavEnv(floor_plan=PLAN)
    with pytest.raises(GroundingError) as caught:
        env.reset(options={"command": text, "pose": WEST, "implicit_steps": False})
    assert str(caught.value) == message


def test_a_room_that_there_is_not_is_named_once() -> None:
    with pytest.raises(
        ClauseError, match=r'^clause 1 of 2, "go to .*", cannot .* out: office_'
    ) as e:
        plan_goals(PLAN, Command((GoToRoom("attic"), Stop())), WEST)
    assert str(e.value).count("attic") == 1
    with pytest.raises(GroundingError, match=r'^go to room "attic": office_cross has '):
        plan_goals(PLAN, Command((GoToRoom("attic"),)), WEST)


@pytest.mark.parametrize("language", [None, "de"])
def test_the_clause_is_named_in_the_language_of_the_command(language: str | None) -> None:
    text = "dreh dich um und fahr durch die neunte Tür rechts"
    env = SemNavEnv(floor_plan=PLAN)
    for command in (text, parse(text)) if language else (text,):
        named = r'^Teil 2 von 2, "fahr durch die neunte Tür rechts", geht nicht: die neunte Tür '
        with pytest.raises(ClauseError, match=named):
            env.reset(options={"command": command, "language": language, "pose": WEST})


def test_a_clause_error_survives_pickling() -> None:
    command = Command((Leave(), GoToRoom("attic")))
    error = ClauseError(command, 1, "no such room").in_words_of("de")
    again = pickle.loads(pickle.dumps(error))
    assert (str(again), again.command, again.clause) == (str(error), command, 1)
    assert again.reason == "no such room"


@pytest.mark.parametrize(
    ("text", "echo", "refusal"),
    [
        (
            "fahr durch die zweite Tür links und halt an",
            "die zweite Tür links",
            'Teil 1 von 2, "fahr durch die zwölfte Tür links", geht nicht',
        ),
        (
            "go through the second door on the left and stop",
            "the second door on the left",
            'clause 1 of 2, "go through the twelfth door on the left", cannot',
        ),
    ],
)
def test_ground_speaks_the_language_of_the_command(
    capsys, text: str, echo: str, refusal: str
) -> None:
    _, out, _ = run(capsys, "ground", text, "--map=office_cross", POSE)
    assert f"  {echo}  (door west_north_2)\n" in out
    refused = text.replace("zweite", "zwölfte").replace("second", "twelfth")
    code, _, err = run(capsys, "ground", refused, "--map=office_cross", POSE)
    assert code == 2
    assert refusal in err


def test_demo_speaks_the_language_of_the_command(capsys) -> None:
    _, out, _ = run(capsys, "demo", "Bitte umdrehen!", "--map=office_cross", POSE)
    assert '"dreh dich um": fertig nach' in out
