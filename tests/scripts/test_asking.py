"""At a terminal the commands ask what is left open; elsewhere that is an error."""

import io
import sys

import pytest

from semnav_scripts.main import main

GROUND = ["ground", "turn 90 degrees", "--pose=0,0,0"]


class Terminal(io.StringIO):
    """Text that is typed, or shown, at a terminal."""

    def isatty(self) -> bool:
        return True


def test_a_person_at_the_terminal_is_asked(monkeypatch, capsys) -> None:
    shown = Terminal()
    monkeypatch.setattr(sys, "stdin", Terminal("what?\nright\n"))
    monkeypatch.setattr(sys, "stderr", shown)
    assert main(GROUND) == 0
    assert "turn right by 90 degrees" in capsys.readouterr().out
    assert shown.getvalue() == "Left, or right? " * 2


def test_an_end_of_the_input_is_no_answer(monkeypatch) -> None:
    shown = Terminal()
    monkeypatch.setattr(sys, "stdin", Terminal(""))
    monkeypatch.setattr(sys, "stderr", shown)
    assert main(GROUND) == 2
    assert shown.getvalue().endswith("there is no answer; say the whole command\n")


def test_nobody_is_asked_in_a_pipe(monkeypatch, capsys) -> None:
    monkeypatch.setattr(sys, "stdin", io.StringIO("right\n"))
    assert main(GROUND) == 2
    assert "Left, or right?" in capsys.readouterr().err


@pytest.mark.parametrize("ask", [3, "left"])
def test_what_cannot_be_asked_is_refused(ask: object) -> None:
    from semnav_env import SemNavEnv

    env = SemNavEnv(floor_plan="office_cross")
    with pytest.raises(ValueError, match="ask"):
        env.reset(seed=0, options={"command": "turn 90 degrees", "ask": ask})
    _, info = env.reset(
        seed=0, options={"command": "turn 90 degrees", "ask": lambda question: "the left one"}
    )
    assert info["command"] == "turn left by 90 degrees"
    env.close()
