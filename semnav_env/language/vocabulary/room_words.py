"""The words that people say for rooms: their names, and kinds of rooms in both languages."""

from __future__ import annotations

import json
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache
from importlib.resources import files
from itertools import chain
from types import MappingProxyType

from semnav_env.language.rooms import GERMAN_LETTERS, plain_name, spoken_names, without_accents
from semnav_env.language.words import pieces

MOST_ASKED = 4
"""The most rooms of one kind for which the robot asks which is meant: two in a question."""


def name_phrases(names: Sequence[str]) -> Mapping[tuple[str, ...], str]:
    """The plain name of each room by the words that people say for it."""
    return _name_phrases(tuple(names))


@lru_cache(maxsize=64)
def _name_phrases(names: tuple[str, ...]) -> Mapping[tuple[str, ...], str]:
    found: dict[tuple[str, ...], str] = {}
    for name in names:
        folded = "".join(GERMAN_LETTERS.get(c, c) for c in name.casefold()).replace("\u2019", "'")
        folded = without_accents(folded)
        found[tuple(p.text for p in pieces(folded) if p.text != "'")] = plain_name(name)
    for said, name in spoken_names(names).items():
        words = tuple(piece.text for piece in pieces(said))
        found[words] = name
        if len(words) == 2 and words[0] in ROOM_WORDS and words[1][0].isdigit():
            found.setdefault(words[1:], name)
    for words, name in tuple(found.items()):
        for other in _in_other_words(words):
            found.setdefault(other, name)
    return MappingProxyType(found)


def _in_other_words(words: tuple[str, ...]) -> Iterator[tuple[str, ...]]:
    """A name with its kind in other words or in the other language: "labor" for "lab".

    Of whose bedroom it is one also says that it is that person's room.
    """
    if len(words) > 1 and words[-1] == "bedroom":
        yield *words[:-1], "room"
    for at in range(len(words)):
        for kind in _KINDS:
            for said in filter(lambda said: words[at : at + len(said)] == said, kind):
                yield from ((*words[:at], *other, *words[at + len(said) :]) for other in kind)


@lru_cache(maxsize=64)
def shared_kinds(names: tuple[str, ...]) -> Mapping[tuple[str, ...], tuple[str, ...]]:
    """The plain names of the rooms of each kind of which there are several, by words for it.

    Of "parents' bedroom" and "daughter's bedroom" these are "bedroom" and "schlafzimmer".
    """
    known, found = name_phrases(names), defaultdict[tuple[str, ...], dict[str, None]](dict)
    for kind in chain.from_iterable(_KINDS):
        for words, name in known.items():
            if any(words[at : at + len(kind)] == kind for at in range(len(words))):
                found[kind][name] = None
    several = {k: tuple(rooms) for k, rooms in found.items() if 1 < len(rooms) <= MOST_ASKED}
    return MappingProxyType({kind: several[kind] for kind in several.keys() - known.keys()})


_TABLE = json.loads(
    (files("semnav_env.language.vocabulary") / "people_and_rooms.json").read_text("utf-8")
)
_KINDS = [[tuple(name.split()) for name in row.split("|")] for row in _TABLE["rooms"]]
"""Names for one kind of room, in both languages."""

SUPPORTING = {kind: frozenset(_TABLE[kind].split("|")) for kind in ("person", "house", "voice")}
"""Words of both languages for people, for the whole house, and for calling and asking."""

SUPPORTING_WORDS = frozenset[str]().union(*SUPPORTING.values())
"""All of them."""

ROOM_WORDS = frozenset({"room", "zimmer", "raum", "office", "buero", "saal"})
"""Words that people leave out before a room's number."""
