"""Statements that say where something is: "the kitchen is the third door on the right".

Such a text names one destination twice. The door or place tells the way, so the name is left out;
where there is no door, the name stays and what is said of it is left out.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from semnav_env.language.speech.items import JOINTS, Item, ItemKind
from semnav_env.language.speech.moves import is_door

_ENDS = (ItemKind.AND, ItemKind.THEN, ItemKind.VERB, ItemKind.IF, ItemKind.IN, ItemKind.BUT)


def without_labels(items: list[Item]) -> list[Item]:
    """The items with each destination named once."""
    items = _without_title(_without_restatement(items))
    at = 0
    while at < len(items):
        if _is_statement(items[at]):
            items = _told_once(items, at)
        at += 1
    return items


def _is_statement(item: Item) -> bool:
    return item.kind is ItemKind.VERB and item.value == "be"


def _is_name(item: Item) -> bool:
    return item.kind is ItemKind.REF and item.value.kind == "named"


def _without_title(items: list[Item]) -> list[Item]:
    """Drop "My office?" before the way to it."""
    title = next((i for i, item in enumerate(items[:4]) if item.value in ("?", ":")), None)
    if title is None or any(item.kind is ItemKind.COULD_YOU for item in items[:title]):
        return items
    named = [item for item in items[:title] if item.kind is ItemKind.REF]
    plain = items[0].kind is ItemKind.REF and all(
        item.kind in (ItemKind.REF, ItemKind.SIGN) or item.value == "be" for item in items[:title]
    )
    told = any(item.kind is ItemKind.REF and item.value.kind != "it" for item in items[title:])
    return items[title + 1 :] if plain and len(named) == 1 and told else items


def _without_restatement(items: list[Item]) -> list[Item]:
    """Of "Out of here, out of this room I mean": what stands before it is corrected."""
    found = list(items)
    for end, item in enumerate(items):
        rest = items[end + 1 :]
        last = all(each.kind is ItemKind.SIGN for each in rest)
        meant = item.value == "meant" and (last or rest[0].kind in JOINTS)
        commas = [i for i in range(end) if items[i].kind is ItemKind.SIGN]
        if item.kind is ItemKind.NO and (last or meant) and commas and commas[-1] < end - 1:
            at = commas[-1] + 1
            found[at : end + 1] = [item, *items[at:end]]
    return found


def _told_once(items: list[Item], at: int) -> list[Item]:
    """The items without the name or without what the statement at an item says of it."""
    stop = _end(items, at + 1)
    said = items[at + 1 : stop]
    doors = [item for item in said if item.kind is ItemKind.REF and is_door(item.value)]
    names = [item for item in said if _is_name(item) and not item.roles]
    subject = _subject(items, at)
    door = _before(items, at)
    if names and not doors and door is not None and is_door(items[door].value):
        if door == at - 1 and not items[door].roles:  # "the second door is the bath"
            return [item for item in items if item is not names[0]]
        return [*items[: door + 1], *items[stop:]]  # "through the second door, it is the bath"
    if subject is None or names:
        return items
    if doors:
        kept = [item for item in said if item.kind is not ItemKind.SIGN]
        return [*items[: _begin(items, subject)], items[at], *kept, *items[stop:]]
    if not any(item.kind in (ItemKind.UNKNOWN, ItemKind.NOT) for item in said):
        return [*items[: subject + 1], *items[stop:]]
    return items


def _is_door_item(item: Item) -> bool:
    return item.kind is ItemKind.REF and is_door(item.value) and not item.roles


def _end(items: Sequence[Item], at: int) -> int:
    """The end of a statement; a comma is in it if a door without a preposition follows."""
    while at < len(items) and items[at].kind not in _ENDS:
        if items[at].kind is ItemKind.SIGN:
            goes_on = items[at].value == "," and at + 1 < len(items)
            if not goes_on or not _is_door_item(items[at + 1]):
                return at
        at += 1
    return at


def _before(items: Sequence[Item], at: int) -> int | None:
    """What is named directly before a statement, or in the sentence before."""
    before = at - 1
    while before >= 0 and items[before].kind in (ItemKind.SIGN, ItemKind.HERE):
        before -= 1
    return before if before >= 0 and items[before].kind is ItemKind.REF else None


def _subject(items: Sequence[Item], at: int) -> int | None:
    """The name of a room of which a statement tells: before its verb, or in the sentence before."""
    before = _before(items, at)
    if before is None or not _is_name(items[before]):
        return None
    roles = set(items[before].roles)
    return before if not roles or roles & {"to", "into"} else None


def _begin(items: Sequence[Item], subject: int) -> int:
    """Where the clause of a name begins: with its verb if it has one."""
    roles = set(items[subject].roles)
    if not roles & {"to", "into"}:
        return subject
    while subject and items[subject - 1].kind in (ItemKind.VERB, ItemKind.COULD_YOU):
        subject -= 1
    return subject


def merged_names(items: Sequence[Item]) -> list[Item]:
    """Of "The kitchen door" and "the kitchen, the one on the right": the kitchen."""
    found: list[Item] = []
    for item in items:
        before = found[-1] if found else None
        if before is not None and _is_name(before) and _is_bare_door(item):
            front = ("to", "front") if "to" in before.roles else before.roles
            found[-1] = replace(before, stop=item.stop, roles=front)
            continue
        one = item.kind is ItemKind.REF and item.value.kind == "one" and not item.roles
        comma = before is not None and before.value == ","
        if one and comma and len(found) > 1 and _is_bound_for(found[-2]):
            found.pop()
            continue
        found.append(item)
    return found


def _is_bound_for(item: Item) -> bool:
    """Whether an item names a room to go to, and none that is passed."""
    return _is_name(item) and (not item.roles or bool(set(item.roles) & {"to", "into"}))


def _is_bare_door(item: Item) -> bool:
    if item.kind is not ItemKind.REF or item.roles or item.value.kind != "door":
        return False
    return item.value.ordinal is None and item.value.side is None
