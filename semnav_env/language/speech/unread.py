"""Leaves out words that are not understood where they can say nothing of the way.

What is left is doubtful, so it is asked about. A text keeps words, and is refused, if they may name
something: a noun with its article or preposition, a verb with an object, or anything that the
robot is known not to do ("beyond").
"""

from __future__ import annotations

from collections.abc import Sequence

from semnav_env.language.speech.items import JOINTS, Item, ItemKind
from semnav_env.language.speech.lexicon import SpeechLexicon
from semnav_env.language.speech.negations import SOFT

MAX_UNREAD = 2
"""The most stretches of unknown words that are left out; with more a text is rather no command."""

_PARTS = (*JOINTS, ItemKind.BUT)
_SAYING = (
    *(ItemKind.REF, ItemKind.SIDE, ItemKind.STRAIGHT, ItemKind.IN, ItemKind.OUT, ItemKind.IF),
    *(ItemKind.DISTANCE, ItemKind.DEGREES, ItemKind.SECONDS, ItemKind.AROUND, ItemKind.BACK),
)
_NAMING = ("det", "a", "prep", "adj", "ordinal", "number", "numeral word")
_DIRECTED = frozenset({"to", "into", "through", "past", "until", "along", "all along", "toward"})


def without_unread(
    items: Sequence[Item], words: Sequence[str], lexicon: SpeechLexicon
) -> list[Item] | None:
    """The items without unknown words that can be left out; None if one cannot.

    Args:
        items: of a text, as they were read.
        words: of the text.
        lexicon: of its language.
    """
    found, left_out = list(items), 0
    while (at := _first_unread(found)) is not None:
        stop = at
        while stop < len(found) and found[stop].kind is ItemKind.UNKNOWN:
            stop += 1
        left_out += 1
        instead = _instead(found, at, stop, words, lexicon)
        if instead is None or left_out > MAX_UNREAD:
            return None
        found = instead
    return found


def _first_unread(items: Sequence[Item]) -> int | None:
    return next((i for i, item in enumerate(items) if item.kind is ItemKind.UNKNOWN), None)


def _instead(
    items: list[Item], at: int, stop: int, words: Sequence[str], lexicon: SpeechLexicon
) -> list[Item] | None:
    """The items without those from `at` to `stop`, or with a verb for them; None to keep them."""
    if (corrected := _corrected(items, at, stop)) is not None:
        return corrected
    if (told := _framed(items, at, words, lexicon)) is not None:
        return told
    if (aside := _aside(items, at, stop, words, lexicon)) is not None:
        return aside
    if (told := _without_remark(items, at, words, lexicon)) is not None:
        return told
    unread = words[items[at].start : items[stop - 1].stop]
    if _is_vocative(items, at, stop, unread, lexicon):
        return [*items[:at], *items[stop:]]
    if len(unread) != 1 or not unread[0].isalpha() or unread[0] in lexicon.of_class("beyond"):
        return None
    if any(lexicon.find(words, items[at].start, kind) for kind in (*_NAMING, "if", "not", "or")):
        return None
    return _without_one(items, at, words, lexicon)


def _is_vocative(
    items: Sequence[Item], at: int, stop: int, unread: Sequence[str], lexicon: SpeechLexicon
) -> bool:
    """Whether a few unknown words stand by themselves: "..., both sides included"."""
    begins = at == 0 or items[at - 1].kind in _PARTS
    ends = stop == len(items) or items[stop].kind in _PARTS
    small = [word for word in unread if any(lexicon.find((word,), 0, kind) for kind in _NAMING)]
    known = set(unread) & lexicon.of_class("beyond")
    return begins and ends and 1 < len(unread) <= MAX_ASIDE and not small and not known


MAX_ASIDE = 4
"""The most unknown words that stand by themselves and are left out."""


def _without_remark(
    items: list[Item], at: int, words: Sequence[str], lexicon: SpeechLexicon
) -> list[Item] | None:
    """Without a clause that only tells something: "the patient is waiting, ..."."""
    start, stop = at, at
    while start and items[start - 1].kind not in _PARTS:
        start -= 1
    while stop < len(items) and items[stop].kind not in _PARTS:
        stop += 1
    clause, last = items[start:stop], items[stop - 1].stop
    first = items[start - 1].stop if start else 0
    said = words[first:last]
    if any(item.kind in _SAYING and not _is_small_noun(item) for item in clause):
        return None
    if lexicon.of_class("beyond").intersection(said) - lexicon.words:
        return None
    begins = any(lexicon.find(said, 0, kind) for kind in ("verb", "prep"))
    told = any(lexicon.find(said[i : i + 1], 0, "finite") for i in range(1, len(said)))
    rest = [*items[:start], *items[stop:]]
    return rest if told and not begins and any(i.kind in _SAYING for i in rest) else None


def _is_small_noun(item: Item) -> bool:
    return item.kind is ItemKind.REF and item.value.kind in ("it", "one", "hall", "area")


def _without_one(
    items: list[Item], at: int, words: Sequence[str], lexicon: SpeechLexicon
) -> list[Item] | None:
    """The items without one unknown word, by what stands around it."""
    start = items[at].start
    before = items[at - 1] if at else None
    behind = items[at + 1] if at + 1 < len(items) else None
    begins = before is None or before.kind in _PARTS
    ends = behind is None or behind.kind in _PARTS
    rest = [*items[:at], *items[at + 1 :]]
    if _is_named(words, start, lexicon):
        return rest  # "hello Petra"
    if start and any(lexicon.find(words, start - 1, kind) for kind in _NAMING):
        return None  # "the elevator"
    if begins and ends:
        return rest  # "easy, ..."
    if behind is not None and (begins or before is None) and _leads(behind):
        verb = Item(ItemKind.VERB, start, start + 1, "go")
        return [*items[:at], verb, *items[at + 1 :]]  # "trundle to the corner"
    moves = before is not None and before.kind in (ItemKind.VERB, ItemKind.COULD_YOU)
    if moves and behind is not None and (_leads(behind) or behind.kind is ItemKind.SIDE):
        return rest  # "keep truckin' to the corner"
    said = before is not None and before.kind in (ItemKind.SIDE, ItemKind.REF, ItemKind.STRAIGHT)
    return rest if said and ends and behind is not None else None  # "turn left dude."


def _is_named(words: Sequence[str], at: int, lexicon: SpeechLexicon) -> bool:
    """Whether a word stands behind a greeting."""
    starts = range(max(0, at - 4), at)
    return any(
        kind == "greeting" and stop == at
        for start in starts
        for kind, _, stop in lexicon.matches(words, start)
    )


def _leads(item: Item) -> bool:
    """Whether an item says a way: "to the corner", "straight ahead", "out"."""
    if item.kind in (ItemKind.STRAIGHT, ItemKind.OUT, ItemKind.TO_END, ItemKind.DISTANCE):
        return True
    return item.kind is ItemKind.REF and bool(set(item.roles) & _DIRECTED)


def _corrected(items: list[Item], at: int, stop: int) -> list[Item] | None:
    """Of "To the archive, no, to the kitchen": what is taken back need not be known."""
    after = stop
    while after < len(items) and items[after].kind is ItemKind.SIGN:
        after += 1
    if after + 1 >= len(items) or items[after].kind is not ItemKind.NO:
        return None
    start = at
    while start and items[start - 1].kind not in _PARTS:
        start -= 1
    return [*items[:start], *items[after + 1 :]]


def _framed(
    items: list[Item], at: int, words: Sequence[str], lexicon: SpeechLexicon
) -> list[Item] | None:
    """Without what stands before a command: "it would be kind if you ...", "my desk is in ..."."""
    start = at
    while start and items[start - 1].kind is not ItemKind.SIGN:
        start -= 1
    first = items[start].start
    unread = [item for item in items[start:] if item.kind is ItemKind.UNKNOWN]
    if any(str(item.value) in lexicon.of_class("beyond") for item in unread):
        return None
    said = [item for item in items[start:at] if item.kind not in SOFT and item.value != "be"]
    for stop in range(at + 1, len(items)):
        if said or items[stop - 1].kind in _SAYING:
            return None
        before = items[at:stop]
        only = start == at and all(item.kind is ItemKind.UNKNOWN for item in before)
        if only and items[stop].value == "be" and items[stop].kind is ItemKind.VERB:
            return [*items[:start], *items[stop:]]  # "my desk is in the second room"
        spoken = range(items[stop - 1].start, items[stop].start + 1)
        ends = [found[1] for i in spoken if (found := lexicon.find(words, i, "handover"))]
        behind = [item for item in items[stop:] if ends and item.start >= ends[0]]
        if behind and ends[0] > first:
            return [*items[:start], *behind]
    return None


def _aside(
    items: list[Item], at: int, stop: int, words: Sequence[str], lexicon: SpeechLexicon
) -> list[Item] | None:
    """Without a remark about somebody: "I'm tired", "so that we can see you"."""
    start = at
    while start and items[start - 1].kind not in _PARTS:
        start -= 1
    first = items[start - 1].stop if start else 0
    opens = next((i for i in range(first, at_word(items, at)) if _opens(words, i, lexicon)), None)
    if opens is None:
        return None
    begin = next((i for i in range(start, at) if items[i].start >= opens), at)
    end = stop
    for index in range(stop, len(items)):
        if items[index].kind in _PARTS:
            break
        end = index + 1 if items[index].kind is ItemKind.UNKNOWN else end
    dropped = items[begin:end]
    if any(item.kind in _SAYING for item in dropped):
        return None
    return [*items[:begin], *items[end:]]


def at_word(items: Sequence[Item], at: int) -> int:
    """The number behind the first word of an item."""
    return items[at].start + 1


def _opens(words: Sequence[str], at: int, lexicon: SpeechLexicon) -> bool:
    return lexicon.find(words, at, "aside") is not None
