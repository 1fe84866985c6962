"""Other ways to understand a text: the same programs, the same refusals."""

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_env.judge import plan_goals
from semnav_env.language import (
    Command,
    CommandError,
    DoorReference,
    GoToDoor,
    GoToRoom,
    Interpreter,
    LearnedInterpreter,
    ModelInterpreter,
    Side,
    from_program,
    read,
    to_program,
)
from semnav_env.mind.grounding import GroundingError, PassGoal
from semnav_env.world.maps import load_floor_plan
from tests.support.command_strategies import commands

SECOND_RIGHT = Command((GoToDoor(DoorReference(2, Side.RIGHT)),))
TEXT = "please would you bring yourself through that second one"


def stub(answer: object) -> ModelInterpreter:
    """A model that always gives the same answer."""
    return ModelInterpreter(lambda text: answer)


@given(commands)
def test_a_program_comes_back_from_plain_values(command: Command) -> None:
    assert from_program(to_program(command)) == command
    assert from_program(json.loads(json.dumps(to_program(command)))) == command


@pytest.mark.parametrize(
    "answer", [SECOND_RIGHT, to_program(SECOND_RIGHT), json.dumps(to_program(SECOND_RIGHT))]
)
def test_a_model_answers_with_a_program(answer: object) -> None:
    understood = stub(answer).interpret(TEXT)
    assert understood.command == SECOND_RIGHT
    assert understood.by == "model"
    assert understood.echo == "go through the second door on the right"


@pytest.mark.parametrize(
    ("answer", "reason"),
    [
        ("go through the second door", "no program"),
        ("", "no program"),
        (None, "a list of clauses, not NoneType"),
        ({"kind": "Stop"}, "a list of clauses, not dict"),
        ([], "1 to 8 clauses, not 0"),
        ([{"kind": "Stop"}] * 9, "1 to 8 clauses, not 9"),
        ([{"kind": "Jump"}], "the kind of clause 0 is one of Follow, Turn"),
        ([["Stop"]], "clause 0 is a dictionary"),
        ([{"kind": "Stop", "minutes": 3}], "clause 0, a Stop, has no 'minutes'"),
        ([{"kind": "Stop", "seconds": "3"}], "seconds of clause 0 cannot be '3'"),
        ([{"kind": "Stop", "seconds": True}], "seconds of clause 0 cannot be True"),
        ([{"kind": "Turn"}], "missing 1 required"),
        ([{"kind": "Turn", "turning": "up"}], "turning of clause 0 is one of 'left', 'right'"),
        ([{"kind": "Turn", "turning": None}], "turning of clause 0 is one of"),
        ([{"kind": "Turn", "turning": ["left"]}], "turning of clause 0 is one of"),
        ([{"kind": "GoToDoor", "door": {"kind": "DoorReference", "ordinal": 21}}], "1 to 20"),
        ([{"kind": "GoToDoor", "door": {"kind": "Distance", "amount": 2}}], "is one of DoorRef"),
        ([{"kind": "Follow", "until": {"kind": "Distance", "amount": float("nan")}}], "0.5 to 50"),
        ([{"kind": "GoToRoom", "name": "../../etc"}], "small letters and digits"),
    ],
)
def test_a_wrong_program_is_refused(answer: object, reason: str) -> None:
    with pytest.raises(CommandError, match="the model's answer is no program") as caught:
        stub(answer).interpret(TEXT)
    assert reason in str(caught.value)


@given(
    st.recursive(
        st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=8),
        lambda inner: (
            st.lists(inner, max_size=3)
            | st.dictionaries(
                st.sampled_from(("kind", "turning", "door", "until", "ordinal", "x")), inner
            )
        ),
        max_leaves=8,
    )
)
def test_any_answer_is_a_program_or_refused(answer: object) -> None:
    try:
        understood = stub(answer).interpret(TEXT)
    except CommandError:
        return
    assert read(understood.echo) == understood.command


def test_a_model_is_not_asked_about_texts_that_hide_something() -> None:
    asked: list[str] = []
    model = ModelInterpreter(lambda text: asked.append(text))
    for text in ("\u202eturn left", "x" * 1_000_000, "turn l\u0435ft", ""):
        with pytest.raises(CommandError):
            model.interpret(text)
    assert asked == []


def test_a_model_may_name_only_rooms_that_are_there() -> None:
    model = ModelInterpreter(lambda text: Command((GoToRoom("attic"),)), rooms=("kitchen",))
    with pytest.raises(CommandError, match='no room "attic"; there are: kitchen'):
        model.interpret(TEXT)


def test_what_a_model_says_is_resolved_like_every_other_command() -> None:
    """The second door is there, the ninth is not, whoever asks for it."""
    plan, start = load_floor_plan("office_cross"), (1.3, 9.1, 0.0)
    second = stub(SECOND_RIGHT).interpret(TEXT).command
    (goal,) = plan_goals(plan, second, start)
    assert isinstance(goal, PassGoal)
    assert goal.door.name == "west_south_2"
    ninth = stub(to_program(read("go through the ninth door on the right"))).interpret(TEXT).command
    with pytest.raises(GroundingError, match="no ninth door on the right: the hallway ended after"):
        plan_goals(plan, ninth, start)


def test_the_learned_reader_is_an_interpreter() -> None:
    reader: Interpreter = LearnedInterpreter()
    found = reader.interpret("nimm die zweite Tür links")
    assert (str(found.command), found.by) == (
        "go through the second door on the left",
        "translator",
    )
    assert 0.5 < found.likeness <= 1.0
    assert found.echo == "fahr durch die zweite Tür links"
    assert len(repr(found)) < 300
