"""What is understood, and as what."""

import re
from random import Random

import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from semnav_env.language import Command, CommandError, IfThere, read
from semnav_env.language.languages import english, languages
from semnav_env.language.normalise import SIGNS
from semnav_env.language.vocabulary.lexicon import lexicon_of
from tests.support.command_strategies import commands
from tests.support.paths import ROOT

# Each command beside its canonical wording.
UNDERSTOOD = """
go down the hallway = go down the hallway
Go down the corridor. = go down the hallway
follow the hall = go down the hallway
drive down the passage = go down the hallway
head down the hallway! = go down the hallway
continue along the corridor = go down the hallway
go along hallway = go down the hallway
walk straight down the hallway = go down the hallway
follow the corridor until the end = go down the hallway until the end of the hallway
go down the hallway to the end of the hallway = go down the hallway until the end of the hallway
follow the hallway to the end of the corridor = go down the hallway until the end of the hallway
follow the hall all the way to the end = go down the hallway until the end of the hallway
go to the end of the hallway = go down the hallway until the end of the hallway
continue until the end = go down the hallway until the end of the hallway
go down the hallway until the next intersection = go down the hallway until the first intersection
go down the hall until the intersection = go down the hallway until the first intersection
follow the hallway till the second junction = go down the hallway until the second intersection
drive down the corridor up to the 3rd crossing = go down the hallway until the third intersection
go to the next intersection = go down the hallway until the first intersection
head along the corridor until you reach the corner = go down the hallway until the first corner
follow the passage as far as the fourth corner = go down the hallway until the fourth corner
go down the hallway until the door on the left = go down the hallway until the first door on the left
follow the hallway to the 5th door on your right = go down the hallway until the fifth door on the right
continue until the last door = go down the hallway until the last door
turn left = turn left
turn right now = turn right
Turn around, please = turn around
turn round = turn around
turn left here = turn left
please turn right here = turn right
turn left at the intersection = turn left at the first intersection
turn left at the next junction = turn left at the first intersection
turn right at the 2nd intersection = turn right at the second intersection
turn right at second crossing = turn right at the second intersection
turn left at the third corner = turn left at the third corner
turn around at the end of the corridor = turn around at the end of the hallway
turn right at the end = turn right at the end of the hallway
at the second intersection, turn left = turn left at the second intersection
at the end of the hallway turn right = turn right at the end of the hallway
go to the door = go to the first door
go up to the third door on the left = go to the third door on the left
drive to the last door on your right = go to the last door on the right
go to the door ahead = go to the first door straight ahead
go to the next door straight ahead = go to the first door straight ahead
go to the door in front of you = go to the first door straight ahead
go through the door = go through the first door
go through the second door on the right = go through the second door on the right
go into the 12th door on the left = go through the twelfth door on the left
go in the first door on the right = go through the first door on the right
enter the last door on your left = go through the last door on the left
enter the twentieth door = go through the twentieth door
take the next door on the left side = go through the first door on the left
take the final doorway on your right-hand side = go through the last door on the right
drive through the door to the left = go through the first door on the left
go in through the door on the left hand side = go through the first door on the left
Drive Through The Second Door On The Right = go through the second door on the right
stop = stop
halt! = stop
stop here. = stop
turn left, stop = turn left and stop
turn left; stop = turn left and stop
turn left and stop = turn left and stop
turn left then stop = turn left and stop
turn left and then stop = turn left and stop
turn left, and then stop = turn left and stop
turn left. Then stop. = turn left and stop
turn left, then, stop... = turn left and stop
please, turn left, please, and stop now, please! = turn left and stop
go down the hallway and through the first door on the left = go down the hallway and go through the first door on the left
go down the hallway, turn left at the intersection and go in the first door on the right = go down the hallway, turn left at the first intersection and go through the first door on the right
go down the hallway, turn left at the intersection and go in the second door on the right = go down the hallway, turn left at the first intersection and go through the second door on the right
follow the corridor until the end, then turn right at the corner and enter the last door on your left. stop = go down the hallway until the end of the hallway, turn right at the first corner, go through the last door on the left and stop
turn left, at the second intersection, turn right = turn left and turn right at the second intersection
"""  # noqa: E501
TABLE = [tuple(line.split(" = ")) for line in UNDERSTOOD.strip().splitlines()]


def test_the_table_is_long_enough_to_mean_something() -> None:
    assert len(TABLE) >= 60
    assert len(set(TABLE)) == len(TABLE)


@pytest.mark.parametrize(("text", "canonical"), TABLE)
def test_wordings_mean_their_canonical_form(text: str, canonical: str) -> None:
    assert str(read(text)) == canonical


@pytest.mark.parametrize(
    "text",
    [
        "  go\tthrough \n the\u2028second\u00a0door on\u3000the right ",
        "GO THROUGH THE SECOND DOOR ON THE RIGHT",
        "ｇｏ ｔｈｒｏｕｇｈ ｔｈｅ second door on the right",
        "𝐠𝐨 through the 𝟐nd door on the right",
        "\ufeffgo thr\u200bough the se\u00adcond door\u2060 on the ri\u200dght\u200e",
    ],
)
def test_case_spaces_and_invisible_characters_change_nothing(
    text: str,
) -> None:
    assert str(read(text)) == "go through the second door on the right"


@settings(suppress_health_check=[HealthCheck.filter_too_much])
@given(commands, st.randoms(use_true_random=False))
def test_fillers_and_case_between_clauses_change_nothing(command: Command, random: Random) -> None:
    joints = (", ", " and ", "; ", " then ", ". ", " and then ", ", please ", " now, and then ")
    assume(not any(isinstance(clause, IfThere) for clause in command.clauses))
    text = str(command.clauses[0])
    for clause in command.clauses[1:]:
        text += random.choice(joints) + random.choice((str, lambda c: str(c).upper()))(clause)
    assert read(text) == command


def _mirrored(text: str) -> str:
    return re.sub("left|right", lambda m: "left" if m[0] == "right" else "right", text)


@pytest.mark.parametrize(("text", "canonical"), TABLE)
def test_swapping_left_and_right_swaps_them_in_the_meaning(text: str, canonical: str) -> None:
    assert str(read(_mirrored(text.lower()))) == _mirrored(canonical)


REFUSED = [
    "don't go through the door",
    "do not turn left",
    "turn left or right",
    "turn",
    "turn left right",
    "turn left around",
    "turnleft",
    "go",
    "go to the second",
    "go through door 2",
    "go through the twenty-first door",
    "go through the 2st door",
    "go through the 0th door",
    "turn left at the second end",
    "turn left at",
    "go to the kitchen",
    "turn around the corner",
    "go down the hallway not until the end",
    "turn a bit to the left",
    "go to the closed door",
    "turn 90 degrees",
    "turn left?",
    '"turn left"',
    "please",
    "...",
    "drive slowly to the end",
    "go 3² metres",
]


@pytest.mark.parametrize("text", REFUSED)
def test_partly_understood_texts_are_refused(text: str) -> None:
    with pytest.raises(CommandError):
        read(text)


@given(st.sampled_from(TABLE), st.data())
def test_a_command_cut_short_never_gains_meaning(row: tuple[str, str], data: st.DataObject) -> None:
    """Leaving words off the end gives an error or a shorter command, with no clause invented."""
    words = row[0].split()
    kept = " ".join(words[: data.draw(st.integers(0, len(words)))])
    whole = read(row[0])
    try:
        part = read(kept)
    except CommandError:
        return
    *finished, _ = part.clauses
    assert whole.clauses[: len(finished)] == tuple(finished)


@pytest.mark.parametrize("code", sorted(languages()))
def test_every_word_can_be_typed_on_a_plain_keyboard(code: str) -> None:
    language = languages()[code]
    assert all(word.isascii() for word in lexicon_of(language).words if word not in SIGNS)


@pytest.mark.parametrize("code", sorted(languages()))
def test_every_language_knows_all_phrases(code: str) -> None:
    assert {key for key in english().phrases} <= set(languages()[code].phrases)


def test_a_language_is_read_once() -> None:
    assert lexicon_of(english()) is lexicon_of(english())
    assert english() is english()


def test_every_example_of_the_documentation_means_what_it_says() -> None:
    page = ROOT / "docs" / "wordings.md"
    rows = re.findall(r"^\| `([^`]+)` \| `([^`]+)` \|$", page.read_text("utf-8"), re.MULTILINE)
    assert len(rows) >= 20
    assert [str(read(text)) for text, _ in rows] == [canonical for _, canonical in rows]
