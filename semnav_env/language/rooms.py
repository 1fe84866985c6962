"""Names of rooms in their three forms: written in a plan, plain in a command, spoken by people."""

from __future__ import annotations

import re
import unicodedata
from collections import Counter
from collections.abc import Sequence

from semnav_env.language.references import MAX_NAME

GERMAN_LETTERS = {"ä": "ae", "ö": "oe", "ü": "ue", "ß": "ss"}
"""The letters of German that a plain name has not, as it spells them."""

_LETTERS_WITHOUT_PARTS = {"ł": "l", "ø": "o", "đ": "d", "ð": "d", "þ": "th", "æ": "ae", "œ": "oe"}
"""Latin letters that Unicode does not take apart."""

_APOSTROPHE = re.compile("(?<=[^\\W\\d_])['\u2019](?=[^\\W\\d_])")
"""An apostrophe within a word."""

_NUMBERED = re.compile(r"(?:room|[a-z]*)[ _-]?(\d+)[ ._-](\d+[a-z]?)")


def plain_name(name: str) -> str:
    """The plain name of a room: "Küche 2" becomes "kueche 2", and "Anna's café" "annas cafe".

    A name without a Latin letter or a digit becomes "". A plain name has small letters a to z and
    digits, parted by single spaces, dots, hyphens or underscores.
    """
    folded = "".join(
        GERMAN_LETTERS.get(c, c) for c in unicodedata.normalize("NFKC", name).casefold()
    )
    joined = _APOSTROPHE.sub("", without_accents(folded))
    kept = re.sub(r"[^a-z0-9._-]+", " ", joined)
    single = re.sub(r"([ ._-])[ ._-]*", r"\1", kept)
    return single[:MAX_NAME].strip(" ._-")


def without_accents(text: str) -> str:
    """Small Latin letters without their accents: "café" becomes "cafe". Others stay as they are."""
    return "".join(map(_without_accent, text))


def _without_accent(character: str) -> str:
    base = unicodedata.normalize("NFD", character)[0]
    base = base if base.isascii() and base.isalpha() else character
    return _LETTERS_WITHOUT_PARTS.get(character, base)


def spoken_names(names: Sequence[str]) -> dict[str, str]:
    """The plain name of each room by the words that people say for it, parted by single spaces.

    "room_west_1" is spoken as "west 1". "l3_508" is also spoken as "3.508" and, if only one room
    ends so, as "508".
    """
    plain = [name for name in map(plain_name, names) if name]
    short = [(said, name) for name in plain for said in _in_short(name)]
    often = Counter(said for said, _ in short)
    once = {said: name for said, name in short if often[said] == 1}
    as_written = {name: name for name in plain} | {_in_words(name): name for name in plain}
    return once | {_said(name): name for name in plain} | as_written


def _in_words(name: str) -> str:
    from semnav_env.language.words import pieces  # plain names do without

    return " ".join(piece.text for piece in pieces(name))


def _said(name: str) -> str:
    return _in_words(re.sub("[_-]", " ", name)).removeprefix("room ")


def _in_short(name: str) -> set[str]:
    numbered = _NUMBERED.fullmatch(name)
    if numbered is None:
        return set()
    floor, number = numbered.groups()
    return {_said(said) for said in (f"{floor}.{number}", f"{floor} {number}", number)}
