"""What a demo prints is in the language of the command, with the words that were corrected."""

from __future__ import annotations

import pytest

from tests.support.command_line import run

CROSS = ("--map", "office_cross", "--pose=1.3,9.1,0")


@pytest.mark.parametrize(
    ("text", "lines"),
    [
        ("bleib stehen", ["von 1.30,9.10,0.00 in office_cross", '"halt an": fertig nach ']),
        ("stop", ["from 1.30,9.10,0.00 in office_cross", '"stop": done after ']),
    ],
)
def test_the_outcome_is_told_in_the_language_of_the_command(capsys, text, lines):
    """A stop corrects no word, so there are no further lines."""
    code, out, _ = run(capsys, "demo", text, *CROSS)
    assert code == 0
    printed = out.splitlines()
    assert len(printed) == len(lines)
    assert all(line.startswith(start) for line, start in zip(printed, lines, strict=True))


def test_a_corrected_word_is_told_beside_what_is_understood(capsys):
    _, out, _ = run(capsys, "ground", "geh durch die zweite Tür rehcts", *CROSS)
    assert out.splitlines()[0] == '"rehcts" als "rechts" verstanden'
    _, out, _ = run(capsys, "demo", "turn by 30 degrees to the lefft", *CROSS)
    assert out.splitlines()[1] == '"lefft" taken as "left"'


def test_a_room_behind_a_shut_door_is_told_in_the_language_of_the_command(capsys):
    _, _, err = run(capsys, "ground", "fahr in Raum east south 2", *CROSS)
    assert 'dorthin führt keine offene Tür: die Tür von "room_east_south_2" ist zu' in err
