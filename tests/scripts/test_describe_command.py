"""`semnav describe`: the command of a route, on the command line."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from semnav_env.language import from_program, parse
from semnav_scripts.main import main


def described(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, str]:
    code = main(["describe", "--map", "office_cross", "--from", "1.3,9.1,0", *words])
    output = capsys.readouterr()
    return code, output.out or output.err


def test_the_command_line_says_a_command_and_draws_the_route(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    picture = tmp_path / "new" / "route.png"
    code, said = described(capsys, "--to", "west_south_2", "--plot", str(picture))
    assert code == 0
    assert said.splitlines()[0] == "go through the second door on the right"
    assert len([line for line in said.splitlines() if line.startswith("  or: ")]) == 3
    assert picture.stat().st_size > 10_000


def test_the_command_line_speaks_german_and_json(capsys: pytest.CaptureFixture[str]) -> None:
    words = ("--to", "room_bend_north_1", "--language", "german", "--json", "--paraphrases", "5")
    code, said = described(capsys, *words)
    outcome = json.loads(said)
    assert code == 0
    assert outcome["door"] == "bend_north_1"
    command = from_program(outcome["program"])
    assert {parse(text, "de") for text in (outcome["command"], *outcome["paraphrases"])} == {
        command
    }


def test_the_command_line_leads_to_a_place(capsys: pytest.CaptureFixture[str]) -> None:
    assert described(capsys, "--to", "29,9", "--paraphrases", "0") == (0, "go down the hallway\n")


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--to", "kitchen"), "has no door, room or place 'kitchen'"),
        (("--to", "west_south_2", "--language", "latin"), "no language 'latin'; there are: "),
        (
            ("--to", "west_south_2", "--paraphrases", "-1"),
            "--paraphrases is -1; it must be 0 or more",
        ),
        ((), "--to"),
    ],
)
def test_the_command_line_says_what_is_wrong(
    capsys: pytest.CaptureFixture[str], words: tuple[str, ...], message: str
) -> None:
    code, said = described(capsys, *words)
    assert code == 2
    assert message in said
    assert said.count("\n") == 1
