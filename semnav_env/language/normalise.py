"""Brings a text into one form: lower case, single spaces, no invisible characters."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator
from dataclasses import dataclass

from semnav_env.language.clauses import GoToDoor
from semnav_env.language.errors import CommandError, character_name
from semnav_env.language.language import Language
from semnav_env.language.references import DoorReference, Side
from semnav_env.language.rooms import without_accents
from semnav_env.language.words import pieces

MAX_CHARACTERS = 4_000
"""The longest text that is read, characters; it bounds the time that a parse can take."""

MAX_WORDS = 150
"""The most words, numbers and signs that are read. Those of 8,511 frozen texts and of 2,360 that
people wrote have 73 at most; the time of a parse grows faster than their number."""

MAX_WORD_LENGTH = 80
"""The longest word, number or quoted name that is read, characters; no known word is longer."""

INVISIBLE = frozenset("\u00ad\u200b\u200c\u200d\u200e\u200f\u061c\u2060\ufeff")
"""Soft hyphen, zero-width spaces and joiners, direction marks. They are dropped, because they
change no word."""

REORDERING = frozenset("\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069")
"""Bidirectional controls. They are refused, because they can show words in another order than the
one in which they are read."""

SIGNS = frozenset("°")
"""Signs outside ASCII that commands may have: degrees."""

_CLUSTER = re.compile(r".[\u0300-\u036f]*", re.DOTALL)


@dataclass(frozen=True, slots=True)
class NormalisedText:
    """A normalised text, and where each of its characters comes from.

    Attributes:
        original: the text as it was given.
        text: lower case, NFKC, single spaces.
        origin: for each character of `text`, and for its end, the index in `original`.
    """

    original: str
    text: str
    origin: tuple[int, ...]

    def span(self, start: int, stop: int) -> tuple[int, int]:
        """Index in the original at which `text[start:stop]` begins, and its length there."""
        position = self.origin[start]
        last = self.origin[stop - 1] if stop > start else position
        return position, last + 1 - position


def normalise(original: str, language: Language) -> NormalisedText:
    """Bring a text into the one form that is read.

    Raises:
        CommandError: it is not a text, is empty or too long, or has characters that no command has.
    """
    _check_size(original)
    characters: list[str] = []
    origin: list[int] = []
    for index, folded in _folded(original, language):
        if folded == " " and (not characters or characters[-1] == " "):
            continue
        characters.append(folded)
        origin.append(index)
    text = "".join(characters).rstrip()
    if not text:
        raise empty_command(language)
    end = origin[len(text) - 1] + 1
    normalised = NormalisedText(original, text, (*origin[: len(text)], end))
    _check_words(normalised)
    return normalised


def empty_command(language: Language) -> CommandError:
    """The error for a text without words."""
    example = GoToDoor(DoorReference(2, Side.RIGHT)).say(language)
    hint = language.tell('for example: "{command}"', command=example)
    return CommandError(language.tell("the command is empty"), hint=hint)


def _check_words(normalised: NormalisedText) -> None:
    """Refuse what would take long to read, before it is read."""
    found = pieces(normalised.text)
    if len(found) > MAX_WORDS:
        problem = f"the command has {len(found)} words and signs; at most {MAX_WORDS} are read"
        raise CommandError(problem)
    for piece in found:
        if len(piece.text) > MAX_WORD_LENGTH:
            problem = f"a word has {len(piece.text)} characters; at most {MAX_WORD_LENGTH} are read"
            position, length = normalised.span(piece.start, piece.stop)
            raise CommandError(problem, normalised.original, position, length)


def _check_size(original: str) -> None:
    if not isinstance(original, str):
        raise CommandError(f"a command is a text (str), not {type(original).__name__}")
    if len(original) > MAX_CHARACTERS:
        problem = f"the command has {len(original)} characters; at most {MAX_CHARACTERS} are read"
        raise CommandError(problem)


def _folded(original: str, language: Language) -> Iterator[tuple[int, str]]:
    """Each character of the normalised text, with the index in the original that it comes from.

    A letter is folded together with the combining accents behind it, so that both Unicode forms of
    an accented letter give the same character.
    """
    if original.isascii() and original.isprintable():
        yield from enumerate(original.lower())
        return
    for cluster in _CLUSTER.finditer(original):
        index = cluster.start()
        first = cluster.group()[0]
        if first in INVISIBLE:
            continue
        if first.isspace() and first not in "\x0b\x0c\x1c\x1d\x1e\x1f\x85":
            yield index, " "
            continue
        _refuse_invisible(original, index)
        _refuse_superscript(original, index)
        for character in _nfkc_casefold(cluster.group()):
            known = without_accents(language.folded(character))
            _refuse_foreign(original, index, known, language)
            yield from ((index, each) for each in known)


def _nfkc_casefold(text: str) -> str:
    """Compatibility case folding (The Unicode Standard, section 3.13, definition D146)."""
    folded = unicodedata.normalize("NFKC", unicodedata.normalize("NFKC", text).casefold())
    return "".join(" " if c.isspace() else c for c in folded if c not in INVISIBLE)


def _refuse_invisible(original: str, index: int) -> None:
    character = original[index]
    if character in REORDERING:
        name = character_name(character)
        problem = f"{name} can change the order in which words are shown: leave it out"
        raise CommandError(problem, original, index)
    if unicodedata.category(character) in ("Cc", "Cs"):
        kind = "surrogate" if unicodedata.category(character) == "Cs" else "control character"
        raise CommandError(
            f"{character_name(character)} is a {kind}: leave it out", original, index
        )


def _refuse_superscript(original: str, index: int) -> None:
    """Refuse digits that are no decimal digits: "3²" is not 32."""
    if original[index].isdigit() and not original[index].isdecimal():
        problem = f"{character_name(original[index])} is no plain digit: write numbers with 0 to 9"
        raise CommandError(problem, original, index)


def _refuse_foreign(original: str, index: int, character: str, language: Language) -> None:
    if not character.isascii() and character not in SIGNS:
        shown = character if original[index].isascii() else original[index]
        problem = f"{character_name(shown)} is not used in {language.name.capitalize()} commands"
        letters = "".join(letter for letter in language.same_as if letter.isalpha())
        signs = " ".join(language.punctuation)
        hint = f"letters a to z{letters}, also with accents, digits and {signs} are"
        raise CommandError(problem, original, index, hint=hint)
