"""Keeps what is done from resting on words that nobody knows: "the libary" is no person."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from rapidfuzz.distance import OSA

from semnav_env.language.clauses import GoBack
from semnav_env.language.finding_clauses import AskName, GoToPerson, SearchHouse
from semnav_env.language.languages import languages
from semnav_env.language.translating.spoken_values import MIN_MISSPELT
from semnav_env.language.translating.translator import TranslatedText
from semnav_env.language.translating.word_classes import UNKNOWN
from semnav_env.language.vocabulary.lexicon import lexicon_of
from semnav_env.language.vocabulary.room_words import SUPPORTING_WORDS, name_phrases
from semnav_env.language.vocabulary.typos import nearest_word

MOST_SLIPS = 3 / 7
"""Slips for each letter of a room's name up to which the robot asks whether it is meant."""

GOING = frozenset({"prep to", "prep into"})
"""Classes of the words before a place to go to."""

NAMING = GOING | {"prep in", "in", "prep at", "prep on", "det"}
"""Classes of the words before any place."""


def rests_on_known_words(found: TranslatedText, rooms: Sequence[str]) -> bool:
    """Whether a text has known words for whom and where its likeliest command searches or returns.

    An unknown word may name a place that the command passes over, or takes for something else.

    Args:
        found: the text, with a command at least.
        rooms: names of the rooms of the floor plan; none if they are not known.
    """
    kinds = set(map(type, found.translations[0].command.clauses))
    said = found.support.classes
    unknown = list(_unknown_places(found))
    return not (
        (kinds & {GoToPerson, AskName} and "person" not in said)
        or (kinds & {GoToPerson, GoBack} and any(before & GOING for _, before in unknown))
        or (SearchHouse in kinds and "house" not in said and unknown)
        or any(_is_near(word, rooms) for word, _ in unknown)
    )


def _unknown_places(found: TranslatedText) -> Iterator[tuple[str, set[str]]]:
    """The unknown words where places are named, with the classes of the words before them."""
    classes = [{name.partition(",")[0] for name in names} for names in found.plain.classes]
    for at, word in enumerate(found.plain.words):
        if at and classes[at] == {UNKNOWN} and word.isalpha() and word not in SUPPORTING_WORDS:
            is_article = at > 1 and not classes[at - 1].isdisjoint(("det", "a"))
            before = classes[at - 1] | (classes[at - 2] if is_article else set())
            if before & NAMING:
                yield word, before


def _is_near(word: str, rooms: Sequence[str]) -> bool:
    """Whether a word is a slip or two from the name of a room, or from a known word for one."""
    areas = (lexicon_of(each).of_class("noun area") for each in languages().values())
    near = nearest_word(word, _names(rooms).union(*areas)) if len(word) >= MIN_MISSPELT else None
    return near is not None and near[0] == word[0]


def near_room(word: str, rooms: Sequence[str]) -> str | None:
    """The word of a room's name that a word was perhaps meant to be; None if it is one, or none."""
    names = _names(rooms)
    slips = {each: OSA.distance(word, each) for each in sorted(names) if each[0] == word[0]}
    near = (each for each in slips if slips[each] <= MOST_SLIPS * len(each))
    if word in names or len(word) < MIN_MISSPELT:
        return None
    return min(near, key=slips.__getitem__, default=None)


def _names(rooms: Sequence[str]) -> frozenset[str]:
    """The words of the names of rooms."""
    return frozenset(word for name in name_phrases(rooms) for word in name)
