"""Replaces what a speaker takes back: corrections and negations."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

from semnav_env.language.speech.ellipsis import in_full
from semnav_env.language.speech.items import JOINTS, Item, ItemKind, Noun
from semnav_env.language.speech.moves import is_door
from semnav_env.language.speech.negations import (
    SOFT,
    corrects,
    cut_before,
    end_of_clause,
    merged_items,
    without_negated,
)
from semnav_env.language.speech.order import in_order
from semnav_env.language.speech.statements import merged_names, without_labels


def rewritten(items: Sequence[Item]) -> list[Item]:
    """The items without those that others replace."""
    found = _repaired(_without_first_no(_without_bare_go(in_full(in_order(items)))))
    found = _corrected(merged_names(without_labels(found)))
    found = without_negated(_without_breaks(found))
    return _with_antecedents(_without_too_far(found))


def _without_too_far(items: list[Item]) -> list[Item]:
    """Drop "if you come to the corner, you have gone too far"."""
    for at, item in enumerate(items):
        if item.kind is ItemKind.TOO_FAR:
            start = at
            while start > 0 and items[start - 1].kind in (*SOFT, ItemKind.REF, ItemKind.IF):
                start -= 1
                if items[start].kind in (ItemKind.REF, ItemKind.IF):
                    break
            return _without_too_far([*items[:start], *items[at + 1 :]])
    return items


def _without_bare_go(items: list[Item]) -> list[Item]:
    """Of "Kitchen. Go.": a sentence that only says to go says nothing more."""
    ends = [-1, *(i for i, item in enumerate(items) if item.kind is ItemKind.SIGN), len(items)]
    bare = [
        start + 1
        for start, stop in pairwise(ends)
        if stop == start + 2 and items[start + 1].value == "go" and len(items) > 3
    ]
    return [item for i, item in enumerate(items) if i not in bare]


def _without_first_no(items: list[Item]) -> list[Item]:
    """Drop "no" where nothing has been said that it could take back."""
    while items and items[0].kind in (ItemKind.NO, ItemKind.BUT, *JOINTS):
        items = items[1:]
    return items


def _without_breaks(items: list[Item]) -> list[Item]:
    """Drop "go, uh, go straight", and the comma of "a bit left, ten degrees"."""
    found: list[Item] = []
    for index, item in enumerate(items):
        following = [each.kind for each in items[index + 1 : index + 3]]
        comma = item.kind is ItemKind.SIGN and item.value in (",", ":")
        if (
            comma
            and found
            and found[-1].kind is ItemKind.SIDE
            and following[:1] == [ItemKind.DEGREES]
        ):
            continue
        if (
            comma
            and index > 1
            and found
            and found[-1].kind is ItemKind.VERB
            and found[-1].value == "go"
            and following[:1] in ([ItemKind.VERB], [ItemKind.SIGN])
            and (len(found) == 1 or found[-2].kind in SOFT)
        ):
            continue
        behind = items[index + 1] if index + 1 < len(items) else None
        if (
            comma
            and behind is not None
            and behind.kind is ItemKind.REF
            and found
            and found[-1].kind not in SOFT
        ):
            goes = found[-1].kind in (ItemKind.VERB, ItemKind.STRAIGHT)
            negated = len(found) > 1 and found[-2].kind is ItemKind.NOT
            joined = "until" in behind.roles and goes and not negated
            if joined or (behind.value.kind == "start" and not behind.roles):
                continue
        broken = (
            item.kind is ItemKind.VERB
            and item.value == "go"
            and following
            and items[index + 1].kind is ItemKind.SIGN
        )
        again = next((each for each in items[index + 1 :] if each.kind is not ItemKind.SIGN), None)
        if (
            broken
            and again is not None
            and again.kind is ItemKind.VERB
            and again.value == "go"
            and (not found or found[-1].kind in SOFT)
        ):
            continue
        found.append(item)
    return found


def _repaired(items: list[Item]) -> list[Item]:
    """Of "At the first, er, second intersection": a noun that breaks off, and is said again."""
    at = 0
    while at + 1 < len(items):
        item, stop = items[at], at + 1
        while stop < len(items) and items[stop].kind is ItemKind.SIGN and items[stop].value == ",":
            stop += 1
        again = items[stop] if stop < len(items) else item
        broken = item.kind is ItemKind.REF and item.value.elliptic and item.roles
        if (
            broken
            and again is not item
            and again.kind is ItemKind.REF
            and not again.roles
            and not again.value.elliptic
        ):
            items = [*items[:at], replace(again, roles=item.roles), *items[stop + 1 :]]
        at += 1
    return items


def _corrected(items: list[Item]) -> list[Item]:
    """Put what stands behind "no" in the place of what it corrects, if that is a noun or a side."""
    at = 0
    while at < len(items):
        if items[at].kind is ItemKind.NO:
            before = cut_before(items, at)
            if before and items[before - 1].kind is ItemKind.REF:
                noun = items[before - 1].value
                if noun.kind == "area" and at + 1 < len(items):  # no destination by itself
                    items = [*items[: before - 1], *items[at + 1 :]]
                    at = before - 1
                    continue
            start = _next(items, at + 1)
            stop = end_of_clause(items, start)
            part = items[start:stop]
            if part and part[0].kind in (ItemKind.REF, ItemKind.SIDE, ItemKind.DISTANCE):
                stop = start + 1 if len(part) > 1 else stop
                target = _target(items[:at], part[0], beside=len(part) > 1)
                if target is not None:
                    merged = merged_items(items[target], part[0])
                    items = [
                        *items[:target],
                        merged,
                        *items[target + 1 : cut_before(items, at)],
                        *items[stop:],
                    ]
                    at = target
        at += 1
    return items


def _next(items: Sequence[Item], at: int) -> int:
    while at < len(items) and items[at].kind in (*SOFT, ItemKind.NO):
        at += 1
    return at


def _target(before: Sequence[Item], by: Item, beside: bool) -> int | None:
    """Which of the items before a correction it corrects; beside it, if a clause goes on."""
    end = cut_before(before, len(before))
    for index in range(end - 1, end - 2 if beside else -1, -1):
        if corrects(before[index], by):
            return index
    return None


def _is_needless(item: Item, before: Sequence[Item]) -> bool:
    """Whether an item is the end of "the second door after it", which is counted from there."""
    if item.kind is not ItemKind.REF or item.value.kind != "it" or "after" not in item.roles:
        return False
    last = before[-1] if before else None
    named = last is not None and last.kind is ItemKind.REF and is_door(last.value)
    return named and "past" not in before[-1].roles


def _with_antecedents(items: list[Item]) -> list[Item]:
    """Of "To it" and "past it" with the door or place that was named before."""
    last: Noun | None = None
    verb = ""
    found: list[Item] = []
    for at, item in enumerate(items):
        verb = item.value if item.kind is ItemKind.VERB else verb
        if item.kind is ItemKind.REF and item.value.relative:
            item, found = _behind_landmark(item, found)
        if _is_needless(item, found):
            if last is not None and last.kind == "named" and not _was_passed(found, last):
                found.append(replace(item, value=last))  # "to the library, the door after it"
            continue
        if item.kind is ItemKind.REF:
            noun = item.value
            if last is not None and (_is_it(item) or _is_door_again(item, last, verb)):
                if found and _is_passed(found, last) and set(item.roles) & {"past"}:
                    continue  # "past the corner, go round it"
                at_door = noun.kind == "it" and noun.at_end
                item = replace(item, value=replace(last, at_end=last.at_end or at_door))
            elif last is not None and last.kind == "named" and _says_behind(items, at):
                pass
            elif is_door(noun) or noun.kind == "named" or noun.kind in ("intersection", "corner"):
                last = noun
        found.append(item)
    return found


def _was_passed(found: Sequence[Item], noun: Noun) -> bool:
    """Whether some item says to pass a room, which need not be said again."""
    return any(
        item.kind is ItemKind.REF
        and item.value.name == noun.name
        and bool(set(item.roles) & {"past", "after"} or _goes_by(found))
        for item in found
    )


def _goes_by(found: Sequence[Item]) -> bool:
    return any(item.kind is ItemKind.VERB and item.value == "pass" for item in found)


def _says_behind(items: Sequence[Item], at: int) -> bool:
    """Whether "after it" follows a door: what was named before is meant."""
    item = items[at]
    if at + 1 >= len(items) or not is_door(item.value):
        return False
    behind = items[at + 1]
    named = behind.kind is ItemKind.REF and behind.value.kind == "it"
    return named and "after" in behind.roles and item.value.ordinal in (None, 1)


def _is_passed(found: Sequence[Item], noun: Noun) -> bool:
    """Whether the last noun of the items is one, and is passed."""
    said = [item for item in found if item.kind is ItemKind.REF]
    return bool(said) and said[-1].value == noun and "past" in said[-1].roles


def _is_it(item: Item) -> bool:
    """Whether an item is "to it" or "past it"."""
    roles = set(item.roles)
    beside = roles & {"past", "after", "to", "until", "before", "near"}
    return item.value.kind == "it" and bool(beside) and "into" not in roles


def _is_door_again(item: Item, last: Noun, verb: str) -> bool:
    """Of "To the second door, and stop in front of the door": the one that was named."""
    noun: Noun = item.value
    bare = noun.kind == "door" and noun == Noun("door", definite=noun.definite)
    stops = verb.split()[:1] in (["stop"], ["wait"])
    return bare and stops and "front" in item.roles and last.kind == "door" and not last.counted


def _behind_landmark(item: Item, before: list[Item]) -> tuple[Item, list[Item]]:
    """Of "The one after that", of a room or a place: the first one behind it."""
    places = [index for index, each in enumerate(before) if each.kind is ItemKind.REF]
    if not places or is_door(before[places[-1]].value):
        return item, before
    at = places[-1]
    same = item.value.kind == before[at].value.kind
    if same and any(each.kind is ItemKind.SIDE for each in before[at + 1 :]):
        noun = replace(item.value, ordinal=1, relative=False)
        return replace(item, value=noun), before  # "next crossing left, the one after that right"
    passed = replace(before[at], roles=("past",))
    seen = [
        each
        for each in before[:at]
        if each.kind is not ItemKind.VERB or each.value not in ("reach", "be")
    ]
    noun = replace(item.value, ordinal=1, relative=False, kind="door")
    return replace(item, value=noun), [*seen, passed, *before[at + 1 :]]
