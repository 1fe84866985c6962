"""At a terminal the commands ask what is left open; elsewhere that is an error."""

import io
import sys

import pytest

from semnav_scripts.main import main
from tests.support.asked import asked_about

TEXT, QUESTION = asked_about()
GROUND = ["ground", TEXT, "--pose=-2.5,-0.3,0.24"]


class Terminal(io.StringIO):
    """Text that is typed, or shown, at a terminal."""

    def isatty(self) -> bool:
        return True


def test_a_person_at_the_terminal_is_asked(monkeypatch, capsys) -> None:
    shown = Terminal()
    monkeypatch.setattr(sys, "stdin", Terminal(f"what?\n{QUESTION.choices[0].name}\n"))
    monkeypatch.setattr(sys, "stderr", shown)
    assert main(GROUND) == 0
    assert capsys.readouterr().out
    assert shown.getvalue() == f"{QUESTION.text} " * 2


def test_an_end_of_the_input_is_no_answer(monkeypatch) -> None:
    shown = Terminal()
    monkeypatch.setattr(sys, "stdin", Terminal(""))
    monkeypatch.setattr(sys, "stderr", shown)
    assert main(GROUND) == 2
    assert shown.getvalue().endswith("there is no answer; say the whole command\n")


def test_nobody_is_asked_in_a_pipe(monkeypatch, capsys) -> None:
    monkeypatch.setattr(sys, "stdin", io.StringIO("right\n"))
    assert main(GROUND) == 2
    assert QUESTION.text in capsys.readouterr().err


@pytest.mark.parametrize("ask", [3, "left"])
def test_what_cannot_be_asked_is_refused(ask: object) -> None:
    from semnav_env import SemNavEnv

    env = SemNavEnv(floor_plan="office_cross")
    with pytest.raises(ValueError, match="ask"):
        env.reset(seed=0, options={"command": TEXT, "ask": ask})
    options = {"command": TEXT, "ask": lambda question: QUESTION.choices[1].name}
    _, info = env.reset(seed=0, options=options)
    assert info["command"] == str(QUESTION.readings[1])
    env.close()
