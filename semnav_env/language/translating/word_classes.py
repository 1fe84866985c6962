"""What the lexicon knows of each word of a text, which a network sees beside its spelling."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from semnav_env.language.vocabulary.lexicon import Lexicon, parts_of

UNKNOWN = "unknown"
"""The class of a word that is in no phrase."""

NUMERIC = ("number", "ordinal")
"""Classes that are given without their value, which is masked."""


def classes_of(words: Sequence[str], lexicon: Lexicon) -> list[tuple[str, ...]]:
    """The classes of the phrases of which each word is a part.

    A phrase of several words gives another class to its first word ("noun end, begun") than to
    those behind it ("noun end, inside"). A word that is in no phrase has the classes of the words
    of which it is made.
    """
    found: list[dict[str, None]] = [{} for _ in words]
    for at in range(len(words)):
        for name, stop in _phrases(words, at, lexicon):
            places = ("",) if stop == at + 1 else (", begun", *[", inside"] * (stop - at - 1))
            for k, place in enumerate(places, at):
                found[k][name + place] = None
    return [
        tuple(known or dict.fromkeys(_of_parts(word, lexicon))) or (UNKNOWN,)
        for word, known in zip(words, found, strict=True)
    ]


def _of_parts(word: str, lexicon: Lexicon) -> Iterator[str]:
    parts = parts_of(word, lexicon)
    if parts != (word,):
        yield from (name for part in parts for name, _ in _phrases((part,), 0, lexicon))


def _phrases(words: Sequence[str], at: int, lexicon: Lexicon) -> Iterator[tuple[str, int]]:
    """The class of each phrase that begins at a word, and its end."""
    for kind, value, stop in lexicon.matches(words, at):
        yield (f"{kind} {value}" if value and kind not in NUMERIC else kind), stop
