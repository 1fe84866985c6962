"""Negations, and what a correction puts in the place of what: "not the first but the second"."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from semnav_env.language.speech.items import Item, ItemKind, Noun
from semnav_env.language.speech.moves import is_door

SOFT = (ItemKind.SIGN, ItemKind.AND, ItemKind.THEN)


CLAUSE_KINDS = (
    *(ItemKind.VERB, ItemKind.REF, ItemKind.SIDE, ItemKind.STRAIGHT, ItemKind.AROUND),
    *(ItemKind.BACK, ItemKind.IN, ItemKind.OUT, ItemKind.TO_END, ItemKind.DISTANCE),
)


def end_of_clause(items: Sequence[Item], at: int) -> int:
    """The end of the clause at an item."""
    while at < len(items) and items[at].kind in CLAUSE_KINDS:
        at += 1
    return at


def corrects(item: Item, by: Item) -> bool:
    """Whether an item can take the place of another one."""
    if by.kind is ItemKind.DISTANCE:
        amounts = (ItemKind.DISTANCE, ItemKind.SECONDS, ItemKind.DEGREES)
        return item.kind in amounts if isinstance(by.value, float) else item.kind is by.kind
    if by.kind is ItemKind.SIDE:
        return item.kind is ItemKind.SIDE or (
            item.kind is ItemKind.REF and item.value.side is not None
        )
    if item.kind is ItemKind.SIDE:
        sided = by.kind is ItemKind.REF and by.value.side is not None
        return sided and by.value.ordinal is None
    if item.kind is not ItemKind.REF or by.kind is not ItemKind.REF:
        return False
    return (
        item.value.kind == by.value.kind
        or (not is_door(item.value) and not is_door(by.value))
        or "one" in (by.value.kind, item.value.kind)
    )


def merged_items(item: Item, by: Item) -> Item:
    """An item as it is corrected."""
    if isinstance(by.value, float):
        of_distance = item.kind is ItemKind.DISTANCE
        return replace(
            item, value=replace(item.value, amount=by.value) if of_distance else by.value
        )
    if item.kind is ItemKind.SIDE or by.kind is ItemKind.DISTANCE:
        side = by.value if by.kind is not ItemKind.REF else by.value.side
        return replace(item, value=side)
    old: Noun = item.value
    if by.kind is ItemKind.SIDE:
        return replace(item, value=replace(old, side=by.value))
    new: Noun = by.value
    noun = replace(new, ordinal=old.ordinal if new.ordinal is None else new.ordinal)
    if new.side is None and is_door(old):
        noun = replace(noun, side=old.side)
    if old.kind == "named" or new.kind == "named" or old.kind != new.kind:
        noun = new
    return Item(item.kind, item.start, by.stop, noun, by.roles or item.roles)


def without_negated(items: list[Item]) -> list[Item]:
    """Drop "not the first door but", "don't turn left,", "instead of the left one"."""
    at = 0
    while at < len(items):
        if items[at].kind is ItemKind.INSTEAD_OF:
            stop = end_of_clause(items, at + 1)
            items = [*items[:at], *items[min(stop, at + 2) :]]
        elif items[at].kind is ItemKind.NOT:
            items = _without(items, at)
        else:
            at += 1
            continue
        if at < len(items) and items[at].kind is ItemKind.NOT:
            at += 1
    return items


def _without(items: list[Item], at: int) -> list[Item]:
    """The items without the negated clause that begins at an item."""
    if items[at + 1 : at + 2] and items[at + 1].kind is ItemKind.HERE and _goes_on(items, at + 2):
        return [*items[: cut_before(items, at)], *items[_goes_on(items, at + 2) :]]
    stop = end_of_clause(items, at + 1)
    named = [i for i in range(at + 1, stop) if items[i].kind is ItemKind.REF]
    if len(named) > 1 and not any(items[i].kind is ItemKind.VERB for i in range(at + 1, stop)):
        stop = named[0] + 1  # "not this door the next one"
    negated = items[at + 1 : stop]
    following = stop
    while following < len(items) and items[following].kind in (*SOFT, ItemKind.BUT, ItemKind.NO):
        following += 1
    rest = items[following:]
    verbs = [item for item in negated if item.kind is ItemKind.VERB]
    before = items[:at]
    if not rest:
        refs = [item for item in negated if item.kind is ItemKind.REF]
        end = at - 1 if items[at - 1].kind is ItemKind.BUT else at
        if verbs and refs and end > 0 and all(item.value.kind == "it" for item in refs):
            return items[: cut_before(items, end)]  # "to the crossing, but don't cross it"
        again = [i for i in range(at + 2, stop) if items[i].kind is ItemKind.VERB]
        if again and items[again[0]].value != "be":  # "don't turn around go straight"
            return [*items[:at], *items[again[0] :]]
    if not negated and (said := _said_before(items, at)) is not None and following < len(items):
        counted = [i for i in items[said:at] if i.kind is ItemKind.REF and i.value.counted]
        passed = [replace(i, roles=("past",)) for i in counted]
        joint = _other_clause([]) if passed else []
        return [*items[:said], *passed, *joint, *rest]  # "rechts nicht, durch die linke"
    if not rest or not negated:
        if len(negated) == len(verbs) == 1 and verbs[0].value in ("go", "turn"):
            return [*before, replace(verbs[0], value="stop")]
        if before and len(negated) == 1 and not verbs and _is_contrast(before, negated[0]):
            return [*items[: cut_before(items, at)], *rest]
        return items
    if len(negated) == 1 and before and _takes_back(before[-1], negated[0], items, stop):
        return [*before, *items[stop:]]  # "left, not right, and then ..."
    if any(item.kind in (ItemKind.IF, ItemKind.OTHERWISE) for item in rest[:1]):
        return items
    place = next((i for i in negated if i.kind is ItemKind.REF and "at" in i.roles), None)
    if place is not None and verbs and verbs[-1].value in _STOPPING:
        return [*before, replace(place, roles=("past",)), *_other_clause(rest)]
    if place is not None and not is_door(place.value) and verbs:
        return _behind_place(before, place, rest, goes_on=verbs[-1].value in _GOING_ON)
    refs = [item for item in negated if item.kind is ItemKind.REF]
    if len(verbs) == len(negated) == 1 and verbs[0].value in _STOPPING and _is_place(before):
        return [*before[:-1], replace(before[-1], roles=("past",)), *_other_clause(rest)]
    before = _without_name(before, refs)
    if refs and refs[-1].value.counted and not verbs:
        return [*before, replace(refs[-1], roles=("past",)), *items[stop:]]
    if refs and rest[0].kind is ItemKind.REF and rest[0].value.kind == "it":
        return [*before, replace(rest[0], value=refs[-1].value), *rest[1:]]
    if refs and rest[0].kind is ItemKind.REF and not verbs:
        merged = merged_items(refs[-1], rest[0]) if corrects(refs[-1], rest[0]) else rest[0]
        rest = [_next_of(refs[-1].value, merged), *rest[1:]]
    elif refs and (is_door(refs[-1].value) or refs[-1].value.kind == "named"):
        rest = [_next_of(refs[-1].value, item) for item in rest]
        rest = [_named_again(item, refs[-1].value) for item in rest]
    if before and before[-1].kind is ItemKind.VERB and rest[0].kind is ItemKind.VERB:
        before = before[:-1]
    return [*before, *rest]


def _goes_on(items: Sequence[Item], at: int) -> int:
    """The item behind "but" at an item: "not here, but at the corner"; 0 if there is none."""
    while at < len(items) and items[at].kind in SOFT:
        at += 1
    return at + 1 if at + 1 < len(items) and items[at].kind is ItemKind.BUT else 0


def _takes_back(said: Item, negated: Item, items: Sequence[Item], stop: int) -> bool:
    """Whether a side that is not meant stands behind the one that is, before another clause."""
    sides = said.kind is negated.kind is ItemKind.SIDE and said.value != negated.value
    goes_on = stop < len(items) and items[stop].kind in (ItemKind.AND, ItemKind.THEN)
    return sides and goes_on


def _without_name(before: list[Item], refs: Sequence[Item]) -> list[Item]:
    """Of "The kitchen. Not the kitchen, the library": without the room that is not meant."""
    names = [item.value.name for item in refs if item.value.kind == "named"]
    last = next((i for i in reversed(range(len(before))) if before[i].kind not in SOFT), None)
    said = None if last is None else before[last]
    if said is None or said.kind is not ItemKind.REF or said.value.name not in names:
        return before
    start = last or 0
    while start and before[start - 1].kind is ItemKind.VERB:
        start -= 1
    return before[:start]


_GOING_ON = ("continue", "go")
_STOPPING = ("stop", "wait", "stop keep")


def _is_place(before: Sequence[Item]) -> bool:
    """Whether what stands before a negation ends with a place: "am Labor nicht anhalten"."""
    return bool(before) and before[-1].kind is ItemKind.REF and "at" in before[-1].roles


def _other_clause(rest: list[Item]) -> list[Item]:
    """What is done behind a place at which one does not stop, as a clause of its own."""
    at = rest[0].start if rest else 0
    return [Item(ItemKind.THEN, at, at), *rest]


def _behind_place(
    before: list[Item], place: Item, rest: list[Item], *, goes_on: bool
) -> list[Item]:
    """Of "Don't turn at the corner": what is done there instead, or where else it is done."""
    if _names_another(place, rest):
        return [*before, *rest]
    if goes_on:  # "don't stop at the kitchen, keep going"
        return [*before, replace(place, roles=("past",)), *rest]
    return [*before, place, *rest]


def _said_before(items: Sequence[Item], at: int) -> int | None:
    """Where the clause begins that a "not" at its end negates; None if there is none."""
    start = at
    while start > 0 and items[start - 1].kind not in SOFT:
        start -= 1
    behind = items[at + 1] if at + 1 < len(items) else None
    ends = behind is not None and behind.kind in (*SOFT, ItemKind.BUT)
    named = any(item.kind is ItemKind.REF for item in items[start:at])
    return start if ends and named and start < at else None


def _names_another(place: Item, rest: Sequence[Item]) -> bool:
    """Of "Not at the first intersection, but at the second": counted from the same place."""
    item = next(
        (each for each in rest[: end_of_clause(rest, 0)] if each.kind is ItemKind.REF), None
    )
    return item is not None and corrects(place, item) and "at" in item.roles


def _is_contrast(before: Sequence[Item], negated: Item) -> bool:
    """Of "The second door, not the first": what is negated is of the kind that was named before."""
    named = [item for item in before if item.kind not in SOFT]
    return bool(named) and corrects(named[-1], negated) and "until" not in negated.roles


def _next_of(noun: Noun, item: Item) -> Item:
    """Of "The next" after a door that is not meant: one farther than that."""
    if item.kind is not ItemKind.REF or not item.value.is_next or not is_door(item.value):
        return item
    ordinal = (noun.ordinal or 1) + 1
    return replace(item, value=replace(item.value, ordinal=ordinal, is_next=False))


def _named_again(item: Item, noun: Noun) -> Item:
    """An item with "it" replaced by a noun that is not named elsewhere."""
    if item.kind is ItemKind.BEFORE_IT:
        return Item(ItemKind.REF, item.start, item.stop, noun, ("before",))
    is_it = item.kind is ItemKind.REF and item.value.kind == "it"
    if not is_it:
        return item
    return replace(item, value=replace(noun, at_end=noun.at_end or item.value.at_end))


def cut_before(items: Sequence[Item], at: int) -> int:
    """The end of what stands before a correction, without its comma."""
    while at > 0 and items[at - 1].kind in SOFT:
        at -= 1
    return at
