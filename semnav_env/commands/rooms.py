"""Names of rooms in their three forms: written in a plan, plain in a command, spoken by people."""

from __future__ import annotations

import re
import unicodedata
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence

from semnav_env.commands.words import pieces

MAX_NAME = 40
"""The longest plain name, characters."""

_GERMAN_LETTERS = {"ä": "ae", "ö": "oe", "ü": "ue", "ß": "ss"}
_NUMBERED = re.compile(r"(?:room|[a-z]*)[ _-]?(\d+)[ ._-](\d+[a-z]?)")


def plain_name(name: str) -> str:
    """The plain name of a room: "Küche 2" becomes "kueche 2". "" if it has no letter or digit.

    It has small letters a to z and digits, parted by single spaces, dots, hyphens or underscores.
    """
    folded = "".join(
        _GERMAN_LETTERS.get(c, c) for c in unicodedata.normalize("NFKC", name).casefold()
    )
    kept = re.sub(r"[^a-z0-9._-]+", " ", folded)
    single = re.sub(r"([ ._-])[ ._-]*", r"\1", kept)
    return single[:MAX_NAME].strip(" ._-")


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


def name_phrases(names: Sequence[str]) -> dict[tuple[str, ...], str]:
    """The plain name of each room by the words that people say for it."""
    found: dict[tuple[str, ...], str] = {}
    for name in names:
        folded = "".join(_GERMAN_LETTERS.get(c, c) for c in name.casefold()).replace("\u2019", "'")
        found[tuple(p.text for p in pieces(folded) if p.text != "'")] = plain_name(name)
    for said, name in spoken_names(names).items():
        words = tuple(piece.text for piece in pieces(said))
        found[words] = name
        if len(words) == 2 and words[0] in _ROOM_WORDS and words[1][0].isdigit():
            found.setdefault(words[1:], name)
    for words, name in tuple(found.items()):
        for other in _in_other_words(words):
            found.setdefault(other, name)
    return found


def kinds_of_rooms(names: Iterable[tuple[str, ...]]) -> frozenset[str]:
    """The words for kinds of rooms, such as "office" or "labor", that are in these names."""
    said = {word for words in names for word in words}
    return frozenset(word for kind in _KINDS for word in kind if said.intersection(kind))


def _in_other_words(words: tuple[str, ...]) -> Iterator[tuple[str, ...]]:
    """A name with one of its words in other words or in the other language: "labor" for "lab"."""
    for at, word in enumerate(words):
        for kind in _KINDS:
            if word in kind:
                yield from ((*words[:at], other, *words[at + 1 :]) for other in kind)


_KINDS = (
    ("office", "buero"),
    ("lab", "laboratory", "labor"),
    ("kitchen", "kueche"),
    ("bathroom", "bad", "badezimmer"),
    ("bedroom", "schlafzimmer"),
    ("library", "bibliothek"),
    ("workshop", "werkstatt"),
    ("toilet", "toilette", "wc"),
)
"""Words for one kind of room, in both languages."""


_ROOM_WORDS = frozenset({"room", "zimmer", "raum", "office", "buero", "saal"})
"""Words that people leave out before a room's number."""


def _in_words(name: str) -> str:
    return " ".join(piece.text for piece in pieces(name))


def _said(name: str) -> str:
    return _in_words(re.sub("[_-]", " ", name)).removeprefix("room ")


def _in_short(name: str) -> set[str]:
    numbered = _NUMBERED.fullmatch(name)
    if numbered is None:
        return set()
    floor, number = numbered.groups()
    return {_said(said) for said in (f"{floor}.{number}", f"{floor} {number}", number)}
