"""What people say is acted on as they mean it, asked about, or refused."""

from __future__ import annotations

import pickle
import re
import subprocess
import sys

import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_env.language import (
    AmbiguousCommandError,
    Command,
    CommandError,
    LearnedInterpreter,
    parse,
    read,
)
from semnav_env.language.corpora import ParseOutcome, load_sentences, verdicts
from semnav_env.language.corpora.meanings import key_of
from semnav_env.language.languages import english, languages
from semnav_env.language.normalise import SIGNS
from semnav_env.language.translating.interpreter import AskingLimits
from semnav_env.language.translating.network import load_translator
from semnav_env.language.translating.support import TextSupport
from semnav_env.language.translating.translator import translate
from semnav_env.language.vocabulary.lexicon import lexicon_of
from studies.corpora import learned_corpora
from tests.support.paths import ROOT

SAID = {
    "second door on the right": "go through the second door on the right",
    "the second door on your right": "go through the second door on the right",
    "zweite Tür rechts": "go through the second door on the right",
    "it's the second door on the right": "go through the second door on the right",
    "go down the hallway, then the second door on the right": (
        "go down the hallway and go through the second door on the right"
    ),
    "take the second left": "turn left at the second turning",
    "make a left at the T-junction": "turn left at the first T-junction",
    "turn left at the end": "turn left at the end of the hallway",
    "am Flurende nach links": "turn left at the end of the hallway",
    "turn left at the corner, no, right": "turn right at the first corner",
    "fahr zurück zum Start": "go back to the start",
    "back up two metres": "back up for 2 metres",
    "wait half a minute": "wait for 30 seconds",
}
"""Everyday texts, which are acted on."""


@pytest.mark.parametrize(("text", "meant"), SAID.items())
def test_everyday_commands_are_acted_on(text: str, meant: str) -> None:
    assert key_of(parse(text)) == key_of(read(meant))


@pytest.mark.parametrize("path", learned_corpora()[:2], ids=lambda path: path.stem)
def test_what_it_has_learned_is_acted_on(path) -> None:
    """The texts of the project; of authors whom it does not know see docs/lab/language.md."""
    found = [each.outcome for each in verdicts(load_sentences(path), parse)]
    assert found.count(ParseOutcome.UNDERSTOOD) >= 0.9 * len(found)
    assert found.count(ParseOutcome.MISREAD) <= 0.02 * len(found)


def first_reading(text: str) -> Command:
    """What a text is taken for, or what a question about it names first."""
    try:
        return parse(text)
    except AmbiguousCommandError as error:
        return error.readings[0]


def test_every_example_of_the_documentation_means_what_it_says() -> None:
    page = (ROOT / "docs" / "guides" / "wordings.md").read_text("utf-8")
    rows = re.findall(r"^\| `([^`]+)` \| `([^`]+)` \|$", page, re.MULTILINE)
    assert len(rows) >= 20
    for text, canonical in rows:
        assert key_of(first_reading(text)) == key_of(read(canonical)), text


@pytest.mark.parametrize(
    "text",
    [
        "",
        "?!",
        "asdf qwer zxcv",
        "what time is it",
        "sing me a song",
        "Wie spät ist es?",
        "take the elevator to the third floor",
        "bring me the blue cup",
        "\x00",
        "x " * 299,
    ],
)
def test_nonsense_is_refused_without_a_question(text: str) -> None:
    with pytest.raises(CommandError) as refused:
        parse(text)
    assert not isinstance(refused.value, AmbiguousCommandError)


@pytest.mark.parametrize(
    "text",
    [
        "don't turn left",
        "do not enter the first door on the left",
        "geh nicht durch die erste Tür rechts",
        "go through the first or the second door on the left",
        "go down the hallway but don't turn left at the intersection",
        "bieg an der Kreuzung auf keinen Fall links ab",
        "you must not enter the second door",
        "stay out of the first room on the left",
    ],
)
def test_what_is_forbidden_or_left_to_choose_is_not_done(text: str) -> None:
    with pytest.raises(CommandError):
        parse(text)


def test_limits_say_when_the_robot_acts_and_when_it_asks() -> None:
    text, meant = "geh bitte durch die dritte Tür links", "go through the third door on the left"
    with pytest.raises(AmbiguousCommandError) as asked:
        LearnedInterpreter(limits=AskingLimits(acting=1.01)).interpret(text)
    assert asked.value.readings[0] == read(meant)
    assert len(asked.value.readings) <= AskingLimits().choices
    assert asked.value.question.text.startswith("Durch die dritte Tür links")
    assert pickle.loads(pickle.dumps(asked.value)).readings == asked.value.readings
    acted = LearnedInterpreter(limits=AskingLimits(acting=0.0)).interpret(text)
    assert (acted.command, acted.by) == (read(meant), "translator")


def test_the_probabilities_of_the_translations_are_at_most_one_together() -> None:
    found = translate("take the second right, door", (), load_translator())
    assert found is not None
    shares = [each.likeness for each in found.translations]
    assert shares == sorted(shares, reverse=True)
    assert 0.0 < sum(shares) <= 1.0


@given(st.text(max_size=40), st.sampled_from(sorted(languages())))
def test_a_room_that_is_not_there_is_never_gone_to(name: str, code: str) -> None:
    try:
        command = parse(f"go to the {name}", code, rooms=("Kitchen",))
    except CommandError:
        return
    assert "room" not in str(command) or 'room "kitchen"' in str(command)


def test_asking_needs_no_torch() -> None:
    code = (
        "import sys\n"
        "from semnav_env.language import parse\n"
        "try: parse('mosey to the third door')\n"
        "except ValueError: pass\n"
        "assert 'torch' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


@pytest.mark.parametrize(
    ("text", "meant", "speaks"),
    [
        ("look at me when i talk", "face the first intersection", False),
        ("where do you come from", "go back to the start", False),
        ("follow me", "go down the hallway", False),
        ("halt", "stop", False),
        ("whizz to the crossing", "go down the hallway until the first intersection", True),
        ("und dann die dritte", "go through the third door", True),
    ],
)
def test_a_text_speaks_of_all_that_its_translation_names(
    text: str, meant: str, speaks: bool
) -> None:
    assert TextSupport.of(text.split()).speaks_of(read(meant)) is speaks


@pytest.mark.parametrize(("text", "code"), [("kehr um", "de"), ("walk down the corridor", "en")])
def test_the_language_of_a_text_is_recognised(text: str, code: str) -> None:
    assert LearnedInterpreter().interpret(text).language.code == code
    with pytest.raises(CommandError, match="language="):
        parse(text, {"en": "de", "de": "en"}[code])


@pytest.mark.parametrize("code", sorted(languages()))
def test_every_word_can_be_typed_on_a_plain_keyboard(code: str) -> None:
    language = languages()[code]
    assert all(word.isascii() for word in lexicon_of(language).words if word not in SIGNS)


@pytest.mark.parametrize("code", sorted(languages()))
def test_every_language_knows_all_phrases(code: str) -> None:
    assert {key for key in english().phrases} <= set(languages()[code].phrases)


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("don't go into the kitchen", "say only what to do"),
        ("fahr nicht in die Küche", "sag nur, was zu tun ist"),
        ("go down the hallway, but don't turn left at the corner", "say only what to do"),
    ],
)
def test_a_prohibition_is_refused_with_what_to_say(text: str, problem: str) -> None:
    with pytest.raises(CommandError) as refused:
        parse(text, rooms=("kitchen", "Küche"))
    assert refused.value.problem == problem


def test_no_refusal_blames_a_comma_or_a_room_that_is_there() -> None:
    for text in ("Ten, nine, eight, glide to your resting place.", "sing, kitchen, and dance"):
        with pytest.raises(CommandError) as refused:
            parse(text, rooms=("kitchen",))
        assert not {"kitchen", ","} & set(refused.value.problem.replace('"', " ").split())
