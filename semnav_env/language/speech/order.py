"""Puts clauses in the order in which they are done: "before you turn left, wait"."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from semnav_env.language.speech.items import Item, ItemKind
from semnav_env.language.speech.negations import SOFT

_LATER = (ItemKind.BEFORE_DOING, ItemKind.BEFORE_THAT)
_PARTS = (*SOFT, ItemKind.BUT)


def in_order(items: Sequence[Item]) -> list[Item]:
    """The items of what is done first before those of what is done then."""
    found = list(items)
    for at, item in enumerate(found):
        if item.kind in (*_LATER, ItemKind.AFTER_DOING):
            return in_order(_reordered(found, at))
    return found


def _reordered(items: list[Item], at: int) -> list[Item]:
    """The items with those around one that says "before" or "after" in their order."""
    opens, kind = items[at], items[at].kind
    start, stop = _sentence(items, at)
    said, rest = _stripped(items[start:at]), items[at + 1 : stop]
    then = Item(ItemKind.THEN, opens.start, opens.stop)
    end = next((i for i, item in enumerate(rest) if item.kind in _PARTS), len(rest))
    if kind is ItemKind.BEFORE_THAT:
        first, second, more = rest, said, []
    elif said:
        begin = max((i + 1 for i, item in enumerate(said) if item.kind in _PARTS), default=0)
        start += begin
        first, second, more = said[begin:], rest[:end], rest[end:]
    else:
        verbs = [i for i, item in enumerate(rest) if item.kind is ItemKind.VERB]
        if end == len(rest) and len(verbs) > 1:
            end = verbs[1]  # "before you turn left wait"
        first, second, more = rest[end:], rest[:end], []
    if kind is not ItemKind.AFTER_DOING:
        first = [*_place_of(first, second), *first]
    if kind is ItemKind.AFTER_DOING:
        first, second = second, first
    while second and second[0].kind in _PARTS:
        second = second[1:]
    joined = [*_stripped(first), then, *second] if first and second else [*first, *second]
    return [*items[:start], *joined, *more, *items[stop:]]


def _place_of(first: Sequence[Item], second: Sequence[Item]) -> list[Item]:
    """Of "Before you turn at the corner, wait there": where that is."""
    waits = any(item.value in ("stop", "wait") for item in first)
    if not waits or any(item.kind is ItemKind.REF for item in first):
        return []
    places = [item for item in second if item.kind is ItemKind.REF and "at" in item.roles]
    then = [Item(ItemKind.THEN, item.start, item.stop) for item in places]
    return [replace(places[0], roles=("until",)), then[0]] if places else []


def _sentence(items: Sequence[Item], at: int) -> tuple[int, int]:
    """The first item of the sentence around an item, and the sign behind it."""
    ends = [i for i, item in enumerate(items) if _ends(item)]
    start = max((i + 1 for i in ends if i < at), default=0)
    return start, min((i for i in ends if i > at), default=len(items))


def _ends(item: Item) -> bool:
    return item.kind is ItemKind.SIGN and item.value != ","


def _stripped(items: list[Item]) -> list[Item]:
    """The items without joints around them."""
    start, stop = 0, len(items)
    while start < stop and items[start].kind in _PARTS:
        start += 1
    while stop > start and items[stop - 1].kind in _PARTS:
        stop -= 1
    return items[start:stop]
